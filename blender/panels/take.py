# SPDX-License-Identifier: GPL-3.0-or-later
"""Takes a picture of every panel, list, menu and dialog, inside Blender with a window. Run by ci/blender_panels.

    blender --factory-startup --python take.py -- FOLDER [WORDS]

FOLDER holds the zips, the example and sample.py. A step puts the scene into some state; a little later, when Blender has
drawn it, the picture is taken under the step's name.
"""

import struct
import sys
import traceback
import zlib
from pathlib import Path

import bpy
import numpy as np

FOLDER, *WORDS = sys.argv[sys.argv.index("--") + 1:]
FOLDER = Path(FOLDER)
sys.path.insert(0, str(FOLDER))
DRAWN_S = 0.8  # software needs that long for a window
REDRAWS = 3  # panels that open slide into their places

steps = []
bpy.context.preferences.view.show_splash = False


def step(function):
    """Registers a picture under the function's name."""
    if not WORDS or any(word in function.__name__ for word in WORDS) or function.__name__.startswith("prepare"):
        steps.append(function)
    return function


def window():
    return bpy.context.window_manager.windows[0]


def area(kind="VIEW_3D"):
    return max((each for each in window().screen.areas if each.type == kind), key=lambda each: each.width * each.height)


def in_view(operator, *arguments, **options):
    """Calls an operator as from the 3D view."""
    place = area()
    region = next(each for each in place.regions if each.type == "WINDOW")
    with bpy.context.temp_override(window=window(), area=place, region=region):
        return operator(*arguments, **options)


def choose(*names, mode="OBJECT"):
    if bpy.context.mode != "OBJECT":
        in_view(bpy.ops.object.mode_set, mode="OBJECT")
    for obj in bpy.context.view_layer.objects:
        obj.select_set(obj.name in names)
    bpy.context.view_layer.objects.active = bpy.data.objects[names[0]]
    if mode != "OBJECT":
        in_view(bpy.ops.object.mode_set, mode=mode)


def module(name):
    return sys.modules[f"bl_ext.user_default.{name}"]


def pong():
    return bpy.context.window_manager.pong


def settings():
    return next(obj for obj in bpy.context.scene.objects if obj.pong.role == "root").pong_model


# --- subjects --------------------------------------------------------------------------------------------------------


def install():
    """Both extensions as shipped, with the panels open that are closed at first.

    The tab in front cannot be chosen before Blender 5, so all panels go to the first one, "Item".
    """
    for archive in sorted(FOLDER.glob("pong_*.zip")):
        in_view(bpy.ops.extensions.package_install_files, filepath=str(archive), repo="user_default", enable_on_install=True)
    panels = [*module("pong_pmtk.ui.panels").CLASSES, module("pong_viz.ui").PONG_PT_response]
    for panel in panels:
        bpy.utils.unregister_class(panel)
        panel.bl_category = "Item"
        panel.bl_options = getattr(panel, "bl_options", set()) - {"DEFAULT_CLOSED"}
    for panel in panels:
        bpy.utils.register_class(panel)


def set_up():
    area().spaces.active.show_region_ui = True


def empty_scene():
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)


@step
def prepare_a_file():
    empty_scene()


@step
def a_no_model():
    """First view after installation."""


@step
def prepare_a_model():
    bpy.context.scene.unit_settings.length_unit = "MILLIMETERS"
    build_model()


def build_model():
    """A model with some of everything, made with the operators."""
    add = bpy.ops.mesh
    in_view(add.primitive_cube_add, size=0.1, location=(0, 0, 0.05))
    bpy.context.object.name = "housing"
    in_view(add.primitive_uv_sphere_add, radius=0.02, location=(0.2, 0, 0.02))
    bpy.context.object.name = "roller"
    in_view(add.primitive_cube_add, size=0.05, location=(-0.2, 0, 0.05))
    bpy.context.object.name = "stop"
    in_view(bpy.ops.object.empty_add, type="SINGLE_ARROW", location=(0, 0.2, 0), radius=0.05)
    bpy.context.object.name = "plunger"
    in_view(add.primitive_grid_add, size=0.6, location=(0, 0, 0))
    bpy.context.object.name = "terrain"
    choose("housing", "roller", "stop", "plunger", "terrain")
    in_view(bpy.ops.pong.mark, kind="PROPOSE")
    choose("housing", "roller", "stop", "plunger", "terrain")
    in_view(bpy.ops.pong.root_new, name="gripper")
    choose("housing", "stop", "terrain")
    in_view(bpy.ops.pong.group_new, name="base")
    choose("roller", "plunger")
    in_view(bpy.ops.pong.group_new, name="finger", movable=True, bound="Obb", origin="MEDIAN")
    choose("gripper")
    in_view(bpy.ops.pong.surface_add, name="rubber", stiffness=2.5e5)
    rubber = settings().surfaces["rubber"]
    rubber.normal, rubber.use_ramp = "Linear", True
    rubber.damping, rubber.ramp = 20.0, 0.00025
    rubber.friction, rubber.mu = "Bristle", 0.6
    rubber.use_bristle_stiffness, rubber.use_bristle_damping = True, True
    in_view(bpy.ops.pong.surface_add, name="steel", stiffness=1e6)
    in_view(bpy.ops.pong.surface_assign, surface="rubber")
    choose("housing", mode="EDIT")
    in_view(bpy.ops.mesh.select_mode, type="EDGE")
    in_view(bpy.ops.mesh.select_all, action="SELECT")
    in_view(bpy.ops.pong.mark_elements, kind="LineSegment", name="edge")
    choose("gripper")
    in_view(bpy.ops.view3d.view_all)


@step
def b_model_and_tree():
    choose("gripper")


@step
def c_group():
    choose("finger")


@step
def d_solid_with_parts():
    choose("housing")


@step
def e_parts_in_edit_mode():
    choose("housing", mode="EDIT")


@step
def f_sphere():
    choose("roller")
    bpy.data.objects["roller"].pong.radius = 0.00025


@step
def prepare_sphere_again():
    bpy.data.objects["roller"].pong.radius = 0.02


@step
def g_ray():
    choose("plunger")
    bpy.data.objects["plunger"].pong.use_reach = True


@step
def h_mesh():
    choose("terrain")
    bpy.data.objects["terrain"].pong.kind = "TriangleMesh"
    bpy.data.objects["terrain"].pong.use_thickness = True


@step
def i_surface_linear():
    choose("gripper")
    settings().active_surface = 0


@step
def j_surface_restitution():
    settings().surfaces["rubber"].use_restitution = True


@step
def k_surface_hertz():
    rubber = settings().surfaces["rubber"]
    rubber.normal, rubber.exponent, rubber.friction = "HuntCrossley", "HERTZ", "Coulomb"


@step
def l_pair():
    in_view(bpy.ops.pong.pair_add, first="rubber", second="steel")
    pair = settings().pairs[0]
    pair.use_stiffness, pair.normal, pair.friction = True, "Linear", "Bristle"


@step
def m_findings():
    in_view(bpy.ops.pong.pair_remove)
    for name in ("housing", "stop"):
        bpy.data.objects[name].data.flip_normals()
    choose("roller")
    bpy.data.objects["roller"].scale = (2, 2, 2)
    in_view(bpy.ops.object.transform_apply, location=False, rotation=False, scale=True)
    in_view(bpy.ops.pong.check)


@step
def n_finding_chosen():
    pong().active_finding = 1


@step
def o_overlays():
    in_view(bpy.ops.pong.findings_fix)
    for name in ("show_bounds", "show_normals", "show_rays", "show_round", "show_groups"):
        setattr(pong(), name, True)


@step
def prepare_without_overlays():
    for name in ("show_bounds", "show_normals", "show_rays", "show_round", "show_groups"):
        setattr(pong(), name, False)


@step
def q_export_dialog():
    choose("gripper")
    in_view(bpy.ops.pong.export_ron, "INVOKE_DEFAULT")


@step
def prepare_after_export():
    cancel_dialog()


@step
def r_import_dialog():
    in_view(bpy.ops.pong.import_ron, "INVOKE_DEFAULT")


@step
def prepare_after_import():
    cancel_dialog()


@step
def s_imported_model():
    empty_scene()
    path = next(path for path in sorted(FOLDER.glob("*.ron")) if '"pong-model"' in path.read_text())
    in_view(bpy.ops.pong.import_ron, filepath=str(path))
    in_view(bpy.ops.view3d.view_all)


@step
def t_response_dialog():
    in_view(bpy.ops.pong.import_response, "INVOKE_DEFAULT")


@step
def prepare_after_response():
    cancel_dialog()


@step
def u_response():
    import sample

    empty_scene()
    log = sample.write_log(FOLDER / "response")
    in_view(bpy.ops.pong.import_response, filepath=str(log / "run.json"))
    bpy.context.scene.frame_set(8)
    in_view(bpy.ops.view3d.view_camera)


@step
def v_menu_object():
    in_view(bpy.ops.mesh.primitive_cube_add, size=0.1)
    in_view(bpy.ops.wm.call_menu, name="PONG_MT_mark")


@step
def prepare_beside_the_menu():
    window().cursor_warp(250, 1200)  # beside the menu, which stays open


@step
def w_bind_dialog():
    in_view(bpy.ops.pong.bind_body, "INVOKE_DEFAULT")


def cancel_dialog():
    """Closes the windows that dialogs have opened."""
    for each in list(bpy.context.window_manager.windows)[1:]:
        with bpy.context.temp_override(window=each):
            bpy.ops.wm.window_close()


# --- screenshots -----------------------------------------------------------------------------------------------------


def take(name):
    """Image of the screen; Blender's own screenshot is black without a graphics card."""
    screen = (FOLDER / "screen" / "Xvfb_screen0").read_bytes()  # in the format of xwd
    header = struct.unpack(">25I", screen[:100])
    size, width, height, row, colors = header[0], header[4], header[5], header[12], header[19]
    pixels = np.frombuffer(screen, np.uint8, row * height, size + 12 * colors).reshape(height, row)[:, : 4 * width]
    rgb = pixels.reshape(height, width, 4)[:, :, 2::-1]
    (FOLDER / "pictures" / f"{name}.png").write_bytes(png(np.ascontiguousarray(rgb)))


def png(rgb):
    """An image of 8 bits for each of three channels."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    height, width, _ = rgb.shape
    rows = np.concatenate([np.zeros((height, 1), np.uint8), rgb.reshape(height, 3 * width)], axis=1)
    head = chunk(b"IHDR", struct.pack(">2I5B", width, height, 8, 2, 0, 0, 0))
    return b"\x89PNG\r\n\x1a\n" + head + chunk(b"IDAT", zlib.compress(rows.tobytes(), 6)) + chunk(b"IEND", b"")


def run():
    """Runs one step at a time, each in a separate timer call, so that Blender draws in between."""
    for function in (install, set_up):
        print(function.__name__, flush=True)
        function()
        yield
    for function in steps:
        print("step", function.__name__, flush=True)
        function()
        silent = function.__name__.startswith("prepare")
        for _ in range(1 if silent else REDRAWS):
            yield
            for place in (each for open_ in bpy.context.window_manager.windows for each in open_.screen.areas):
                place.tag_redraw()
        if not silent:
            yield
            take(function.__name__)
    print("all pictures taken", flush=True)


work = run()


def tick():
    try:
        next(work)
    except StopIteration:
        bpy.ops.wm.quit_blender()
        return None
    except Exception:
        traceback.print_exc()
        sys.stdout.flush()
        bpy.ops.wm.quit_blender()
        return None
    return DRAWN_S


bpy.app.timers.register(tick, first_interval=2.0)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the pictures of docs/modelling.md: one function for each, on the scene at its place in the page.

    python pictures.py NAME FOLDER TARGET.png

FOLDER holds the scenes that run.py saved, `picture_NAME.blend`. What the toolkit's overlays draw over the view of an
interface is drawn here as thin tubes, from the same lines (pong_pmtk/core/overlay.py).
"""

import os
import sys
from pathlib import Path

import bpy
import numpy as np
from mathutils import Vector

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import pong_pmtk  # noqa: E402
from pong_pmtk.core import overlay  # noqa: E402
from pong_pmtk.scene import session  # noqa: E402
from pong_pmtk.store import elements  # noqa: E402
from pong_viz import render  # noqa: E402

STEEL, PALE, INK = (0.56, 0.64, 0.74, 1.0), (0.80, 0.80, 0.78, 1.0), (0.05, 0.05, 0.06, 1.0)
BRASS = (0.85, 0.66, 0.32, 1.0)
MARKED, BOUND = (0.95, 0.42, 0.02, 1.0), (0.10, 0.35, 0.75, 1.0)
AXES = ((0.80, 0.08, 0.08, 1.0), (0.10, 0.55, 0.12, 1.0), (0.10, 0.25, 0.85, 1.0))
MM = 1e-3


# --- the stage -----------------------------------------------------------------------------------------------------


def stage(width, height):
    """White ground, outlines, colours of the objects."""
    scene = bpy.context.scene
    if scene.world is None:
        scene.world = bpy.data.worlds.new("white")
    render.prepare(scene, render.Picture(width, height))
    scene.world.color = (1.0, 1.0, 1.0)
    scene.view_settings.exposure = 0.5
    scene.render.dither_intensity = 0.0  # noise does not compress
    scene.render.image_settings.compression = 100
    shading = scene.display.shading
    shading.show_shadows, shading.show_object_outline, shading.background_type = False, True, "WORLD"
    shading.object_outline_color = (0.25, 0.25, 0.28)
    scene.display.render_aa = "16"
    return scene


def look(at_mm, direction, size_mm):
    """An orthographic camera: the picture's longer side shows `size_mm`."""
    data = bpy.data.cameras.new("picture")
    data.type, data.ortho_scale = "ORTHO", size_mm * MM
    camera = bpy.data.objects.new("picture", data)
    bpy.context.scene.collection.objects.link(camera)
    away = Vector(direction).normalized()
    camera.location = Vector(at_mm) * MM + away
    camera.rotation_mode = "QUATERNION"
    camera.rotation_quaternion = away.to_track_quat("Z", "Y")
    bpy.context.scene.camera = camera
    return camera


def paint(name, color, alpha=1.0):
    bpy.data.objects[name].color = (*color[:3], alpha)
    bpy.data.objects[name].hide_set(False)


def only(*names):
    """Hides meshes of other names."""
    for obj in bpy.context.scene.objects:
        if obj.type == "MESH":
            obj.hide_render = obj.name not in names


def tubes(name, lines, color, radius_mm=0.35):
    """Lines, an array of pairs of ends in metres, as tubes."""
    curve = bpy.data.curves.new(name, "CURVE")
    curve.dimensions, curve.bevel_depth, curve.bevel_resolution = "3D", radius_mm * MM, 3
    curve.use_fill_caps = True
    for start, end in np.asarray(lines, dtype=float).reshape(-1, 2, 3):
        spline = curve.splines.new("POLY")
        spline.points.add(1)
        spline.points[0].co, spline.points[1].co = (*start, 1.0), (*end, 1.0)
    return _placed(name, curve, color)


def balls(name, places, color, radius_mm):
    for place in places:
        bpy.ops.mesh.primitive_uv_sphere_add(radius=radius_mm * MM, location=place)
        bpy.ops.object.shade_smooth()
        bpy.context.object.name, bpy.context.object.color = name, color


def label(text, at_mm, color=INK, size_mm=6.0):
    """A label that faces the camera."""
    curve = bpy.data.curves.new(text, "FONT")
    curve.body, curve.size = text, size_mm * MM
    made = _placed(text, curve, color)
    camera = bpy.context.scene.camera
    nearer = camera.rotation_quaternion @ Vector((0.0, 0.0, 0.5))  # before all bodies: nothing hides it
    made.location = Vector(at_mm) * MM + nearer
    made.rotation_mode = "QUATERNION"
    made.rotation_quaternion = camera.rotation_quaternion
    return made


def _placed(name, data, color):
    made = bpy.data.objects.new(name, data)
    made.color = color
    bpy.context.scene.collection.objects.link(made)
    return made


# --- the pictures --------------------------------------------------------------------------------------------------


def jaw(target):
    """The marked edges of the jaw."""
    scene = stage(900, 620)
    look((-2, 0, 40), (1.1, -1.5, 0.75), 140)
    only("jaw")
    paint("jaw", STEEL)
    tubes("edges", part_lines(bpy.data.objects["jaw"]), MARKED, 0.7)
    label("ramp: 2 segments", (10, 15, 72), size_mm=5.0)
    label("catch: 2 segments", (-66, -15, 54), size_mm=5.0)
    render.still(scene, target, 1, caption=False)


def part_lines(obj):
    """Ends of the edges of an object's first part, in the common frame."""
    mesh, part = obj.data, obj.pong.parts[0]
    chosen = elements.indices(mesh, part.attribute, "edges")
    return [obj.matrix_world @ mesh.vertices[i].co for e in chosen for i in mesh.edges[e].vertices]


def tree(target):
    """Bounds and axes of the groups."""
    scene = stage(1000, 700)
    look((0, 0, 24), (1.0, -1.7, 0.85), 235)
    only("plate", "jaw")
    paint("plate", PALE, 0.4)
    paint("jaw", STEEL, 0.7)
    model, loaded = exported("latch")
    for path, lines in overlay.bounds_lines(model, loaded).items():
        tubes(path, lines, BOUND, 0.5)
    for path, lines in overlay.groups_lines(model, 0.022).items():
        for axis, color in enumerate(AXES):
            tubes(f"{path} {axis}", lines[2 * axis : 2 * axis + 2], color, 0.9)
    label("hook, movable: bound Obb", (14, 4, 74), BOUND, 6.5)
    label("its origin, on the hinge", (24, 0, 12), INK, 5.0)
    label("base: bound Aabb", (-66, -60, -50), BOUND, 6.5)
    render.still(scene, target, 1, caption=False)


def exported(name):
    """The model of a root, as written and as loaded by the engine, with a default surface if it has none yet."""
    root = bpy.data.objects[name]
    if not len(root.pong_model.surfaces):
        root.pong_model.surfaces.add().name = "any"
        root.pong_model.surfaces["any"].stiffness = 1e6
        root.pong.surface = "any"
    bpy.context.view_layer.update()
    result = session.check(bpy.context, name)
    if result.model is None:
        raise SystemExit("\n".join(map(str, result.findings)))
    return result.model, result.loaded


def striker(target):
    """The bar and the feet."""
    scene = stage(900, 620)
    look((0, 0, -4), (1.0, -1.7, 0.55), 235)
    only("bar", "left_post", "right_post", "cover")
    for name in ("left_post", "right_post", "cover"):
        paint(name, PALE, 0.4)
    paint("bar", MARKED)
    bpy.data.objects["bar"].scale.y *= 0.99  # its ends lie in the posts' sides, and would flicker
    feet = []
    for name in ("left_post", "right_post"):
        obj = bpy.data.objects[name]
        chosen = elements.indices(obj.data, obj.pong.parts[0].attribute, "vertices")
        feet += [obj.matrix_world @ obj.data.vertices[i].co for i in chosen]
    balls("foot", feet, MARKED, 2.2)
    label("bar: a Polyhedron", (40, 40, 16), size_mm=6.5)
    label("feet: 8 Points", (10, 0, -64), size_mm=6.5)
    render.still(scene, target, 1, caption=False)


def opening(target):
    """The bar passes the nose: the page's first picture."""
    scene = stage(1000, 720)
    graphics()
    look((0, 0, 51), (0.9, -1.7, 0.6), 262)
    render.still(scene, target, picture_at(scene, 0.30), caption=False)


def graphics():
    for name, color, alpha in (("plate", PALE, 1.0), ("jaw", STEEL, 1.0), ("bar", BRASS, 0.75),
                               ("left_post", PALE, 0.35), ("right_post", PALE, 0.35), ("cover", PALE, 0.35)):
        paint(name, color, alpha)


def picture_at(scene, time_s):
    """The picture of an instant: the run of 1.5 s fills the scene's frames."""
    return round(scene.frame_start + (scene.frame_end - scene.frame_start) * time_s / 1.5)


def capture(target):
    """Four instants side by side, seen along the bar: ramp, nose, feet, pull."""
    scene = stage(420, 520)
    graphics()
    for name, color, alpha in (("plate", PALE, 1.0), ("jaw", STEEL, 0.85), ("bar", BRASS, 0.6), ("right_post", PALE, 0.3)):
        paint(name, color, alpha)
    for name in ("left_post", "cover"):
        bpy.data.objects[name].hide_render = True
    look((0, 0, 42), (0, -1, 0), 130)
    panels = []
    for time_s in (0.20, 0.36, 0.50, 1.40):
        path = target.with_name(f".{target.stem}_{time_s}.png")
        caption = label(f"t = {time_s:.2f} s", (-24, 0, -17), size_mm=6.0)
        render.still(scene, path, picture_at(scene, time_s), caption=False)
        bpy.data.objects.remove(caption)
        panels.append(pixels(path))
        path.unlink()
    save(np.concatenate(panels, axis=1), target)


def pixels(path):
    image = bpy.data.images.load(str(path))
    image.colorspace_settings.name = "Non-Color"
    width, height = image.size
    found = np.empty(width * height * 4, dtype=np.float32)
    image.pixels.foreach_get(found)
    return found.reshape(height, width, 4)


def save(values, target):
    height, width, _ = values.shape
    image = bpy.data.images.new("picture", width, height)
    image.colorspace_settings.name = "Non-Color"
    image.pixels.foreach_set(np.ascontiguousarray(values).ravel())
    image.save_render(str(target), quality=100)


PICTURES = {function.__name__: function for function in (jaw, tree, striker, opening, capture)}
SCENES = {"opening": "capture"}  # the picture stands on the page before its scene is made


def main():
    name, folder, target = sys.argv[1], Path(sys.argv[2]).resolve(), Path(sys.argv[3]).resolve()
    pong_pmtk.register()
    bpy.ops.wm.open_mainfile(filepath=str(folder / f"picture_{SCENES.get(name, name)}.blend"))
    PICTURES[name](target)


main()
sys.stdout.flush()
os._exit(0)  # Blender as a module does not always survive its own exit

# SPDX-License-Identifier: GPL-3.0-or-later
"""The interface as far as it works without a display: overlays up to the lines that are drawn, lists, registration."""

import math
import types

import bpy
import numpy as np
import pong_pmtk
from pong_pmtk.store.state import state
from pong_pmtk.ui import lists, overlay, panels

from .scenes import CUBE, InBlender, activate, edit, mark, mesh, new, root


class Overlays(InBlender):
    def shown(self, **toggles):
        for name, value in toggles.items():
            setattr(state(bpy.context), name, value)
        bpy.context.view_layer.update()
        overlay.refresh(bpy.context)
        return overlay._shown.get(bpy.context.scene.name, {})

    def tearDown(self):
        for name in overlay.COLOURS:
            setattr(state(bpy.context), name, False)

    def test_bounds_stand_around_the_mesh_wherever_the_root_stands(self):
        top = root(location=(10, 0, 0), rotation=(0, 0, math.pi / 2))
        mark(new("block", mesh(CUBE), top, location=(3, 0, 0)), kind="Polyhedron")
        points = self.shown(show_bounds=True)["show_bounds"]
        np.testing.assert_allclose(points.min(axis=0), (9, 2, -1), atol=1e-5)
        np.testing.assert_allclose(points.max(axis=0), (11, 4, 1), atol=1e-5)

    def test_lines_are_in_the_units_of_the_scene(self):
        bpy.context.scene.unit_settings.scale_length = 0.001
        mark(new("ray", parent=root(), location=(500, 0, 0)), kind="Ray", length=250.0)
        points = self.shown(show_rays=True)["show_rays"]
        np.testing.assert_allclose(points, [(500, 0, 0), (500, 0, 250)], atol=1e-4)

    def test_normals_point_outward(self):
        mark(new("block", mesh(CUBE), root()), kind="Polyhedron")
        ends = self.shown(show_normals=True)["show_normals"].reshape(-1, 2, 3)
        self.assertEqual(len(ends), 6)
        self.assertTrue((np.linalg.norm(ends[:, 1], axis=1) > np.linalg.norm(ends[:, 0], axis=1)).all())

    def test_a_faulty_model_shows_nothing_and_says_so(self):
        mark(new("block", mesh((CUBE[0], CUBE[1][1:])), root()), kind="Polyhedron")
        self.assertFalse(self.shown(show_groups=True))
        self.assertIn("1 error", overlay.message(bpy.context))

    def test_changes_are_followed_in_a_pause(self):
        block = mark(new("block", mesh(CUBE), root()), kind="Polyhedron")
        self.shown(show_bounds=True)
        block.location.x = 5
        bpy.context.view_layer.update()
        self.assertTrue(bpy.app.timers.is_registered(overlay.in_pause))
        overlay.in_pause()
        points = overlay._shown[bpy.context.scene.name]["show_bounds"]
        self.assertAlmostEqual(points[:, 0].max(), 6.0, places=5)

    def test_what_only_marks_and_settings_know_is_followed_too(self):
        """Blender reports transforms and meshes, but not *Assign to Selected* and similar changes."""
        top = root()
        top.pong.surface = ""
        block = mark(new("block", mesh(CUBE), top), kind="Polyhedron")
        self.assertFalse(self.shown(show_bounds=True))
        self.assertIn("1 error", overlay.message(bpy.context))
        activate(block)
        for change, rows in (
            (lambda: bpy.ops.pong.surface_assign(surface="steel"), 12),
            (lambda: setattr(top.pong, "bound", "Sphere"), 144),
            (lambda: setattr(top.pong, "bound", "Aabb"), 12),
            (lambda: bpy.ops.pong.unmark(), 0),
        ):
            if bpy.app.timers.is_registered(overlay.in_pause):
                bpy.app.timers.unregister(overlay.in_pause)
            change()
            self.assertTrue(bpy.app.timers.is_registered(overlay.in_pause))
            overlay.in_pause()
            overlay.refresh(bpy.context)  # the module has no window
            self.assertEqual(len(overlay._shown.get(bpy.context.scene.name, {}).get("show_bounds", ())), 2 * rows)

    def test_nothing_is_worked_out_while_all_is_off(self):
        mark(new("block", mesh(CUBE), root()), kind="Polyhedron")
        self.assertFalse(self.shown())
        overlay.later()
        self.assertFalse(bpy.app.timers.is_registered(overlay.in_pause))


class Lists(InBlender):
    def test_the_tree_lists_parents_before_children_and_nothing_else(self):
        top = root()
        group = mark(new("z_group", parent=top), "group")
        mark(new("a_tip", parent=group), kind="Point")
        new("lamp")
        activate(group)
        found = types.SimpleNamespace(filter_name="", bitflag_filter_item=1)
        flags, order = lists.PONG_UL_tree.filter_items(found, bpy.context, bpy.context.scene, "objects")
        names = [obj.name for obj in bpy.context.scene.objects]
        shown = sorted((place, name) for place, name, flag in zip(order, names, flags) if flag)
        self.assertEqual([name for _, name in shown], ["model", "z_group", "a_tip"])
        self.assertEqual(sorted(order), list(range(len(names))))

    def test_every_line_of_the_tree_is_indented_by_what_it_hangs_below(self):
        top = root()
        group = mark(new("group", parent=new("only_a_transform", parent=top)), "group")
        tip = mark(new("tip", parent=group), kind="Point")
        self.assertEqual([lists.depth(obj) for obj in (top, group, tip)], [0, 1, 2])
        for obj, depth in ((top, 0), (group, 1), (tip, 2)):
            recorder = Recorder()
            # Blender makes a list anew for every line, so one that has filtered nothing must work.
            lists.PONG_UL_tree.draw_item(types.SimpleNamespace(), bpy.context, recorder, None, obj, 0, None, "", 0)
            self.assertAlmostEqual(sum(recorder.separators), lists.INDENT * depth)

    def test_a_click_in_the_tree_selects(self):
        top = root()
        first, second = (mark(new(name, mesh(CUBE), top), kind="Polyhedron") for name in "ab")
        activate(first)
        found = state(bpy.context)
        objects = bpy.context.scene.objects
        self.assertEqual(objects[found.active_object], first)
        found.active_object = objects.find("b")
        self.assertEqual((bpy.context.view_layer.objects.active, first.select_get(), second.select_get()),
                         (second, False, True))
        edit(second)
        found.active_object = objects.find("a")
        self.assertEqual((bpy.context.mode, bpy.context.view_layer.objects.active), ("OBJECT", first))

    def test_the_tree_tells_kinds_and_parts(self):
        obj = new("block", mesh(CUBE), root())
        part = pong_pmtk.core.marks.Part("p", "Point", vertices=[0])
        for fields, text in (({"kind": "Polyhedron"}, "Polyhedron"), ({"parts": [part]}, "1 part"),
                             ({"kind": "Polyhedron", "parts": [part, part]}, "Polyhedron + 2 parts")):
            self.assertEqual(lists.contents(mark(obj, **fields).pong), text)

    def test_long_texts_are_wrapped(self):
        lines = panels.wrapped("word " * 50, 300)
        self.assertTrue(all(len(line) <= 300 // 7 for line in lines))
        self.assertEqual(" ".join(lines).split(), ["word"] * 50)


class Panels(InBlender):
    """Panels are drawn into a recorder: Blender draws none without a window."""

    def drawn(self):
        """(property group, name) of all that is shown."""
        recorder = Recorder()
        for panel in panels.CLASSES:
            if getattr(panel, "poll", lambda _context: True)(bpy.context):
                panel.draw(Drawn(panel, recorder), Context())
        return recorder.shown

    def test_every_panel_names_only_what_exists(self):
        self.drawn()
        top = root()
        obj = mark(new("block", mesh(CUBE), top), kind="Polyhedron", parts=[pong_pmtk.core.marks.Part("p", "Point")])
        for kind in pong_pmtk.core.marks.KINDS:
            top.pong_model.surfaces[0].normal = "Linear"
            activate(mark(new(kind, parent=top), kind=kind))
            self.drawn()
        for normal in ("DEFAULT", "Linear", "HuntCrossley", "PowerLaw", "Custom"):
            for friction in ("DEFAULT", "Bristle", "Coulomb", "Custom"):
                surface = top.pong_model.surfaces[0]
                surface.normal, surface.friction = normal, friction
                self.drawn()
        activate(obj)
        bpy.ops.pong.pair_add()
        bpy.ops.pong.check()
        self.drawn()
        activate(top)
        self.drawn()


    def test_an_object_with_parts_shows_its_kind(self):
        part = pong_pmtk.core.marks.Part("p", "Point", vertices=[0])
        activate(mark(new("block", mesh(CUBE), root()), kind="Polyhedron", parts=[part]))
        self.assertIn("kind", [name for _, name in self.drawn()])

    def test_no_number_is_shown_without_its_unit(self):
        """Numbers with a dimension; Blender's own fields support only lengths, with a fixed number of decimals."""
        top = root()
        surface = top.pong_model.surfaces[0]
        bare = {"order", "leaf_size", "file_scale", "normal_length"}  # counts and shares
        seen = set()
        for normal, friction, restitution in (("Linear", "Bristle", True), ("Linear", "Coulomb", False),
                                              ("HuntCrossley", "Bristle", True), ("HuntCrossley", "Bristle", False),
                                              ("PowerLaw", "Bristle", True), ("PowerLaw", "Bristle", False)):
            surface.normal, surface.friction, surface.use_restitution = normal, friction, restitution
            for kind in ("Sphere", "Ellipsoid", "Ray", "TriangleMesh"):
                obj = mark(new(kind, mesh(CUBE), top), kind=kind, file="a.obj", reach=0.01, thickness=0.01)
                activate(obj)
                for holder, name in self.drawn():
                    definition = holder.bl_rna.properties[name]
                    if definition.type in ("FLOAT", "INT") and name not in bare and not name.startswith("active_"):
                        self.assertEqual((name, definition.unit), (name, "LENGTH"))
                        self.assertGreaterEqual(definition.precision, 6)
                        seen.add(name)
        self.assertEqual(seen, {"radius", "semi_axes", "length", "reach", "thickness"})


class Drawn:
    """Replacement of a panel; its methods are those of the panel's class."""

    def __init__(self, panel, layout):
        self.panel, self.layout = panel, layout

    def __getattr__(self, name):
        return getattr(self.panel, name).__get__(self)


class Context:
    """The context of a panel in a 3D view."""

    region = types.SimpleNamespace(width=300)

    def __getattr__(self, name):
        return getattr(bpy.context, name)


class Recorder:
    """A layout that draws nothing, and fails where Blender's would report an error."""

    def __init__(self, above=None):
        self.separators = above.separators if above else []
        self.shown = above.shown if above else []  # (property group, name)

    def prop(self, data, name, **_options):
        assert name in data.bl_rna.properties, f"{data.bl_rna.identifier} has no {name}"
        self.shown.append((data, name))

    def prop_search(self, data, name, search_data, search_name, **_options):
        self.prop(data, name)
        self.prop(search_data, search_name)

    def template_list(self, kind, _id, data, name, active, active_name, **_options):
        assert hasattr(bpy.types, kind), kind
        self.prop(data, name)
        self.prop(active, active_name)

    def operator(self, name, **_options):
        module, function = name.split(".")
        getattr(getattr(bpy.ops, module), function).get_rna_type()  # raises if there is none
        return types.SimpleNamespace()

    def operator_menu_enum(self, name, enum, **_options):
        module, function = name.split(".")
        assert enum in getattr(getattr(bpy.ops, module), function).get_rna_type().properties, (name, enum)

    def label(self, **_options):
        pass

    def separator(self, factor=1.0):
        self.separators.append(factor)

    def _inner(self, **_options):
        return Recorder(self)

    row = column = box = grid_flow = _inner

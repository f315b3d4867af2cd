# SPDX-License-Identifier: GPL-3.0-or-later
"""What of the interface works without a screen: overlays up to the lines that are drawn, lists, registration."""

import math
import types

import bpy
import numpy as np
import pong_pmtk
from pong_pmtk.store.state import state
from pong_pmtk.ui import lists, overlay, panels

from .scenes import CUBE, InBlender, activate, mark, mesh, new, root


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
        self.assertEqual(found.depths, {"model": 0, "z_group": 1, "a_tip": 2})

    def test_long_texts_are_wrapped(self):
        lines = panels.wrapped("word " * 50, 300)
        self.assertTrue(all(len(line) <= 300 // 7 for line in lines))
        self.assertEqual(" ".join(lines).split(), ["word"] * 50)


class Panels(InBlender):
    """Panels are drawn into a recorder: Blender itself draws none without a window."""

    def drawn(self):
        for panel in panels.CLASSES:
            if getattr(panel, "poll", lambda _context: True)(bpy.context):
                recorder = Recorder()
                panel.draw(Drawn(panel, recorder), Context())

    def test_every_panel_names_only_what_exists(self):
        self.drawn()
        top = root()
        obj = mark(new("block", mesh(CUBE), top), kind="Polyhedron", parts=[pong_pmtk.core.marks.Part("p", "Point")])
        for kind in pong_pmtk.core.marks.KINDS:
            top.pong_model.surfaces[0].normal = "Linear"
            activate(mark(new(kind, parent=top), kind=kind))
            self.drawn()
        for normal in ("DEFAULT", "Linear", "HuntCrossley", "Custom"):
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


class Drawn:
    """Stands for a panel; its methods are those of the panel's class."""

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
    """A layout that draws nothing, and fails where Blender's would complain."""

    def prop(self, data, name, **_options):
        assert name in data.bl_rna.properties, f"{data.bl_rna.identifier} has no {name}"

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

    def _inner(self, **_options):
        return Recorder()

    row = column = box = grid_flow = _inner

# SPDX-License-Identifier: GPL-3.0-or-later
"""Rows of round parts, horizontal pins, rigid surfaces, library overrides, and repairs of whole objects."""

import tempfile
from pathlib import Path

import bpy
import numpy as np
from pong_pmtk.core.write import write_text
from pong_pmtk.scene import fixes
from pong_pmtk.store import marks, presets
from pong_pmtk.store.state import state
from pong_pmtk.store.surfaces import OF_PARTNER

from .scenes import CUBE, InBlender, activate, mark, mesh, new, root

ADD = {
    "Cylinder": lambda: bpy.ops.mesh.primitive_cylinder_add(radius=0.003, depth=0.02),
    "Capsule": lambda: bpy.ops.mesh.primitive_cylinder_add(radius=0.003, depth=0.02),
    "Sphere": lambda: bpy.ops.mesh.primitive_uv_sphere_add(radius=0.003),
    "Ellipsoid": lambda: bpy.ops.mesh.primitive_uv_sphere_add(radius=0.003),
}


def added(kind, parent, name="pin"):
    ADD[kind]()
    obj = bpy.context.object
    obj.name, obj.parent = name, parent
    activate(obj)
    return obj


class Rows(InBlender):
    """Array and Mirror on round kinds: a body for each copy, of its own size."""

    def test_an_array_gives_bodies_of_the_size_of_one(self):
        for kind in ADD:
            with self.subTest(kind):
                bpy.ops.wm.read_factory_settings(use_empty=True)
                pin = added(kind, root())
                array = pin.modifiers.new("Array", "ARRAY")
                array.count, array.relative_offset_displace = 4, (3.0, 0.0, 0.0)
                bpy.ops.pong.mark(kind=kind)
                self.assertEqual(self.rules(), set())
                parts = self.primitives()
                self.assertEqual(sorted(parts), [f"pin_{index}" for index in range(4)])
                for index in range(4):
                    fields, x = parts[f"pin_{index}"].fields, 0.018 * index
                    self.assertIn(fields.get("radius", fields.get("semi_axes")), (0.003, (0.003,) * 3))
                    middle = fields.get("center", np.mean(fields.get("ends", [(0, 0, 0)]), axis=0))
                    np.testing.assert_allclose(middle, (x, 0.0, 0.0), atol=1e-8)
                    if "ends" in fields:
                        length = 0.02 if kind == "Cylinder" else 0.014
                        np.testing.assert_allclose(np.ptp(fields["ends"], axis=0), (0.0, 0.0, length), atol=1e-8)

    def test_a_mirror_gives_the_image_too(self):
        top = root()
        pin = added("Cylinder", top)
        bpy.ops.pong.mark(kind="Cylinder")  # before the modifier: the mark is right already
        center = new("center", parent=top, location=(0.05, 0.0, 0.0))
        pin.modifiers.new("Mirror", "MIRROR").mirror_object = center
        parts = self.primitives()
        self.assertEqual(self.rules(), set())
        self.assertEqual([parts[f"pin_{index}"].fields["ends"][0] for index in (0, 1)], [(0.0, 0.0, -0.01), (0.1, 0.0, -0.01)])

    def test_a_row_of_something_else_is_refused(self):
        box = mark(new("box", mesh(([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0.1, 0.1, 1)], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)])),
                       root()), kind="Cylinder", length=1.0, radius=0.5)
        box.modifiers.new("Array", "ARRAY").relative_offset_displace = (3.0, 0.0, 0.0)
        (finding,) = [each for each in self.check().findings if each.severity == "error"]
        self.assertEqual(finding.rule, "pieces-not-round")
        self.assertIn("Array", finding.cause)


class Pins(InBlender):
    def test_as_wide_as_long_it_is_told_and_no_repair_is_offered(self):
        bpy.ops.mesh.primitive_cylinder_add(radius=0.003, depth=0.006)
        lug = bpy.context.object
        lug.name, lug.parent = "lug", root()
        activate(lug)
        bpy.ops.pong.mark(kind="Capsule")
        self.assertEqual((lug.pong.length, round(lug.pong.radius, 9)), (0.0, 0.003))
        (finding,) = [each for each in self.check().findings if each.severity == "error"]
        self.assertEqual((finding.rule, finding.fix), ("no-length", ""))
        self.assertIn("0.006 long and 0.006 wide", finding.cause)
        with self.assertRaisesRegex(fixes.FixFault, "a Capsule is longer than wide; choose another kind"):
            fixes.run(bpy.context, "fit-round", lug)

    def test_one_that_lies_is_turned_and_stays_in_place(self):
        for kind, length in (("Cylinder", 0.02), ("Capsule", 0.014)):
            bpy.ops.wm.read_factory_settings(use_empty=True)
            pin = added(kind, root())
            pin.rotation_euler, pin.location = (0.0, np.radians(90.0), 0.0), (0.1, 0.2, 0.3)
            child = new("child", parent=pin, location=(0.0, 0.0, 0.02))
            bpy.ops.object.transform_apply(location=False, rotation=True, scale=False)
            bpy.ops.pong.mark(kind=kind)
            bpy.context.view_layer.update()
            before = np.array(child.matrix_world)
            self.assertEqual(self.rules(), {"axis-not-shown"})
            bpy.ops.pong.check()
            bpy.ops.pong.findings_fix(rule="")
            self.assertEqual(self.rules(), set())
            ends = np.sort(np.array(self.primitives()["pin"].fields["ends"]), axis=0)
            np.testing.assert_allclose(ends, [(0.1 - length / 2, 0.2, 0.3), (0.1 + length / 2, 0.2, 0.3)], atol=1e-7)
            np.testing.assert_allclose(np.array(child.matrix_world), before, atol=1e-6)


class Rigid(InBlender):
    def surface(self):
        activate(root())
        bpy.ops.pong.surface_add(name="hard", stiffness=5e5)
        return bpy.data.objects["model"].pong_model.surfaces["hard"]

    def label(self, surface, name):
        chosen = getattr(surface, name)
        return bpy.types.UILayout.enum_item_name(surface, name, chosen)

    def test_it_leaves_friction_to_what_it_meets(self):
        surface = self.surface()
        self.assertEqual((surface.friction, self.label(surface, "normal")), ("Bristle", "Undamped"))
        surface.rigid = True
        self.assertEqual((surface.friction, surface.normal), ("DEFAULT", "DEFAULT"))
        self.assertEqual((self.label(surface, "friction"), self.label(surface, "normal")), (OF_PARTNER, OF_PARTNER))
        self.assertIn('"hard": (stiffness: inf),', write_text(self.with_ball()))
        surface.rigid = False
        self.assertEqual((surface.friction, round(surface.mu, 7), surface.stiffness), ("Bristle", 0.2, 5e5))

    def with_ball(self):
        mark(new("ball", parent=bpy.data.objects["model"]), kind="Sphere", radius=0.1)
        return self.check().model

    def test_friction_that_is_given_stays_and_is_told(self):
        surface = self.surface()
        surface.mu = 0.3
        surface.rigid = True
        self.assertEqual(surface.friction, "Bristle")
        self.with_ball()
        (finding,) = [each for each in self.check().findings if each.rule == "rigid-friction"]
        self.assertEqual(finding.severity, "hint")
        self.assertIn("μ of 0.1 there becomes 0.15", finding.cause)


class Overrides(InBlender):
    """Marks on library overrides: changed, saved, opened again; and beside their originals."""

    def setUp(self):
        super().setUp()
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)
        collection = bpy.data.collections.new("latches")
        bpy.context.scene.collection.children.link(collection)
        body, tip = new("hook", mesh(CUBE)), new("tip", location=(3.0, 0.0, 0.0))
        base, plain = root("base"), new("plain", location=(5.0, 0.0, 0.0))
        for obj in (body, tip, base, plain):
            collection.objects.link(obj)
            bpy.context.scene.collection.objects.unlink(obj)
        mark(body, kind="Polyhedron")
        mark(tip, kind="Ray", length=0.4, reach=0.5)
        bpy.ops.wm.save_as_mainfile(filepath=str(self.folder / "lib.blend"))
        bpy.ops.wm.read_factory_settings(use_empty=True)
        with bpy.data.libraries.load(str(self.folder / "lib.blend"), link=True) as (_, into):
            into.collections = ["latches"]
        self.linked = into.collections[0]
        bpy.context.scene.collection.children.link(self.linked)
        bpy.context.view_layer.update()
        self.linked.override_hierarchy_create(bpy.context.scene, bpy.context.view_layer, do_fully_editable=True)
        self.hook, self.tip, self.base, self.plain = map(self.own, ("hook", "tip", "base", "plain"))

    def own(self, name):
        return next(obj for obj in bpy.data.objects if obj.name == name and not obj.library)

    def reopened(self):
        path = str(self.folder / "over.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.open_mainfile(filepath=path)

    def test_what_is_changed_is_saved(self):
        self.tip.pong.length, self.tip.pong.label, self.tip.pong.use_reach = 0.123456, "nose", False
        self.hook.pong.kind, self.hook.pong.thickness = "TriangleMesh", 0.25
        before = [marks.read_mark(obj) for obj in (self.hook, self.tip)]
        self.reopened()
        self.assertEqual([marks.read_mark(self.own(name)) for name in ("hook", "tip")], before)
        self.assertEqual((before[1].length, before[1].reach, before[0].thickness), (0.123456, None, 0.25))

    def test_a_root_around_overrides_beside_their_originals(self):
        activate(self.hook, self.tip)
        self.assertEqual(bpy.ops.pong.root_new(name="over"), {"FINISHED"})
        bpy.ops.pong.surface_add(name="s", stiffness=1e5)
        bpy.ops.pong.surface_assign(surface="s")
        self.tip.pong.kind = "Point"
        parts = self.primitives("over")
        self.assertEqual(sorted((part.kind, name) for name, part in parts.items()), [("Point", "tip"), ("Polyhedron", "hook")])
        self.assertEqual(self.rules("over"), set())
        text = write_text(self.check("over").model)
        self.reopened()
        self.assertEqual(write_text(self.check("over").model), text)

    def test_settings_of_a_root_that_is_an_override(self):
        surfaces = self.base.pong_model.surfaces
        surfaces["steel"].stiffness, surfaces["steel"].normal, surfaces["steel"].damping = 123456.0, "Linear", 12.5
        surfaces["steel"].use_ramp = True
        activate(self.base)
        bpy.ops.pong.surface_add(name="hard")
        surfaces["hard"].rigid = True
        bpy.ops.pong.pair_add(first="steel", second="hard")
        before = marks.read_settings(self.base)
        self.assertEqual((len(before.surfaces), len(before.pairs)), (2, 1))
        self.reopened()
        self.assertEqual(marks.read_settings(self.own("base")), before)

    def test_an_override_of_what_was_never_marked(self):
        activate(self.plain)
        bpy.ops.pong.mark(kind="Sphere")
        self.plain.pong.radius = 0.3
        before = marks.read_mark(self.plain)
        self.reopened()
        self.assertEqual(marks.read_mark(self.own("plain")), before)


class Repairs(InBlender):
    def test_primitives_beside_groups_get_a_group(self):
        top = root()
        arm = mark(new("arm", parent=top), "group")
        mark(new("ball", parent=arm), kind="Sphere", radius=0.1)
        solid = mark(new("solid", mesh(CUBE), top, location=(5.0, 0.0, 0.0)), kind="Polyhedron")
        helper = new("helper", parent=top, location=(0.0, 5.0, 0.0))
        mark(new("tip", parent=helper), kind="Point")
        bpy.ops.pong.check()
        (finding,) = [each for each in state(bpy.context).findings if each.severity == "error"]
        self.assertEqual((finding.rule, finding.fix), ("groups-and-primitives", "group-primitives"))
        bpy.ops.pong.findings_fix(rule="")
        parts = self.primitives()
        self.assertEqual(solid.parent.name, "parts")
        self.assertEqual(parts["tip"].fields["position"], (0.0, 5.0, 0.0))
        self.assertEqual(self.rules(), set())

    def test_the_mark_of_a_copy_is_taken_away_and_its_elements_stay_with_the_other(self):
        top = root()
        first = mark(new("pad", mesh(CUBE), top), kind="Polyhedron", inactive_faces=[])
        copy = first.copy()
        bpy.context.scene.collection.objects.link(copy)
        copy.name = "pad_copy"
        bpy.ops.pong.check()
        (finding,) = [each for each in state(bpy.context).findings if each.rule == "same-place"]
        self.assertEqual((finding.fix, finding.object), ("unmark-copy", "pad_copy"))
        bpy.ops.pong.findings_fix(rule="same-place")
        self.assertEqual((first.pong.role, copy.pong.role, self.rules()), ("primitive", "none", set()))

    def test_unmarking_a_copy_leaves_parts_of_a_shared_mesh(self):
        top = root()
        first = new("pad", mesh(CUBE), top)
        marks.write_mark(first, marks.Mark("primitive", parts=[marks.Part("feet", "Point", vertices=[0, 1])]))
        copy = first.copy()
        bpy.context.scene.collection.objects.link(copy)
        marks.clear_mark(copy)
        self.assertEqual(marks.read_mark(first).parts[0].vertices, [0, 1])

    def test_presets_are_damped_and_say_from_what(self):
        activate(root())
        for name in presets.STANDARD:
            self.assertEqual(bpy.ops.pong.preset_load(preset=name), {"FINISHED"})
            surface = bpy.data.objects["model"].pong_model.surfaces[name]
            self.assertEqual((surface.normal, surface.restitution, surface.mass), ("Linear", 0.5, 1.0))
            self.assertIn("no property of the material: give the mass", presets.source_of(name))
        mark(new("ball", parent=bpy.data.objects["model"]), kind="Sphere", radius=0.1)
        self.assertEqual(self.rules(), set())

    def test_a_group_around_what_was_placed_adds_no_rounding(self):
        activate(mark(new("ball", location=(0.1, 0.2, 0.3)), kind="Sphere", radius=0.1))
        bpy.ops.pong.root_new(name="thing")
        bpy.ops.pong.surface_add(name="s")
        bpy.ops.pong.surface_assign(surface="s")
        activate(bpy.data.objects["ball"])
        bpy.context.scene.cursor.location = (0.05, 0.0, 0.1)
        bpy.ops.pong.group_new(name="arm", movable=True, origin="CURSOR")
        text = write_text(self.check("thing").model)
        self.assertIn("position: (0.05, 0.0, 0.1)", text)
        self.assertIn("center: (0.05, 0.2, 0.2)", text)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks under Blender's own tools (Apply Scale, Join, Duplicate, modifiers)."""

import bpy
import numpy as np
from pong_pmtk.core.marks import Part
from pong_pmtk.scene import fixes, proposal
from pong_pmtk.store import elements, marks
from pong_pmtk.store.state import state

from .scenes import CUBE, InBlender, activate, edit, mark, mesh, new, root


class Authors(InBlender):
    def findings(self, rule):
        bpy.ops.pong.check()
        return [item for item in state(bpy.context).findings if item.rule == rule]

    def fix_all(self, rule=""):
        bpy.ops.pong.findings_fix(rule=rule)
        return {item.rule for item in state(bpy.context).findings}


def ball(parent, radius=0.5, **options):
    bpy.ops.mesh.primitive_uv_sphere_add(radius=radius)
    obj = bpy.context.object
    obj.parent = parent
    for name, value in options.items():
        setattr(obj, name, value)
    activate(obj)
    bpy.ops.pong.mark(kind="PROPOSE")
    return obj


class Sizes(Authors):
    def test_apply_scale_is_told_and_mended(self):
        obj = ball(root())
        obj.scale = (2, 2, 2)
        self.assertEqual(self.findings("size-not-shown"), [])
        bpy.ops.object.transform_apply(location=False, rotation=False, scale=True)
        (found,) = self.findings("size-not-shown")
        self.assertIn("a Sphere of radius 1 m, its mark says a Sphere of radius 0.5 m", found.cause)
        self.assertEqual(self.fix_all(), set())
        self.assertAlmostEqual(self.primitives()["Sphere"].fields["radius"], 1.0, places=5)

    def test_scaling_in_edit_mode_is_told_even_there(self):
        obj = ball(root())
        edit(obj)
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.transform.resize(value=(1, 1, 3))
        (found,) = self.findings("size-not-shown")
        self.assertEqual(found.fix, "fit-ellipsoid")
        self.assertEqual(self.fix_all(), set())
        bpy.ops.object.mode_set(mode="OBJECT")
        found = self.primitives()["Sphere"]
        self.assertEqual(found.kind, "Ellipsoid")
        np.testing.assert_allclose(found.fields["semi_axes"], (0.5, 0.5, 1.5), rtol=1e-5)

    def test_an_empty_that_is_scaled_is_told(self):
        top = root()
        for kind, sizes, shape, fix in (
            ("Sphere", {"radius": 0.25}, "SPHERE", "fit-sphere"),
            ("Ray", {"length": 0.25}, "SINGLE_ARROW", "fit-length"),
            ("Ellipsoid", {"semi_axes": (0.1, 0.2, 0.25)}, "SPHERE", ""),
        ):
            obj = mark(new(kind, parent=top), kind=kind, **sizes)
            obj.empty_display_type = shape
            self.assertEqual(obj.empty_display_size, 0.25)
            obj.scale = (3, 3, 3)
            activate(obj)
            bpy.ops.object.transform_apply(location=False, rotation=False, scale=True)
            self.assertEqual([(item.object, item.fix) for item in self.findings("size-not-shown")], [(kind, fix)])
            if fix:
                self.assertEqual(self.fix_all(), set())
                (size,) = marks.read_numbers(obj).values()
                self.assertEqual(size, 0.75)

    def test_a_number_that_is_typed_is_shown(self):
        obj = mark(new("tip", parent=root()), kind="Sphere", radius=0.25)
        obj.pong.radius = 0.3
        self.assertEqual(self.findings("size-not-shown"), [])
        self.assertEqual(marks.read_numbers(obj), {"radius": 0.3})

    def test_the_toolkits_own_repair_scales_the_mark_as_well(self):
        top = root()
        for scale, kind, sizes in (
            ((2, 2, 2), "Sphere", {"radius": 1.0}),
            ((2, -2, 2), "Sphere", {"radius": 1.0}),
            ((2, 4, 2), "Ellipsoid", {"semi_axes": (1.0, 2.0, 1.0)}),
        ):
            for obj in (ball(top, scale=scale), mark(new("e", parent=top, scale=scale), kind="Sphere", radius=0.5)):
                given = marks.read_numbers(obj)["radius"]
                activate(obj)
                bpy.ops.pong.fix(fix="apply-scale")
                numbers = marks.read_numbers(obj)
                self.assertEqual(obj.pong.kind, kind)
                for name, value in sizes.items():
                    np.testing.assert_allclose(numbers[name], np.multiply(value, given / 0.5), rtol=1e-12)
                self.assertEqual(self.findings("size-not-shown"), [])
                bpy.data.objects.remove(obj)

    def test_what_no_mark_can_say_is_refused(self):
        turned = mark(new("e", parent=root(), rotation=(0.3, 0, 0)), kind="Ellipsoid", semi_axes=(1.0, 2.0, 3.0))
        back = mark(new("r", parent=turned.parent, scale=(1, 1, -1)), kind="Ray", length=1.0)
        for obj, fix in ((turned, "apply-transform"), (back, "apply-scale")):
            before = marks.read_mark(obj)
            with self.assertRaisesRegex(fixes.FixFault, "along its axes"):
                fixes.run(bpy.context, fix, obj)
            self.assertEqual((marks.read_mark(obj), tuple(obj.scale)), (before, tuple(obj.scale)))


class Joined(Authors):
    def pair(self, second):
        """Two cubes with a part each (of one corner), joined."""
        top = root()
        first = mark(new("first", mesh(CUBE), top), parts=[Part("foot", "Point", vertices=[0])])
        other = mark(new("other", mesh(CUBE), top, location=(5, 0, 0)), **second)
        activate(first, other)
        bpy.ops.object.join()
        return first

    def test_parts_stay_apart_and_those_of_the_other_are_told(self):
        first = self.pair({"parts": [Part("edge", "LineSegment", edges=[3], surface="steel")]})
        self.assertEqual(marks.read_mark(first).parts[0].vertices, [0])
        (found,) = self.findings("left-over-part")
        self.assertEqual((found.severity, found.fix), ("error", "adopt-parts"))
        self.fix_all()
        kinds = [(part.name, part.kind, len(part.vertices) + len(part.edges)) for part in marks.read_mark(first).parts]
        self.assertEqual(kinds, [("foot", "Point", 1), ("linesegment", "LineSegment", 1)])
        self.assertEqual(self.rules(), set())

    def test_parts_of_one_kind_stay_apart(self):
        first = self.pair({"parts": [Part("foot", "Point", vertices=[2, 5])]})
        self.assertEqual(len(self.findings("left-over-part")), 1)
        self.fix_all()
        self.assertEqual([len(part.vertices) for part in marks.read_mark(first).parts], [1, 2])

    def test_inactive_faces_stay_inactive(self):
        top = root()
        pair = [mark(new(name, mesh(CUBE), top, location=(x, 0, 0)), kind="Polyhedron", inactive_faces=[face])
                for name, x, face in (("first", 0, 1), ("other", 5, 2))]
        activate(*pair)
        bpy.ops.object.join()
        self.assertEqual(len(marks.read_mark(pair[0]).inactive_faces), 1)
        self.assertEqual(len(self.findings("left-over-part")), 1)
        self.fix_all()
        self.assertEqual(sorted(marks.read_mark(pair[0]).inactive_faces), [1, 8])

    def test_an_object_without_marks_gets_them(self):
        top = root()
        plain = new("plain", mesh(CUBE), top)
        other = mark(new("other", mesh(CUBE), top, location=(5, 0, 0)), parts=[Part("foot", "Point", vertices=[0])])
        activate(plain, other)
        bpy.ops.object.join()
        self.assertEqual(len(self.findings("left-over-part")), 1)
        self.fix_all()
        self.assertEqual(sorted(self.primitives()), ["point"])

    def test_a_shared_mesh_has_the_parts_of_all_its_objects(self):
        shared = mesh(CUBE)
        top = root()
        for name, x in (("a", 0), ("b", 5)):
            mark(new(name, shared, top, location=(x, 0, 0)), parts=[Part(f"foot_{name}", "Point", vertices=[0])])
        self.assertEqual(self.rules(), set())

    def test_names_of_attributes_are_of_their_own(self):
        self.assertNotEqual(elements.new_attribute("Point"), elements.new_attribute("Point"))
        longest = max(elements.new_attribute("TriangleMesh") + "_v", key=len)
        self.assertLess(len(longest), 64)


class Copies(Authors):
    def test_a_copy_in_place_is_told(self):
        obj = mark(new("block", mesh(CUBE), root()), kind="Polyhedron")
        activate(obj)
        bpy.ops.object.duplicate()
        (found,) = self.findings("same-place")
        self.assertIn("springs add", found.cause)
        bpy.context.object.location.x = 5
        self.assertEqual(self.findings("same-place"), [])

    def test_a_copy_within_the_mesh_is_told(self):
        obj = mark(new("block", mesh(CUBE), root()), kind="Polyhedron")
        edit(obj)
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.mesh.duplicate()
        self.assertEqual(len(self.findings("same-place")), 1)


class SolidWithSegments(Authors):
    def test_a_solid_with_segments_is_one_object(self):
        top = root()
        obj = new("box", mesh(CUBE), top)
        activate(obj)
        bpy.ops.pong.mark(kind="PROPOSE")
        edit(obj)
        bpy.ops.mesh.select_mode(type="EDGE")
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.pong.mark_elements(kind="LineSegment", name="edge")
        bpy.ops.object.mode_set(mode="OBJECT")
        kinds = [primitive.kind for primitive in self.primitives().values()]
        self.assertEqual((kinds.count("Polyhedron"), kinds.count("LineSegment"), len(kinds)), (1, 12, 13))
        self.assertEqual(self.rules(), set())


class Modifiers(Authors):
    def test_proposals_look_at_what_would_be_exported(self):
        sheet = new("sheet", mesh(([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [(0, 1, 2, 3)])))
        bpy.context.view_layer.update()
        self.assertEqual(proposal.of_object(bpy.context, sheet).kind, "Plane")
        sheet.modifiers.new("Solidify", "SOLIDIFY").thickness = 0.2
        bpy.context.view_layer.update()
        self.assertEqual(proposal.of_object(bpy.context, sheet).kind, "Polyhedron")
        activate(sheet)
        bpy.ops.pong.mark()
        self.assertEqual(sheet.pong.kind, "Polyhedron")

    def test_sizes_are_those_after_modifiers(self):
        obj = ball(root())
        push = obj.modifiers.new("Displace", "DISPLACE")
        push.strength, push.mid_level = 0.5, 0.0
        (found,) = self.findings("size-not-shown")
        self.assertEqual(found.fix, "fit-sphere")
        self.assertEqual(self.fix_all() - {"modifiers"}, set())
        self.assertAlmostEqual(obj.pong.radius, 1.0, places=2)

    def test_a_hidden_object_is_told(self):
        sheet = new("sheet", mesh(CUBE))
        sheet.modifiers.new("Solidify", "SOLIDIFY")
        sheet.hide_viewport = True
        bpy.context.view_layer.update()
        self.assertIn("hidden", proposal.of_object(bpy.context, sheet).reason)


class ManyFindings(Authors):
    def test_twelve_findings_are_mended_at_once(self):
        top = root()
        for number in range(12):
            turned = mesh((CUBE[0], [face[::-1] for face in CUBE[1]]))
            mark(new(f"block_{number}", turned, top, location=(5 * number, 0, 0)), kind="Polyhedron")
        hidden = mark(new("hidden", mesh(CUBE), top, location=(0, 9, 0)), kind="Polyhedron")
        hidden.hide_viewport = True
        self.assertEqual(len(self.findings("inside-out")), 12)
        self.assertEqual(self.fix_all("inside-out"), {"hidden-object"})
        self.assertEqual(self.fix_all(), set())
        with self.assertRaisesRegex(RuntimeError, "nothing to repair|no findings"):
            bpy.ops.pong.findings_fix()

    def test_a_repair_that_is_refused_is_told_and_the_others_are_made(self):
        top = root()
        for name, place in (("a", 0), ("b", 5)):
            turned = mesh((CUBE[0], [face[::-1] for face in CUBE[1]]))
            mark(new(name, turned, top, location=(place, 0, 0)), kind="Polyhedron")
        mended = dict(fixes.REPAIRS)

        def refuse(_context, obj):
            if obj.name == "a":
                raise fixes.FixFault("not this one")
            mended["recalculate-normals"](_context, obj)

        bpy.ops.pong.check()
        fixes.REPAIRS["recalculate-normals"] = refuse
        try:
            bpy.ops.pong.findings_fix()
        finally:
            fixes.REPAIRS.update(mended)
        self.assertEqual([item.object for item in state(bpy.context).findings], ["a"])

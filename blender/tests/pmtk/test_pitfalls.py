# SPDX-License-Identifier: GPL-3.0-or-later
"""Differences between Blender's scenes and exact models, with Blender's own data."""

import math

import bpy
import numpy as np
from mathutils import Euler, Quaternion, Vector
from pong_pmtk.core.marks import Part
from pong_pmtk.scene import extract

from .scenes import CUBE, SQUARE, TETRAHEDRON, InBlender, activate, edit, keep_transform, mark, mesh, new, root


def solid(name="block", shape=CUBE, parent=None, **options):
    return mark(new(name, mesh(shape), parent, **options), kind="Polyhedron")


def world_vertices(obj):
    """Vertices of an object as Blender itself has them."""
    bpy.context.view_layer.update()
    evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return np.array([evaluated.matrix_world @ vertex.co for vertex in evaluated.data.vertices])


def same_places(first, second, within_m=2e-6):
    """True if two sets of points agree within single precision, in any order."""
    apart = np.linalg.norm(np.asarray(first)[:, None] - np.asarray(second)[None], axis=2)
    return len(first) == len(second) and (apart.min(axis=0) < within_m).all() and (apart.min(axis=1) < within_m).all()


class Transforms(InBlender):
    def assert_where_blender_has_it(self, obj):
        found = self.primitives()[obj.name].fields["vertices"]
        self.assertTrue(same_places(found, world_vertices(obj)), (found, world_vertices(obj)))

    def test_transforms_that_were_never_evaluated_count(self):
        solid(parent=new("between", parent=root(), location=(7, 0, 0)))  # no view_layer.update()
        self.assertAlmostEqual(self.primitives()["block"].fields["vertices"][:, 0].min(), 6.0)

    def test_every_way_to_rotate(self):
        turn = Euler((0.3, -0.2, 0.9)).to_quaternion()
        for mode in ("QUATERNION", "AXIS_ANGLE", "XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX"):
            with self.subTest(mode=mode):
                bpy.ops.wm.read_factory_settings(use_empty=True)
                obj = solid(parent=root())
                obj.rotation_mode = mode
                obj.rotation_quaternion = 3.0 * turn  # Blender makes it a unit
                obj.rotation_axis_angle = (turn.angle, *turn.axis)
                obj.rotation_euler = (0.3, -0.2, 0.9)
                self.assert_where_blender_has_it(obj)

    def test_deltas(self):
        for mode in ("QUATERNION", "ZYX"):
            with self.subTest(mode=mode):
                bpy.ops.wm.read_factory_settings(use_empty=True)
                obj = solid(parent=root(), location=(1, 2, 3), rotation=(0.1, 0.2, 0.3), scale=(2, 1, 1))
                obj.rotation_mode = mode
                obj.delta_location, obj.delta_scale = (0.5, 0, 0), (1, 3, 1)
                obj.delta_rotation_euler = (0, 0.4, 0)
                obj.delta_rotation_quaternion = Quaternion((1, 0, 0), 0.7)
                self.assert_where_blender_has_it(obj)

    def test_the_parents_inverse_counts(self):
        parent = new("between", parent=root(), location=(5, 1, 0), rotation=(0, 0, 1), scale=(2, 2, 2))
        obj = solid(location=(1, 0, 0))
        keep_transform(obj, parent)
        self.assert_where_blender_has_it(obj)

    def test_a_sheared_solid_is_baked_whole(self):
        obj = solid(parent=new("between", parent=root(), scale=(3, 1, 1)), rotation=(0, 0, 0.6))
        self.assert_where_blender_has_it(obj)

    def test_a_sheared_group_names_the_parent(self):
        parent = new("squeezed", parent=root(), scale=(3, 1, 1))
        group = mark(new("group", parent=parent, rotation=(0, 0, 0.6)), "group")
        solid(parent=group)
        errors = [finding for finding in self.check().findings if finding.rule == "sheared-group"]
        self.assertIn("squeezed", errors[0].cause)
        self.assertEqual(errors[0].fix, "apply-scale")

    def test_a_mirrored_solid_is_not_inside_out(self):
        obj = solid(shape=TETRAHEDRON, parent=root(), scale=(-1, 1, 1))
        self.assert_where_blender_has_it(obj)
        self.assertNotIn("inside-out", self.rules())

    def test_a_zero_scale_is_refused(self):
        solid(parent=root(), scale=(1, 0, 1))
        self.assertIn("zero-scale", self.rules())

    def test_a_chain_of_groups_does_not_gather_rounding(self):
        parent = root()
        for number in range(6):
            parent = mark(new(f"g{number}", parent=parent, location=(10.1, 0.3, 0), rotation=(0, 0, 0.7)), "group")
        mark(new("tip", parent=parent, location=(0.1, 0, 0)), kind="Point")
        group = self.check().model.root
        while group.groups:
            group = group.groups[0]
            self.assertEqual(group.position, (10.1, 0.3, 0.0))  # as typed, not as float32
            self.assertAlmostEqual(sum(c * c for c in group.orientation), 1.0, places=15)
        self.assertEqual(tuple(group.primitives[0].fields["position"]), (0.1, 0.0, 0.0))

    def test_units_other_than_metres(self):
        bpy.context.scene.unit_settings.scale_length = 0.001
        mark(new("tip", parent=root(), location=(1500, 0, 0)), kind="Point")
        mark(new("ball", parent=bpy.data.objects["model"]), kind="Sphere", radius=250.0)
        found = self.primitives()
        self.assertEqual(tuple(found["tip"].fields["position"]), (1.5, 0.0, 0.0))
        self.assertEqual(found["ball"].fields["radius"], 0.25)

    def test_parents_other_than_objects_are_refused(self):
        top = root()
        obj = solid(parent=new("carrier", mesh(CUBE), top))
        obj.parent_type, obj.parent_vertices = "VERTEX", (0, 0, 0)
        self.assertIn("parent-type", self.rules())

    def test_constraints_are_refused_and_muted_ones_are_not(self):
        obj = solid(parent=root())
        constraint = obj.constraints.new("LIMIT_LOCATION")
        self.assertIn("constraint", self.rules())
        constraint.mute = True
        self.assertNotIn("constraint", self.rules())

    def test_animation_is_told_and_exported_at_the_current_frame(self):
        obj = solid(parent=root())
        for frame, x in ((1, 0.0), (11, 10.0)):
            obj.location.x = x
            obj.keyframe_insert("location", frame=frame)
        bpy.context.scene.frame_set(11)
        self.assertIn("animation", self.rules())
        self.assertAlmostEqual(self.primitives()["block"].fields["vertices"][:, 0].max(), 11.0)

    def test_drivers_are_told(self):
        obj = solid(parent=root())
        obj.driver_add("location", 0).driver.expression = "2.0"
        self.assertIn("driver", self.rules())


class Visibility(InBlender):
    def test_hidden_and_excluded_objects_are_refused(self):
        obj = solid(parent=root())
        self.assertNotIn("hidden-object", self.rules())
        obj.hide_viewport = True
        self.assertIn("hidden-object", self.rules())
        obj.hide_viewport = False
        bpy.context.view_layer.update()
        obj.hide_set(True)
        self.assertIn("hidden-object", self.rules())
        obj.hide_set(False)
        collection = bpy.data.collections.new("aside")
        bpy.context.scene.collection.children.link(collection)
        collection.objects.link(obj)
        bpy.context.scene.collection.objects.unlink(obj)
        bpy.context.view_layer.layer_collection.children["aside"].exclude = True
        self.assertIn("excluded-object", self.rules())

    def test_a_hidden_parent_still_places_its_children(self):
        between = new("between", parent=root(), location=(7, 0, 0))
        obj = solid(parent=between)
        between.hide_viewport = True
        bpy.context.view_layer.update()
        self.assertAlmostEqual(self.primitives()[obj.name].fields["vertices"][:, 0].min(), 6.0)


class Geometry(InBlender):
    def test_modifiers_are_applied(self):
        sheet = mark(new("sheet", mesh(SQUARE), root()), kind="TriangleMesh")
        array = sheet.modifiers.new("Array", "ARRAY")
        array.count = 3
        self.assertEqual(len(self.primitives()["sheet"].fields["triangles"]), 6)
        array.show_viewport = False
        self.assertEqual(len(self.primitives()["sheet"].fields["triangles"]), 2)

    def test_shape_keys_are_applied(self):
        tip = mark(new("tip", mesh(([(0, 0, 0)], [])), root()), kind="Point")
        tip.shape_key_add(name="Basis")
        key = tip.shape_key_add(name="out")
        key.data[0].co = (4, 0, 0)
        key.value = 0.5
        self.assertEqual(tuple(self.primitives()["tip"].fields["position"]), (2.0, 0.0, 0.0))

    def test_parts_of_a_mesh_whose_modifiers_change_it_are_refused(self):
        obj = mark(new("a", mesh(CUBE), root()), parts=[Part("feet", "Point", vertices=[0, 1])])
        self.assertEqual(len(self.primitives()), 2)
        obj.modifiers.new("Subdivision", "SUBSURF")
        self.assertIsNone(self.check().model)

    def test_n_gons_survive(self):
        angles = [math.tau * i / 6 for i in range(6)]
        ring = [(math.cos(a), math.sin(a), z) for z in (0, 1) for a in angles]
        sides = [(i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6) for i in range(6)]
        solid(shape=(ring, [(5, 4, 3, 2, 1, 0), (6, 7, 8, 9, 10, 11), *sides]), parent=root())
        self.assertEqual(sorted(len(face) for face in self.primitives()["block"].fields["faces"]), [4] * 6 + [6] * 2)

    def test_planarity_is_judged_by_what_single_precision_holds(self):
        # A tilted box 100 m away from its origin: its float32 corners are micrometres off their planes.
        turn = Euler((0.4, 0.7, 0.2)).to_matrix()
        far = [tuple(turn @ (Vector((100, 70, 0)) + Vector(co))) for co in CUBE[0]]
        solid(shape=(far, CUBE[1]), parent=root())
        self.assertIsNotNone(self.check().model)

    def faulty(self, shape, rule):
        solid(shape=shape, parent=root())
        result = self.check()
        self.assertIsNone(result.model)
        self.assertIn(rule, {finding.rule for finding in result.findings.errors})

    def test_open_solids_are_refused(self):
        self.faulty((CUBE[0], CUBE[1][1:]), "open-polyhedron")

    def test_inside_out_solids_are_refused(self):
        self.faulty((CUBE[0], [face[::-1] for face in CUBE[1]]), "inside-out")

    def test_non_planar_faces_are_refused(self):
        self.faulty(([*CUBE[0][:6], (1, 1, 1.5), CUBE[0][7]], CUBE[1]), "face-not-planar")

    def test_two_pieces_are_two_solids(self):
        shifted = [(x + 5, y, z) for x, y, z in CUBE[0]]
        solid(shape=(CUBE[0] + shifted, CUBE[1] + [tuple(i + 8 for i in face) for face in CUBE[1]]), parent=root())
        self.assertEqual(sorted(self.primitives()), ["block_0", "block_1"])

    def test_vertices_edges_and_empties_alone(self):
        top = root()
        mark(new("feet", mesh(([(0, 0, 0), (1, 0, 0)], [])), top), kind="Point")
        mark(new("bar", mesh(([(0, 0, 0), (1, 0, 0)], []), edges=[(1, 0)]), top), kind="LineSegment")
        mark(new("tip", parent=top), kind="Point")
        found = self.primitives()
        self.assertEqual(sorted(found), ["bar", "feet_0", "feet_1", "tip"])
        np.testing.assert_array_equal(found["bar"].fields["ends"], [(1, 0, 0), (0, 0, 0)])

    def test_a_curve_as_a_primitive_is_refused(self):
        curve = bpy.data.curves.new("curve", "CURVE")
        mark(new("curve", curve, root()), kind="TriangleMesh")
        self.assertIsNone(self.check().model)

    def test_an_unscaled_sphere_becomes_an_ellipsoid_where_scaled(self):
        mark(new("ball", parent=root(), scale=(2, 1, 1)), kind="Sphere", radius=0.5)
        ball = self.primitives()["ball"]
        self.assertEqual(ball.kind, "Ellipsoid")
        np.testing.assert_allclose(sorted(ball.fields["semi_axes"]), [0.5, 0.5, 1.0])


class EditMode(InBlender):
    def test_what_is_being_edited_is_exported_without_leaving(self):
        obj = solid(parent=root())
        edit(obj)
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.transform.translate(value=(3, 0, 0))
        self.assertAlmostEqual(self.primitives()["block"].fields["vertices"][:, 0].min(), 2.0)
        self.assertEqual(obj.mode, "EDIT")

    def test_a_mesh_with_modifiers_must_leave_edit_mode(self):
        obj = solid(parent=root())
        obj.modifiers.new("Array", "ARRAY").show_in_editmode = False
        edit(obj)
        self.assertIn("edit-mode", self.rules())


class Instances(InBlender):
    def collection(self, name="latch", offset=(0, 0, 0)):
        made = bpy.data.collections.new(name)
        made.instance_offset = offset
        return made

    def shown(self, collection, name, parent, **options):
        empty = new(name, parent=parent, **options)
        empty.instance_type, empty.instance_collection = "COLLECTION", collection
        return empty

    def into(self, collection, obj):
        collection.objects.link(obj)
        bpy.context.scene.collection.objects.unlink(obj)
        return obj

    def test_two_instances_of_a_collection_stand_where_blender_shows_them(self):
        collection, top = self.collection(offset=(0.5, 0, 0)), root()
        carrier = self.into(collection, new("carrier", location=(0, 1, 0), rotation=(0, 0, 0.3)))
        self.into(collection, solid("claw", shape=TETRAHEDRON, parent=carrier, location=(0, 0, 2)))
        self.shown(collection, "left", top, location=(-3, 0, 0))
        self.shown(collection, "right", top, location=(3, 0, 0), rotation=(0, 0, math.pi / 2))
        bpy.context.view_layer.update()
        shown = [
            [tuple(instance.matrix_world @ vertex.co) for vertex in instance.object.data.vertices]
            for instance in bpy.context.evaluated_depsgraph_get().object_instances
            if instance.is_instance and instance.object.type == "MESH"
        ]
        self.assertEqual(len(shown), 2)
        found = [primitive.fields["vertices"] for primitive in self.primitives().values()]
        self.assertEqual([sum(same_places(one, other) for other in shown) for one in found], [1, 1])

    def test_instances_within_instances(self):
        inner, outer, top = self.collection("inner"), self.collection("outer"), root()
        self.into(inner, mark(new("tip", location=(1, 0, 0)), kind="Point"))
        self.into(outer, self.shown(inner, "arm", None, location=(0, 10, 0)))
        self.shown(outer, "left", top, location=(0, 0, 100))
        positions = [tuple(primitive.fields["position"]) for primitive in self.primitives().values()]
        self.assertEqual(positions, [(1.0, 10.0, 100.0)])

    def test_modifiers_within_an_instance_are_applied(self):
        collection, top = self.collection(), root()
        sheet = self.into(collection, mark(new("sheet", mesh(SQUARE)), kind="TriangleMesh"))
        sheet.modifiers.new("Array", "ARRAY").count = 4
        self.shown(collection, "left", top)
        (primitive,) = self.primitives().values()
        self.assertEqual(len(primitive.fields["triangles"]), 8)

    def test_instances_on_vertices_get_names_of_their_own(self):
        carrier = new("carrier", mesh(([(0, 0, 0), (2, 0, 0), (5, 1, 0)], [])), root())
        mark(new("foot", parent=carrier), kind="Point")
        carrier.instance_type = "VERTS"
        positions = [tuple(primitive.fields["position"]) for primitive in self.primitives().values()]
        self.assertEqual(positions, [(0, 0, 0), (2, 0, 0), (5, 1, 0)])


class Names(InBlender):
    def test_numbers_count_as_numbers(self):
        top = root()
        for number in (10, 2, 1):
            mark(new(f"foot_{number}", parent=top, location=(number, 0, 0)), kind="Point")
        names = [primitive.name for primitive in self.check().model.root.primitives]
        self.assertEqual(names, ["foot_1", "foot_2", "foot_10"])

    def test_the_order_of_making_does_not_matter(self):
        from pong_pmtk.core.write import write_text

        texts = []
        for names in (("a", "b", "c"), ("c", "a", "b")):
            bpy.ops.wm.read_factory_settings(use_empty=True)
            top = root()
            for name in names:
                mark(new(name, parent=top, location=(ord(name), 0, 0)), kind="Point")
            texts.append(write_text(self.check().model))
        self.assertEqual(*texts)

    def test_two_objects_may_have_one_name_in_the_model_but_not_below_one_group(self):
        top = root()
        first, second = (mark(new(name, parent=top), "group") for name in ("left", "right"))
        mark(new("tip", parent=first), kind="Point", name="tip")
        other = mark(new("tip", parent=second), kind="Point", name="tip")
        self.assertIsNotNone(self.check().model)
        other.parent = first
        self.assertIn("repeated-name", self.rules())


class Facts(InBlender):
    def test_reading_changes_nothing(self):
        obj = solid(parent=root())
        obj.modifiers.new("Array", "ARRAY")
        activate(obj)
        before = (len(bpy.data.meshes), len(bpy.data.objects), obj.select_get(), obj.mode)
        extract.snapshot(bpy.context)
        self.assertEqual((len(bpy.data.meshes), len(bpy.data.objects), obj.select_get(), obj.mode), before)

    def test_a_frame_and_a_file_are_told(self):
        bpy.context.scene.frame_set(17)
        self.assertEqual(extract.snapshot(bpy.context).frame, 17)


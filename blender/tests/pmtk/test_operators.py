# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators, as called by menus and scripts."""

import json
import tempfile
from pathlib import Path

import bpy
import numpy as np
from pong_pmtk.core.finding import FIXES
from pong_pmtk.core.marks import Part
from pong_pmtk.scene import fixes
from pong_pmtk.store import elements, marks
from pong_pmtk.store.state import state

from .scenes import CUBE, SQUARE, TETRAHEDRON, InBlender, activate, edit, mark, mesh, new, root


def ball(name="ball", radius=0.5):
    bpy.ops.mesh.primitive_uv_sphere_add(radius=radius)
    bpy.context.object.name = name
    return bpy.context.object


class Marking(InBlender):
    def test_the_geometry_proposes_and_the_author_decides(self):
        objects = {
            "Polyhedron": new("solid", mesh(CUBE)),
            "TriangleMesh": new("sheet", mesh((CUBE[0], CUBE[1][1:]))),
            "Plane": new("ground", mesh(SQUARE)),
            "LineSegment": new("bar", mesh(([(0, 0, 0), (1, 0, 0)], []), edges=[(0, 1)])),
            "Point": new("feet", mesh(([(0, 0, 0)], []))),
            "Sphere": ball(),
        }
        activate(*objects.values())
        bpy.ops.pong.mark()
        self.assertEqual({kind: obj.pong.kind for kind, obj in objects.items()}, {kind: kind for kind in objects})
        self.assertAlmostEqual(objects["Sphere"].pong.radius, 0.5, places=6)
        activate(objects["Polyhedron"])
        bpy.ops.pong.mark(kind="TriangleMesh")
        self.assertEqual(objects["Polyhedron"].pong.kind, "TriangleMesh")

    def test_closed_meshes_of_a_new_root_are_solids(self):
        block = new("block", mesh(CUBE))
        activate(block)
        bpy.ops.pong.root_new(name="crate")
        top = bpy.data.objects["crate"]
        self.assertEqual(top.pong.contact, "Automatic")
        bpy.ops.pong.surface_add(name="wood", stiffness=1e5)
        top.pong.surface = "wood"
        activate(block)
        bpy.ops.pong.mark()
        self.assertEqual(self.check().model.root.contact, "Solid")
        bpy.ops.pong.check()
        told = state(bpy.context).touches.splitlines()
        self.assertEqual(told[0], "crate: 1 solid shape")

        edit(block)  # feet by hand: the author says what touches
        bpy.ops.mesh.select_mode(type="VERT")
        elements.select(block.data, {"vertices": [0, 1]})
        bpy.ops.pong.mark_elements(kind="Point")
        bpy.ops.object.mode_set(mode="OBJECT")
        result = self.check()
        self.assertIsNone(result.model.root.contact)
        self.assertIn("not-solid", {finding.rule for finding in result.findings})

        activate(top)
        bpy.ops.pong.group_set(contact="Solid")
        self.assertEqual(self.rules(), {"solid-corner"})

    def test_inward_and_unwelded_solids_are_repaired(self):
        top = root()
        top.pong.contact = "Solid"
        turned = mark(new("a", mesh((CUBE[0], [face[::-1] for face in CUBE[1]])), top), kind="TriangleMesh")
        loose = [vertex for face in CUBE[1] for vertex in (CUBE[0][i] for i in face)]
        loose[:4] = [(x + 1e-6, y, z) for x, y, z in loose[:4]]  # triangles share corners that are the same to the last bit
        faces = [tuple(range(4 * i, 4 * i + 4)) for i in range(6)]
        mark(new("b", mesh((loose, faces)), top, location=(5, 0, 0)), kind="TriangleMesh")
        bpy.ops.pong.check()
        self.assertEqual(self.rules() - {"t-junction"}, {"solid-volume", "open-solid"})
        bpy.ops.pong.findings_fix()
        self.assertEqual(self.rules(), set())
        self.assertEqual(len(turned.data.polygons), 6)

    def test_unmarking(self):
        obj = mark(new("a"), kind="Sphere", radius=1.0)
        activate(obj)
        bpy.ops.pong.unmark()
        self.assertEqual(marks.read_mark(obj), marks.Mark())

    def test_nothing_selected_is_told(self):
        with self.assertRaisesRegex(RuntimeError, "Select an object"):
            bpy.ops.pong.mark()

    def test_selected_elements_become_parts_without_leaving_edit_mode(self):
        top = root()
        obj = new("a", mesh(CUBE), top)
        edit(obj)
        for mode, sort, chosen, kind in (("VERT", "vertices", [0, 3], "Point"), ("EDGE", "edges", [2], "LineSegment"),
                                         ("FACE", "faces", [1], "TriangleMesh")):
            bpy.ops.mesh.select_mode(type=mode)
            elements.select(obj.data, {sort: chosen})
            bpy.ops.pong.mark_elements(surface="steel")
            part = marks.read_mark(obj).parts[-1]
            self.assertEqual((part.kind, getattr(part, sort)), (kind, chosen))
        self.assertEqual(obj.mode, "EDIT")
        self.assertEqual(sorted(primitive.kind for primitive in self.primitives().values()),
                         ["LineSegment", "Point", "Point", "TriangleMesh"])

    def test_parts_of_objects_that_are_edited_together_have_names_of_their_own(self):
        top = root()
        pair = [new(name, mesh(CUBE), top, location=(x, 0, 0)) for name, x in (("a", 0), ("b", 5))]
        activate(*pair)
        bpy.ops.object.mode_set(mode="EDIT")
        for obj in pair:
            elements.select(obj.data, {"vertices": [0, 3]})
        bpy.ops.pong.mark_elements(kind="Point", name="foot")
        bpy.ops.object.mode_set(mode="OBJECT")
        self.assertEqual([part.name for obj in pair for part in obj.pong.parts], ["foot", "foot_2"])
        self.assertEqual(self.rules(), set())

    def test_parts_grow_shrink_select_and_go(self):
        obj = new("a", mesh(CUBE))
        edit(obj)
        bpy.ops.mesh.select_mode(type="VERT")
        elements.select(obj.data, {"vertices": [0]})
        bpy.ops.pong.mark_elements(kind="Point")
        elements.select(obj.data, {"vertices": [5, 6]})
        bpy.ops.pong.part_assign()
        elements.select(obj.data, {"vertices": [0]})
        bpy.ops.pong.part_assign(take_out=True)
        self.assertEqual(marks.read_mark(obj).parts[0].vertices, [5, 6])
        bpy.ops.object.mode_set(mode="OBJECT")
        bpy.ops.pong.part_select()
        self.assertEqual(elements.selected(obj.data, "vertices"), [5, 6])
        bpy.ops.pong.part_remove()
        self.assertFalse(marks.read_mark(obj).parts)

    def test_inactive_faces(self):
        obj = mark(new("a", mesh(CUBE), root()), kind="Polyhedron")
        edit(obj)
        bpy.ops.mesh.select_mode(type="FACE")
        elements.select(obj.data, {"faces": [3, 4]})
        bpy.ops.pong.mark_inactive()
        elements.select(obj.data, {"faces": [4]})
        bpy.ops.pong.mark_inactive(active=True)
        self.assertEqual(marks.read_mark(obj).inactive_faces, [3])


class Surfaces(InBlender):
    def test_batch_assignment_and_refusal_of_unknown_ones(self):
        top = root()
        objects = [mark(new(name, parent=top), kind="Point") for name in "abc"]
        activate(*objects)
        bpy.ops.pong.surface_add(name="ice", stiffness=2e5)
        bpy.ops.pong.surface_assign(surface="ice")
        self.assertEqual({primitive.surface for primitive in self.primitives().values()}, {"ice"})
        with self.assertRaisesRegex(RuntimeError, "no surface"):
            bpy.ops.pong.surface_assign(surface="snow")

    def test_a_surface_in_use_stays(self):
        activate(root())
        with self.assertRaisesRegex(RuntimeError, "used by model"):
            bpy.ops.pong.surface_remove()
        bpy.ops.pong.surface_add(name="ice")
        bpy.ops.pong.surface_remove()
        self.assertEqual(bpy.context.object.pong_model.surfaces.keys(), ["steel"])

    def test_pairs(self):
        top = root()
        activate(top)
        bpy.ops.pong.pair_add(second="other")
        top.pong_model.pairs[0].friction = "None"
        self.assertEqual(marks.read_settings(top).pairs, [{"surfaces": ("steel", "other"), "friction": None}])
        bpy.ops.pong.pair_remove()
        self.assertFalse(marks.read_settings(top).pairs)


class Tree(InBlender):
    def test_a_model_from_nothing(self):
        first, second = (new(name, mesh(CUBE), location=(x, 0, 0)) for name, x in (("a", 0.1), ("b", 5.3)))
        activate(first, second)
        bpy.ops.pong.mark()
        bpy.ops.pong.root_new(name="vehicle")
        bpy.ops.pong.preset_load(preset="steel_hard")
        bpy.ops.pong.surface_assign(surface="steel_hard")
        activate(second)
        bpy.ops.pong.group_new(name="door", movable=True, bound="Obb", origin="MEDIAN")
        activate(first)
        bpy.ops.pong.group_new(name="body")
        model = self.check().model
        door = model.root.groups[-1]
        self.assertEqual((door.name, door.movable, door.bound), ("door", True, "Obb"))
        np.testing.assert_allclose(door.position, (5.3, 0, 0), atol=1e-6)

    def test_new_roots_and_groups_are_shown_as_large_as_suits_what_they_hold(self):
        small = new("small", mesh(CUBE), scale=(0.01, 0.02, 0.01))
        activate(small)
        bpy.ops.pong.root_new()
        self.assertAlmostEqual(bpy.context.object.empty_display_size, 0.02, places=6)
        activate(small)
        bpy.ops.pong.group_new()
        self.assertAlmostEqual(bpy.context.object.empty_display_size, 0.02, places=6)

    def test_grouping_at_the_parents_origin_moves_nothing_by_a_bit(self):
        top = root()
        tip = mark(new("tip", parent=top, location=(0.1, 0.2, 0.3), rotation=(0.1, 0.2, 0.3)), kind="Point")
        activate(tip)
        bpy.ops.pong.group_new(name="g")
        self.assertEqual(tip.parent.parent, top)
        self.assertEqual(tuple(self.primitives()["tip"].fields["position"]), (0.1, 0.2, 0.3))

    def test_moving_to_a_group_keeps_the_place(self):
        top = root()
        group = mark(new("g", parent=top, location=(1, 2, 3), rotation=(0, 0, 1)), "group")
        tip = mark(new("tip", parent=top, location=(4, 5, 6)), kind="Point")
        activate(group, tip)
        bpy.ops.pong.group_move()
        bpy.context.view_layer.update()
        self.assertEqual(tip.parent, group)
        np.testing.assert_allclose(tip.matrix_world.translation, (4, 5, 6), atol=1e-5)
        activate(top, group)
        bpy.ops.pong.group_move()
        activate(tip, group)
        with self.assertRaises(RuntimeError):
            bpy.ops.pong.group_move()

    def test_setting_many_groups_at_once(self):
        groups = [new(name) for name in "abc"]
        activate(*groups)
        bpy.ops.pong.group_set(movable=True)
        bpy.ops.pong.group_set(bound="Sphere")
        self.assertEqual({(g.pong.role, g.pong.movable, g.pong.bound) for g in groups}, {("group", True, "Sphere")})

    def test_a_root_is_not_grouped(self):
        activate(root())
        with self.assertRaisesRegex(RuntimeError, "root"):
            bpy.ops.pong.group_new()


class Findings(InBlender):
    def listed(self):
        bpy.ops.pong.check()
        return state(bpy.context).findings

    def test_a_finding_selects_its_object_and_elements(self):
        top = root()
        mark(new("block", mesh((CUBE[0], CUBE[1][1:])), top), kind="Polyhedron")
        activate(top)
        (finding,) = [item for item in self.listed() if item.rule == "open-polyhedron"]
        self.assertEqual(finding.object, "block")
        bpy.ops.pong.finding_select(index=list(state(bpy.context).findings).index(finding))
        block = bpy.context.view_layer.objects.active
        self.assertEqual((block.name, block.mode), ("block", "EDIT"))
        for sort, numbers in json.loads(finding.elements).items():
            self.assertLessEqual(set(numbers), set(elements.selected(block.data, sort)))
        self.assertEqual(elements.selected(block.data, "faces"), [1, 2, 3, 4])  # those at the hole

    def fixed(self, obj, rule):
        """Checks, runs the repair that the finding of a rule offers, and checks that it is gone."""
        activate(obj)
        found = {item.rule: index for index, item in enumerate(self.listed())}
        self.assertIn(rule, found)
        bpy.ops.pong.finding_fix(index=found[rule])
        self.assertNotIn(rule, {item.rule for item in state(bpy.context).findings})

    def test_inside_out(self):
        obj = mark(new("a", mesh((CUBE[0], [face[::-1] for face in CUBE[1]])), root()), kind="Polyhedron")
        self.fixed(obj, "inside-out")

    def test_hidden(self):
        obj = mark(new("a", mesh(CUBE), root()), kind="Polyhedron")
        obj.hide_viewport = True
        self.fixed(obj.parent, "hidden-object")

    def test_repeated_name(self):
        top = root()
        for name in ("a", "b"):
            obj = mark(new(name, parent=top), kind="Point", name="tip")
        self.fixed(obj, "repeated-name")

    def test_repeated_names_of_parts(self):
        top = root()
        part = Part(name="foot", kind="Point", vertices=[0])
        for name in "ab":
            mark(new(name, mesh(CUBE), top), parts=[part])
        self.fixed(top, "repeated-name")

    def test_sheared_group(self):
        squeezed = new("squeezed", parent=root(), scale=(3, 1, 1))
        group = mark(new("group", parent=squeezed, rotation=(0, 0, 0.6)), "group")
        mark(new("block", mesh(CUBE), group), kind="Polyhedron")
        activate(squeezed)
        bpy.ops.pong.fix(fix="apply-scale")
        self.assertEqual(tuple(squeezed.scale), (1, 1, 1))


class Repairs(InBlender):
    """Every repair preserves positions."""

    def test_there_is_one_for_every_offer(self):
        self.assertLessEqual(set(FIXES), set(fixes.REPAIRS))

    def repaired(self, obj, fix):
        activate(obj)
        bpy.ops.pong.fix(fix=fix)
        bpy.context.view_layer.update()
        return obj

    def world(self, obj):
        bpy.context.view_layer.update()
        return np.array([obj.matrix_world @ vertex.co for vertex in obj.data.vertices])

    def test_applying_keeps_the_place_of_the_mesh_and_of_children_and_of_sharers(self):
        for fix in ("apply-scale", "apply-transform"):
            with self.subTest(fix=fix):
                bpy.ops.wm.read_factory_settings(use_empty=True)
                shared = mesh(TETRAHEDRON)
                obj = new("a", shared, location=(1, 2, 3), scale=(2, -3, 1), rotation=(0.1, 0.2, 0.3))
                child, other = new("b", shared, obj, location=(1, 0, 0)), new("c", shared)
                before = [self.world(each) for each in (obj, child, other)]
                self.repaired(obj, fix)
                self.assertEqual(tuple(obj.scale), (1, 1, 1))
                for each, places in zip((obj, child, other), before):
                    np.testing.assert_allclose(self.world(each), places, atol=1e-5)
                normals = [polygon.normal.dot(polygon.center) for polygon in obj.data.polygons[2:3]]
                self.assertGreater(normals[0], 0.0)  # mirrored, so turned round

    def test_applying_keeps_full_precision(self):
        obj = mark(new("a", mesh(CUBE), root(), scale=(0.1, 0.1, 0.1)), kind="Polyhedron")
        self.repaired(obj, "apply-scale")
        self.assertEqual(set(np.abs(self.primitives()["a"].fields["vertices"]).ravel()), {0.1})

    def test_clearing_the_parents_inverse_and_setting_the_origin(self):
        for fix in ("clear-parent-inverse", "set-origin"):
            with self.subTest(fix=fix):
                bpy.ops.wm.read_factory_settings(use_empty=True)
                parent = new("p", location=(5, 0, 0), rotation=(0, 0.5, 0))
                obj = new("a", mesh(TETRAHEDRON), parent, location=(1, 2, 3), scale=(2, 2, 2), rotation=(0.1, 0.2, 0.3))
                obj.matrix_parent_inverse = parent.matrix_world.inverted()
                before = self.world(obj)
                self.repaired(obj, fix)
                np.testing.assert_allclose(self.world(obj), before, atol=1e-5)

    def test_geometry(self):
        double = (CUBE[0] + [CUBE[0][0]], CUBE[1])
        doubled = new("doubled", mesh(double))
        self.assertEqual(len(self.repaired(doubled, "delete-loose").data.vertices), 8)
        doubled = new("doubled", mesh(double))
        self.assertEqual(len(self.repaired(doubled, "merge-by-distance").data.vertices), 8)
        self.assertEqual(len(self.repaired(new("a", mesh(CUBE)), "triangulate").data.polygons), 12)
        sliver = new("sliver", mesh(([*SQUARE[0], (2, 0, 0), (3, 0, 0)], [*SQUARE[1], (1, 4, 5)])))
        self.assertEqual(len(self.repaired(sliver, "dissolve-degenerate").data.polygons), 1)

    def test_repairs_of_a_mesh_work_in_edit_mode(self):
        obj = new("a", mesh(CUBE))
        edit(obj)
        bpy.ops.pong.fix(fix="triangulate")
        self.assertEqual(obj.mode, "EDIT")
        bpy.ops.object.mode_set(mode="OBJECT")
        self.assertEqual(len(obj.data.polygons), 12)

    def test_pieces_become_objects_with_the_same_mark(self):
        shifted = [(x + 5, y, z) for x, y, z in CUBE[0]]
        both = (CUBE[0] + shifted, CUBE[1] + [tuple(i + 8 for i in face) for face in CUBE[1]])
        obj = mark(new("a", mesh(both), root()), kind="Polyhedron", name="pair")
        self.repaired(obj, "separate-loose")
        self.assertEqual(len(self.primitives()), 2)

    def test_conversions(self):
        curve = bpy.data.curves.new("c", "CURVE")
        curve.bevel_depth = 0.1
        spline = curve.splines.new("POLY")
        spline.points.add(1)
        spline.points[1].co = (1, 0, 0, 1)
        obj = self.repaired(new("c", curve), "convert-to-mesh")
        self.assertEqual(bpy.data.objects["c"].type, "MESH")
        collection = bpy.data.collections.new("latch")
        collection.objects.link(mark(bpy.data.objects.new("claw", mesh(CUBE)), kind="Polyhedron"))
        empty = new("left", parent=root())
        empty.instance_type, empty.instance_collection = "COLLECTION", collection
        self.repaired(empty, "make-instances-real")
        self.assertEqual([child.pong.kind for child in empty.children], ["Polyhedron"])

    def test_fitting(self):
        obj = mark(ball(radius=2.0), kind="Sphere")
        self.repaired(obj, "fit-sphere")
        self.assertAlmostEqual(obj.pong.radius, 2.0, places=5)
        obj = mark(new("b", mesh(([(2, 0, 0), (0, -3, 0), (0, 0, 1)], [(0, 1, 2)]))), kind="Ellipsoid")
        self.repaired(obj, "fit-ellipsoid")
        self.assertEqual(tuple(obj.pong.semi_axes), (2.0, 3.0, 1.0))


class Files(InBlender):
    def setUp(self):
        super().setUp()
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.path = Path(temporary.name) / "model.ron"

    def test_export_and_import_by_operator(self):
        mark(new("block", mesh(CUBE), root()), kind="Polyhedron")
        bpy.ops.pong.export_ron(filepath=str(self.path))
        first = self.path.read_bytes()
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.ops.pong.import_ron(filepath=str(self.path))
        self.assertEqual(bpy.context.object.pong.role, "root")
        bpy.ops.pong.export_ron(filepath=str(self.path))
        self.assertEqual(self.path.read_bytes(), first)

    def test_a_refused_export_names_the_object_and_writes_nothing(self):
        mark(new("block", mesh((CUBE[0], CUBE[1][1:])), root()), kind="Polyhedron")
        with self.assertRaisesRegex(RuntimeError, r"Nothing was written:\nmodel/block: error \[open-polyhedron\]"):
            bpy.ops.pong.export_ron(filepath=str(self.path))
        self.assertFalse(list(self.path.parent.iterdir()))
        self.assertTrue(len(state(bpy.context).findings))

    def test_a_model_in_other_units_is_refused_on_import(self):
        mark(new("tip", parent=root()), kind="Point")
        bpy.ops.pong.export_ron(filepath=str(self.path))
        bpy.context.scene.unit_settings.scale_length = 0.001
        count = len(bpy.data.objects)
        with self.assertRaisesRegex(RuntimeError, "metres"):
            bpy.ops.pong.import_ron(filepath=str(self.path))
        self.assertEqual(len(bpy.data.objects), count)

    def test_the_menus_have_their_entries(self):
        from pong_pmtk.ui import menus

        for name, draw in menus.ENTRIES.items():
            self.assertIn(draw, getattr(bpy.types, name)._dyn_ui_initialize(), name)

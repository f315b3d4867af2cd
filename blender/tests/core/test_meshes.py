# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes as primitives: pieces, parts, cuts, instances, modifiers; the engine accepts the exports."""

import itertools
import math
import random
import unittest

from support import PONG, build, built, check_model, in_single_precision, np, rules, scene
from core import polygon
from core.author import box, cylinder, grid, mesh, prism
from core.engine import polyhedron_faults
from core.marks import Part
from core.read import read_text
from core.write import write_text

SQUARE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
FACES = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]


def area(vertices, triangles):
    corners = vertices[triangles]
    return 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum()


def star(points, inner=0.4):
    """A star in the plane: concave everywhere between its tips."""
    turn = [math.pi * i / points for i in range(2 * points)]
    return [
        ((1.0 if i % 2 == 0 else inner) * math.cos(a), (1.0 if i % 2 == 0 else inner) * math.sin(a), 0.0)
        for i, a in enumerate(turn)
    ]


class Triangulation(unittest.TestCase):
    def cut(self, vertices, faces):
        shape = mesh(vertices, faces)
        return (shape.vertices, *polygon.triangulated(shape.vertices, shape.loops, shape.face_starts))

    def test_concave_faces_keep_their_area_and_front(self):
        for points in (3, 4, 5, 9, 20):
            outline = star(points)
            vertices, triangles, source, crossed = self.cut(outline, [list(range(2 * points))])
            self.assertEqual((len(triangles), crossed), (2 * points - 2, []))
            corners = vertices[triangles]
            z = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 2]
            self.assertTrue((z > 0).all())
            self.assertAlmostEqual(z.sum() / 2, polygon.area_vector(vertices)[2] / 2, 12)

    def test_quads(self):
        for turned in range(4):
            dart = np.roll(np.array([(0, 0, 0), (2, -1, 0), (0.5, 0, 0), (2, 1, 0)], dtype=float)[::-1], turned, axis=0)
            vertices, triangles, _, crossed = self.cut(dart, [[0, 1, 2, 3]])
            self.assertEqual(crossed, [])
            self.assertAlmostEqual(area(vertices, triangles), abs(polygon.area_vector(dart)[2]) / 2, 12)
        long = [(0, 0, 0), (4, 0, 0), (5, 1, 0), (1, 1, 0)]
        self.assertEqual(self.cut(long, [[0, 1, 2, 3]])[1].tolist(), [[1, 2, 3], [1, 3, 0]])
        self.assertEqual(self.cut(SQUARE, [[0, 1, 2, 3]])[1].tolist(), [[0, 1, 2], [0, 2, 3]])

    def test_faces_that_cross_themselves_are_told(self):
        self.assertEqual(self.cut(SQUARE, [[0, 1, 2, 3], [0, 2, 1, 3]])[3], [1])
        pentagram = [(math.cos(1.2566370614 * 2 * i), math.sin(1.2566370614 * 2 * i), 0.0) for i in range(5)]
        self.assertEqual(self.cut(pentagram, [[0, 1, 2, 3, 4]])[3], [0])

    def test_bent_faces_are_told(self):
        s = scene()
        s.mesh("bent", "TriangleMesh", mesh([*SQUARE[:3], (0, 1, 0.1)], [[0, 1, 2, 3]]))
        self.assertEqual(rules(built(s), "warning"), ["bent-face"])


class Pieces(unittest.TestCase):
    def test_each_connected_piece_is_a_polyhedron(self):
        shapes = [box((1, 1, 1), (3.0 * i, 0, 0)) for i in range(3)]
        faces = np.concatenate([np.array(FACES) + 8 * i for i in range(3)])
        random.seed(7)
        order = random.sample(range(len(faces)), len(faces))
        s = scene()
        blocks = mesh(np.concatenate([shape.vertices for shape in shapes]), faces[order])
        thing = s.mesh("block", "Polyhedron", blocks, inactive_faces=[order.index(5), order.index(10)])
        made = built(s)
        primitives = made.model.root.primitives
        self.assertEqual([p.name for p in primitives], ["block_0", "block_1", "block_2"])
        walls = {}
        for primitive in primitives:
            vertices, faces = primitive.fields["vertices"], primitive.fields["faces"]
            self.assertEqual((len(vertices), len(faces)), (8, 6))
            for wall in primitive.fields["inactive_faces"]:
                walls[round(float(vertices[:, 0].mean()))] = vertices[list(faces[wall])][:, 0]
            self.assertEqual(made.object_of(primitive), thing.name)
        # Face 5 of the first box looks along +x, face 4 of the second along -x.
        self.assertEqual({key: set(x) for key, x in walls.items()}, {0: {0.5}, 3: {2.5}})

    def test_pieces_that_touch_stay_apart(self):
        two = np.concatenate([box((1, 1, 1)).vertices, box((1, 1, 1), (1, 0, 0)).vertices])
        s = scene()
        s.mesh("block", "Polyhedron", mesh(two, np.concatenate([np.array(FACES), np.array(FACES) + 8])))
        self.assertEqual(len(built(s).model.root.primitives), 2)

    def test_faces_with_vertices_of_their_own_are_welded(self):
        soup = box((1, 1, 1)).vertices[np.array(FACES).ravel()]
        s = scene()
        s.mesh("block", "Polyhedron", mesh(soup, np.arange(24).reshape(6, 4)))
        text = write_text(built(s).model)
        self.assertEqual(len(read_text(text).root.primitives[0].fields["vertices"]), 8)


class Parts(unittest.TestCase):
    def test_every_kind(self):
        shape = box((1.0, 1.0, 1.0))
        s = scene()
        s.root.settings.surfaces["ice"] = {"stiffness": 1.0}
        group = s.group("arm", location=(0.0, 0.0, 1.0))
        parts = [
            Part("corners", "Point", "ice", vertices=[7, 0]),
            Part("rim", "LineSegment", edges=[3]),
            Part("needle", "Ray", edges=[0]),
            Part("floor", "Plane", faces=[1]),
            Part("sheet", "TriangleMesh", faces=[5, 2]),
            Part("solid", "Polyhedron", faces=[0, 1, 2, 3, 4, 5]),
        ]
        s.mesh("block", "", shape, above=group, parts=parts)
        made = built(s)
        found = {p.name: p for p in made.model.root.groups[0].primitives}
        self.assertEqual(list(found), ["corners_0", "corners_1", "rim", "needle", "floor", "sheet", "solid"])
        self.assertEqual(found["corners_0"].fields["position"], (0.5, 0.5, 0.5))
        self.assertEqual({p.surface for p in found.values()}, {"ice", None})
        self.assertEqual(found["floor"].fields, {"normal": (0.0, 0.0, 1.0), "offset": 0.5})
        self.assertEqual(len(found["sheet"].fields["triangles"]), 4)


class Findings(unittest.TestCase):
    """Findings select their elements, and hints do not refuse."""

    def finding(self, made, rule):
        return next(finding for finding in made.findings if finding.rule == rule)

    def test_faces_and_vertices_are_named(self):
        vertices = box((1.0, 1.0, 1.0)).vertices.copy()
        vertices[7] += (0.0, 0.0, 0.01)
        s = scene()
        s.mesh("block", "Polyhedron", mesh([(9, 9, 9), *vertices], np.array(FACES) + 1))
        made = build(s.snapshot())
        self.assertEqual(self.finding(made, "face-not-planar").faces, [1])
        self.assertEqual(self.finding(made, "loose-geometry").vertices, [0])

    def test_duplicates_in_two_meshes_name_the_face(self):
        s = scene()
        s.mesh("a", "TriangleMesh", mesh([(5, 5, 5), (6, 5, 5), (5, 6, 5), *SQUARE], [[0, 1, 2], [3, 4, 5, 6]]))
        s.mesh("b", "TriangleMesh", mesh([*SQUARE[:3], (3, 0, 0), (4, 0, 0), (3, 1, 0)], [[3, 4, 5], [0, 1, 2]]))
        finding = self.finding(build(s.snapshot()), "duplicate-triangle")
        self.assertEqual((finding.object, finding.faces), ("b", [1]))

    def test_movable_groups_are_bodies_of_their_own(self):
        for movable in (False, True):
            s = scene()
            for name in "ab":
                group = s.group(name, movable=movable)
                s.mesh(f"{name}_sheet", "TriangleMesh", mesh(SQUARE, [[0, 1, 2, 3]]), above=group)
            self.assertEqual("duplicate-triangle" in rules(build(s.snapshot()), "error"), not movable)

    def test_edges_that_do_not_fit(self):
        fan = mesh([(0, 0, 0), (0, 0, 1), (1, 0, 0), (-1, 1, 0), (-1, -1, 0)], [[0, 1, 2], [1, 0, 3], [0, 1, 4]])
        turned = mesh([*SQUARE], [[0, 1, 2], [0, 3, 2]])
        crack = mesh([*SQUARE, (0.5, 0, 0), (0.5, -1, 0)], [[0, 1, 2, 3], [0, 5, 4], [4, 5, 1]])
        for shape, rule in ((fan, "crowded-edge"), (turned, "winding"), (crack, "t-junction")):
            s = scene()
            s.mesh("sheet", "TriangleMesh", shape)
            self.assertEqual(rules(built(s), "warning"), [rule])

    def test_hints(self):
        s = scene()
        s.mesh("edges", "LineSegment", box((1, 1, 1)))
        s.mesh("solid", "TriangleMesh", box((1, 1, 1)))
        s.empty("picture", "none", s.root, type="MESH", mesh=box((1, 1, 1)))
        s.root.settings.surfaces["spare"] = {"stiffness": 1.0}
        found = rules(built(s), "hint")
        self.assertEqual(sorted(found), ["convex-mesh", "faces-not-exported", "unmarked-mesh", "unused-surface"])

    def test_what_moves_with_time_is_told_with_its_frame(self):
        s = scene(animated=True, drivers=True)
        s.mesh("p", "Point", mesh(SQUARE), shape_keys=2, stored_mesh=mesh(SQUARE))
        made = built(s, frame=42)
        self.assertEqual(sorted(rules(made, "warning")), ["animation", "driver", "shape-keys"])
        for rule in ("animation", "driver", "shape-keys"):
            self.assertIn("42", self.finding(made, rule).cure)

    def test_modifiers(self):
        s = scene()
        s.mesh("block", "Polyhedron", box((1, 1, 1)), stored_mesh=mesh(SQUARE, [[0, 1, 2, 3]]), modifiers=["Solidify"])
        made = built(s)
        self.assertEqual(rules(made, "hint"), ["modifiers"])
        self.assertEqual(len(made.model.root.primitives[0].fields["faces"]), 6)

    def test_faults_of_a_modified_mesh_cannot_be_selected(self):
        s = scene()
        s.mesh("block", "Polyhedron", mesh(SQUARE, [[0, 1, 2, 3]]), stored_mesh=mesh(SQUARE), modifiers=["Array"])
        self.assertTrue(build(s.snapshot()).findings.errors[0].evaluated)

    def test_unmarked_branches_may_be_anything(self):
        s = scene()
        s.primitive("p", "Point")
        s.empty("lamp", "none", s.root, type="LIGHT", constraints=["Track To"], scale=(0.0, 0.0, 0.0), hidden=True)
        self.assertEqual(list(built(s).findings), [])


class Instances(unittest.TestCase):
    def wheels(self):
        s = scene()
        arm = s.group("cart")
        shown = {"collections": ["wheel"], "excluded": True}
        hub = s.empty("hub", "group", None, location=(1.0, 0.0, 0.0), movable=True, **shown)
        s.primitive("tyre", "Sphere", above=hub, radius=0.1, location=(0.0, 0.5, 0.0), **shown)
        for name, side in (("left", 1.0), ("right", -1.0)):
            s.empty(name, "none", arm, instance_of="wheel", location=(0.0, 0.0, side), scale=(side, side, side))
        return s

    def test_each_empty_shows_a_copy(self):
        made = built(self.wheels(), instance_offsets={"wheel": (0.5, 0.0, 0.0)})
        left, right = made.model.root.groups[0].groups
        self.assertEqual((left.name, right.name), ("left.hub", "right.hub"))
        self.assertEqual((left.position, right.position), ((0.5, 0.0, 1.0), (-0.5, 0.0, -1.0)))
        self.assertEqual([g.primitives[0].name for g in (left, right)], ["left.tyre", "right.tyre"])
        self.assertTrue(left.movable)

    def test_collections_within_collections(self):
        s = self.wheels()
        s.empty("axle", "none", None, instance_of="wheel", collections=["axle"], location=(0.0, 2.0, 0.0))
        s.empty("both", "none", s.objects[1], instance_of="axle", location=(0.0, 0.0, 9.0))
        made = built(s, instance_offsets={"wheel": (0.0, 0.0, 0.0), "axle": (0.0, 0.0, 0.0)})
        names = [group.name for group in made.model.root.groups[0].groups]
        self.assertEqual(names, ["both.axle.hub", "left.hub", "right.hub"])
        self.assertEqual(made.model.root.groups[0].groups[0].position, (1.0, 2.0, 9.0))


class LikeTheLoader(unittest.TestCase):
    """The toolkit judges polyhedra as `pong check` does, which reads them as numbers in a text."""

    def shapes(self):
        """Valid and invalid solids near the limits of every tolerance."""
        random.seed(21)
        for case in range(60):
            sides = random.randint(3, 12)
            shape = cylinder(random.uniform(0.1, 3), 0.0, 10.0 ** random.uniform(-7, 1), sides)
            vertices = shape.vertices @ np.linalg.qr(np.random.default_rng(case).normal(size=(3, 3)))[0].T
            diameter = np.linalg.norm(vertices[:, None] - vertices, axis=2).max()
            spoil = random.choice([0.0, 3e-7, 9e-7, 3e-6, 1e-3]) * diameter
            vertices[random.randrange(len(vertices))] += np.array([random.choice([-1, 1]) * spoil for _ in range(3)])
            faces = np.split(shape.loops, shape.face_starts[1:-1])
            if random.random() < 0.5:
                triangles, _, _ = polygon.triangulated(vertices, shape.loops, shape.face_starts)
                faces = list(triangles)
            if np.linalg.det(np.linalg.qr(np.random.default_rng(case).normal(size=(3, 3)))[0]) < 0:
                faces = [face[::-1] for face in faces]
            yield vertices, faces

    @unittest.skipUnless(PONG, "PONG does not name the program")
    def test_the_same_rules_for_the_same_faults(self):
        from core.model import Group, Model, Primitive

        refused = 0
        for vertices, faces in self.shapes():
            solid = Primitive("Polyhedron", "solid", {"vertices": vertices, "faces": faces})
            model = Model("m", {"s": {"stiffness": 1.0}}, Group("m", surface="s", primitives=[solid]))
            hash_found, text = check_model(model)
            mine = {fault["rule"] for fault in polyhedron_faults(vertices, faces)}
            theirs = {line.split(": [")[1].split("]")[0] for line in text.splitlines() if ": [" in line}
            self.assertEqual(mine, theirs, text)
            self.assertEqual(hash_found is None, bool(mine))
            refused += bool(mine)
        self.assertTrue(10 < refused < 50, refused)

    @unittest.skipUnless(PONG, "PONG does not name the program")
    def test_what_is_exported_loads(self):
        """One scene with every kind, through single precision, under an odd chain of transforms."""
        s = scene()
        chain = {
            "rotation_mode": "ZXY",
            "rotation": (0.3, -1.2, 2.0),
            "location": (3.0, -7.1, 0.2),
            "scale": (1.5, 1.5, 1.5),
        }
        arm = s.group("arm", movable=True, bound="Obb", **chain)
        hand = s.group("hand", above=arm, location=(0.1, 0.0, 0.0), rotation_mode="XYZ", rotation=(0.0, 0.5, 0.0))
        s.primitive("point", "Point", above=hand)
        s.primitive("ray", "Ray", above=hand, length=0.2, reach=0.01, response="Axial")
        s.primitive("ball", "Sphere", above=hand, radius=0.1, location=(1.0, 0.0, 0.0))
        s.primitive(
            "egg", "Ellipsoid", above=hand, semi_axes=(0.1, 0.2, 0.3), rotation_mode="XYZ", rotation=(1.0, 2.0, 0.5)
        )
        s.primitive("ground", "Plane", above=hand, location=(0.0, 0.0, -3.0))
        s.mesh("frame", "LineSegment", box((1, 1, 1)), above=hand, scale=(1.0, -2.0, 3.0))
        s.mesh("drum", "Polyhedron", cylinder(0.3, -0.1, 0.4, 24), above=hand, scale=(1.0, 2.0, -0.5))
        s.mesh("wedge", "Polyhedron", prism([(0, 0), (1, 0), (0, 1)], 0.0, 0.1), above=hand, location=(0.0, 5.0, 0.0))
        hills = grid(np.arange(9) * 0.3, np.arange(8) * 0.2, lambda x, y: 0.1 * math.sin(7 * x) * math.cos(5 * y))
        s.mesh("hills", "TriangleMesh", hills, above=hand, two_sided=True, thickness=0.05, location=(0.0, 0.0, 2.0))
        s.mesh("star", "TriangleMesh", mesh(star(6), [list(range(12))]), above=hand, location=(0.0, 0.0, 4.0))
        made = build(in_single_precision(s.snapshot()))
        self.assertEqual(made.findings.errors, [])
        found, text = check_model(made.model)
        self.assertIsNotNone(found, text)

    def test_32_bit_rounding_of_good_shapes_passes(self):
        """Solids near their origin, of any size: the shape is rounded, not refused."""
        for size, sides, turn in itertools.product((1e-3, 1.0, 100.0), (5, 16, 31), (0.0, 0.7)):
            s = scene()
            shape = cylinder(size, -0.3 * size, size, sides)
            c, d = math.cos(turn), math.sin(turn)
            shape.vertices = shape.vertices @ np.array([[c, 0, d], [0, 1, 0], [-d, 0, c]])
            s.mesh("drum", "Polyhedron", shape)
            self.assertEqual(build(in_single_precision(s.snapshot())).findings.errors, [])


if __name__ == "__main__":
    unittest.main()

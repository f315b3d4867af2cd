# SPDX-License-Identifier: GPL-3.0-or-later
"""Model -> scene -> model gives the same bytes, through JSON and through Blender's single precision too."""

import pathlib
import random
import tempfile
import unittest

from support import PONG, author, build, built, check, check_model, in_single_precision, models, np, scene
from core import mesh_file
from core.model import Group, Model, Primitive, Tagged
from core.read import read_file
from core.snapshot_json import dumps, loads, mark_from_json, mark_to_json
from core.marks import Mark, Part
from core.unbuild import turn_of_z, unbuild
from core.transforms import quaternion_matrix
from core.write import write_text


def random_number(size=10.0):
    return random.choice([round(random.uniform(-size, size), 3), random.uniform(-size, size), 0.0])


def random_vector(size=10.0):
    return tuple(random_number(size) for _ in range(3))


def random_rotation():
    q = np.array([random.gauss(0, 1) for _ in range(4)])
    return random.choice([(1.0, 0.0, 0.0, 0.0), tuple((q / np.sqrt(q @ q)).tolist()), (0.5, -0.5, 0.5, -0.5)])


def random_primitive(index):
    """Every kind with odd numbers: full precision, 32-bit values, short decimals."""
    turned = author.box(np.abs(random_vector(1)) + 0.1)
    matrix = quaternion_matrix(random_rotation())
    solid = turned.vertices @ matrix.T + random_vector(1)
    faces = np.array([[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]])
    length = abs(random_number()) + 0.01
    size = tuple(abs(random_number()) + 0.01 for _ in range(3))
    single = float(np.float32(random.uniform(0.1, 1)))
    kind, fields = random.choice([
        ("Point", {"position": random_vector()}),
        ("LineSegment", {"ends": (random_vector(), (11.0, 0.1, single))}),
        ("Ray", {"origin": random_vector(), "direction": (0.1, random_number(), single), "length": length, "reach": 0.1}),
        ("Ray", {"origin": random_vector(), "direction": (0.0, 0.0, -2.0), "length": single, "response": "Axial"}),
        ("Sphere", {"center": random_vector(), "radius": length}),
        ("Ellipsoid", {"center": random_vector(), "semi_axes": size, "orientation": random_rotation()}),
        ("Plane", {"normal": (random_number(), 0.3, single), "offset": random_number()}),
        ("Triangle", {"vertices": ((0.0, 0.0, 0.0), (1.0, 0.1, 0.0), (0.0, 20.0, single)), "two_sided": True}),
        ("TriangleMesh", {"vertices": solid, "triangles": np.array([[0, 1, 2], [5, 4, 2]]), "thickness": length}),
        ("Polyhedron", {"vertices": solid, "faces": faces, "inactive_faces": (0, 4)}),
        ("Capsule", {"ends": (random_vector(), (11.0, 0.1, single)), "radius": length}),
        ("Cylinder", {"ends": (random_vector(), (11.0, 0.1, single)), "radius": single}),
        ("Cone", {"ends": (random_vector(), (11.0, 0.1, single)), "radii": (length, 0.0)}),
        ("Bore", {"ends": (random_vector(), (11.0, 0.1, single)), "radii": (single, length), "mouths": (True, False)}),
        ("Custom", {"kind": "torus", "parameters": (1.0, single)}),
    ])  # fmt: skip
    return Primitive(
        kind, f"p{index}" if random.random() < 0.7 else f"{kind} {index}", fields, random.choice([None, "ice"])
    )


def random_group(name, depth):
    group = Group(
        name, random.random() < 0.3, random_vector(), random_rotation(),
        random.choice([None, "Sphere", "Obb", "Custom:torus"]), random.choice([None, "ice"]),
    )  # fmt: skip
    group.leaf_size = random.choice([None, None, 1, 32])
    group.contact = random.choice([None, "Marked"])
    if depth < 3 and not group.movable and random.random() < 0.2:
        group.bound = "Above"
    if depth and random.random() < 0.6:
        names = random.sample([f"g{i}" for i in range(12)], 3)
        group.groups = [random_group(below, depth - 1) for below in names]
    else:
        group.primitives = [random_primitive(i) for i in random.sample(range(30), 4)]
    return group


def random_model(seed):
    random.seed(seed)
    ice = {"stiffness": 1e5, "normal": Tagged("Linear", {"restitution": {"e": 0.3, "mass": 7.0}})}
    root = random_group("root", 3)
    root.position = root.orientation = None
    root.movable, root.surface = False, "Steel"
    pairs = [{"surfaces": ("ice", "other"), "friction": None, "stiffness": 0.1}]
    return Model("model", {"Steel": {"stiffness": float("inf")}, "ice": ice}, root, pairs, bool(seed % 2))


class Models(unittest.TestCase):
    def back(self, model, folder=None):
        made = build(in_single_precision(loads(dumps(unbuild(model, folder)))))
        self.assertEqual(list(map(str, made.findings.errors)), [])
        return made

    def test_those_of_the_repository(self):
        for path in models():
            with self.subTest(path.name):
                model = read_file(path)
                self.assertEqual(write_text(self.back(model, path.parent).model), write_text(model))

    def test_random_ones(self):
        for seed in range(60):
            with self.subTest(seed):
                model = random_model(seed)
                self.assertEqual(write_text(self.back(model).model), write_text(model))

    def test_filters(self):
        point = Primitive("Point", "p", {"position": (0.0, 0.0, 0.0)})
        groups = [Group("base", primitives=[point]), Group("arm", True, primitives=[point])]
        model = Model("m", {"s": {"stiffness": 1.0}}, Group("m", surface="s", groups=groups), filters=[("arm", "base")])
        self.assertIn('filters: [("arm", "base")],', write_text(model))
        made = self.back(model)
        self.assertEqual(write_text(made.model), write_text(model))
        self.assertEqual(made.loaded.warnings, [])
        model.filters = [("arm", "bass")]
        refused = build(loads(dumps(unbuild(model)))).findings.errors
        self.assertIn("bass", str(refused[0]))

    def test_solids(self):
        """Every field of solids; `Marked` below `Solid`, and `Marked` of the root, which is its default."""
        shape = author.box((0.1, 0.2, 1 / 3))
        faces = np.array([[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]])
        bristle = Tagged("Bristle", {"mu": 0.3, "rolling": 1 / 3e3, "spinning": 2e-4})
        surfaces = {
            "pad": {"stiffness": 1e5, "foundation": 1e9 / 3, "friction": bristle},
            "plate": {"stiffness": 1e6, "area": 1 / 700},
        }
        groups = [
            Group("arm", True, surface="plate", primitives=[Primitive("Polyhedron", "p", {"vertices": shape.vertices, "faces": faces})]),
            Group("feet", True, contact="Marked", primitives=[Primitive("Point", "q", {"position": (0.0, 0.0, 0.0)})]),
        ]
        for contact in ("Solid", "Marked", None):
            model = Model("m", surfaces, Group("m", surface="pad", groups=groups, contact=contact))
            text = write_text(model)
            made = self.back(model)
            self.assertEqual(write_text(made.model), text)
            self.assertEqual(made.model.root.contact, contact)
            for word in ("foundation: 333333333.3333333", "area: 0.0014285714285714286", "rolling: ", "spinning: "):
                self.assertIn(word, text)

    def test_names_that_blender_cannot_keep(self):
        long = "x" * 80
        groups = [
            Group(name, primitives=[Primitive("Point", long, {"position": (0.0, 0.0, 0.0)})])
            for name in ("a", "b", long)
        ]
        model = Model("m", {"s": {"stiffness": 1.0}}, Group("a", surface="s", groups=groups))
        snapshot = unbuild(model, reserved={"b"})
        names = [thing.name for thing in snapshot.objects]
        self.assertEqual(len(set(names) - {"b"}), len(names))
        self.assertLessEqual(max(map(len, names)), 63)
        self.assertEqual(write_text(self.back(model).model), write_text(model))

    def test_mesh_files(self):
        with tempfile.TemporaryDirectory() as folder:
            shape = author.box((0.1, 0.2, 0.3))
            faces = np.array([[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]])
            ground = mesh_file.write("a.stl", shape.vertices, np.array([[0, 2, 1], [1, 2, 3]]), 0.001)
            (pathlib.Path(folder) / "a.stl").write_bytes(ground)
            (pathlib.Path(folder) / "b.obj").write_bytes(mesh_file.write("b.obj", shape.vertices / 3, faces, 25.4))
            files = [
                Primitive("TriangleMesh", "ground", {"file": "a.stl", "scale": 0.001, "two_sided": True}),
                Primitive("Polyhedron", "block", {"file": "b.obj", "scale": 25.4, "inactive_faces": (2,)}),
            ]
            model = Model("m", {"s": {"stiffness": 1.0}}, Group("m", surface="s", primitives=files))
            made = self.back(model, folder)
            self.assertEqual(write_text(made.model), write_text(model))
            for name, data in made.files.items():
                self.assertEqual(data, (pathlib.Path(folder) / name).read_bytes(), name)

    @unittest.skipUnless(PONG, "PONG does not name the program")
    def test_the_engine_sees_no_difference(self):
        for path in models():
            model = read_file(path)
            with self.subTest(path.name):
                back = self.back(model, path.parent)
                hash_back, text = check_model(back.model, back.files)
                self.assertIsNotNone(hash_back, text)
                self.assertEqual(hash_back, check(path)[0])


class AfterTheAuthorTouchesIt(unittest.TestCase):
    """Exact numbers apply only as long as they match Blender's."""

    def model(self, **fields):
        plane = Primitive("Plane", "p", {"normal": (0.1, 0.2, 0.3), "offset": 0.7})
        rest = [Primitive("Point", "q", {"position": (0.1234567891234, 1.0, 2.0)}), plane]
        return Model("m", {"s": {"stiffness": 1.0}}, Group("m", surface="s", primitives=rest))

    def test_a_moved_coordinate_is_what_was_typed(self):
        snapshot = in_single_precision(unbuild(self.model()))
        point = snapshot.objects[1]
        point.transform.location = (point.transform.location[0], float(np.float32(0.3)), 2.0)
        self.assertEqual(build(snapshot).model.root.primitives[0].fields["position"], (0.1234567891234, 0.3, 2.0))

    def test_a_moved_plane_is_where_it_was_moved(self):
        snapshot = in_single_precision(unbuild(self.model()))
        plane = snapshot.objects[2]
        plane.transform.location, plane.transform.rotation = (0.0, 0.0, 5.0), (1.0, 0.0, 0.0, 0.0)
        self.assertEqual(build(snapshot).model.root.primitives[1].fields, {"normal": (0.0, 0.0, 1.0), "offset": 5.0})

    def test_deleted_and_added_vertices(self):
        vertices = np.array([(0.1, 0.2, 1 / 3), (1 / 7, 0.0, 0.0), (2 / 7, 1.0, 0.0), (1.0, 1.0, 5 / 7)])
        s = scene()
        s.mesh("sheet", "Point", author.mesh(vertices))
        snapshot = in_single_precision(s.snapshot())
        snapshot.objects[1].exact["vertices"] = vertices
        kept = snapshot.objects[1].mesh.vertices
        snapshot.objects[1].mesh.vertices = np.concatenate([kept[[3, 1]], np.float32([[0.3, 0.1, 2.0]]).astype(float)])
        made = build(snapshot).model.root.primitives
        expected = [tuple(vertices[3]), tuple(vertices[1]), (0.3, 0.1, 2.0)]
        self.assertEqual([primitive.fields["position"] for primitive in made], expected)


class Order(unittest.TestCase):
    def names(self, s):
        return [primitive.name for primitive in built(s).model.root.primitives]

    def test_names_sort_naturally_whatever_the_order_of_the_scene(self):
        names = ["foot_10", "foot_2", "Foot_1", "arm", "foot_02"]
        for seed in range(5):
            random.seed(seed)
            s = scene()
            for name in random.sample(names, len(names)):
                s.primitive(name, "Point")
            self.assertEqual(self.names(s), ["arm", "Foot_1", "foot_02", "foot_2", "foot_10"])

    def test_a_given_order_counts_before_names(self):
        s = scene()
        for name, order in (("a", 3), ("b", 0), ("c", 1)):
            s.primitive(name, "Point", order=order)
        self.assertEqual(self.names(s), ["c", "a", "b"])


class Json(unittest.TestCase):
    def test_marks_leave_out_defaults_and_come_back(self):
        mark = Mark("primitive", kind="Ray", length=0.1, parts=[Part("tip", "Point", vertices=[1])])
        data = mark_to_json(mark)
        self.assertEqual(set(data), {"role", "version", "kind", "length", "parts"})
        self.assertEqual(mark_from_json(data), mark)

    def test_a_slip_of_the_keyboard_is_refused(self):
        with self.assertRaisesRegex(ValueError, "raduis"):
            mark_from_json({"role": "primitive", "raduis": 1.0})

    def test_snapshots_settle(self):
        for seed in range(10):
            text = dumps(unbuild(random_model(seed)))
            self.assertEqual(dumps(loads(text)), text)


class TurnOfZ(unittest.TestCase):
    def test_it_turns_z_to_the_direction(self):
        random.seed(3)
        directions = [[random.gauss(0, 1) for _ in range(3)] for _ in range(200)]
        directions += [[0, 0, 1], [0, 0, -1], [1e-9, 0, -1], [1, 0, 0], [0, -1, 0], [1e-300, 0, -1e-300]]
        for direction in directions:
            unit = np.array(direction) / np.abs(direction).max()
            unit = unit / np.sqrt(unit @ unit)
            np.testing.assert_allclose(quaternion_matrix(turn_of_z(direction))[:, 2], unit, atol=4e-16)


if __name__ == "__main__":
    unittest.main()

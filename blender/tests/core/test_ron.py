# SPDX-License-Identifier: GPL-3.0-or-later
"""Model files: read as by the engine, written in one form whatever their layout."""

import math
import pathlib
import random
import re
import tempfile
import unittest

from support import PONG, ROOT, check, mesh_files, models, np
from core import marks, mesh_file
from core.engine import wheel
from core.model import Group, Model, Primitive, Tagged
from core.read import ModelFaults, read_file, read_text
from core.schema import RESPONSES, primitives
from core.surfaces import derived
from core.write import write_files, write_text


SURFACE = 'surfaces: {"s": (stiffness: 1.0)}'
HEAD = f'(format: "pong-model", version: 1, name: "m", {SURFACE}, root: (name: "r", surface: "s", primitives: ['
TAIL = "]))"


class Notation(unittest.TestCase):
    """Any valid RON is read as by the engine (crates/pong-model has the tests of that) and written in one form."""

    def test_values(self):
        for written, value in {
            "1": 1.0, "+1.5": 1.5, ".5": 0.5, "5.": 5.0, "1e3": 1000.0, "1E-3": 0.001, "1_000": 1000.0, "0xff": 255.0,
            "-0x10": -16.0, "0b101": 5.0, "0o17": 15.0, "1.5f64": 1.5, "12u8": 12.0, "/* a /* b */ c */ 1 // d\n": 1.0,
        }.items():  # fmt: skip
            with self.subTest(written):
                model = read_text(HEAD + f'Plane(name: "a", normal: (0, 0, 1), offset: {written})' + TAIL)
                self.assertEqual(model.root.primitives[0].fields["offset"], value)

    def test_texts(self):
        for written, value in {
            '"a\\n\\"\\u{3bc}\\x41"': 'a\n"\u03bcA', 'r#"a"b"#': 'a"b', "'x'": "x", '"\u200b"': "\u200b",
        }.items():  # fmt: skip
            with self.subTest(written):
                model = read_text(HEAD + f"Point(name: {written}, position: (0, 0, 0))" + TAIL)
                self.assertEqual(model.root.primitives[0].name, value)

    def test_a_value_left_out_in_any_way_is_left_out(self):
        for surface in ("Some(\"s\")", "\"s\""):
            model = read_text(HEAD + f'Ray(name: "a", surface: {surface}, origin: (0, 0, 0), direction: (0, 0, 1), length: 1, reach: None)' + TAIL)
            self.assertEqual((model.root.primitives[0].surface, "reach" in model.root.primitives[0].fields), ("s", False))
        model = read_text((HEAD + 'Point(name: "a", position: (0, 0, 0))' + TAIL).replace('name: "r",', 'name: "r", bound: Aabb,'))
        self.assertEqual((model.root.bound, model.root.position), (None, None))

    def test_values_may_not_nest_without_end(self):
        with self.assertRaises(ModelFaults) as caught:
            read_text("[" * 129 + "]" * 129)
        self.assertEqual([fault.rule for fault in caught.exception.faults], ["too-deep"])


class Names(unittest.TestCase):
    def test_names_are_those_of_the_format(self):
        tables = wheel().model.schema()
        self.assertEqual(marks.KINDS, tuple(tables["primitives"]))
        self.assertEqual((*marks.BOUNDS, "Custom"), tables["bounds"])
        self.assertEqual(RESPONSES, tables["primitives"]["Ray"]["response"]["choices"])

    def test_defaults_are_values(self):
        defaults = {(kind, field.name): field.default for kind, table in primitives().items() for field in table}
        self.assertEqual(defaults["Ellipsoid", "orientation"], (1.0, 0.0, 0.0, 0.0))
        self.assertEqual(defaults["Bore", "mouths"], (True, True))
        self.assertEqual(defaults["Polyhedron", "inactive_faces"], ())
        self.assertEqual((defaults["Ray", "response"], defaults["Ray", "reach"]), ("Normal", None))
        self.assertEqual((defaults["TriangleMesh", "scale"], defaults["TriangleMesh", "two_sided"]), (1.0, False))


class Faults(unittest.TestCase):
    def faults(self, text):
        with self.assertRaises(ModelFaults) as caught:
            read_text(text, "m.ron")
        return caught.exception.faults

    def test_line_and_column(self):
        (fault,) = self.faults(HEAD + '\n  Sphere(name: "a", center: (0, 0, 0), radius: -1),' + TAIL)
        self.assertEqual((fault.line, fault.column, fault.path, fault.rule), (2, 48, "r/a", "not-positive"))
        self.assertEqual(
            str(fault), "m.ron:2:48: r/a: [not-positive] the radius is -1; the radius must be above zero"
        )

    def test_stiffness_has_a_range(self):
        for stiffness in ("1e101", "1e-101"):
            text = (HEAD + 'Point(name: "a", position: (0, 0, 0))' + TAIL).replace("stiffness: 1.0", f"stiffness: {stiffness}")
            self.assertEqual([fault.rule for fault in self.faults(text)], ["stiffness-range"])
            bristle = f"stiffness: 1.0, friction: Bristle(mu: 0.1, stiffness: {stiffness})"
            text = (HEAD + 'Point(name: "a", position: (0, 0, 0))' + TAIL).replace("stiffness: 1.0", bristle)
            self.assertEqual([fault.rule for fault in self.faults(text)], ["stiffness-range"])
        read_text((HEAD + 'Point(name: "a", position: (0, 0, 0))' + TAIL).replace("stiffness: 1.0", "stiffness: inf"))

    def test_rules(self):
        for body, rule in {
            'Sphere(name: "a", center: (0, 0, 0))': "missing-field",
            'Sphere(name: "a", center: (0, 0), radius: 1)': "wrong-type",
            'Torus(name: "a")': "unknown-kind",
            'Point(name: "a", position: (0, 0, 0), color: 1)': "unknown-field",
            'Point(name: "a", name: "b", position: (0, 0, 0))': "repeated-field",
            'Point(name: "a", position: (0, 0, inf))': "not-finite",
            'Point(name: "a", position: (0, 0, -1e101))': "too-large",
            'TriangleMesh(name: "a", vertices: [(0, 0, 0), (1, 0, 1e154), (0, 1, 0)], triangles: [(0, 1, 2)])': "too-large",
            'Point(name: "", position: (0, 0, 0))': "empty-name",
            'Point(name: "a/b", position: (0, 0, 0))': "slash-in-name",
            'Point(name: "a", position: (0, 0, 0)), Point(name: "a", position: (0, 0, 0))': "repeated-name",
            'Point(name: "a", position: (0, 0, 0), surface: "t")': "unknown-surface",
            'Ellipsoid(name: "a", center: (0, 0, 0), semi_axes: (1, 1, 1), orientation: (1, 1, 0, 0))': "quaternion-norm",
            'Plane(name: "a", normal: (0, 0, 0), offset: 0)': "zero-direction",
            'Polyhedron(name: "a", vertices: [(0, 0, 0)], faces: [[0, -1]])': "not-an-index",
            'TriangleMesh(name: "a", file: "a.stl", vertices: [(0, 0, 0)])': "either-or",
            "": "empty-group",
        }.items():
            with self.subTest(rule):
                self.assertEqual([fault.rule for fault in self.faults(HEAD + body + TAIL)], [rule])

    def test_all_are_told_at_once(self):
        body = 'Sphere(name: "a", center: 1, radius: 0), Point(name: "b", position: (0, 0, 0), color: 1)'
        self.assertEqual(len(self.faults(HEAD + body + TAIL)), 3)


class OfTheDocument(unittest.TestCase):
    def test_every_example_is_read(self):
        text = (ROOT / "docs" / "model_format.md").read_text()
        blocks = re.findall(r"```ron([^\n]*)\n(.*?)```", text, re.DOTALL)
        self.assertGreater(len(blocks), 10)
        surfaces = '"steel": (stiffness: 1e6), "rubber": (stiffness: 1e5)'
        for kind, body in blocks:
            where = kind.strip()
            point = 'Point(name: "p", position: (0, 0, 0))'
            fields = {
                "surfaces": surfaces if where != "surfaces" else body,
                "pairs": body if where == "pairs" else "",
                "root": f'(name: "r", surface: "steel", primitives: [{body if where == "primitives" else point}])',
            }
            if where == "surfaces":
                fields["root"] = (
                    f'(name: "r", surface: "{re.search(chr(34) + "(.*?)" + chr(34), body).group(1)}", primitives: [{point}])'
                )
            if where == "groups":
                fields["root"] = f'(name: "r", surface: "steel", groups: [{body}])'
            whole = (
                f'(format: "pong-model", version: 1, name: "m", surfaces: {{{fields["surfaces"]}}}, '
                f"pairs: [{fields['pairs']}], root: {fields['root']})"
            )
            with self.subTest(where, body=body[:40]):
                model = read_text(body if not where else whole)
                self.assertEqual(write_text(read_text(write_text(model))), write_text(model))


class Layout(unittest.TestCase):
    def test_writing_settles_at_once(self):
        for path in models():
            with self.subTest(path.name):
                text = write_text(read_file(path))
                self.assertEqual(write_text(read_text(text)), text)
                self.assertLessEqual(max(map(len, text.splitlines())), 120)

    def test_numbers_keep_every_bit(self):
        random.seed(1)
        numbers = [random.uniform(-1, 1) * 10.0 ** random.randint(-300, 100) for _ in range(300)]
        numbers += [0.1, 1e22, 1e-7, 5e-324, 1e100, -0.0, 123456789.123456789]
        vertices = np.array(numbers[: len(numbers) // 3 * 3]).reshape(-1, 3)
        triangles = np.arange(len(vertices) // 3 * 3).reshape(-1, 3)
        vertices = vertices[: len(triangles) * 3]
        mesh = Primitive("TriangleMesh", "t", {"vertices": vertices, "triangles": triangles})
        points = [Primitive("Point", f"p{i}", {"position": tuple(v)}) for i, v in enumerate(vertices.tolist())]
        model = Model("m", {"s": {"stiffness": math.inf}}, Group("r", surface="s", primitives=[mesh, *points]))
        read = read_text(write_text(model))
        self.assertEqual(read.root.primitives[0].fields["vertices"].tobytes(), vertices.tobytes())
        for before, after in zip(points, read.root.primitives[1:]):
            self.assertEqual(
                np.array(after.fields["position"]).tobytes(), np.array(before.fields["position"]).tobytes()
            )
        self.assertEqual(read.surfaces, model.surfaces)

    def test_names_keep_every_character(self):
        for name in ('a"b', "back\\slash", "line\nbreak", "µ-Größe", "tab\t", "\u200b", "// no comment", "'"):
            point = name.replace("/", "|")
            group = Group("r", surface=name, primitives=[Primitive("Point", point, {"position": (0.0, 0.0, 0.0)})])
            read = read_text(write_text(Model(name, {name: {"stiffness": 1.0}}, group)))
            self.assertEqual((read.name, read.root.surface, read.root.primitives[0].name), (name, name, point))

    def test_defaults_are_not_written(self):
        text = (
            HEAD.replace("version: 1,", "version: 1, entry_memory: true,")
            + (
                'Ray(name: "a", origin: (0, 0, 0), direction: (0, 0, 1), length: Some(1), reach: None, response: Normal),'
                'Ellipsoid(name: "b", center: (0, 0, 0), semi_axes: (1, 2, 3), orientation: (1, 0, 0, 0), surface: None)'
            )
            + TAIL
        )
        written = write_text(read_text(text))
        for name in ("entry_memory", "reach", "response", "orientation", "None", "bound"):
            self.assertNotIn(name, written)

    def test_unused_vertices_of_a_mesh_are_not_written(self):
        body = 'TriangleMesh(name: "t", vertices: [(9, 9, 9), (0, 0, 0), (1, 0, 0), (0, 1, 0)], triangles: [(1, 2, 3)])'
        fields = read_text(write_text(read_text(HEAD + body + TAIL))).root.primitives[0].fields
        self.assertEqual(fields["vertices"].tolist(), [[0, 0, 0], [1, 0, 0], [0, 1, 0]])
        self.assertEqual(fields["triangles"].tolist(), [[0, 1, 2]])

    def test_laws(self):
        laws = {
            "a": {"stiffness": 1.0, "normal": Tagged("Linear", {"restitution": {"e": 0.5, "mass": 2.0}, "ramp": 0.1})},
            "b": {"stiffness": 1.0, "normal": Tagged("Custom", {"name": "cubic", "parameters": (1.0, 2.0)})},
            "c": {"stiffness": 1.0, "friction": Tagged("Coulomb", {"mu": 0.1, "slip_speed": 0.001})},
            "d": {"stiffness": float("inf")},
            "e": {"stiffness": float("inf"), "friction": None},
        }
        pairs = [{"surfaces": ("a", "b"), "friction": None}, {"surfaces": ("a", "x"), "stiffness": 3.0}]
        pairs += [{"surfaces": ("m/a", "x/a"), "stiffness": 4.0}]
        group = Group(
            "r", surface="a", bound="Custom:torus", primitives=[Primitive("Point", "p", {"position": (0, 0, 0)})]
        )
        model = Model("m", laws, Group("r", groups=[group, Group("arm", True, groups=[group])]), pairs, False, [("arm", "r/r")])
        read = read_text(write_text(model))
        self.assertEqual((read.surfaces, read.pairs, read.entry_memory), (laws, pairs, False))
        self.assertEqual(read.filters, [("arm", "r/r")])
        read.root = read.root.groups[0]
        self.assertEqual(read.root.bound, "Custom:torus")


class Derived(unittest.TestCase):
    def test_damping_of_a_restitution_and_of_a_bristle(self):
        fields = {"stiffness": 1e6, "normal": Tagged("Linear", {"restitution": {"e": 0.5, "mass": 2.0}}),
                  "friction": Tagged("Bristle", {"mu": 0.2})}  # fmt: skip
        values = derived(fields)
        ratio = values["normal"]["damping"] / (2 * math.sqrt(1e6 * 2.0))
        root = math.sqrt(1 - ratio**2)
        rebound = math.exp(-ratio / root * math.atan2(2 * ratio * root, 2 * ratio**2 - 1))
        self.assertAlmostEqual(rebound, 0.5, delta=1e-9)
        self.assertAlmostEqual(values["friction"]["damping"], 2 * math.sqrt(2 / 3 * 1e6 * 2.0), delta=1e-6)
        fields["normal"] = Tagged("HuntCrossley", {"exponent": 1.0, "restitution": {"e": 0.5, "speed": 0.1}})
        self.assertGreater(derived(fields)["normal"]["dissipation"], 0.0)
        self.assertEqual(derived({"stiffness": -1.0}), {})


class MeshFiles(unittest.TestCase):
    SQUARE = np.array([(0.0, 0.0, 0.1), (1.0, 0.0, 0.2), (1.0, 1.0, 0.3), (0.0, 1.0, 1 / 3)])

    def test_obj_keeps_every_bit_and_face(self):
        faces = [np.array([0, 1, 2, 3]), np.array([2, 1, 0])]
        vertices, read = mesh_file.read_obj(mesh_file.write_obj(self.SQUARE, faces))
        self.assertEqual(vertices.tobytes(), self.SQUARE.tobytes())
        self.assertEqual([face.tolist() for face in read], [face.tolist() for face in faces])

    def test_obj_as_others_write_it(self):
        text = b"# x\nmtllib a.mtl\nv 0 0 0 1.0\nv 1 0 0 0.5 0.5 0.5\nv 1 1 0\nvn 0 0 1\no thing\nf 1//1 2//1 3//1\nf -3 -2 -1\nf 1 2\n"
        vertices, faces = mesh_file.read_obj(text)
        self.assertEqual(len(vertices), 3)
        self.assertEqual(faces.tolist(), [[0, 1, 2], [0, 1, 2]])

    def test_stl_binary_and_text(self):
        data = mesh_file.write_stl(self.SQUARE, np.array([[0, 1, 2], [0, 2, 3]]))
        vertices, faces = mesh_file.read_stl(b"solid" + data[5:])
        self.assertEqual(vertices[faces].tolist(), np.float32(self.SQUARE)[[[0, 1, 2], [0, 2, 3]]].tolist())
        text = b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0.1\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n"
        self.assertEqual(mesh_file.read_stl(text)[0].tolist(), [[0, 0, float(np.float32(0.1))], [1, 0, 0], [0, 1, 0]])

    def test_text_of_all_kinds(self):
        facet = b"facet normal nan nan nan\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
        for text in (
            b"solid\n" + facet,
            b"\xef\xbb\xbf  SOLID\tPi\xe8ce\n" + facet.upper() + b"END SOLID",
            b"; a comment\nsolid my facet\n" + facet.replace(b"\n", b"\r") + b"endsolid",
        ):
            self.assertEqual(mesh_file.read_stl(text)[0].tolist(), [[0, 0, 0], [1, 0, 0], [0, 1, 0]], text)
        self.assertEqual(len(mesh_file.read_stl(2 * (b"solid a\n" + facet + b"endsolid a\n"))[1]), 2)
        obj = b"usemtl \ng\n\tv 0 0 0\nv 1 0 \\\r\n 0 # x\nv 0 1 0\no pi\xe8ce\nf 1/1 2//3 \\\n-1\n"
        for text in (obj, obj.replace(b"\r\n", b"\n").replace(b"\n", b"\r")):
            vertices, faces = mesh_file.read_obj(text)
            self.assertEqual((vertices.tolist(), faces.tolist()), ([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]))

    def test_damaged_text_tells_the_line(self):
        facet = b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
        for read, data, line in (
            (mesh_file.read_stl, facet[:51], 2),
            (mesh_file.read_stl, facet.replace(b"endloop", b"vertex 1 1 1"), 7),
            (mesh_file.read_stl, facet.replace(b"vertex 1 0 0\n", b""), 7),
            (mesh_file.read_obj, b"v 0 0 0\nv 1,5 0 0\n", 2),
            (mesh_file.read_obj, b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", 4),
            (mesh_file.read_obj, b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", 4),
        ):
            with self.assertRaisesRegex(mesh_file.MeshFileError, f"line {line}: "):
                read(data)

    def test_damaged_ones_are_refused(self):
        for name, data in (
            ("a.stl", b"\0" * 80 + b"\5\0\0\0"),
            ("a.obj", b"v 1 2\nf 1 1 1\n"),
            ("a.obj", b"v 1 2 3\nf 1 2 3\n"),
        ):
            with self.assertRaises(mesh_file.MeshFileError):
                (mesh_file.read_obj if name.endswith("obj") else mesh_file.read_stl)(data)

    def test_scale_is_taken_out_to_the_last_bit(self):
        random.seed(2)
        for scale in (0.001, 25.4, 0.3048):
            values = np.array([random.uniform(-1e4, 1e4) for _ in range(2000)]) * scale
            self.assertEqual((mesh_file.before_scale(values, scale) * scale).tobytes(), values.tobytes())

    def test_paths_stay_in_the_folder(self):
        for name in ("/a.obj", "../a.obj", "a/../../b.obj", "a\\b.obj", "c:a.obj", ""):
            with self.assertRaises(mesh_file.MeshFileError):
                mesh_file.check_path(name)
        mesh_file.check_path("meshes/a.obj")


class Writing(unittest.TestCase):
    def test_a_fault_leaves_what_was_there(self):
        model = read_file(models()[0])
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "m.ron"
            path.write_text("before")
            (pathlib.Path(folder) / "taken").write_text("a file where a folder should be")
            with self.assertRaises(OSError):
                write_files(path, model, {"taken/a.obj": b""})
            self.assertEqual(path.read_text(), "before")
            self.assertEqual(sorted(p.name for p in pathlib.Path(folder).iterdir()), ["m.ron", "taken"])


@unittest.skipUnless(PONG, "PONG does not name the program")
class TheEngine(unittest.TestCase):
    def test_the_hash_of_a_rewritten_model_is_that_of_the_model(self):
        for path in models():
            with self.subTest(path.name), tempfile.TemporaryDirectory() as folder:
                other = pathlib.Path(folder) / "m.ron"
                write_files(other, read_file(path), mesh_files(path))
                hash_before, _ = check(path)
                self.assertIsNotNone(hash_before)
                self.assertEqual(check(other)[0], hash_before)


if __name__ == "__main__":
    unittest.main()

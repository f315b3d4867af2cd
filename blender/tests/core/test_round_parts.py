# SPDX-License-Identifier: GPL-3.0-or-later
"""Capsules, cylinders, cones and bores: built, unbuilt, proposed, compared with their display, drawn."""

import math
import unittest

from support import PONG, build, built, check_model, in_single_precision, np, rules, scene
from core import overlay
from core.author import box, cylinder, mesh
from core.exact import without_rounding
from core.model import Group, Model, Primitive
from core.propose import propose_mesh
from core.read import read_text
from core.round_shape import fitted_numbers, off
from core.snapshot_json import dumps, loads, mark_from_json, mark_to_json
from core.unbuild import unbuild
from core.write import write_text

NUMBERS = {
    "Capsule": {"length": 0.5, "radius": 0.1},
    "Cylinder": {"length": 0.5, "radius": 0.1},
    "Cone": {"length": 0.5, "radii": (0.1, 0.0)},
    "Bore": {"length": 0.5, "radii": (0.1, 0.2), "thickness": 0.01, "mouths": (True, False)},
}
QUARTER = (math.sqrt(0.5), 0.0, math.sqrt(0.5), 0.0)  # z to x


def frustum(radii, low, high, sides):
    """A closed mesh around z, without vertices on its axis."""
    turn = [2.0 * math.pi * i / sides for i in range(sides)]
    ring = lambda r, z: [(r * math.cos(a), r * math.sin(a), z) for a in turn]  # noqa: E731
    faces = [[i, (i + 1) % sides, sides + (i + 1) % sides, sides + i] for i in range(sides)]
    faces += [list(range(sides))[::-1], list(range(sides, 2 * sides))]
    return mesh([*ring(radii[0], low), *ring(radii[1], high)], faces)


def one(made):
    return made.model.root.primitives[0]


class Built(unittest.TestCase):
    def test_the_axis_is_z_and_the_middle_the_origin(self):
        for kind, numbers in NUMBERS.items():
            with self.subTest(kind):
                s = scene()
                s.primitive("part", kind, location=(1.0, 2.0, 3.0), rotation=QUARTER, **numbers)
                part = one(built(s))
                self.assertEqual(part.kind, kind)
                np.testing.assert_allclose(part.fields["ends"], [(0.75, 2.0, 3.0), (1.25, 2.0, 3.0)], atol=1e-15)
                for name in ("radius", "radii", "thickness", "mouths"):
                    self.assertEqual(part.fields.get(name), numbers.get(name))

    def test_decimals_stay_short(self):
        s = scene()
        s.primitive("part", "Cylinder", length=0.3, radius=0.1, location=(0.1, 0.0, 0.0))
        self.assertIn("ends: ((0.1, 0.0, -0.15), (0.1, 0.0, 0.15)), radius: 0.1", write_text(built(s).model))

    def test_scale_counts_along_the_axis_and_around_it(self):
        for kind, scale, told in (
            ("Cylinder", (2.0, 2.0, 3.0), []), ("Cylinder", (2.0, -2.0, 3.0), []), ("Cylinder", (2.0, 3.0, 2.0), ["uneven-round"]),
            ("Capsule", (2.0, 2.0, 2.0), []), ("Capsule", (2.0, 2.0, 3.0), ["uneven-round"]),
            ("Bore", (2.0, 2.0, 3.0), []), ("Cone", (1.0, 2.0, 1.0), ["uneven-round"]),
        ):
            with self.subTest(kind, scale=scale):
                s = scene()
                s.primitive("part", kind, scale=scale, **NUMBERS[kind])
                made = build(s.snapshot())
                self.assertEqual(rules(made, "error"), told)
                if not told:
                    fields = one(made).fields
                    np.testing.assert_allclose(fields["ends"], [(0, 0, -0.25 * scale[2]), (0, 0, 0.25 * scale[2])])
                    first = NUMBERS[kind].get("radius") or NUMBERS[kind]["radii"][0]
                    np.testing.assert_allclose(fields.get("radius") or fields["radii"][0], 2.0 * first)

    def test_what_is_sheared_is_refused(self):
        s = scene()
        helper = s.empty("helper", "none", s.root, scale=(1.0, 2.0, 1.0))
        turned = (math.cos(0.3), math.sin(0.3), 0.0, 0.0)
        s.primitive("part", "Cylinder", above=helper, rotation=turned, **NUMBERS["Cylinder"])
        made = build(s.snapshot())
        self.assertEqual(rules(made, "error"), ["sheared-round"])
        self.assertEqual(made.findings.errors[0].fix, "apply-scale")

    def test_numbers_that_make_no_part_are_refused(self):
        for kind, numbers, told in (
            ("Capsule", {"length": 0.5}, ["no-radius"]), ("Cylinder", {"radius": 0.5}, ["no-length"]),
            ("Cone", {"length": 0.5}, ["no-radius"]), ("Cone", {"length": 0.5, "radii": (0.1, -0.1)}, ["no-radius"]),
            ("Bore", {}, ["no-length", "no-radius"]), ("Bore", {"length": math.nan, "radii": (0.1, 0.1)}, ["no-length"]),
            ("Bore", {"length": 0.5, "radii": (0.1, 0.1), "thickness": 0.0}, ["thickness"]),
        ):
            with self.subTest(kind, numbers=numbers):
                s = scene()
                s.primitive("part", kind, **numbers)
                self.assertEqual(rules(build(s.snapshot()), "error"), told)

    def test_in_another_unit(self):
        s = scene()
        s.primitive("part", "Cone", length=500.0, radii=(100.0, 50.0), location=(1000.0, 0.0, 0.0))
        fields = one(built(s, unit_scale=0.001)).fields
        self.assertEqual(fields, {"ends": ((1.0, 0.0, -0.25), (1.0, 0.0, 0.25)), "radii": (0.1, 0.05)})

    @unittest.skipUnless(PONG, "PONG names no program")
    def test_the_engine_takes_them(self):
        s = scene()
        for kind, numbers in NUMBERS.items():
            s.primitive(kind.lower(), kind, **numbers)
        found, text = check_model(built(s).model)
        self.assertIsNotNone(found, text)


def beside(shape, *offsets):
    """A mesh of copies of another one."""
    faces = np.split(shape.loops, shape.face_starts[1:-1])
    count = len(shape.vertices)
    return mesh(
        np.concatenate([shape.vertices + np.asarray(offset) for offset in offsets]),
        [face + count * index for index in range(len(offsets)) for face in faces],
    )


class Pieces(unittest.TestCase):
    """A mesh of several bodies: rows and mirror images of modifiers, pins that were joined."""

    ROW = ((0.0, 0.0, 0.0), (0.25, 0.0, 0.0), (0.5, 0.1, 0.0))

    def row(self, kind, shape, **more):
        s = scene()
        s.mesh("pin", kind, beside(shape, *self.ROW), stored_mesh=shape, modifiers=["Array"], **more)
        return build(in_single_precision(s.snapshot()))

    def test_each_is_a_body_of_the_size_and_in_the_place_that_is_shown(self):
        pin, made = frustum((0.1, 0.1), -0.25, 0.25, 8), []
        for kind, shape, numbers in (
            ("Cylinder", pin, {"length": 0.5, "radius": 0.1}),
            ("Bore", pin, {"length": 0.5, "radii": (0.1, 0.1)}),
            ("Cone", frustum((0.1, 0.05), -0.25, 0.25, 12), {"length": 0.5, "radii": (0.1, 0.05)}),
            ("Capsule", ball_ended(), {"length": 0.3, "radius": 0.1}),
        ):
            with self.subTest(kind):
                made = self.row(kind, shape, **numbers)
                self.assertEqual((rules(made, "error"), rules(made, "warning")), ([], []))
                self.assertEqual(rules(made, "hint"), ["modifiers", "several-pieces"])
                parts = made.model.root.primitives
                self.assertEqual([part.name for part in parts], ["pin_0", "pin_1", "pin_2"])
                half = numbers["length"] / 2
                for part, (x, y, _) in zip(parts, self.ROW):
                    self.assertEqual(part.fields["ends"], ((x, y, -half), (x, y, half)))
                    self.assertEqual({name: part.fields[name] for name in numbers if name != "length"},
                                     {name: value for name, value in numbers.items() if name != "length"})

    def test_a_mark_of_another_size_is_told_and_what_is_shown_counts(self):
        made = self.row("Cylinder", frustum((0.1, 0.1), -0.25, 0.25, 32), length=0.5, radius=0.7)
        self.assertEqual(rules(made, "warning"), ["size-not-shown"])
        self.assertEqual([part.fields["radius"] for part in made.model.root.primitives], [0.1] * 3)

    def test_along_any_axis_and_under_a_transform(self):
        pin = frustum((0.1, 0.1), -0.25, 0.25, 32)
        turn = np.array([[0.6, 0.0, 0.8], [0.0, 1.0, 0.0], [-0.8, 0.0, 0.6]])
        pin.vertices = pin.vertices @ turn.T
        s = scene()
        s.mesh("pin", "Cylinder", beside(pin, *self.ROW), stored_mesh=pin, modifiers=["Array"], length=0.5, radius=0.1,
               rotation=QUARTER, location=(1.0, 2.0, 3.0), scale=(2.0, 2.0, 2.0))
        made = build(in_single_precision(s.snapshot()))
        self.assertEqual(rules(made, "error"), [])
        parts = made.model.root.primitives
        self.assertEqual([part.fields["radius"] for part in parts], [0.2] * 3)
        for part, (x, y, z) in zip(parts, self.ROW):
            middle = np.array([1.0 + 2 * z, 2.0 + 2 * y, 3.0 - 2 * x])
            low, high = np.array(part.fields["ends"])
            np.testing.assert_allclose((low + high) / 2, middle, atol=2e-6)
            np.testing.assert_allclose(np.abs(high - low), (0.6, 0.0, 0.8), atol=2e-6)

    def test_balls_too(self):
        ball = round_ball(0.1)
        for kind, numbers, field in (("Sphere", {"radius": 0.1}, 0.1), ("Ellipsoid", {"semi_axes": (0.1,) * 3}, (0.1,) * 3)):
            made = self.row(kind, ball, **numbers)
            self.assertEqual((rules(made, "error"), rules(made, "warning")), ([], []))
            for part, center in zip(made.model.root.primitives, self.ROW):
                self.assertEqual(part.fields["center"], center)
                self.assertEqual(part.fields.get("radius") or part.fields["semi_axes"], field)

    def test_pins_that_were_joined_too_but_no_decoration(self):
        pin, s = frustum((0.1, 0.1), -0.25, 0.25, 32), scene()
        s.mesh("pins", "Cylinder", beside(pin, *self.ROW), length=0.5, radius=0.1)
        self.assertEqual(len(built(s).model.root.primitives), 3)
        inner = beside(pin, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
        inner.vertices[len(pin.vertices) :] *= 0.5
        boxes = beside(box((0.1, 0.1, 0.5)), (0.0, 0.0, 0.0), (0.3, 0.0, 0.0))
        for shown in (inner, boxes):
            s = scene()
            s.mesh("pin", "Cylinder", shown, length=0.5, radius=0.1)
            self.assertEqual(len(built(s).model.root.primitives), 1)

    def test_a_pin_as_wide_as_long_is_no_capsule_and_says_why(self):
        s = scene()
        s.mesh("lug", "Capsule", frustum((0.003, 0.003), -0.003, 0.003, 32), radius=0.003)
        (finding,) = build(s.snapshot()).findings.errors
        self.assertEqual((finding.rule, finding.fix), ("no-length", ""))
        self.assertIn("0.006 long and 0.006 wide", finding.cause)
        self.assertIn("Sphere or a Cylinder", finding.cure)

    def test_a_pin_that_lies_has_the_numbers_of_its_own_axis(self):
        lying = frustum((0.003, 0.003), -0.01, 0.01, 32).vertices[:, [2, 0, 1]]
        self.assertEqual(fitted_numbers(lying, "Cylinder"), {"length": 0.02, "radius": 0.003})
        self.assertEqual(fitted_numbers(lying, "Capsule"), {"length": 0.014, "radius": 0.003})


class Decimals(unittest.TestCase):
    def test_sums_of_decimals_are_decimals(self):
        s = scene()
        s.primitive("plug", "Cylinder", length=0.04, radius=0.02, location=(0.0, 0.0, 0.06))
        helper = s.empty("helper", "none", s.root, location=(0.1, 0.0, 0.0))
        s.primitive("tip", "Point", above=helper, location=(0.2, 0.0, 0.0))
        text = write_text(built(s).model)
        self.assertIn("ends: ((0.0, 0.0, 0.04), (0.0, 0.0, 0.08))", text)
        self.assertIn("position: (0.3, 0.0, 0.0)", text)

    def test_numbers_that_are_no_short_decimals_stay_and_none_moves_by_more_than_rounding(self):
        rng = np.random.default_rng(1)
        numbers = rng.normal(size=20000)
        found = without_rounding(numbers, 1.0)
        self.assertLess(np.mean(found != numbers), 0.02)
        self.assertLess(np.abs(found - numbers).max(), 1e-15)
        short = np.round(numbers, 7)
        np.testing.assert_array_equal(without_rounding(short + rng.choice([-2, 0, 2], 20000) * 2.0**-53, 1.0), short)
        for size in (0.0, np.inf, np.nan, 1e-300, 1e300):
            np.testing.assert_array_equal(without_rounding(numbers, size), numbers)


class BackAgain(unittest.TestCase):
    """A model becomes a scene and the same model again, byte for byte."""

    def model(self, seed):
        rng = np.random.default_rng(seed)
        place = lambda: tuple(rng.normal(size=3).tolist())  # noqa: E731
        parts = []
        for index, kind in enumerate([*NUMBERS] * 3):
            fields = {"ends": (place(), place())}
            if kind in ("Capsule", "Cylinder"):
                fields["radius"] = float(rng.uniform(0.01, 1.0))
            else:
                fields["radii"] = (float(rng.uniform(0.01, 1.0)), float(rng.choice([0.0, 0.25, rng.uniform()])))
            if kind == "Bore" and index > 4:
                fields |= {"thickness": float(rng.uniform(0.01, 1.0)), "mouths": (False, bool(index > 8))}
            parts.append(Primitive(kind, f"{kind}_{index}", fields, None))
        return Model("m", {"s": {"stiffness": 1.0}}, Group("m", surface="s", primitives=parts))

    def test_through_blenders_single_precision(self):
        for seed in range(20):
            with self.subTest(seed):
                model = self.model(seed)
                made = build(in_single_precision(loads(dumps(unbuild(model)))))
                self.assertEqual(list(map(str, made.findings.errors)), [])
                self.assertEqual(write_text(made.model), write_text(model))
                self.assertEqual(write_text(read_text(write_text(model))), write_text(model))

    def test_a_length_that_is_changed_counts(self):
        snapshot = unbuild(self.model(1))
        thing = next(thing for thing in snapshot.objects if thing.mark.kind == "Cylinder")
        middle = np.mean(thing.exact["ends"], axis=0)
        thing.mark.length, thing.exact["length"] = 0.5, np.asarray(0.5)
        made = build(snapshot)
        part = next(p for p in made.model.root.primitives if p.name == thing.name)
        low, high = np.array(part.fields["ends"])
        np.testing.assert_allclose([np.linalg.norm(high - low), *(low + high) / 2], [0.5, *middle], atol=1e-12)

    def test_marks_as_json(self):
        s = scene()
        for kind, numbers in NUMBERS.items():
            mark = s.primitive(kind, kind, **numbers).mark
            data = mark_to_json(mark)
            self.assertEqual(mark_from_json(data), mark)
            self.assertEqual(list(map(type, mark_from_json(data).mouths)), [bool, bool])
            self.assertEqual("mouths" in data, kind == "Bore")


class Shown(unittest.TestCase):
    """Meshes only display a round part; their size is compared with the mark, and proposed."""

    def test_a_mesh_of_the_right_size_is_quiet_and_another_one_is_told(self):
        for kind in NUMBERS:
            radii = (0.1, 0.1) if kind in ("Capsule", "Cylinder") else (0.1, 0.05)
            shape = ball_ended() if kind == "Capsule" else frustum(radii, -0.25, 0.25, 32)
            if kind == "Bore":
                shape = mesh(shape.vertices, np.split(shape.loops, shape.face_starts[1:-1])[:-2])
            numbers = fitted_numbers(shape.vertices, kind)
            self.assertLess(off(shape.vertices, kind, numbers["length"], radii), 1e-6)
            for change, told in ((1.0, []), (1.01, ["size-not-shown"])):
                with self.subTest(kind, change=change):
                    s = scene()
                    s.mesh("part", kind, shape, **{**numbers, "length": change * numbers["length"]})
                    made = build(s.snapshot())
                    self.assertEqual((rules(made, "error"), rules(made, "warning")), ([], told))

    def test_a_mesh_beside_its_origin_and_a_mesh_that_is_none(self):
        dented = frustum((0.1, 0.1), -0.25, 0.25, 32)
        dented.vertices = np.concatenate([dented.vertices, [(0.05, 0.0, 0.0)]])
        for shape, rule, severity in (
            (frustum((0.1, 0.1), 0.0, 0.5, 32), "center-not-shown", "warning"),
            (frustum((0.1, 0.05), -0.25, 0.25, 32), "mesh-not-round", "hint"),
            (dented, "mesh-not-round", "hint"),
        ):
            s = scene()
            s.mesh("part", "Cylinder", shape, length=0.5, radius=0.1)
            self.assertEqual(rules(build(s.snapshot()), severity), [rule])

    def test_an_empty_shows_half_its_length(self):
        for size, told in ((0.25, []), (0.3, ["size-not-shown"])):
            s = scene()
            s.primitive("part", "Cylinder", display_size=size, **NUMBERS["Cylinder"])
            self.assertEqual(rules(build(s.snapshot()), "warning"), told)

    def test_round_meshes_are_proposed_beside_the_polyhedron_and_prisms_are_not(self):
        for shape, kinds, numbers in (
            (cylinder(0.1, -0.25, 0.25, 16), ["Polyhedron", "Cylinder", "TriangleMesh"], {"length": 0.5, "radius": 0.1}),
            (frustum((0.1, 0.05), -0.25, 0.25, 24), ["Polyhedron", "Cone", "TriangleMesh"], {"length": 0.5, "radii": (0.1, 0.05)}),
            (ball_ended(), ["Polyhedron", "Capsule", "TriangleMesh"], {"length": 0.3, "radius": 0.1}),
            (cylinder(0.1, -0.25, 0.25, 8), ["Polyhedron", "TriangleMesh"], None),
        ):
            found = propose_mesh(shape.vertices, shape)
            self.assertEqual([proposal.kind for proposal in found], kinds)
            if numbers:
                for name, value in numbers.items():
                    np.testing.assert_allclose(found[1].fields[name], value, rtol=1e-6)
                s = scene()
                s.mesh("part", found[1].kind, shape, **found[1].fields)
                self.assertEqual(rules(build(s.snapshot()), "error"), [])


class SamePlace(unittest.TestCase):
    def test_a_copy_in_place_is_told_also_from_the_other_end(self):
        flip = (0.0, 1.0, 0.0, 0.0)
        for kind, numbers in NUMBERS.items():
            back = {**numbers, "radii": tuple(reversed(numbers["radii"]))} if "radii" in numbers else numbers
            for more, count in (({**numbers}, 1), ({**back, "rotation": flip}, 1), ({**numbers, "location": (0.0, 0.0, 0.01)}, 0)):
                with self.subTest(kind, more=more):
                    s = scene()
                    s.primitive("first", kind, **numbers)
                    s.primitive("copy", kind, **more)
                    self.assertEqual(rules(build(s.snapshot()), "warning"), ["same-place"] * count)

    def test_a_cone_the_other_way_round_is_another(self):
        s = scene()
        s.primitive("first", "Cone", length=0.5, radii=(0.1, 0.2))
        s.primitive("other", "Cone", length=0.5, radii=(0.2, 0.1))
        self.assertEqual(rules(build(s.snapshot()), "warning"), [])


class Drawn(unittest.TestCase):
    def test_the_lines_lie_on_the_parts(self):
        s = scene()
        arm = s.group("arm", location=(1.0, 2.0, 3.0), rotation=QUARTER)
        for kind, numbers in NUMBERS.items():
            s.primitive(kind, kind, above=arm, **numbers)
        lines = overlay.round_lines(built(s).model)
        self.assertEqual(sorted(lines), sorted(f"model/arm/{kind}" for kind in NUMBERS))
        for kind, numbers in NUMBERS.items():
            places = lines[f"model/arm/{kind}"] - np.array([1.0, 2.0, 3.0])
            local = np.stack([-places[:, 2], places[:, 1], places[:, 0]], axis=1)
            radii = numbers.get("radii") or (numbers["radius"],) * 2
            self.assertLess(off(local, kind, 0.5, radii), 1e-12)
            longest = 0.25 + (radii[0] if kind == "Capsule" else 0.0)
            np.testing.assert_allclose([local[:, 2].min(), local[:, 2].max()], [-longest, longest], atol=1e-12)


def round_ball(radius):
    """A ball of rows and columns."""
    rows, sides = 8, 16
    places = [(math.pi * i / rows, 2.0 * math.pi * j / sides) for i in range(1, rows) for j in range(sides)]
    vertices = [(math.sin(a) * math.cos(b), math.sin(a) * math.sin(b), math.cos(a)) for a, b in places]
    vertices += [(0.0, 0.0, 1.0), (0.0, 0.0, -1.0)]
    at = lambda i, j: i * sides + j % sides  # noqa: E731
    top, bottom = len(vertices) - 2, len(vertices) - 1
    faces = [[at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)] for i in range(rows - 2) for j in range(sides)]
    faces += [[top, at(0, j), at(0, j + 1)] for j in range(sides)]
    faces += [[bottom, at(rows - 2, j + 1), at(rows - 2, j)] for j in range(sides)]
    return mesh(radius * np.array(vertices), faces)


def ball_ended():
    """A capsule of radius 0.1 whose axis is 0.3 long."""
    quarter, sides = 6, 24
    arcs = [0.5 * math.pi * i / quarter for i in range(1, quarter + 1)]
    rows = [(-0.15 - 0.1 * math.cos(a), 0.1 * math.sin(a)) for a in arcs]
    rows += [(0.15 + 0.1 * math.cos(a), 0.1 * math.sin(a)) for a in reversed(arcs)]
    turn = [2.0 * math.pi * i / sides for i in range(sides)]
    vertices = [(r * math.cos(a), r * math.sin(a), z) for z, r in rows for a in turn]
    vertices += [(0.0, 0.0, -0.25), (0.0, 0.0, 0.25)]
    at = lambda row, i: row * sides + i % sides  # noqa: E731
    last, low, high = len(rows) - 1, len(vertices) - 2, len(vertices) - 1
    faces = [[at(j, i), at(j, i + 1), at(j + 1, i + 1), at(j + 1, i)] for j in range(last) for i in range(sides)]
    faces += [[low, at(0, i + 1), at(0, i)] for i in range(sides)]
    faces += [[high, at(last, i), at(last, i + 1)] for i in range(sides)]
    return mesh(vertices, faces)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-3.0-or-later
"""Copies in place, and sizes that differ from the display."""

import math
import unittest

from support import build, in_single_precision, np, rules, scene
from core.author import box, cylinder, mesh
from core.marks import Part
from test_propose import ball

TURN = (math.cos(0.35), 0.0, math.sin(0.35), 0.0)
EDGE = mesh([(0.1, 0.2, 0.3), (0.4, 0.2, 0.3)], edges=[(0, 1)])
KINDS = {
    "Point": lambda s, name, **more: s.primitive(name, "Point", **more),
    "Sphere": lambda s, name, **more: s.primitive(name, "Sphere", radius=0.1, **more),
    "Ellipsoid": lambda s, name, **more: s.primitive(name, "Ellipsoid", semi_axes=(0.1, 0.2, 0.3), **more),
    "Ray": lambda s, name, **more: s.primitive(name, "Ray", length=0.1, **more),
    "Plane": lambda s, name, **more: s.primitive(name, "Plane", **more),
    "LineSegment": lambda s, name, **more: s.mesh(name, "LineSegment", EDGE, **more),
    "Polyhedron": lambda s, name, **more: s.mesh(name, "Polyhedron", box((1.0, 2.0, 3.0)), **more),
}
PLACE = {"location": (0.1, 0.7, -0.3), "rotation": TURN}


def found(s, rule):
    return [finding for finding in build(s.snapshot()).findings if finding.rule == rule]


class SamePlace(unittest.TestCase):
    def test_a_copy_in_place_is_told_of_every_kind(self):
        for kind, add in KINDS.items():
            with self.subTest(kind):
                s = scene()
                add(s, "first", **PLACE)
                add(s, "copy", **PLACE)
                (finding,) = found(s, "same-place")
                self.assertEqual((finding.severity, finding.object), ("warning", "first"))  # "copy" sorts before
                self.assertIn("model/copy", finding.cause)

    def test_what_stands_elsewhere_is_not(self):
        for kind, add in KINDS.items():
            with self.subTest(kind):
                s = scene()
                add(s, "first", **PLACE)
                add(s, "second", **{**PLACE, "location": (0.1, 0.7, -0.29)})
                if kind not in ("Point", "Sphere"):
                    add(s, "turned", **{**PLACE, "rotation": (1.0, 0.0, 0.0, 0.0)})
                self.assertEqual(found(s, "same-place"), [])

    def test_other_sizes_and_other_kinds_are_not(self):
        s = scene()
        for index in range(3):
            s.primitive(f"ball_{index}", "Sphere", radius=0.1 + 0.1 * index)
        s.primitive("tip", "Point")
        self.assertEqual(found(s, "same-place"), [])

    def test_in_another_group_of_the_body_too_in_single_precision(self):
        for kind, add in KINDS.items():
            with self.subTest(kind):
                s = scene()
                add(s, "first", above=s.group("here"), **PLACE)
                turned = s.group("there", location=(0.3, -0.2, 0.9), rotation=TURN)
                c, w = math.cos(0.7), math.sin(0.7)
                x, y, z = np.array(PLACE["location"]) - (0.3, -0.2, 0.9)
                back = (c * x - w * z, y, w * x + c * z)
                add(s, "copy", above=turned, location=back, rotation=(1.0, 0.0, 0.0, 0.0))
                made = build(in_single_precision(s.snapshot()))
                self.assertEqual(rules(made, "warning"), ["same-place"])

    def test_bodies_that_move_on_their_own_may_meet(self):
        s = scene()
        for name in ("left", "right"):
            s.primitive(f"{name}_tip", "Point", above=s.group(name, movable=True))
        self.assertEqual(found(s, "same-place"), [])

    def test_doubled_vertices_of_one_object_can_be_merged(self):
        s = scene()
        s.mesh("feet", "Point", mesh([(0, 0, 0), (1, 0, 0), (0, 0, 0), (1, 0, 0), (1, 0, 0)]))
        (finding,) = found(s, "same-place")
        self.assertEqual(finding.fix, "merge-by-distance")
        self.assertIn("3 of its Points", finding.cause)

    def test_vertices_in_another_order_are_the_same_solid(self):
        s, solid = scene(), box((1.0, 2.0, 3.0))
        s.mesh("first", "Polyhedron", solid)
        order = np.array([3, 1, 4, 0, 5, 7, 2, 6])  # new index -> old
        place = np.argsort(order)
        faces = np.split(place[solid.loops], solid.face_starts[1:-1])
        s.mesh("second", "Polyhedron", mesh(solid.vertices[order], faces))
        self.assertEqual(len(found(s, "same-place")), 1)

    def test_at_a_border_of_the_search_they_are_found_as_well(self):
        for step in range(40):
            s = scene()
            for name, off in (("first", -2e-7), ("second", 2e-7)):
                s.primitive(name, "Point", location=(step * 1e-6 + off, 0.0, 0.0))
            s.primitive("far", "Point", location=(1.0, 0.0, 0.0))
            self.assertEqual(len(found(s, "same-place")), 1, step)


class SolidsWithSegments(unittest.TestCase):
    def test_an_object_may_be_a_solid_and_have_parts(self):
        s = scene()
        s.mesh("box", "Polyhedron", box((1.0, 1.0, 1.0)), parts=[Part("edge", "LineSegment", edges=list(range(12)))])
        made = build(s.snapshot())
        self.assertEqual(list(made.findings), [])
        kinds = [primitive.kind for primitive in made.model.root.primitives]
        self.assertEqual((kinds.count("Polyhedron"), kinds.count("LineSegment"), len(kinds)), (1, 12, 13))

    def test_parts_and_the_whole_that_say_the_same_are_told(self):
        s = scene()
        s.mesh("box", "Polyhedron", box((1.0, 1.0, 1.0)), parts=[Part("again", "Polyhedron", faces=list(range(6)))])
        self.assertEqual(len(found(s, "same-place")), 1)


class ShownSizes(unittest.TestCase):
    def shown(self, kind, shape=None, display_size=None, unit_scale=1.0, **sizes):
        s = scene()
        if shape is None:
            s.primitive("ball", kind, **sizes)
            s.objects[-1].display_size = display_size
        else:
            s.mesh("ball", kind, shape, **sizes)
        made = build(s.snapshot(unit_scale=unit_scale))
        return {finding.rule: finding for finding in made.findings}

    def test_sizes_that_are_shown_are_silent(self):
        axes = (0.1, 0.2, 0.3)
        self.assertEqual(self.shown("Sphere", ball(axes=(0.2,) * 3), radius=0.2), {})
        self.assertEqual(self.shown("Ellipsoid", ball(axes=axes), semi_axes=axes), {})
        self.assertEqual(self.shown("Sphere", display_size=float(np.float32(0.2)), radius=0.2), {})
        self.assertEqual(self.shown("Ellipsoid", display_size=float(np.float32(0.3)), semi_axes=axes), {})
        self.assertEqual(self.shown("Ray", display_size=float(np.float32(0.2)), length=0.2), {})
        self.assertEqual(self.shown("Sphere", radius=0.2), {})  # of a scene that says nothing of it

    def test_scaled_meshes_and_empties_are_told_with_the_repair(self):
        for factor in (2.0, 0.5, 1.0001):
            big = 0.2 * factor
            for kind, shape, sizes, fix in (
                ("Sphere", ball(axes=(big,) * 3), {"radius": 0.2}, "fit-sphere"),
                ("Ellipsoid", ball(axes=(big, big, 3 * big)), {"semi_axes": (0.2, 0.2, 0.6)}, "fit-ellipsoid"),
                ("Sphere", ball(axes=(0.2, 0.2, 3 * big)), {"radius": 0.2}, "fit-ellipsoid"),
            ):
                self.assertEqual(self.shown(kind, shape, **sizes)["size-not-shown"].fix, fix)
            for kind, sizes, fix in (
                ("Sphere", {"radius": 0.2}, "fit-sphere"),
                ("Ray", {"length": 0.2}, "fit-length"),
                ("Ellipsoid", {"semi_axes": (0.1, 0.2, 0.2)}, ""),
            ):
                self.assertEqual(self.shown(kind, display_size=big, **sizes)["size-not-shown"].fix, fix)

    def test_it_is_told_in_metres(self):
        cause = self.shown("Sphere", ball(axes=(500.0,) * 3), radius=250.0, unit_scale=0.001)["size-not-shown"].cause
        self.assertIn("a Sphere of radius 0.5 m, its mark says a Sphere of radius 0.25 m", cause)

    def test_what_is_round_about_another_point_and_what_is_not_round(self):
        away = self.shown("Sphere", ball(center=(0.0, 0.0, 0.5)), radius=1.0)
        self.assertEqual({rule: finding.fix for rule, finding in away.items()}, {"center-not-shown": "set-origin"})
        self.assertEqual(list(self.shown("Sphere", box((1.0, 1.0, 1.0)), radius=0.5)), ["mesh-not-round"])
        self.assertEqual(list(self.shown("Ellipsoid", cylinder(1.0, -1.0, 1.0, 12), semi_axes=(1.0, 1.0, 0.5))), ["mesh-not-round"])


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-3.0-or-later
"""Sizes that the engine refuses are refused by the toolkit, and no others: kind by kind, just inside and just outside."""

import unittest

from support import PONG, build, check_model, np, rules, scene
from core.author import box
from core.size_range import outside

SQUARE = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
BOX = box((1.0, 1.0, 1.0))


def of_size(kind, size):
    """The fields of a primitive of that size, m."""
    return {
        "LineSegment": {"ends": ((0.0, 0.0, 0.0), (0.0, size, 0.0))},
        "Ray": {"length": size, "reach": None},
        "Sphere": {"radius": size},
        "Ellipsoid": {"semi_axes": (size, size, size)},
        "Triangle": {"vertices": size * SQUARE},
        "TriangleMesh": {"vertices": size * SQUARE, "triangles": np.array([[0, 1, 2]])},
        "Polyhedron": {"vertices": size / np.sqrt(3.0) * BOX.vertices},
    }[kind]


KINDS = ("LineSegment", "Ray", "Sphere", "Ellipsoid", "Triangle", "TriangleMesh", "Polyhedron")


class SizeRange(unittest.TestCase):
    def test_limits_of_every_kind(self):
        for kind in KINDS:
            for size, refused in ((0.9e-30, True), (1.1e-30, False), (1.0, False), (0.9e30, False), (1.1e30, True)):
                with self.subTest(kind, size=size):
                    self.assertEqual(outside(kind, of_size(kind, size)) is not None, refused)

    def test_one_size_of_several(self):
        self.assertIsNotNone(outside("Ray", {"length": 1.0, "reach": 1e-31}))
        self.assertIsNone(outside("Ray", {"length": 1.0, "reach": 0.0}))
        self.assertIsNotNone(outside("Ellipsoid", {"semi_axes": (1.0, 1e-31, 1.0)}))
        self.assertIsNotNone(outside("Triangle", {"vertices": SQUARE, "thickness": 1e31}))
        two = {"vertices": np.concatenate([SQUARE, 1e-31 * SQUARE]), "triangles": np.array([[0, 1, 2], [3, 4, 5]])}
        self.assertIsNotNone(outside("TriangleMesh", two))

    def test_what_has_no_size(self):
        for kind, fields in (("Point", {}), ("Plane", {}), ("Custom", {}), ("Sphere", {"radius": 0.0})):
            self.assertIsNone(outside(kind, fields))

    def test_a_scene_is_refused_at_its_object(self):
        for radius, refused in ((1e-31, ["size-range"]), (2e-30, []), (5e29, []), (2e30, ["size-range"])):
            s = scene()
            s.primitive("ball", "Sphere", radius=radius)
            made = build(s.snapshot())
            self.assertEqual(rules(made, "error"), refused)
            if refused:
                self.assertEqual(made.findings.errors[0].object, "ball")
                self.assertIsNone(made.model)

    @unittest.skipUnless(PONG, "PONG names no program")
    def test_the_loader_takes_what_passes(self):
        for radius in (2e-30, 5e29):
            s = scene()
            s.primitive("ball", "Sphere", radius=radius)
            made = build(s.snapshot())
            self.assertIsNotNone(check_model(made.model)[0])


if __name__ == "__main__":
    unittest.main()

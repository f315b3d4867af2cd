# SPDX-License-Identifier: GPL-3.0-or-later
"""The toolkit refuses exactly the sizes that the engine refuses: kind by kind, just inside and just outside."""

import unittest

from support import PONG, build, check_model, np, rules, scene
from core.author import box, mesh

SQUARE = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
BOX = box((1.0, 1.0, 1.0))


def of_size(kind, size):
    """A scene with one object of that kind and size, m."""
    s = scene()
    if kind == "LineSegment":
        s.mesh("thing", kind, mesh([(0.0, 0.0, 0.0), (0.0, size, 0.0)], edges=[(0, 1)]))
    elif kind == "Triangle":
        s.mesh("thing", kind, mesh(size * SQUARE, [[0, 1, 2]]))
    elif kind == "TriangleMesh":
        s.mesh("thing", kind, mesh(np.concatenate([SQUARE - 5.0, size * SQUARE]), [[0, 1, 2], [3, 4, 5]]))
    elif kind == "Polyhedron":
        s.mesh("thing", kind, mesh(size / np.sqrt(3.0) * BOX.vertices, np.split(BOX.loops, BOX.face_starts[1:-1])))
    else:
        sizes = {"Ray": {"length": size}, "Sphere": {"radius": size}, "Ellipsoid": {"semi_axes": (size,) * 3}}
        sizes |= dict.fromkeys(("Capsule", "Cylinder"), {"length": 1.0, "radius": size})
        sizes |= {"Cone": {"length": 1.0, "radii": (size, 0.0)}, "Bore": {"length": size, "radii": (1.0, 1.0)}}
        s.primitive("thing", kind, **sizes[kind])
    return s


KINDS = (
    "LineSegment", "Ray", "Sphere", "Ellipsoid", "Triangle", "TriangleMesh", "Polyhedron", "Capsule", "Cylinder", "Cone", "Bore",
)


class SizeRange(unittest.TestCase):
    def refused(self, s):
        made = build(s.snapshot())
        self.assertIn(rules(made, "error"), ([], ["size-range"]))
        return bool(made.findings.errors)

    def test_limits_of_every_kind(self):
        for kind in KINDS:
            for size, refused in ((0.9e-30, True), (1.1e-30, False), (1.0, False), (0.9e30, False), (1.1e30, True)):
                with self.subTest(kind, size=size):
                    self.assertEqual(self.refused(of_size(kind, size)), refused)

    def test_one_size_of_several(self):
        for fields, refused in (({"reach": 1e-31}, True), ({"reach": 0.0}, False)):
            s = scene()
            s.primitive("thing", "Ray", length=1.0, **fields)
            self.assertEqual(self.refused(s), refused)
        s = scene()
        s.primitive("thing", "Ellipsoid", semi_axes=(1.0, 1e-31, 1.0))
        self.assertTrue(self.refused(s))
        s = scene()
        s.mesh("thing", "Triangle", mesh(SQUARE, [[0, 1, 2]]), thickness=1e31)
        self.assertTrue(self.refused(s))

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

# SPDX-License-Identifier: GPL-3.0-or-later
"""Proposals from shapes whose kind is known."""

import math
import unittest

from support import build, np, scene
from core.author import box, cylinder, grid, mesh
from core.propose import propose, propose_mesh


def ball(rings=8, segments=12, axes=(1.0, 1.0, 1.0), center=(0.0, 0.0, 0.0)):
    """A sphere of latitudes and longitudes, as Blender's UV sphere."""
    polar = [math.pi * (i + 1) / rings for i in range(rings - 1)]
    turn = [2 * math.pi * i / segments for i in range(segments)]
    vertices = [(math.sin(p) * math.cos(a), math.sin(p) * math.sin(a), math.cos(p)) for p in polar for a in turn]
    vertices += [(0, 0, 1), (0, 0, -1)]
    top, bottom = len(vertices) - 2, len(vertices) - 1
    at = lambda i, j: i * segments + j % segments  # noqa: E731
    faces = [[top, at(0, j), at(0, j + 1)] for j in range(segments)]
    faces += [[bottom, at(rings - 2, j + 1), at(rings - 2, j)] for j in range(segments)]
    faces += [
        [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)] for i in range(rings - 2) for j in range(segments)
    ]
    return mesh(np.array(vertices) * axes + center, faces)


class Kinds(unittest.TestCase):
    def first(self, shape):
        return propose_mesh(shape.vertices, shape)[0]

    def test_what_each_shape_is(self):
        notch = mesh(
            [*box((1, 1, 1)).vertices, (0, 0, 0.2)], [*BOX[:1], *BOX[2:], [4, 5, 8], [5, 7, 8], [7, 6, 8], [6, 4, 8]]
        )
        for shape, kind in (
            (mesh([(0, 0, 0)]), "Point"),
            (mesh([(0, 0, 0), (1, 0, 0)]), "Point"),
            (mesh([(0, 0, 0), (1, 0, 0)], edges=[(0, 1)]), "LineSegment"),
            (mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [[0, 1, 2]]), "Triangle"),
            (mesh([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [[0, 1, 2, 3]]), "Plane"),
            (mesh([(0, 0, 0), (1, 0, 0), (1, 1, 1), (0, 1, 0)], [[0, 1, 2, 3]]), "TriangleMesh"),
            (grid(range(4), range(4), lambda x, y: x * y), "TriangleMesh"),
            (box((1, 2, 3)), "Polyhedron"),
            (cylinder(1.0, -1.0, 1.0, 48), "Polyhedron"),  # its corners lie on a sphere
            (notch, "TriangleMesh"),
            (ball(), "Sphere"),
            (ball(axes=(1.0, 2.0, 0.5)), "Ellipsoid"),
        ):
            self.assertEqual(self.first(shape).kind, kind)

    def test_sizes(self):
        found = self.first(ball(axes=(0.3, 0.3, 0.3)))
        self.assertEqual((found.fields, found.fix), ({"radius": 0.3}, ""))
        found = self.first(ball(axes=(0.3, 0.2, 1.0), center=(5.0, 0.0, 0.0)))
        np.testing.assert_allclose(found.fields["semi_axes"], (0.3, 0.2, 1.0), rtol=1e-6)
        self.assertEqual(found.fix, "set-origin")

    def test_reasons_tell_what_stands_in_the_way(self):
        inside_out = mesh(box((1, 1, 1)).vertices, [face[::-1] for face in BOX])
        self.assertEqual(self.first(inside_out).fix, "recalculate-normals")
        two = mesh(
            np.concatenate([box((1, 1, 1)).vertices, box((1, 1, 1), (3, 0, 0)).vertices]), [*BOX, *(np.array(BOX) + 8)]
        )
        self.assertIn("2 pieces", self.first(two).reason)

    def test_what_is_proposed_can_be_built(self):
        for shape in (
            box((1, 1, 1)),
            ball(),
            ball(axes=(1, 2, 3)),
            cylinder(1, 0, 1, 9),
            grid([0, 1], [0, 1], lambda x, y: 0),
        ):
            for proposal in propose_mesh(shape.vertices, shape):
                s = scene()
                s.mesh("thing", proposal.kind, shape, **proposal.fields)
                self.assertEqual(build(s.snapshot()).findings.errors, [], proposal)

    def test_empties(self):
        s = scene()
        self.assertEqual([p.kind for p in propose(s.primitive("x", ""))], ["Point"])
        self.assertEqual(propose(s.empty("y", "none", s.root, type="CAMERA")), [])


BOX = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]

if __name__ == "__main__":
    unittest.main()

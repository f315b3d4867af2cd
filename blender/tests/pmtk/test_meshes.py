# SPDX-License-Identifier: GPL-3.0-or-later
"""Bulk conversion of meshes to and from Blender preserves every index."""

import bpy
import numpy as np
from pong_pmtk.core.snapshot import Mesh
from pong_pmtk.scene import meshes

from .scenes import CUBE, InBlender, mesh


class Bulk(InBlender):
    def there_and_back(self, source):
        made = bpy.data.meshes.new("made")
        meshes.fill(made, source)
        self.assertFalse(made.validate(verbose=True), "Blender had to correct the mesh")
        return meshes.read(made)

    def test_order_and_direction_of_everything_is_kept(self):
        source = Mesh(
            np.arange(18.0).reshape(6, 3) ** 1.5 % 7,
            np.array([[5, 4], [2, 1], [0, 1]]),  # one loose edge, one of a face against its turn, one with it
            np.array([0, 1, 2, 3, 2, 1, 5]),
            np.array([0, 4, 7]),
        )
        found = self.there_and_back(source)
        np.testing.assert_array_equal(found.vertices, source.vertices.astype(np.float32))
        np.testing.assert_array_equal(found.edges[:3], source.edges)
        np.testing.assert_array_equal(found.loops, source.loops)
        np.testing.assert_array_equal(found.face_starts, source.face_starts)
        sides = {frozenset(edge) for edge in [(0, 1), (1, 2), (2, 3), (3, 0), (1, 5), (5, 2), (5, 4)]}
        self.assertEqual({frozenset(edge) for edge in found.edges.tolist()}, sides)
        self.assertEqual(len(found.edges), len(sides))

    def test_loops_know_their_edges(self):
        made = bpy.data.meshes.new("made")
        meshes.fill(made, meshes.read(mesh(CUBE)))
        for polygon in made.polygons:
            for loop in polygon.loop_indices:
                self.assertIn(made.loops[loop].vertex_index, made.edges[made.loops[loop].edge_index].vertices)

    def test_nothing_vertices_alone_and_edges_alone(self):
        none = np.empty((0, 2), int)
        for vertices, edges in ((np.empty((0, 3)), none), (np.ones((3, 3)), none), (np.eye(3), np.array([[2, 0]]))):
            found = self.there_and_back(Mesh(vertices, edges, np.empty(0, int), np.zeros(1, int)))
            np.testing.assert_array_equal(found.vertices, vertices)
            np.testing.assert_array_equal(found.edges, edges)
            self.assertEqual(found.face_starts.tolist(), [0])

    def test_faces_look_flat_as_they_touch(self):
        made = bpy.data.meshes.new("made")
        meshes.fill(made, meshes.read(mesh(CUBE)))
        self.assertFalse(any(polygon.use_smooth for polygon in made.polygons))

# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes in bulk: Blender's to arrays and back."""

import numpy as np

from ..core.snapshot import Mesh


def read(mesh):
    """A Blender mesh as arrays; its stored numbers, widened."""
    starts = _column(mesh.polygons, "loop_start", np.int32, 1)
    return Mesh(
        vertices=_column(mesh.vertices, "co", np.float32, 3).reshape(-1, 3).astype(np.float64),
        edges=_column(mesh.edges, "vertices", np.int32, 2).reshape(-1, 2).astype(np.int64),
        loops=_column(mesh.loops, "vertex_index", np.int32, 1).astype(np.int64),
        face_starts=np.append(starts, len(mesh.loops)).astype(np.int64),
    )


def _column(items, name, dtype, width):
    values = np.empty(len(items) * width, dtype)
    items.foreach_get(name, values)
    return values


def fill(mesh, source):
    """Fills an empty Blender mesh; vertices, edges and faces keep their order."""
    loops = np.asarray(source.loops, np.int32)
    starts = np.asarray(source.face_starts, np.int32)
    edges, loop_edges = _edges(source)
    mesh.vertices.add(len(source.vertices))
    mesh.vertices.foreach_set("co", np.asarray(source.vertices, np.float32).ravel())
    mesh.edges.add(len(edges))
    mesh.edges.foreach_set("vertices", edges.ravel())
    mesh.loops.add(len(loops))
    mesh.loops.foreach_set("vertex_index", loops)
    mesh.loops.foreach_set("edge_index", loop_edges)
    mesh.polygons.add(len(starts) - 1)
    mesh.polygons.foreach_set("loop_start", starts[:-1])
    mesh.update()


def _edges(source):
    """The edges of a mesh, those that only faces have behind those it lists, and each loop's edge."""
    listed = np.asarray(source.edges, np.int64).reshape(-1, 2)
    loops = np.asarray(source.loops, np.int64)
    following = np.arange(1, len(loops) + 1)
    starts = np.asarray(source.face_starts, np.int64)
    full = np.diff(starts) > 0
    following[starts[1:][full] - 1] = starts[:-1][full]
    sides = np.stack([loops, loops[following]], axis=1) if len(loops) else np.empty((0, 2), np.int64)
    count = max(len(source.vertices), 1)
    listed_keys, side_keys = (np.sort(pairs, axis=1) @ (count, 1) for pairs in (listed, sides))
    missing, first = np.unique(side_keys[~np.isin(side_keys, listed_keys)], return_index=True)
    extra = sides[~np.isin(side_keys, listed_keys)][first]
    edges = np.concatenate([listed, extra])
    keys = np.concatenate([listed_keys, missing])
    order = np.argsort(keys, kind="stable")
    loop_edges = order[np.searchsorted(keys[order], side_keys)] if len(side_keys) else np.empty(0, np.int64)
    return edges.astype(np.int32), loop_edges.astype(np.int32)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Bulk conversion of meshes: Blender's to arrays and back."""

import numpy as np

from ..core.snapshot import Mesh

SEQUENCES = {  # where the same stands in Edit Mode
    "position": ("vertices", "co"),
    ".edge_verts": ("edges", "vertices"),
    ".corner_vert": ("loops", "vertex_index"),
}


def read(mesh):
    """A Blender mesh as arrays, with its numbers widened."""
    starts = _column(mesh.polygons, "loop_start", np.int32, 1)
    return Mesh(
        vertices=_attribute(mesh, "position", "vector", np.float32, 3).reshape(-1, 3).astype(np.float64),
        edges=_attribute(mesh, ".edge_verts", "value", np.int32, 2).reshape(-1, 2).astype(np.int64),
        loops=_attribute(mesh, ".corner_vert", "value", np.int32, 1).astype(np.int64),
        face_starts=np.append(starts, len(mesh.loops)).astype(np.int64),
    )


def _attribute(mesh, name, field, dtype, width):
    """Reads attributes as one block of memory; access through `loops` is ten times slower."""
    if mesh.is_editmode:  # there are no attributes then
        items, field = SEQUENCES[name]
        return _column(getattr(mesh, items), field, dtype, width)
    attribute = mesh.attributes.get(name)
    return _column(attribute.data, field, dtype, width) if attribute else np.empty(0, dtype)


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
    mesh.edges.add(len(edges))
    mesh.loops.add(len(loops))
    mesh.polygons.add(len(starts) - 1)
    _set_attribute(mesh, "position", "vector", np.asarray(source.vertices, np.float32))
    _set_attribute(mesh, ".edge_verts", "value", edges)
    _set_attribute(mesh, ".corner_vert", "value", loops)
    _set_attribute(mesh, ".corner_edge", "value", loop_edges)
    mesh.polygons.foreach_set("loop_start", starts[:-1])
    mesh.shade_flat()  # faces are what touches: they are to be seen as they are
    mesh.update()


def _set_attribute(mesh, name, field, values):
    if len(values):
        mesh.attributes[name].data.foreach_set(field, np.ascontiguousarray(values).ravel())


def _edges(source):
    """Edges of a mesh, with those only in faces after the listed ones, and each loop's edge."""
    listed = np.asarray(source.edges, np.int64).reshape(-1, 2)
    loops = np.asarray(source.loops, np.int64)
    sides = np.stack([loops, loops[_following(source)]], axis=1) if len(loops) else np.empty((0, 2), np.int64)
    pairs = np.concatenate([listed, sides])
    keys = pairs.min(axis=1) * max(len(source.vertices), 1) + pairs.max(axis=1)
    _, first, place = np.unique(keys, return_index=True, return_inverse=True)
    new = first >= len(listed)
    numbers = np.where(new, len(listed) + np.cumsum(new) - 1, first)
    edges = np.concatenate([listed, pairs[first[new]]])
    return edges.astype(np.int32), numbers[place.ravel()[len(listed):]].astype(np.int32)


def _following(source):
    """Next loop of its face for each loop."""
    starts = np.asarray(source.face_starts, np.int64)
    following = np.arange(1, len(source.loops) + 1)
    full = np.diff(starts) > 0
    following[starts[1:][full] - 1] = starts[:-1][full]
    return following

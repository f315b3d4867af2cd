# SPDX-License-Identifier: GPL-3.0-or-later
"""Canonical form of a written model: no field at its default, no unused vertex.

The engine sees no difference: it leaves unused vertices aside, and welds those of a polyhedron that are the same place.
"""

from __future__ import annotations

import copy

import numpy as np

from .model import Group, Model, Primitive
from .schema import SOLID_NUMBERS, is_default, primitives


def canonical(model: Model) -> Model:
    """A copy of the model in that form; arrays are shared where nothing changes."""
    surfaces = {name: _surface(surface) for name, surface in model.surfaces.items()}
    root, pairs = _group(model.root, True), copy.deepcopy(model.pairs)
    return Model(model.name, surfaces, root, pairs, model.entry_memory, list(model.filters))


def _surface(surface: dict) -> dict:
    fields = {key: surface[key] for key in ("stiffness", *SOLID_NUMBERS, "normal", "friction") if surface.get(key) is not None}
    if "friction" in surface and surface.get("stiffness") == float("inf"):
        # For a rigid surface, no friction differs from friction left to the partner.
        fields["friction"] = surface["friction"]
    return fields


def _group(group: Group, is_root: bool = False) -> Group:
    position, orientation = group.position, group.orientation
    return Group(
        group.name,
        group.movable and not is_root,
        None if position is None or not any(position) else tuple(map(float, position)),
        None if orientation is None or tuple(orientation) == (1.0, 0.0, 0.0, 0.0) else tuple(map(float, orientation)),
        None if group.bound == "Aabb" and (group.movable or is_root) else group.bound,
        group.surface,
        [_group(below) for below in group.groups],
        [_primitive(primitive) for primitive in group.primitives],
        group.leaf_size,
        group.contact,
    )


def _primitive(primitive: Primitive) -> Primitive:
    fields = {}
    for field in primitives()[primitive.kind]:
        value = primitive.fields.get(field.name)
        if value is not None and not is_default(value, field.default):
            fields[field.name] = value
    if "vertices" in fields and primitive.kind in ("TriangleMesh", "Polyhedron"):
        faces = "triangles" if primitive.kind == "TriangleMesh" else "faces"
        clean = clean_mesh(fields["vertices"], fields[faces], weld=primitive.kind == "Polyhedron")
        fields["vertices"], fields[faces] = clean
    return Primitive(primitive.kind, primitive.name, fields, primitive.surface)


def clean_mesh(vertices: np.ndarray, faces, weld: bool):
    """Vertices and faces without unused vertices and, on request, with bit-equal ones welded.

    A mesh that has worse faults is left as it is, so that they can be told.
    """
    vertices = np.asarray(vertices, dtype=np.float64).reshape(-1, 3)
    flat, widths = flattened(faces)
    if len(flat) == 0 or flat.max() >= len(vertices) or flat.min() < 0:
        return vertices, faces
    target = _welded(vertices, flat, widths) if weld else np.arange(len(vertices))
    used = np.zeros(len(vertices), dtype=bool)
    used[target[flat]] = True
    if used.all():
        return vertices, faces
    number = np.cumsum(used) - 1
    return vertices[used], unflattened(number[target[flat]], widths)


def _welded(vertices: np.ndarray, flat: np.ndarray, widths: np.ndarray) -> np.ndarray:
    """First vertex at the same position for each vertex; the identity if a face would lose a corner."""
    _, first, inverse = np.unique(vertices + 0.0, axis=0, return_index=True, return_inverse=True)
    target = first[inverse.ravel()]
    face = np.repeat(np.arange(len(widths)), widths)
    corners = np.stack([face, target[flat]], axis=1)
    return target if len(np.unique(corners, axis=0)) == len(corners) else np.arange(len(vertices))


def flattened(faces) -> tuple[np.ndarray, np.ndarray]:
    """All indices face after face, and the corner count of each face."""
    if isinstance(faces, np.ndarray):
        return faces.ravel(), np.full(len(faces), faces.shape[1])
    if not len(faces):
        return np.zeros(0, dtype=np.int64), np.zeros(0, dtype=np.int64)
    flat = np.concatenate([np.asarray(face, dtype=np.int64) for face in faces])
    return flat, np.array([len(face) for face in faces])


def unflattened(flat: np.ndarray, widths: np.ndarray):
    """Inverse of `flattened`."""
    if len(widths) and (widths == widths[0]).all():
        return flat.reshape(-1, widths[0])
    return np.split(flat, np.cumsum(widths)[:-1])

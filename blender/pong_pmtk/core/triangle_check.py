# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles of a whole body, checked by the engine (core/engine.py), reported by object and face.

All triangles of a body whose corners are the same to the last bit share vertices, whatever group they belong to.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .shape import Origin
from .engine import wheel
from .model import Group, Primitive
from .scene import Scene
from .transforms import Affine, identity, quaternion_matrix

FIXES = {
    "sliver-triangle": "dissolve-degenerate",
    "duplicate-triangle": "merge-by-distance",
    "winding": "recalculate-normals",
}


@dataclass
class _Body:
    """Triangles of a body: corners in its frame, and the origin and face of each."""

    corners: list[np.ndarray]
    owners: list[Origin]


def check_triangles(scene: Scene, root: Group, origins: dict[int, Origin]) -> None:
    for body in _bodies(root, origins):
        if body.corners:
            _check(scene, body)


def _bodies(root: Group, origins: dict[int, Origin]) -> list[_Body]:
    found: list[_Body] = []

    def walk(group: Group, place: Affine, body: _Body) -> None:
        for primitive in group.primitives:
            corners = _corners(primitive)
            if corners is not None and len(corners) and id(primitive) in origins:
                body.corners.append(place.points(corners))
                body.owners.append(origins[id(primitive)])
        for below in group.groups:
            if below.movable:
                found.append(_Body([], []))
                walk(below, identity(), found[-1])
            else:
                walk(below, place @ pose_of(below), body)

    found.append(_Body([], []))
    walk(root, identity(), found[0])
    return found


def pose_of(group: Group) -> Affine:
    """Pose of a group in the frame of its parent."""
    rotation = np.eye(3) if group.orientation is None else quaternion_matrix(group.orientation)
    return Affine(rotation, np.zeros(3) if group.position is None else np.asarray(group.position, dtype=np.float64))


def _corners(primitive: Primitive) -> np.ndarray | None:
    """(n, 3, 3) corners of the triangles given in the model itself."""
    if primitive.kind == "Triangle":
        return np.asarray(primitive.fields["vertices"], dtype=np.float64)[None]
    if primitive.kind == "TriangleMesh" and "vertices" in primitive.fields:
        return primitive.fields["vertices"][primitive.fields["triangles"]]
    return None


def _check(scene: Scene, body: _Body) -> None:
    starts = np.concatenate([[0], np.cumsum([len(corners) for corners in body.corners])])
    for fault in wheel().model.check_triangles(np.concatenate(body.corners)):
        triangles, rule = fault["triangles"], fault["rule"]
        owner = np.searchsorted(starts, triangles, side="right") - 1
        for index in np.unique(owner):
            origin = body.owners[index]
            own = triangles[owner == index] - starts[index]
            faces = np.unique(origin.faces[own] if origin.faces is not None else own)
            cause = fault["cause"] if len(faces) == 1 else f"of {len(faces)} faces each: {fault['cause']}"
            scene.findings.add(
                fault["severity"], rule, (origin.object, origin.path), cause, fault["cure"],
                faces=faces, evaluated=origin.evaluated, fix=FIXES.get(rule, ""),
            )  # fmt: skip

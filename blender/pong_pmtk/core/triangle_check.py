# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles of a whole body: slivers and duplicates, which the engine refuses, and edges that do not fit together.

All triangles of a body whose corners are the same to the last bit share vertices, whatever group they belong to.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .build_primitives import Origin
from .model import Group, Primitive
from .scene import Scene
from .transforms import Affine, identity, quaternion_matrix

SLIVER = 1e-9
ON_EDGE = 1e-9  # of an edge's length
JUNCTION_PAIRS = 20_000_000  # more pairs of free edges and vertices are left to `pong check`


@dataclass
class _Body:
    """The triangles of a body: corners in its frame, and for each the origin and the face."""

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
    """The pose of a group in the frame of the one above."""
    rotation = np.eye(3) if group.orientation is None else quaternion_matrix(group.orientation)
    return Affine(rotation, np.zeros(3) if group.position is None else np.asarray(group.position, dtype=np.float64))


def _corners(primitive: Primitive) -> np.ndarray | None:
    """(n, 3, 3), of what is given in the model itself."""
    if primitive.kind == "Triangle":
        return np.asarray(primitive.fields["vertices"], dtype=np.float64)[None]
    if primitive.kind == "TriangleMesh" and "vertices" in primitive.fields:
        return primitive.fields["vertices"][primitive.fields["triangles"]]
    return None


class _Told:
    """Turns numbers of a body's triangles into findings, one for each object concerned."""

    def __init__(self, scene: Scene, body: _Body):
        self.findings, self.body = scene.findings, body
        self.starts = np.concatenate([[0], np.cumsum([len(corners) for corners in body.corners])])

    def tell(self, severity: str, rule: str, triangles: np.ndarray, cause: str, cure: str, fix: str = "") -> None:
        owner = np.searchsorted(self.starts, triangles, side="right") - 1
        for index in np.unique(owner):
            origin = self.body.owners[index]
            own = np.unique(triangles[owner == index]) - self.starts[index]
            faces = origin.faces[own] if origin.faces is not None else own
            self.findings.add(
                severity, rule, (origin.object, origin.path), cause.format(n=len(np.unique(faces))), cure,
                faces=np.unique(faces), evaluated=origin.evaluated, fix=fix,
            )  # fmt: skip


def _check(scene: Scene, body: _Body) -> None:
    told = _Told(scene, body)
    corners = np.concatenate(body.corners)
    thin = np.flatnonzero(~(height_share(corners) >= SLIVER))
    if len(thin):
        cause = "{n} faces give slivers: triangles lower than 1e-9 of their longest edge"
        told.tell("error", "sliver-triangle", thin, cause, "dissolve them or move a vertex", "dissolve-degenerate")
        return
    triangles = welded(corners)
    turned = np.take_along_axis(triangles, (triangles.argmin(axis=1)[:, None] + np.arange(3)) % 3, axis=1)
    _, first, inverse = np.unique(turned, axis=0, return_index=True, return_inverse=True)
    repeated = np.flatnonzero(first[inverse.ravel()] != np.arange(len(turned)))
    if len(repeated):
        cause = "{n} faces are there twice in this body"
        told.tell("error", "duplicate-triangle", repeated, cause, "remove one of each two", "merge-by-distance")
    _tell_edges(told, corners, triangles)


def height_share(corners: np.ndarray) -> np.ndarray:
    """Smallest height over longest edge, as the loader has it."""
    edges = np.roll(corners, -1, axis=1) - corners
    longest = np.sqrt((edges**2).sum(axis=2)).max(axis=1)
    safe = np.where(longest > 0.0, longest, 1.0)[:, None]
    area = np.cross(edges[:, 0] / safe, edges[:, 1] / safe)
    return np.where(longest > 0.0, np.sqrt((area**2).sum(axis=1)), 0.0)


def welded(corners: np.ndarray) -> np.ndarray:
    """Vertex numbers of the corners: places equal to the last bit have one number."""
    flat = np.ascontiguousarray(corners.reshape(-1, 3) + 0.0)
    order = np.lexsort(flat.T)
    new = np.ones(len(flat), dtype=np.int64)
    new[1:] = (flat[order[1:]] != flat[order[:-1]]).any(axis=1)
    numbers = np.empty(len(flat), dtype=np.int64)
    numbers[order] = np.cumsum(new) - 1
    return numbers.reshape(-1, 3)


def _tell_edges(told: _Told, corners: np.ndarray, triangles: np.ndarray) -> None:
    starts, ends = triangles.ravel(), np.roll(triangles, -1, axis=1).ravel()
    count = int(triangles.max()) + 1
    keys = np.minimum(starts, ends) * count + np.maximum(starts, ends)
    order = np.argsort(keys, kind="stable")
    _, first, uses = np.unique(keys[order], return_index=True, return_counts=True)
    crowd = order[np.repeat(uses > 2, uses)]
    if len(crowd):
        cause = "{n} faces meet at edges that three or more triangles share; these count as free edges"
        told.tell("warning", "crowded-edge", crowd // 3, cause, "separate the sheets")
    pairs = first[uses == 2]
    same_way = starts[order[pairs]] == starts[order[pairs + 1]]
    if same_way.any():
        wound = np.concatenate([order[pairs[same_way]], order[pairs[same_way] + 1]])
        cause = "{n} faces are wound against their neighbours; their common edges count as free"
        told.tell("warning", "winding", wound // 3, cause, "turn all normals one way", "recalculate-normals")
    _tell_junctions(told, corners, order[first[uses == 1]])


def _tell_junctions(told: _Told, corners: np.ndarray, free: np.ndarray) -> None:
    """Ends of free edges that lie within other free edges."""
    a, b = corners[free // 3, free % 3], corners[free // 3, (free + 1) % 3]
    places = np.unique(a, axis=0)
    if len(free) * len(places) > JUNCTION_PAIRS:
        return
    along = b - a
    length = np.sqrt((along**2).sum(axis=1))
    found = []
    for start in range(0, len(free), 256):
        part = slice(start, start + 256)
        unit = along[part] / length[part, None]
        arms = places[None] - a[part, None]
        t = np.einsum("ijk,ik->ij", arms, unit)
        off = np.sqrt(((arms - t[..., None] * unit[:, None]) ** 2).sum(axis=2))
        margin = ON_EDGE * length[part, None]
        within = (t > margin) & (t < length[part, None] - margin) & (off <= margin)
        found.append(free[part][within.any(axis=1)])
    open_ = np.concatenate(found) if found else np.zeros(0, dtype=np.int64)
    if len(open_):
        cause = "{n} faces have edges within which a vertex of another lies: a crack could open there"
        told.tell("warning", "t-junction", open_ // 3, cause, "cut the larger face at that vertex")

# SPDX-License-Identifier: GPL-3.0-or-later
"""Duplicate primitives of one body in the same position, such as copies pasted and never moved.

Each is a spring of its own, so the contact is as stiff as both together. Triangles are not asked: the engine refuses
those that are there twice (triangle_check.py).
"""

from __future__ import annotations

import itertools
from collections import Counter, defaultdict
from dataclasses import dataclass

import numpy as np

from .shape import Origin
from .model import Group, Primitive
from .round_shape import ROUND_KINDS
from .scene import Scene
from .transforms import Affine, identity, quaternion_matrix
from .triangle_check import pose_of

TOLERANCE = 1e-6  # of the body's size: single precision and a chain of groups round to about a tenth of that
CELLS = 4.0  # tolerances that a cell of the search is wide
# Any three large odd numbers: they hash the numbers of a cell, and colliding ones are compared later.
MIX = np.array([0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9], dtype=np.uint64)
ORDERED = ("Ray", "Plane")
MERGED = ("Point", "LineSegment")  # kinds whose doubles go when vertices are merged


@dataclass
class _Shape:
    """A primitive as points in the frame of its body."""

    kind: str
    points: np.ndarray
    in_order: bool  # whether the first point of another is to be where this one's is
    radii: tuple[float, ...]
    origin: Origin


def check_same_place(scene: Scene, root: Group, origins: dict[int, Origin]) -> None:
    made = Counter(origin.object for origin in origins.values())
    for body in _bodies(root, origins):
        by_kind = defaultdict(list)
        for shape in body:
            by_kind[shape.kind, len(shape.points)].append(shape)
        size = _size(shape for shape in body if shape.kind != "Plane")
        doubles: dict[tuple, list] = defaultdict(list)
        for (kind, _), alike in by_kind.items():
            # Planes are infinite, and their representative points say nothing about the body.
            for one, other in _doubles(alike, TOLERANCE * (_size(alike) if kind == "Plane" else size)):
                doubles[one.kind, one.origin.path, other.origin.path].append((one, other))
        for pairs in doubles.values():
            other = pairs[0][1].origin
            alone = made[other.object] == len(pairs)
            _tell(scene, pairs, alone and other.object != pairs[0][0].origin.object)


def _size(shapes) -> float:
    return max((float(np.abs(shape.points).max()) for shape in shapes), default=0.0)


def _bodies(root: Group, origins: dict[int, Origin]) -> list[list[_Shape]]:
    bodies: list[list[_Shape]] = [[]]

    def walk(group: Group, place: Affine, body: list[_Shape]) -> None:
        for primitive in group.primitives:
            points = _points(primitive, place) if id(primitive) in origins else None
            if points is not None and len(points):
                points, radii, in_order = _turned(primitive, points)
                body.append(_Shape(primitive.kind, points, in_order, radii, origins[id(primitive)]))
        for below in group.groups:
            if below.movable:
                bodies.append([])
                walk(below, identity(), bodies[-1])
            else:
                walk(below, place @ pose_of(below), body)

    walk(root, identity(), bodies[0])
    return bodies


def _turned(primitive: Primitive, points: np.ndarray) -> tuple[np.ndarray, tuple[float, ...], bool]:
    """Points and radii of a primitive, and whether their order matters. A cone may be written from either end."""
    fields = primitive.fields
    if "radius" in fields:
        return points, (fields["radius"],), False
    if "radii" not in fields:
        return points, (0.0,), primitive.kind in ORDERED
    radii = tuple(map(float, fields["radii"]))
    if radii[0] > radii[1]:
        points, radii = points[::-1], radii[::-1]
    return points, radii, radii[0] != radii[1]


def _points(primitive: Primitive, place: Affine) -> np.ndarray | None:
    """Representative points of a primitive, in the frame of its body."""
    f = primitive.fields
    if primitive.kind in ("Point", "Sphere"):
        return place.points(np.array([f["position" if primitive.kind == "Point" else "center"]], dtype=np.float64))
    if primitive.kind == "LineSegment" or primitive.kind in ROUND_KINDS:
        return place.points(np.array(f["ends"], dtype=np.float64))
    if primitive.kind == "Ray":
        origin = np.asarray(f["origin"], dtype=np.float64)
        return place.points(np.array([origin, origin + _unit(f["direction"]) * f["length"]]))
    if primitive.kind == "Ellipsoid":
        turn = quaternion_matrix(f["orientation"]) if f.get("orientation") is not None else np.eye(3)
        axes = (turn * np.asarray(f["semi_axes"], dtype=np.float64)).T
        return place.points(np.asarray(f["center"], dtype=np.float64) + np.concatenate([axes, -axes]))
    if primitive.kind == "Plane":
        normal = place.linear @ _unit(f["normal"])
        foot = normal * (f["offset"] + normal @ place.offset)
        return np.array([foot, foot + normal])
    if primitive.kind == "Polyhedron" and "vertices" in f:
        return place.points(np.asarray(f["vertices"], dtype=np.float64))
    return None


def _unit(direction) -> np.ndarray:
    direction = np.asarray(direction, dtype=np.float64)
    return direction / np.sqrt(direction @ direction)


def _doubles(shapes: list[_Shape], tolerance: float) -> list[tuple[_Shape, _Shape]]:
    """Each shape that coincides with an earlier one, with that."""
    middles = np.array([shape.points.mean(axis=0) for shape in shapes])
    first = list(range(len(shapes)))
    # Points within a tolerance share a cell in at least one of eight grids, each shifted by half a cell.
    for shift in itertools.product((0.0, 0.5), repeat=3) if len(shapes) > 1 and 0.0 < tolerance < np.inf else ():
        for members in _shared_cells(middles / (CELLS * tolerance) + shift):
            _compare(shapes, members, first, tolerance)
    return [(shapes[first[index]], shape) for index, shape in enumerate(shapes) if first[index] != index]


def _shared_cells(places: np.ndarray) -> list[np.ndarray]:
    """Indices of the points that share a cell of width 1, for every cell with more than one."""
    keys = (np.floor(places).astype(np.int64).astype(np.uint64) * MIX).sum(axis=1, dtype=np.uint64)
    order = np.argsort(keys, kind="stable")
    begins = np.flatnonzero(np.concatenate([[True], keys[order][1:] != keys[order][:-1]]))
    return [members for members in np.split(order, begins[1:]) if len(members) > 1]


def _compare(shapes: list[_Shape], members: np.ndarray, first: list[int], tolerance: float) -> None:
    kept: list[int] = []
    for index in members.tolist():
        same = next((other for other in kept if _same(shapes[other], shapes[index], tolerance)), None)
        if same is None:
            kept.append(index)
        else:
            first[index] = min(first[index], first[same])


def _same(one: _Shape, other: _Shape, tolerance: float) -> bool:
    if max(abs(a - b) for a, b in zip(one.radii, other.radii)) > tolerance:
        return False
    if np.abs(one.points - other.points).max() <= tolerance:
        return True
    if one.in_order:
        return False
    # A copy keeps the order of its vertices; separately modelled duplicates do not.
    rest = list(other.points)
    for point in one.points:
        near = next((i for i, place in enumerate(rest) if np.abs(point - place).max() <= tolerance), None)
        if near is None:
            return False
        rest.pop(near)
    return True


def _tell(scene: Scene, pairs: list[tuple[_Shape, _Shape]], whole: bool) -> None:
    """`whole`: the later object consists of duplicates of the other one only."""
    one, other = pairs[0][0].origin, pairs[0][1].origin
    kind, count = pairs[0][1].kind, len(pairs)
    what = f"{count} of its {kind}s are" if count > 1 else f"its {kind} is" if one.path != other.path else f"a {kind} of it is"
    fix = "merge-by-distance" if one.path == other.path and kind in MERGED and not other.evaluated else ""
    twin = f'"{one.path}"' if one.path != other.path else "others of its own" if count > 1 else "another of its own"
    cause = f"{what} in the same place as {twin}: their springs add, so contact is twice as stiff there"
    cure = "merge its vertices" if fix else "delete one of the two, or move it to where it belongs"
    if whole:
        fix, cure = "unmark-copy", f"{cure}; the repair takes this one's mark away and leaves the object"
    scene.findings.warn("same-place", (other.object, other.path), cause, cure, fix=fix)

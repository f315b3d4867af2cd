# SPDX-License-Identifier: GPL-3.0-or-later
"""What a polyhedron must be: the checks of the engine's loader with its tolerances, told by face and vertex.

The order of the checks is the loader's: what follows trusts what went before. A shape that passes here loads.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .polygon import area_vector, longest_edge, off_plane, unit, width
from .polyhedron_merge import LEVELS, HullFace, edges, merge_coplanar, straighten, support

PLANE_TOLERANCE = 1e-6  # of the diameter
SLIVER = 1e-9  # of the longest edge


@dataclass
class Problem:
    """One fault. `off` is by how much a plane is missed, in the unit of the vertices; 0 where none is."""

    rule: str
    cause: str
    cure: str
    faces: list[int] = field(default_factory=list)
    vertices: list[int] = field(default_factory=list)
    off: float = 0.0


class _Refused(Exception):
    def __init__(self, problems: list[Problem]):
        self.problems = problems


def check(vertices: np.ndarray, faces: list[np.ndarray], inactive=()) -> list[Problem]:
    """What is wrong with a polyhedron, in the order of its faces; nothing if the engine takes it."""
    try:
        _check(np.asarray(vertices, dtype=np.float64), faces, set(inactive))
    except _Refused as refused:
        return refused.problems
    return []


def _check(vertices: np.ndarray, faces: list[np.ndarray], inactive: set[int]) -> None:
    if len(faces) < 4:
        cause = f"a solid of {len(faces)} faces"
        raise _Refused([Problem("too-few-faces", cause, "a solid has at least four")])
    welded = weld(vertices)
    faces = [welded[np.asarray(face)] for face in faces]
    used = np.unique(np.concatenate(faces))
    diameter = diameter_of(vertices[used])
    _refuse(_edges_and_widths(vertices, faces))
    _refuse(_closed_surface(vertices, faces))
    _refuse(_volume(vertices, faces, diameter))
    _refuse(_planar(vertices, faces, diameter))
    # The first attempt merges all that lies within the tolerance and leaves the rest as it is. Those after it straighten
    # edges and planes that rounding has bent, and merge less and less, in the end nothing: as in the loader.
    tolerance = PLANE_TOLERANCE * diameter
    problems: list[Problem] = []
    for attempt in range(LEVELS + 2):
        hull = merge_coplanar(vertices, faces, inactive, tolerance, diameter, max(attempt - 1, 0))
        if attempt > 0:
            straighten(vertices, hull, tolerance)
            support(vertices, used, hull, tolerance)
        problems = _convex(vertices, hull, used, diameter)
        if not problems:
            return
    _refuse(problems)


def _refuse(problems: list[Problem]) -> None:
    if problems:
        raise _Refused(problems)


def weld(vertices: np.ndarray) -> np.ndarray:
    """For each vertex the first one at the same place, to the last bit."""
    if not len(vertices):
        return np.zeros(0, dtype=np.int64)
    _, first, inverse = np.unique(vertices + 0.0, axis=0, return_index=True, return_inverse=True)
    return first[inverse.ravel()]


def diameter_of(points: np.ndarray) -> float:
    """Largest distance between two points."""
    largest = 0.0
    for index in range(len(points) - 1):
        arms = points[index + 1 :] - points[index]
        largest = max(largest, float((arms * arms).sum(axis=1).max()))
    return largest**0.5


def _edges_and_widths(vertices: np.ndarray, faces: list[np.ndarray]) -> list[Problem]:
    problems = []
    for index, face in enumerate(faces):
        twice = [int(a) for a, b in edges(face.tolist()) if a == b]
        if twice:
            cause = "two neighbouring vertices are the same place"
            problems.append(Problem("zero-length-edge", cause, "merge the two", [index], twice))
            continue
        corners = vertices[face]
        share = width(corners) / longest_edge(corners) if np.abs(area_vector(corners)).max() > 0.0 else 0.0
        if not share >= SLIVER:
            cause = f"a sliver: its width is {share:.1e} of its longest edge"
            problems.append(Problem("sliver-face", cause, "remove it or move a vertex", [index]))
    return problems


def _closed_surface(vertices: np.ndarray, faces: list[np.ndarray]) -> list[Problem]:
    users: dict[tuple[int, int], int] = {}
    for face in faces:
        for edge in edges(face.tolist()):
            users[edge] = users.get(edge, 0) + 1
    problems = []
    for index, face in enumerate(faces):
        bad = [e for e in edges(face.tolist()) if users[e] != 1 or users.get((e[1], e[0])) != 1]
        if bad:
            a, b = (tuple(vertices[v].tolist()) for v in bad[0])
            cause = f"the edge from {a} to {b} is not shared by exactly two faces in opposite directions"
            cure = "close the surface and turn every face outward"
            problems.append(Problem("open-polyhedron", cause, cure, [index], list(bad[0])))
    return problems


def _volume(vertices: np.ndarray, faces: list[np.ndarray], diameter: float) -> list[Problem]:
    local = (vertices - vertices[faces[0][0]]) / diameter
    six_volumes, largest_area = 0.0, 0.0
    for face in faces:
        corners = local[face]
        area = area_vector(corners)
        six_volumes += float(area @ corners[0])
        largest_area = max(largest_area, float(np.sqrt(area @ area)))
    if abs(six_volumes) <= PLANE_TOLERANCE * largest_area:
        return [_no_thickness()]
    if six_volumes < 0.0:
        cause = "its faces run clockwise seen from outside"
        return [Problem("inside-out", cause, "turn all its normals outward", list(range(len(faces))))]
    return []


def _no_thickness() -> Problem:
    cause = f"the solid is thinner than {PLANE_TOLERANCE:.0e} of its diameter"
    return Problem("zero-volume", cause, "give it a thickness, or make it a TriangleMesh")


def _planar(vertices: np.ndarray, faces: list[np.ndarray], diameter: float) -> list[Problem]:
    problems = []
    for index, face in enumerate(faces):
        off = off_plane(vertices[face]) if len(face) > 3 else 0.0
        if off > PLANE_TOLERANCE * diameter:
            cause = f"a vertex is {off / diameter:.1e} of the diameter off the plane of this face"
            problems.append(
                Problem("face-not-planar", cause, "move it, or cut the face into triangles", [index], off=off)
            )
    return problems


def _convex(vertices: np.ndarray, hull: list[HullFace], used: np.ndarray, diameter: float) -> list[Problem]:
    tolerance = PLANE_TOLERANCE * diameter
    problems, thin = [], False
    cure = "cut the solid into convex pieces"
    for face in hull:
        heights = vertices[used] @ face.normal - face.offset
        thin |= bool(-heights.min() < tolerance)
        heights[np.isin(used, face.outline)] = 0.0
        highest = int(np.argmax(heights))
        if heights[highest] > tolerance:
            place = tuple(vertices[used[highest]].tolist())
            share = f"{heights[highest] / diameter:.1e} of the diameter"
            cause = f"not convex: the vertex {place} is {share} in front of this face"
            problems.append(
                Problem("not-convex", cause, cure, [face.authored], [int(used[highest])], float(heights[highest]))
            )
            continue
        dent = _dent(vertices[face.outline], face.normal)
        if dent > tolerance:
            cause = "the outline of this face has a dent"
            problems.append(Problem("face-not-convex", cause, cure, [face.authored], off=dent))
    if not problems and (thin or len(hull) < 4):
        return [_no_thickness()]
    return sorted(problems, key=lambda problem: problem.faces)


def _dent(corners: np.ndarray, normal: np.ndarray) -> float:
    """How far a corner lies outside the line of an edge."""
    deepest = 0.0
    for start, end in zip(corners, np.roll(corners, -1, axis=0)):
        outward = np.cross(unit(end - start), normal)
        deepest = max(deepest, float(((corners - start) @ outward).max()))
    return deepest

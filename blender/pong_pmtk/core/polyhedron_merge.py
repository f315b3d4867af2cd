# SPDX-License-Identifier: GPL-3.0-or-later
"""Coplanar neighbouring faces count as one when convexity is judged: hulls are often cut into triangles.

Regions grow from the largest faces, whose normals are the surest; a face joins as long as every vertex of the region
stays within the tolerance of the common plane. A region whose outline is ragged is grown again with a quarter of the
tolerance, down to single faces. `straighten` and `support` mend what rounding has bent. These are the engine's rules.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

import numpy as np

from .polygon import area_vector, mean, nearly_convex, plane_of, unit, width

# Below this width (in diameters) the normal of a face is noise and says nothing about its side.
SURE_WIDTH = 4e-6
# By how much the tolerance of a region that is grown again is smaller, and how often that is done.
FINER = 0.25
LEVELS = 5
# How often the plane of a face is tilted until it supports the solid.
TILTS = 8


@dataclass
class HullFace:
    """A planar face: its outline, counter-clockwise, and the lowest face that went into it."""

    normal: np.ndarray
    offset: float
    outline: list[int]
    authored: int


def edges(face: list[int]) -> list[tuple[int, int]]:
    return list(zip(face, face[1:] + face[:1]))


def merge_coplanar(
    vertices: np.ndarray, faces: list[np.ndarray], inactive: set[int], tolerance: float, diameter: float, level: int
) -> list[HullFace]:
    """The planar faces of a closed surface. Regions begin with the tolerance made smaller `level` times; with `LEVELS`
    nothing is merged."""
    regions = _Regions(vertices, faces, inactive, tolerance, diameter)
    sizes = [float(np.sqrt(area @ area)) for area in regions.areas]
    merged: list[HullFace] = []
    regions.settle(sorted(range(len(faces)), key=lambda face: (-sizes[face], face)), level, merged)
    return sorted(merged, key=lambda face: face.authored)


def _face(vertices: np.ndarray, outline: list[int], authored: int) -> HullFace:
    normal, offset = plane_of(vertices[outline])
    return HullFace(normal, offset, outline, authored)


class _Regions:
    def __init__(self, vertices, faces, inactive, tolerance, diameter):
        self.vertices, self.tolerance = vertices, tolerance
        self.faces = [face.tolist() for face in faces]
        self.active = [index not in inactive for index in range(len(faces))]
        self.areas = [area_vector(vertices[face]) for face in faces]
        self.sure = [width(vertices[face]) > SURE_WIDTH * diameter for face in faces]
        self.along = {edge: index for index, face in enumerate(self.faces) for edge in edges(face)}

    def neighbors(self, face: int) -> list[int]:
        return [self.along[(b, a)] for a, b in edges(self.faces[face])]

    def settle(self, order: list[int], level: int, merged: list[HullFace]) -> None:
        """Merges among these faces, the largest first."""
        if level >= LEVELS:
            merged += [_face(self.vertices, self.faces[face], face) for face in order]
            return
        free, ragged = set(order), []
        for seed in order:
            if seed in free:
                region = self.grow(seed, self.tolerance * FINER**level, free)
                face = self.united(region)
                if face is None:
                    ragged.append(region)
                else:
                    merged.append(face)
        for region in ragged:
            self.settle([face for face in order if face in region], level + 1, merged)

    def grow(self, seed: int, tolerance: float, free: set[int]) -> set[int]:
        free.discard(seed)
        region, area, places = {seed}, self.areas[seed], list(self.faces[seed])
        frontier = deque(self.neighbors(seed))
        while frontier:
            face = frontier.popleft()
            if face not in free or self.active[face] != self.active[seed]:
                continue
            united = area + self.areas[face]
            if self.faces_along(face, united) and self.flat(places + self.faces[face], united, tolerance):
                free.discard(face)
                region.add(face)
                area = united
                places += self.faces[face]
                frontier.extend(self.neighbors(face))
        return region

    def faces_along(self, face: int, area: np.ndarray) -> bool:
        return not self.sure[face] or float(unit(self.areas[face]) @ unit(area)) > 0.5

    def flat(self, places: list[int], area: np.ndarray, tolerance: float) -> bool:
        heights = (self.vertices[places] - self.vertices[places[0]]) @ unit(area)
        return float(heights.max() - heights.min()) <= 2.0 * tolerance

    def united(self, region: set[int]) -> HullFace | None:
        """A region as one face, if its outline is one convex loop and its vertices lie near the face's plane."""
        if len(region) == 1:
            only = next(iter(region))
            return _face(self.vertices, self.faces[only], only)
        outline = self.outline(region)
        if outline is None:
            return None
        face = _face(self.vertices, outline, min(region))
        places = [vertex for member in region for vertex in self.faces[member]]
        near = np.abs(self.vertices[places] @ face.normal - face.offset).max() <= self.tolerance
        return face if near and nearly_convex(self.vertices[outline], face.normal, self.tolerance) else None

    def outline(self, region: set[int]) -> list[int] | None:
        """The outline of a region, if it is one loop."""
        following: dict[int, int] = {}
        for face in sorted(region):
            for a, b in edges(self.faces[face]):
                if self.along[(b, a)] not in region:
                    if a in following:
                        return None
                    following[a] = b
        if not following:
            return None
        first = next(iter(following))
        outline, here = [first], following[first]
        while here != first and len(outline) <= len(following):
            outline.append(here)
            if here not in following:
                return None
            here = following[here]
        return outline if len(outline) == len(following) and len(outline) >= 3 else None


def straighten(vertices: np.ndarray, faces: list[HullFace], tolerance: float) -> None:
    """Drops the vertices at which only two faces meet, where that moves the edge between the two by no more than the
    tolerance: rounding gives the short edges of a subdivided straight one directions of their own."""
    users = np.zeros(len(vertices), dtype=int)
    for face in faces:
        for vertex in face.outline:
            users[vertex] += 1
    dropped: set[int] = set()
    for face in faces:
        starts = [place for place, vertex in enumerate(face.outline) if users[vertex] != 2]
        if not starts:
            continue
        around = face.outline[starts[0] :] + face.outline[: starts[0] + 1]
        chain: list[int] = []
        for vertex in around:
            chain.append(vertex)
            if len(chain) > 1 and users[vertex] != 2:
                _drop_between(vertices, chain, tolerance, dropped)
                chain = [vertex]
    for face in faces:
        if sum(vertex not in dropped for vertex in face.outline) < 3:
            dropped.difference_update(face.outline)
    for face in faces:
        face.outline = [vertex for vertex in face.outline if vertex not in dropped]


def _drop_between(vertices: np.ndarray, chain: list[int], tolerance: float, dropped: set[int]) -> None:
    """Drops what lies between the ends of a chain, or between them and the vertex farthest from their line."""
    spans = [(0, len(chain) - 1)]
    while spans:
        start, end = spans.pop()
        a, b = vertices[chain[start]], vertices[chain[end]]
        farthest, off = None, -1.0
        for place in range(start + 1, end):
            away = vertices[chain[place]] - a
            across = away if (a == b).all() else np.cross(away, unit(b - a))
            distance = float(np.sqrt(across @ across))
            if distance >= off:
                farthest, off = place, distance
        if farthest is not None and off > tolerance:
            spans += [(start, farthest), (farthest, end)]
        else:
            dropped.update(chain[start + 1 : end])


def support(vertices: np.ndarray, used: np.ndarray, faces: list[HullFace], tolerance: float) -> None:
    """Tilts planes that a vertex is in front of about the long direction of their faces, until they support the solid:
    across a narrow face rounding decides which way its normal points. A plane that leaves the face's own vertices is not
    taken."""
    for face in faces:
        corners = vertices[face.outline]
        middle, normal, offset = mean(corners), face.normal, face.offset
        others = used[~np.isin(used, face.outline)]
        for _ in range(TILTS):
            heights = vertices[others] @ normal - offset
            if not len(heights) or heights.max() <= tolerance:
                face.normal, face.offset = normal, offset
                break
            tilted = _tilted(corners, normal, vertices[others[int(np.argmax(heights))]])
            if tilted is None:
                break
            normal, offset = tilted, float(tilted @ middle)
            if np.abs(corners @ normal - offset).max() > tolerance:
                break


def _tilted(corners: np.ndarray, normal: np.ndarray, place: np.ndarray) -> np.ndarray | None:
    """The normal of the plane through the long direction of a face and a place in front of it."""

    def farthest(start: np.ndarray) -> np.ndarray:
        squares = ((corners - start) ** 2).sum(axis=1)
        return corners[len(squares) - 1 - int(np.argmax(squares[::-1]))]

    end = farthest(corners[0])
    start = farthest(end)
    along = unit(end - start)
    across = (place - start) - along * float(along @ (place - start))
    if np.abs(across).max() == 0.0:
        return None
    tilted = unit(np.cross(along, unit(across)))
    return -tilted if float(tilted @ normal) < 0.0 else tilted

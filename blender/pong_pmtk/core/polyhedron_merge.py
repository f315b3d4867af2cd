# SPDX-License-Identifier: GPL-3.0-or-later
"""Coplanar neighbouring faces count as one when convexity is judged: hulls are often cut into triangles.

Regions grow from the largest faces, whose normals are the surest; a face joins as long as every vertex of the region
stays within the tolerance of the common plane. These are the engine's rules.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

import numpy as np

from .polygon import area_vector, plane_of, unit, width

# Below this width (in diameters) the normal of a face is noise and says nothing about its side.
SURE_WIDTH = 4e-6


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
    vertices: np.ndarray, faces: list[np.ndarray], inactive: set[int], tolerance: float | None, diameter: float
) -> list[HullFace]:
    """The planar faces of a closed surface; without a tolerance each face as it is."""
    if tolerance is None:
        return [_face(vertices, face.tolist(), index) for index, face in enumerate(faces)]
    regions = _Regions(vertices, faces, inactive, tolerance, diameter)
    merged = []
    for region in regions.all():
        outline = regions.outline(region)
        if outline is not None:
            merged.append(_face(vertices, outline, min(region)))
        else:
            merged += [_face(vertices, faces[f].tolist(), f) for f in sorted(region)]
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

    def all(self) -> list[set[int]]:
        sizes = [float(np.sqrt(area @ area)) for area in self.areas]
        taken: set[int] = set()
        regions = []
        for seed in sorted(range(len(self.faces)), key=lambda face: (-sizes[face], face)):
            if seed not in taken:
                regions.append(self.grow(seed, taken))
        return regions

    def grow(self, seed: int, taken: set[int]) -> set[int]:
        taken.add(seed)
        region, area, places = {seed}, self.areas[seed], list(self.faces[seed])
        frontier = deque(self.neighbors(seed))
        while frontier:
            face = frontier.popleft()
            if face in taken or self.active[face] != self.active[seed]:
                continue
            united = area + self.areas[face]
            if self.faces_along(face, united) and self.flat(places + self.faces[face], united):
                taken.add(face)
                region.add(face)
                area = united
                places += self.faces[face]
                frontier.extend(self.neighbors(face))
        return region

    def faces_along(self, face: int, area: np.ndarray) -> bool:
        return not self.sure[face] or float(unit(self.areas[face]) @ unit(area)) > 0.5

    def flat(self, places: list[int], area: np.ndarray) -> bool:
        heights = (self.vertices[places] - self.vertices[places[0]]) @ unit(area)
        return float(heights.max() - heights.min()) <= 2.0 * self.tolerance

    def outline(self, region: set[int]) -> list[int] | None:
        """The outline of a region, if it is one loop."""
        if len(region) == 1:
            return self.faces[next(iter(region))]
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
            here = following.get(here, first)
        return outline if len(outline) == len(following) else None

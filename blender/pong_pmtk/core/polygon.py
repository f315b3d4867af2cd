# SPDX-License-Identifier: GPL-3.0-or-later
"""Polygons in space: area, plane, width, triangulation. Corners are (n, 3) arrays."""

from __future__ import annotations

import numpy as np


def area_vector(corners: np.ndarray) -> np.ndarray:
    """Twice the area along the polygon's normal (Newell's rule), relative to its first corner."""
    arms = corners[1:] - corners[0]
    return np.cross(arms[:-1], arms[1:]).sum(axis=0)


def unit(v: np.ndarray) -> np.ndarray:
    """A unit vector without overflow at any size; zero stays zero."""
    largest = np.abs(v).max()
    if largest == 0.0:
        return v
    scaled = v / largest
    return scaled / np.sqrt((scaled * scaled).sum())


def mean(corners: np.ndarray) -> np.ndarray:
    return corners[0] + (corners - corners[0]).sum(axis=0) / len(corners)


def plane_of(corners: np.ndarray) -> tuple[np.ndarray, float]:
    """Unit normal and offset: Newell's normal through the mean of the corners."""
    normal = unit(area_vector(corners))
    return normal, float(normal @ mean(corners))


def off_plane(corners: np.ndarray) -> float:
    """Largest distance of a corner from the polygon's plane."""
    return float(off_planes(corners[None])[0])


def off_planes(corners: np.ndarray) -> np.ndarray:
    """`off_plane` of many polygons with the same number of corners, (n, k, 3)."""
    arms = corners - corners[:, :1]
    scale = np.abs(arms).max(axis=(1, 2), keepdims=True)
    arms = arms / np.where(scale > 0.0, scale, 1.0)  # so that no size overflows
    area = np.cross(arms[:, 1:-1], arms[:, 2:]).sum(axis=1)
    size = np.sqrt((area * area).sum(axis=1, keepdims=True))
    normals = area / np.where(size > 0.0, size, 1.0)
    heights = ((arms - arms.mean(axis=1, keepdims=True)) * normals[:, None]).sum(axis=2)
    return np.abs(heights).max(axis=1) * scale[:, 0, 0]


def ears(corners: np.ndarray) -> list[tuple[int, int, int]] | None:
    """Triangulates a simple polygon (indices into `corners`), by ear clipping; `None` if it crosses itself.

    Of all ears the one with the shortest cut goes first, so that no slivers are left over.
    """
    normal = unit(area_vector(corners))
    left = list(range(len(corners)))
    triangles = []
    while len(left) > 3:
        best = None
        for place in range(len(left)):
            ear = _ear(corners, normal, left, place)
            if ear is not None and (best is None or ear < best):
                best = ear
        if best is None:
            return None
        place = best[1]
        triangles.append((left[place - 1], left[place], left[(place + 1) % len(left)]))
        del left[place]
    last = tuple(left)
    if not _turn(corners, normal, *last) > 0.0:
        return None
    return [*triangles, last]


def _turn(corners, normal, a: int, b: int, c: int) -> float:
    return float(np.cross(corners[b] - corners[a], corners[c] - corners[b]) @ normal)


def _ear(corners, normal, left: list[int], place: int) -> tuple[float, int] | None:
    a, b, c = left[place - 1], left[place], left[(place + 1) % len(left)]
    if not _turn(corners, normal, a, b, c) > 0.0:
        return None
    others = [i for i in left if i not in (a, b, c)]
    points = corners[others]
    inside = np.ones(len(others), dtype=bool)
    for start, end in ((a, b), (b, c), (c, a)):
        inside &= np.cross(corners[end] - corners[start], points - corners[start]) @ normal >= 0.0
    if inside.any():
        return None
    cut = corners[c] - corners[a]
    return float(cut @ cut), place


def triangulated(vertices: np.ndarray, loops: np.ndarray, starts: np.ndarray):
    """Triangles of all faces, their source faces, and the faces that cross themselves.

    Quads are cut along the shorter of the diagonals that leave two triangles of the same side; equal ones along 0-2.
    """
    widths = np.diff(starts)
    counts = np.maximum(widths - 2, 0)
    first = np.concatenate([[0], np.cumsum(counts)])
    triangles = np.zeros((int(first[-1]), 3), dtype=np.int64)
    source = np.repeat(np.arange(len(widths)), counts)
    plain = np.flatnonzero(widths == 3)
    triangles[first[plain]] = loops[starts[plain][:, None] + np.arange(3)]
    quads = np.flatnonzero(widths == 4)
    bad = []
    if len(quads):
        corners = loops[starts[quads][:, None] + np.arange(4)]
        cut, crossed = _quad_cuts(vertices[corners])
        triangles[first[quads]] = np.take_along_axis(corners, cut[:, :3], axis=1)
        triangles[first[quads] + 1] = np.take_along_axis(corners, cut[:, 3:], axis=1)
        bad += quads[crossed].tolist()
    for face in np.flatnonzero(widths > 4):
        indices = loops[starts[face] : starts[face + 1]]
        found = ears(vertices[indices])
        if found is None:
            bad.append(int(face))
        else:
            triangles[first[face] : first[face + 1]] = indices[np.array(found)]
    return triangles, source, sorted(bad)


def _quad_cuts(corners: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Six corners of the two triangles of each quad, and whether it crosses itself."""
    a, b, c, d = (corners[:, i] for i in range(4))
    normal = np.cross(c - a, d - b)

    def both_turn(p, q, r, s):
        one = (np.cross(q - p, r - p) * normal).sum(axis=1)
        two = (np.cross(r - p, s - p) * normal).sum(axis=1)
        return (one > 0.0) & (two > 0.0)

    first, second = both_turn(a, b, c, d), both_turn(b, c, d, a)
    shorter = ((d - b) ** 2).sum(axis=1) < ((c - a) ** 2).sum(axis=1)
    use_second = second & (~first | shorter)
    cut = np.where(use_second[:, None], [[1, 2, 3, 1, 3, 0]], [[0, 1, 2, 0, 2, 3]])
    return cut, ~(first | second)

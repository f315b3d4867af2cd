# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether the engine can compute with the sizes of a primitive: the loader's rule `size-range`.

Interference multiplies up to four lengths, and bounding boxes are in single precision: outside of the limits contacts would be
missed. A size of nothing has rules of its own.
"""

from __future__ import annotations

import numpy as np

from .polyhedron_check import diameter_of

SMALLEST_SIZE, LARGEST_SIZE = 1e-30, 1e30  # m, as in crates/pong-model


def outside(kind: str, fields: dict) -> tuple[str, float] | None:
    """What of a primitive is too small or too large, and how long it is, m; `None` if nothing is."""
    for what, size in _sizes(kind, fields):
        if np.isfinite(size) and size > 0.0 and not SMALLEST_SIZE <= size <= LARGEST_SIZE:
            return what, float(size)
    return None


def _sizes(kind: str, fields: dict) -> list[tuple[str, float]]:
    sizes = [("the thickness", fields["thickness"])] if fields.get("thickness") else []
    if kind == "LineSegment":
        a, b = np.asarray(fields["ends"], dtype=np.float64)
        sizes.append(("the length", np.abs(b - a).max()))
    elif kind == "Ray":
        sizes += [("the length", fields["length"]), ("the reach", fields["reach"] or 0.0)]
    elif kind == "Sphere":
        sizes.append(("the radius", fields["radius"]))
    elif kind == "Ellipsoid":
        sizes += [("a semi-axis", min(fields["semi_axes"])), ("a semi-axis", max(fields["semi_axes"]))]
    elif kind in ("Triangle", "TriangleMesh"):
        vertices = np.asarray(fields["vertices"], dtype=np.float64)
        corners = vertices[None] if kind == "Triangle" else vertices[fields["triangles"]]
        if len(corners):
            # By the largest component, which is less than the length by √3 at most: squares could overflow.
            longest = np.abs(np.roll(corners, -1, axis=1) - corners).max(axis=(1, 2))
            sizes += [("the longest edge of a triangle", longest.min()), ("an edge", longest.max())]
    elif kind == "Polyhedron":
        sizes.append(("the diameter", _diameter(np.asarray(fields["vertices"], dtype=np.float64))))
    return sizes


def _diameter(vertices: np.ndarray) -> float:
    """Of the box around it where that decides, for to find the diameter takes longer."""
    extent = float(np.ptp(vertices, axis=0).max()) if len(vertices) else 0.0
    return extent if SMALLEST_SIZE <= extent <= 0.5 * LARGEST_SIZE else float(diameter_of(vertices))

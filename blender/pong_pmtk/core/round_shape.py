# SPDX-License-Identifier: GPL-3.0-or-later
"""Round parts: capsules, cylinders, cones and bores around the z axis of their object, with the origin in their middle.

`length` is the distance of the ends of the axis, at -length/2 and +length/2. A mesh only shows the part: `fit` says
which part it shows, `off` how far its vertices lie from the part's surface.
"""

from __future__ import annotations

import numpy as np

ROUND_KINDS = ("Capsule", "Cylinder", "Cone", "Bore")
ONE_RADIUS = ("Capsule", "Cylinder")
END_SHARE = 1e-3  # of the length: vertices so near to an end lie on its circle


def radii_of(kind: str, numbers: dict) -> tuple[float, float]:
    """Radius at each end, of the numbers of a mark."""
    if kind in ONE_RADIUS:
        return (float(numbers.get("radius", 0.0)),) * 2
    one, other = numbers.get("radii", (0.0, 0.0))
    return float(one), float(other)


def numbers_of(kind: str, length: float, radii: tuple[float, float]) -> dict:
    """The numbers of a mark."""
    return {"length": length, "radius": radii[0]} if kind in ONE_RADIUS else {"length": length, "radii": tuple(radii)}


def fit(vertices: np.ndarray, kind: str) -> tuple[float, tuple[float, float], float] | None:
    """Length, radii at both ends and z of the middle of the part that a mesh shows."""
    vertices = np.asarray(vertices, dtype=np.float64).reshape(-1, 3)
    if not len(vertices):
        return None
    away, z = np.sqrt(vertices[:, 0] ** 2 + vertices[:, 1] ** 2), vertices[:, 2]
    low, high, widest = float(z.min()), float(z.max()), float(away.max())
    if kind == "Capsule":
        return high - low - 2.0 * widest, (widest, widest), (low + high) / 2.0
    near = END_SHARE * (high - low)
    return high - low, (float(away[z <= low + near].max()), float(away[z >= high - near].max())), (low + high) / 2.0


def fitted_numbers(vertices: np.ndarray, kind: str) -> dict:
    """The numbers of a mark that suit a mesh, to seven digits: what 32 bits can say. None where it has no extent."""
    found = fit(vertices, kind)
    if found is None:
        return {}
    length, radii, _ = found
    if kind in ONE_RADIUS:
        radii = (max(radii),) * 2
    if not (length > 0.0 and max(radii) > 0.0):
        return {}
    seven = lambda x: float(f"{x:.7g}")  # noqa: E731
    least = 1e-6 * max(*radii, length)  # the tip of a cone in single precision
    return numbers_of(kind, seven(length), tuple(seven(r) if r > least else 0.0 for r in radii))


def off(vertices: np.ndarray, kind: str, length: float, radii: tuple[float, float]) -> float:
    """Largest distance of a vertex from the surface of the part around the origin, in the half plane through its axis."""
    vertices = np.asarray(vertices, dtype=np.float64).reshape(-1, 3)
    if not len(vertices):
        return 0.0
    places = np.stack([vertices[:, 2], np.sqrt(vertices[:, 0] ** 2 + vertices[:, 1] ** 2)], axis=1)
    low, high = -length / 2.0, length / 2.0
    if kind == "Capsule":
        return float(np.abs(_from(places, (low, 0.0), (high, 0.0)) - radii[0]).max())
    found = _from(places, (low, radii[0]), (high, radii[1]))
    if kind != "Bore":
        found = np.minimum(found, _from(places, (low, 0.0), (low, radii[0])))
        found = np.minimum(found, _from(places, (high, 0.0), (high, radii[1])))
    return float(found.max())


def _from(places: np.ndarray, start, end) -> np.ndarray:
    """Distances of places from a segment."""
    start, along = np.asarray(start), np.subtract(end, start)
    square = float(along @ along)
    share = np.clip((places - start) @ along / square, 0.0, 1.0) if square > 0.0 else np.zeros(len(places))
    return np.sqrt(((places - start - share[:, None] * along) ** 2).sum(axis=1))

# SPDX-License-Identifier: GPL-3.0-or-later
"""Round parts: capsules, cylinders, cones and bores around the z axis of their object, centred at the origin.

`length` is the distance of the ends of the axis, at -length/2 and +length/2. A mesh only shows the part: `fit` says
which part it shows around the z axis, `off` how far its vertices lie from the part's surface, and `find` where a mesh
shows a part at all: around whatever axis.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .exact import without_noise

ROUND_KINDS = ("Capsule", "Cylinder", "Cone", "Bore")
ONE_RADIUS = ("Capsule", "Cylinder")
ALIKE = ("Cylinder", "Cone")  # a mesh of these shows the axis of a Capsule or Bore, too
FIT_TOLERANCE = 2e-3  # of the size: how far vertices may lie off a fitted surface
ROUND_ABOUT = 0.999 * np.pi  # rad: corners with a wider gap between neighbours stand on one side, and make no rim
SHOWN_SHARE = 5e-7  # of a size: how far off it is on a mesh that was made in single precision
LEAST_SHARE = 1e-6  # of the size: shorter is the rounding of single precision
END_SHARE = 1e-3  # of the length: vertices so near to an end lie on its circle


def radii_of(kind: str, numbers: dict) -> tuple[float, float]:
    """Radius at each end, from the numbers of a mark."""
    if kind in ONE_RADIUS:
        return (float(numbers.get("radius", 0.0)),) * 2
    one, other = numbers.get("radii", (0.0, 0.0))
    return float(one), float(other)


def numbers_of(kind: str, length: float, radii: tuple[float, float]) -> dict:
    """The numbers of a mark."""
    return {"length": length, "radius": radii[0]} if kind in ONE_RADIUS else {"length": length, "radii": tuple(radii)}


def fit(vertices: np.ndarray, kind: str) -> tuple[float, tuple[float, float], float] | None:
    """Length, radii at both ends and z of the middle of a mesh's round part."""
    vertices = np.asarray(vertices, dtype=np.float64).reshape(-1, 3)
    if not len(vertices):
        return None
    away, z = np.sqrt(vertices[:, 0] ** 2 + vertices[:, 1] ** 2), vertices[:, 2]
    low, high, widest = float(z.min()), float(z.max()), float(away.max())
    if kind == "Capsule":
        return high - low - 2.0 * widest, (widest, widest), (low + high) / 2.0
    near = END_SHARE * (high - low)
    return high - low, (float(away[z <= low + near].max()), float(away[z >= high - near].max())), (low + high) / 2.0


@dataclass
class Shown:
    """A round part shown by a mesh. `length` follows the kind: zero for a Capsule as wide as it is long."""

    center: np.ndarray
    turn: np.ndarray  # its columns: two directions across the axis, and the axis
    length: float
    radii: tuple[float, float]
    own: np.ndarray  # the vertices around its centre and along its axis as z

    @property
    def axis(self) -> np.ndarray:
        return self.turn[:, 2]


def find(vertices: np.ndarray, kind: str, axes: np.ndarray | None = None) -> Shown | None:
    """The round part whose surface contains the vertices; `None` if there is none.

    Tried are the columns of `axes`, the last one first, then the axes of inertia of the vertices.
    """
    vertices = np.unique(np.asarray(vertices, dtype=np.float64).reshape(-1, 3), axis=0)
    if len(vertices) < 3:
        return None
    given = (np.eye(3) if axes is None else np.asarray(axes, dtype=np.float64)).T[::-1]
    around = vertices - vertices.mean(axis=0)
    for directions in (given, np.linalg.eigh(around.T @ around)[1].T):
        for like in dict.fromkeys((kind, *ALIKE)):
            for direction in directions:
                shown = _around(vertices, kind, like, direction)
                if shown is not None:
                    return shown
    return None


def _around(vertices: np.ndarray, kind: str, like: str, direction: np.ndarray) -> Shown | None:
    """The part of a kind around a direction, if the vertices show one `like` it there."""
    turn = _turn(direction / np.sqrt(direction @ direction))
    own = vertices @ turn
    middle = own.mean(axis=0)
    length, radii, middle[2] = fit(own - np.array([*middle[:2], 0.0]), like)
    size = max(length, 2.0 * max(radii))
    if not min(length, max(radii)) > LEAST_SHARE * size:
        return None
    own = own - middle
    if like in ONE_RADIUS:
        if np.ptp(radii) > FIT_TOLERANCE * size:
            return None
        radii = (max(radii),) * 2
    if off(own, like, length, radii) > FIT_TOLERANCE * size or widest_gap(own, radii) > ROUND_ABOUT:
        return None
    length, radii, _ = fit(own, kind)
    return Shown(turn @ middle, turn, float(length), radii if kind not in ONE_RADIUS else (max(radii),) * 2, own)


def widest_gap(own: np.ndarray, radii: tuple[float, float]) -> float:
    """Largest angle between neighbours around the wider end, rad; a full turn without any."""
    length = float(np.ptp(own[:, 2]))
    size, end = max(length, 2.0 * max(radii)), 0 if radii[0] >= radii[1] else 1
    wide = own[np.sqrt((own[:, :2] ** 2).sum(axis=1)) >= (1.0 - FIT_TOLERANCE) * radii[end]]
    if not len(wide):
        return 2.0 * np.pi
    level = wide[:, 2].max() if end else wide[:, 2].min()
    ring = wide[np.abs(wide[:, 2] - level) <= FIT_TOLERANCE * size]
    turns = np.sort(np.arctan2(ring[:, 1], ring[:, 0]))
    return float(np.diff(np.append(turns, turns[0] + 2.0 * np.pi)).max())


def _turn(axis: np.ndarray) -> np.ndarray:
    """A rotation matrix whose last column is the axis; a permutation for a coordinate axis."""
    axis = np.where(np.abs(axis) > LEAST_SHARE, axis, 0.0)
    axis = axis / np.sqrt(axis @ axis)
    side = np.eye(3)[(int(np.argmax(np.abs(axis))) + 1) % 3]
    side = side - (side @ axis) * axis
    side = side / np.sqrt(side @ side)
    return np.stack([side, np.cross(axis, side), axis], axis=1) + 0.0


def shown_number(x: float) -> float:
    """A size measured on a mesh: the short decimal within single precision, else seven digits."""
    return float(f"{float(without_noise(x, SHOWN_SHARE * abs(x))):.7g}")


def fitted_numbers(vertices: np.ndarray, kind: str) -> dict:
    """Numbers of a mark that match a mesh, to seven digits, the accuracy of 32 bits.

    None where it has no extent; of a Capsule that is no longer than wide the radius alone.
    """
    shown = find(vertices, kind)
    found = (shown.length, shown.radii, 0.0) if shown is not None else fit(vertices, kind)
    if found is None:
        return {}
    length, radii, _ = found
    if kind in ONE_RADIUS:
        radii = (max(radii),) * 2
    least = LEAST_SHARE * max(*radii, abs(length))  # the tip of a cone in single precision
    if not max(radii) > 0.0 or length <= least and kind != "Capsule":
        return {}
    numbers = numbers_of(kind, shown_number(length), tuple(shown_number(r) if r > least else 0.0 for r in radii))
    return numbers if length > least else {"radius": numbers["radius"]}


def fault_of(vertices: np.ndarray, kind: str) -> str:
    """Reason why a mesh shows no part of a kind; "" if it does."""
    shown = find(vertices, kind)
    found = (shown.length, shown.radii, 0.0) if shown is not None else fit(vertices, kind)
    if found is None:
        return "its mesh has no vertices"
    length, wide = found[0], 2.0 * max(found[1])
    least = LEAST_SHARE * max(wide, abs(length))
    if not wide > 0.0:
        return "its mesh has no width around its z axis"
    if length > least:
        return ""
    if kind == "Capsule":
        return f"its mesh is {length + wide:.6g} long and {wide:.6g} wide, and a Capsule is longer than wide"
    return "its mesh has no length along its z axis"


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
    """Distances of points from a segment."""
    start, along = np.asarray(start), np.subtract(end, start)
    square = float(along @ along)
    share = np.clip((places - start) @ along / square, 0.0, 1.0) if square > 0.0 else np.zeros(len(places))
    return np.sqrt(((places - start - share[:, None] * along) ** 2).sum(axis=1))

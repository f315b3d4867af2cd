# SPDX-License-Identifier: GPL-3.0-or-later
"""Bounding volumes of groups, fitted as the engine fits them (crates/pong-geometry, `bounding`), for overlays.

The engine's last digits are not promised: volumes never change a result, only its cost.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .model import Group, Model, Primitive
from .transforms import Affine, identity, quaternion_matrix
from .triangle_check import pose_of

MANY = 512  # more things are not fitted one and all


@dataclass
class Volume:
    """A volume in the frame of its movable group. "Unbounded" has no size; a Sphere's `half` is its radius thrice."""

    kind: str
    center: np.ndarray = field(default_factory=lambda: np.zeros(3))
    half: np.ndarray = field(default_factory=lambda: np.zeros(3))
    axes: np.ndarray = field(default_factory=lambda: np.eye(3))  # columns


@dataclass
class Things:
    """What a volume is fitted around: points, grown by radii, and ellipsoids. All that is convex is the hull of these.

    Where a point has a front, it is grown by half a ball behind that front: a corner of a thick triangle.
    """

    points: np.ndarray = field(default_factory=lambda: np.zeros((0, 3)))
    radii: np.ndarray = field(default_factory=lambda: np.zeros(0))
    fronts: np.ndarray = field(default_factory=lambda: np.zeros((0, 3)))
    ellipsoids: list[tuple[np.ndarray, np.ndarray]] = field(default_factory=list)  # centre, axes · diag(semi-axes)
    unbounded: bool = False

    def along(self, directions: np.ndarray) -> np.ndarray:
        """How far each point with what it is grown by reaches along each direction (rows, units)."""
        forward = np.clip(self.fronts @ directions.T, 0.0, 1.0)
        return self.points @ directions.T + np.sqrt(1.0 - forward * forward) * self.radii[:, None]

    def support(self, directions: np.ndarray) -> np.ndarray:
        """Largest x · d for each direction."""
        best = self.along(directions).max(axis=0) if len(self.points) else np.full(len(directions), -np.inf)
        for center, arms in self.ellipsoids:
            best = np.maximum(best, directions @ center + np.sqrt(((directions @ arms) ** 2).sum(axis=1)))
        return best

    def farthest(self, center: np.ndarray) -> float:
        """An upper bound of the distance to the farthest point."""
        best = 0.0
        if len(self.points):
            best = float((np.sqrt(((self.points - center) ** 2).sum(axis=1)) + self.radii).max())
        for middle, arms in self.ellipsoids:
            best = max(best, _farthest_of_ellipsoid(center - middle, arms))
        return best

    def representatives(self) -> np.ndarray:
        """Points by which centres and axes are chosen."""
        plain = (self.radii == 0.0) | self.fronts.any(axis=1)
        found = [self.points[plain]]
        for axis in np.eye(3):
            balls, arms = self.points[~plain], self.radii[~plain, None] * axis
            found += [balls + arms, balls - arms]
        for center, arms in self.ellipsoids:
            found += [center + arms.T, center - arms.T]
        return np.concatenate(found)

    def outermost(self) -> Things:
        """Of very many points only those that lie outermost in any of 26 directions choose where a volume stands."""
        if len(self.points) <= MANY:
            return self
        steps = np.array(
            [[x, y, z] for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1) if (x, y, z) != (0, 0, 0)]
        )
        chosen = np.unique(self.along(steps / np.sqrt((steps**2).sum(axis=1, keepdims=True))).argmax(axis=0))
        return Things(self.points[chosen], self.radii[chosen], self.fronts[chosen], self.ellipsoids)


def together(parts: list[Things]) -> Things:
    if len(parts) == 1:
        return parts[0]
    empty = [Things()]
    return Things(
        np.concatenate([part.points for part in empty + parts]),
        np.concatenate([part.radii for part in empty + parts]),
        np.concatenate([part.fronts for part in empty + parts]),
        [ellipsoid for part in parts for ellipsoid in part.ellipsoids],
        any(part.unbounded for part in parts),
    )


def _farthest_of_ellipsoid(q: np.ndarray, arms: np.ndarray) -> float:
    """Distance from q (seen from the centre) to the farthest point, from above, by duality as in the engine."""
    axes = np.sqrt((arms**2).sum(axis=0))
    q = (arms / axes).T @ q
    largest = float(axes.max())
    below = (largest - axes) * (largest + axes)
    there = q != 0.0
    low, high = 0.0, largest * float(np.sqrt(q @ q))
    with np.errstate(divide="ignore", invalid="ignore"):
        for _ in range(40):
            excess = 0.5 * (low + high)
            slope = float((axes**2 * (q / (excess + below)) ** 2)[there].sum())
            low, high = (excess, high) if slope > 1.0 else (low, excess)
        bound = largest**2 + high
        return float(np.sqrt(bound + (q * (q * bound / (high + below)))[there].sum()))


def things_of(primitive: Primitive, place: Affine) -> Things:
    """What a primitive (placed in the frame of its movable group) occupies."""
    f = primitive.fields
    if primitive.kind == "Sphere":
        return Things(place.points(np.array([f["center"]])), np.array([float(f["radius"])]), np.zeros((1, 3)))
    if primitive.kind == "Ellipsoid":
        turn = place.linear @ quaternion_matrix(f.get("orientation") or (1.0, 0.0, 0.0, 0.0))
        return Things(ellipsoids=[(place.points(f["center"]), turn * np.asarray(f["semi_axes"]))])
    if primitive.kind in ("Plane", "Custom"):
        # Of custom kinds nothing is known here.
        return Things(unbounded=primitive.kind == "Plane")
    points = place.points(_points_of(primitive))
    if f.get("thickness"):
        return _thick(points, f)
    return Things(points, np.zeros(len(points)), np.zeros((len(points), 3)))


def _thick(points: np.ndarray, f: dict) -> Things:
    corners = points[np.asarray(f.get("triangles", [[0, 1, 2]]))] if len(points) else np.zeros((0, 3, 3))
    fronts = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    size = np.sqrt((fronts**2).sum(axis=1, keepdims=True))
    fronts = np.repeat(fronts / np.where(size > 0.0, size, 1.0), 3, axis=0)
    one = Things(corners.reshape(-1, 3), np.full(len(fronts), f["thickness"]), fronts)
    return together([one, Things(one.points, one.radii, -fronts)]) if f.get("two_sided") else one


def _points_of(primitive: Primitive) -> np.ndarray:
    """Points whose hull the primitive is; none of a mesh file, which was not loaded."""
    f = primitive.fields
    if primitive.kind == "Point":
        return np.array([f["position"]], dtype=np.float64)
    if primitive.kind == "LineSegment":
        return np.array(f["ends"], dtype=np.float64)
    if primitive.kind == "Ray":
        direction = np.asarray(f["direction"], dtype=np.float64)
        direction = direction / np.sqrt(direction @ direction)
        origin = np.asarray(f["origin"], dtype=np.float64)
        return np.array([origin - direction * (f.get("reach") or 0.0), origin + direction * f["length"]])
    return np.asarray(f.get("vertices", np.zeros((0, 3))), dtype=np.float64).reshape(-1, 3)


def volumes(model: Model) -> dict[str, Volume]:
    """By path of each group: its volume, in the frame of its movable group."""
    found: dict[str, Volume] = {}
    _group(model.root, model.root.name, identity(), found)
    return found


def _group(group: Group, path: str, place: Affine, found: dict[str, Volume]) -> Things:
    parts = [things_of(primitive, place) for primitive in group.primitives]
    for below in group.groups:
        inner = _group(below, f"{path}/{below.name}", identity() if below.movable else place @ pose_of(below), found)
        if not below.movable:
            parts.append(inner)
    things = together(parts)
    volume = None if group.bound == "Above" else fit(group.bound or "Aabb", things)
    if volume is not None:
        found[path] = volume
    return things


def fit(kind: str, things: Things) -> Volume | None:
    """The volume of a kind around things; `None` if there are none."""
    if things.unbounded:
        return Volume("Unbounded")
    if not len(things.points) and not things.ellipsoids:
        return None
    high, low = things.support(np.eye(3)), -things.support(-np.eye(3))
    if kind == "Sphere":
        return _sphere(things, (low + high) / 2.0)
    if kind == "Obb":
        return _obb(things)
    return Volume("Aabb", (low + high) / 2.0, (high - low) / 2.0)


def _sphere(things: Things, box_center: np.ndarray) -> Volume:
    few = things.outermost()
    points = few.representatives()
    best = (few.farthest(box_center), box_center)
    for center in _centers(points):
        best = min(best, (few.farthest(center), center), key=lambda ball: ball[0])
    step = 0.125 * best[0]
    for _ in range(12):
        for axis in np.eye(3):
            for side in (axis, -axis):
                radius = few.farthest(best[1] + side * step)
                if radius < best[0]:
                    best = (radius, best[1] + side * step)
                    break
        step *= 0.5
    return Volume("Sphere", best[1], np.full(3, things.farthest(best[1])))


def _centers(points: np.ndarray):
    """Centres of a ball grown from a far pair, and of one drawn to the farthest points from there."""

    def far(center):
        return points[((points - center) ** 2).sum(axis=1).argmax()]

    one = far(points[0])
    other = far(one)
    center, radius = (one + other) / 2.0, float(np.sqrt(((one - other) ** 2).sum())) / 2.0
    for p in points:
        distance = float(np.sqrt(((p - center) ** 2).sum()))
        if distance > radius:
            grown = 0.5 * (radius + distance)
            center = center + (p - center) * ((distance - grown) / distance)
            radius = grown
    yield center
    for k in range(10, 150):
        center = center + (far(center) - center) / (k + 1)
    yield center


def _obb(things: Things) -> Volume:
    few = things.outermost()
    points = few.representatives()
    best = _Box(np.eye(3), few)
    if len(points) > 1:
        best = best.smaller(_Box(_principal_axes(points), few))
    for axis in range(3):
        for tangent in (0.199, -0.199, 0.414, -0.414):
            best = best.smaller(_Box(_turned(best.axes, axis, tangent), few))
    tangent = 0.1
    for _ in range(20):
        for _ in range(4):
            before = best.score
            for axis, side in ((0, 1), (0, -1), (1, 1), (1, -1), (2, 1), (2, -1)):
                best = best.smaller(_Box(_turned(best.axes, axis, side * tangent), few))
            if best.score == before:
                break
        tangent *= 0.5
    whole = _Box(best.axes, things)
    return Volume("Obb", whole.axes @ whole.middle, whole.half, whole.axes)


class _Box:
    """The box along some axes, and how large it counts: flat ones prefer the least face or length."""

    def __init__(self, axes: np.ndarray, things: Things):
        high, low = things.support(axes.T), -things.support(-axes.T)
        self.axes, self.half, self.middle = axes, (high - low) / 2.0, (high + low) / 2.0
        self.score = float(np.prod(self.half + 1e-3 * np.sqrt(self.half @ self.half)))

    def smaller(self, other: _Box) -> _Box:
        return other if other.score < self.score else self


def _principal_axes(points: np.ndarray) -> np.ndarray:
    arms = points - points.mean(axis=0)
    axes = np.linalg.eigh(arms.T @ arms)[1]
    return _orthonormal(axes)


def _turned(axes: np.ndarray, axis: int, tangent: float) -> np.ndarray:
    """Turned about one of its own axes, by twice the angle of this tangent."""
    cosine, sine = (1 - tangent**2) / (1 + tangent**2), 2 * tangent / (1 + tangent**2)
    p, q = (axis + 1) % 3, (axis + 2) % 3
    turn = np.eye(3)
    turn[p, p] = turn[q, q] = cosine
    turn[p, q], turn[q, p] = sine, -sine
    return _orthonormal(axes @ turn)


def _orthonormal(axes: np.ndarray) -> np.ndarray:
    x = axes[:, 0] / np.sqrt(axes[:, 0] @ axes[:, 0])
    y = axes[:, 1] - x * (x @ axes[:, 1])
    y = y / np.sqrt(y @ y)
    return np.stack([x, y, np.cross(x, y)], axis=1)

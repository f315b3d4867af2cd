"""Inertia of a body from the momentum of its touches, without a law of contact (docs/fit.md).

A touch at one point between two free flights changes the velocity by Δv and the angular velocity by Δω. Its impulse
J = m·Δv acts at the point r, so that I·Δω = r × J, whatever forces made it. Both sides have errors, which bias a slope;
the slope with an instrument is not biased: the moment r × n of an impulse along the vertical, in proportion to the speed
of approach, which follows from the flight before the touch alone.
"""

import csv
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ._pong import BadValueError, Scene, Simulation, StudyError

_QUATERNION = ("qw", "qx", "qy", "qz")
# Relative difference of principal moments up to which a free flight is taken as an even rotation.
_UNLIKE = 0.1
# Least number of touches for an interval.
_ENOUGH = 10
_RESAMPLES = 4000
# Step of the simulation that only lists contacts of given poses, s: too short to move a body.
_INSTANT = 1e-9


@dataclass(frozen=True)
class MomentumInertia:
    """Inertia of a body from the momentum of its touches.

    Attributes
    ----------
    body : str
        Name of the body.
    inertia : float
        Mean of the principal moments of inertia, kg·m².
    interval : tuple[float, float]
        Interval of `inertia` by bootstrap over the touches, kg·m².
    factor : float
        Ratio to the inertia in the scene, as `body.BODY.inertia_factor` has it.
    slopes : tuple[float, float]
        The two ordinary slopes, which errors of measurement bias to low and to high values, kg·m².
    touches : int
        Number of touches.
    """

    __module__ = "pong.types"

    body: str
    inertia: float
    interval: tuple[float, float]
    factor: float
    slopes: tuple[float, float]
    touches: int

    def __str__(self) -> str:
        low, high = self.interval
        return (
            f"inertia of `{self.body}` from momentum: {self.inertia:.4g} kg·m² [{low:.4g}, {high:.4g}], {self.factor:.3g} times "
            f"that of the scene, from {self.touches} touches; ordinary slopes {self.slopes[0]:.4g} and {self.slopes[1]:.4g} kg·m²"
        )


@dataclass(frozen=True)
class _Flight:
    """Even rotation and parabola through some poses, about the instant zero."""

    place: np.ndarray  # of the mass centre, m
    velocity: np.ndarray  # m/s
    spin: np.ndarray  # rad/s, along the common axes
    turn: np.ndarray  # matrix of the orientation


@dataclass(frozen=True)
class _Path:
    """Measured poses of one record."""

    time: np.ndarray
    place: np.ndarray  # of the group's origin
    turn: np.ndarray  # matrices of the orientation


def inertia_from_momentum(
    scene: str | os.PathLike[str],
    data: str | os.PathLike[str] | Mapping[str, Any],
    *,
    body: str | None = None,
    flight: int = 5,
    clear: int = 1,
    longest: int = 4,
    near: float = 1e-3,
    apart: float = 15e-3,
    confidence: float = 0.95,
    seed: int = 0,
    allow_files_below: Sequence[str | os.PathLike[str]] = (),
) -> MomentumInertia:
    """Finds the inertia of a free body from touches at a single point between two flights, without a law of contact.

    Mass, mass centre, gravity and geometry are those of the scene; stiffness, damping and friction have no effect. The
    other bodies stay where the scene has them. The ratios of the principal moments are those of the scene.

    Parameters
    ----------
    scene : path_like
        Scene file.
    data : path_like or Mapping
        CSV file, NPZ file or arrays with `time`, `position` and `orientation`, and `record` and `body`, as `fit` takes
        them. Other columns are not used.
    body : str, optional
        Name of the body; not needed if one body is free.
    flight : int, default 5
        Number of poses of the flights before and after a touch.
    clear : int, default 1
        Number of poses between a touch and each flight.
    longest : int, default 4
        Largest number of poses in a touch.
    near : float, default 1e-3
        Distance from the other bodies below which a point may touch, m.
    apart : float, default 15e-3
        Distance that all other points of the body keep in a touch, m.
    confidence : float, default 0.95
        Confidence of the interval.
    seed : int, default 0
        Seed of the bootstrap.
    allow_files_below : sequence of path_like, optional
        Further folders from which models may read meshes.

    Returns
    -------
    MomentumInertia

    Raises
    ------
    StudyError
        There are too few touches, or the body has unlike principal moments.
    BadValueError
        A body, a column or an array cannot be used.
    """
    finder = _Finder(Scene.load(scene, allow_files_below=list(allow_files_below)).build(step=_INSTANT), body)
    paths = _paths(data, finder.body)
    rows = []
    for path in paths:
        for begin, end in _touches(finder.contacts(path, near), flight, clear, longest):
            row = finder.touch(path, begin, end, flight, clear, near, apart)
            if row is not None:
                rows.append(row)
    if len(rows) < _ENOUGH:
        cause = f"there are {len(rows)} touches of one point between two flights of {flight} poses in {len(paths)} records"
        raise StudyError(f"inertia of `{finder.body}`: {cause}; give at least {_ENOUGH}, longer records or shorter flights")
    products = np.array([[z @ moment, z @ turning, turning @ moment, turning @ turning, moment @ moment] for z, moment, turning in rows])

    def slope(sums: np.ndarray, above: int, below: int) -> Any:
        return sums[..., above] / sums[..., below]

    if not abs(products[:, 1].sum()) > 1e-6 * np.sqrt((products[:, 1] ** 2).sum()):
        cause = "impulses along the vertical turn it in no touch"
        raise StudyError(f"inertia of `{finder.body}`: {cause}; its points of contact must lie beside its mass centre")
    draws = np.random.default_rng(seed).integers(len(rows), size=(_RESAMPLES, len(rows)))
    tail = 50.0 * (1.0 - confidence)
    ends = np.percentile(slope(products[draws].sum(axis=1), 0, 1), [tail, 100.0 - tail])
    total, scale = products.sum(axis=0), finder.inertia
    factor = float(slope(total, 0, 1))
    interval = (float(scale * ends[0]), float(scale * ends[1]))
    slopes = (float(scale * slope(total, 2, 3)), float(scale * slope(total, 4, 2)))
    return MomentumInertia(finder.body, scale * factor, interval, factor, slopes, len(rows))


class _Finder:
    """A simulation that lists the contacts of measured poses."""

    def __init__(self, simulation: Simulation, body: str | None) -> None:
        self.simulation = simulation
        free = [name for name in simulation.bodies if _is_free(simulation, name)]
        if body is None and len(free) == 1:
            body = free[0]
        if body not in free:
            cause = "several bodies are free" if body is None else f"there is no free body `{body}`"
            raise BadValueError(f"body: {cause}; name one of: {', '.join(free)}")
        self.body = body
        mass = simulation.mass(body)
        self.mass, self.center = float(mass["mass"]), np.array(mass["mass_center"], dtype=float)
        self.tensor = np.array(mass["inertia"], dtype=float)
        moments = np.linalg.eigvalsh(self.tensor)
        if moments[-1] > (1.0 + _UNLIKE) * moments[0]:
            cause = f"its principal moments {moments[0]:.3g} and {moments[-1]:.3g} kg·m² differ, so that a flight is no even rotation"
            raise StudyError(f"inertia of `{body}`: {cause}; identify it with `fit`")
        self.inertia = float(moments.mean())
        gravity = np.array(simulation.gravity, dtype=float)
        self.gravity = gravity
        self.up = -gravity / np.linalg.norm(gravity) if gravity.any() else np.array([0.0, 0.0, 1.0])

    def listed(self, place: np.ndarray, turn: np.ndarray, lower: float) -> tuple[np.ndarray, np.ndarray]:
        """Contact points (k, 3) in the frame of the body, and depths (k,), of a pose that is lower by a distance, m."""
        moved = place - lower * self.up
        self.simulation.clear_contact_history()
        self.simulation.set_states([[*moved, *_quaternion(turn), *[0.0] * 6]], [self.body])
        self.simulation.step()
        contacts = self.simulation.contacts()
        return (contacts["point"] - moved) @ turn, contacts["depth"]

    def contacts(self, path: _Path, near: float) -> np.ndarray:
        """True for each pose with a point nearer to the other bodies than `near`, m."""
        return np.array([len(self.listed(place, turn, near)[1]) > 0 for place, turn in zip(path.place, path.turn)], dtype=bool)

    def touch(self, path: _Path, begin: int, end: int, flight: int, clear: int, near: float, apart: float) -> Any:
        """Instrument, moment and turning (inertia of the scene times Δω) of a touch; None if several points are near."""
        around = range(begin - 1, end + 2)
        if any(len(self.listed(path.place[k], path.turn[k], apart)[1]) > 1 for k in around):
            return None
        shallow = [self.listed(path.place[k], path.turn[k], near) for k in range(begin, end + 1)]
        points, _ = min((one for one in shallow if len(one[1])), key=lambda one: one[1].min())
        arm_of_body = points[0] - self.center
        zero = float(path.time[begin] + path.time[end]) / 2
        before = self.flight_of(path, np.arange(begin - clear - flight, begin - clear), zero)
        after = self.flight_of(path, np.arange(end + 1 + clear, end + 1 + clear + flight), zero)
        # Both flights fall alike, so that the distance of their places is linear in time.
        offset, closing = after.place - before.place, after.velocity - before.velocity
        frame = float(np.median(np.diff(path.time)))
        instant = float(np.clip(-(offset @ closing) / (closing @ closing), -1.5 * frame, 1.5 * frame))
        turn = self.between(path, zero + instant)
        arm, expected = turn @ arm_of_body, before.turn @ arm_of_body
        approach = (before.velocity + np.cross(before.spin, expected)) @ self.up
        moment = np.cross(arm, self.mass * closing)
        turning = turn @ self.tensor @ turn.T @ (after.spin - before.spin)
        return np.cross(expected, -approach * self.up), moment, turning

    def flight_of(self, path: _Path, poses: np.ndarray, zero: float) -> _Flight:
        """Flight through some poses: a parabola with the known gravity, and an even rotation."""
        time = path.time[poses] - zero
        lines = np.stack([np.ones(len(time)), time], axis=1)
        places = path.place[poses] + path.turn[poses] @ self.center
        place, velocity = np.linalg.lstsq(lines, places - np.outer(time**2 / 2, self.gravity), rcond=None)[0]
        middle = path.turn[poses[len(poses) // 2]]
        turns = np.array([_rotation_vector(turn @ middle.T) for turn in path.turn[poses]])
        turn, spin = np.linalg.lstsq(lines, turns, rcond=None)[0]
        return _Flight(place, velocity, spin, _matrix_of_vector(turn) @ middle)

    def between(self, path: _Path, time: float) -> np.ndarray:
        """Measured orientation at a time, along the arc between two poses."""
        after = int(np.clip(np.searchsorted(path.time, time), 1, len(path.time) - 1))
        first, second = path.turn[after - 1], path.turn[after]
        share = (time - path.time[after - 1]) / (path.time[after] - path.time[after - 1])
        return np.asarray(_matrix_of_vector(share * _rotation_vector(second @ first.T)) @ first)


def _is_free(simulation: Simulation, name: str) -> bool:
    try:
        return bool(simulation.mass(name)["mass"] < np.inf)
    except BadValueError:
        return False


def _touches(touching: np.ndarray, flight: int, clear: int, longest: int) -> list[tuple[int, int]]:
    """First and last pose of each touch between two flights of the poses of a record."""
    found = []
    edges = np.flatnonzero(np.diff(touching.astype(int)))
    for begin, end in zip(edges[:-1] + 1, edges[1:]):
        first, last = begin - clear - flight, end + clear + flight
        alone = touching[begin] and end - begin < longest and first >= 0 and last < len(touching)
        if alone and not touching[first:begin].any() and not touching[end + 1 : last + 1].any():
            found.append((int(begin), int(end)))
    return found


def _paths(data: Any, body: str) -> list[_Path]:
    """Poses of a body, record by record; rows without a pose are left out."""
    if isinstance(data, Mapping):
        arrays = dict(data)
    elif os.fspath(data).endswith(".npz"):
        with np.load(os.fspath(data)) as file:
            arrays = dict(file)
    else:
        arrays = _columns(os.fspath(data))
    missing = [name for name in ("time", "position", "orientation") if name not in arrays]
    if missing:
        raise BadValueError(f"data: there is no `{missing[0]}`; give time, position and orientation")
    time = np.asarray(arrays["time"], dtype=float).ravel()
    place, quaternion = np.asarray(arrays["position"], dtype=float), np.asarray(arrays["orientation"], dtype=float)
    if place.shape != (len(time), 3) or quaternion.shape != (len(time), 4):
        raise BadValueError(
            f"data: position has shape {place.shape} and orientation {quaternion.shape} for {len(time)} times; give a row for each"
        )
    records = np.asarray(arrays.get("record", np.zeros(len(time)))).ravel()
    good = np.isfinite(place).all(axis=1) & np.isfinite(quaternion).all(axis=1)
    if "body" in arrays:
        good &= np.asarray(arrays["body"]).ravel().astype(str) == body
    _, first = np.unique(records, return_index=True)
    paths = []
    for label in records[np.sort(first)]:
        rows = good & (records == label)
        if rows.any():
            paths.append(_Path(time[rows], place[rows], _matrices(quaternion[rows])))
    return paths


def _columns(path: str) -> dict[str, Any]:
    """Arrays of a CSV file of `fit`."""
    with open(path, newline="", encoding="utf-8-sig") as file:
        rows = list(csv.DictReader((line for line in file if line.strip() and not line.startswith("#")), skipinitialspace=True))
    if not rows:
        raise BadValueError(f"{path}: it has no measurement; give a line for each body and time")

    def numbers(names: tuple[str, ...]) -> np.ndarray:
        try:
            return np.array([[float(row[name] or "nan") for name in names] for row in rows])
        except (ValueError, TypeError) as error:
            raise BadValueError(f"{path}: {error}; give numbers, or leave cells empty") from None

    arrays: dict[str, Any] = {name: np.array([row[name] for row in rows]) for name in ("record", "body") if name in rows[0]}
    for name, columns in (("time", ("time",)), ("position", ("x", "y", "z")), ("orientation", _QUATERNION)):
        if all(column in rows[0] for column in columns):
            arrays[name] = numbers(columns)
    return arrays


def _matrices(quaternions: np.ndarray) -> np.ndarray:
    """Matrices of unit quaternions w, x, y, z."""
    w, x, y, z = (quaternions / np.linalg.norm(quaternions, axis=1, keepdims=True)).T
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), -1, 0)


def _quaternion(turn: np.ndarray) -> np.ndarray:
    """Unit quaternion w, x, y, z of a rotation matrix: the eigenvector of the largest eigenvalue (Bar-Itzhack 2000)."""
    a = turn
    symmetric = np.array(
        [
            [a[0, 0] + a[1, 1] + a[2, 2], a[2, 1] - a[1, 2], a[0, 2] - a[2, 0], a[1, 0] - a[0, 1]],
            [a[2, 1] - a[1, 2], a[0, 0] - a[1, 1] - a[2, 2], a[0, 1] + a[1, 0], a[0, 2] + a[2, 0]],
            [a[0, 2] - a[2, 0], a[0, 1] + a[1, 0], a[1, 1] - a[0, 0] - a[2, 2], a[1, 2] + a[2, 1]],
            [a[1, 0] - a[0, 1], a[0, 2] + a[2, 0], a[1, 2] + a[2, 1], a[2, 2] - a[0, 0] - a[1, 1]],
        ]
    )
    return np.asarray(np.linalg.eigh(symmetric)[1][:, -1])


def _rotation_vector(turn: np.ndarray) -> np.ndarray:
    """Rotation vector of a rotation matrix, rad."""
    w, *axis = _quaternion(turn)
    vector = np.array(axis) * (1.0 if w >= 0.0 else -1.0)
    sine = float(np.linalg.norm(vector))
    return np.asarray(vector * (2.0 * np.arctan2(sine, abs(w)) / sine if sine > 1e-12 else 2.0))


def _matrix_of_vector(vector: np.ndarray) -> np.ndarray:
    """Rotation matrix of a rotation vector (Rodrigues)."""
    angle = float(np.linalg.norm(vector))
    x, y, z = vector
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    first = np.sinc(angle / np.pi)
    second = 0.5 * np.sinc(angle / (2.0 * np.pi)) ** 2
    return np.asarray(np.eye(3) + first * cross + second * (cross @ cross))

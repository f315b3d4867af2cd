# SPDX-License-Identifier: GPL-3.0-or-later
"""Conversion of log rows to frames of a film. Numpy only."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .log import Log


@dataclass
class Film:
    """Instants of a film."""

    times: np.ndarray  # of each picture, s in the log
    rows: np.ndarray  # the row of the log whose contacts it shows: the last one not after it
    fps: int


def film(log: Log, fps: int = 30, speed: float = 1.0, start: float | None = None, end: float | None = None) -> Film:
    """Pictures at a constant rate; `speed` 0.1 is slow motion by ten."""
    first = log.times[0] if start is None else max(start, log.times[0])
    last = log.times[-1] if end is None else min(end, log.times[-1])
    # Also false for NaN.
    if not last >= first:
        raise ValueError(f"nothing to show from {first} s to {last} s; the log runs from {log.times[0]} to {log.times[-1]} s")
    count = int(np.floor((last - first) * fps / speed + 1e-9)) + 1
    times = first + np.arange(count) * speed / fps
    # A time that differs from that of a row by rounding only belongs to it.
    slack = 1e-9 * (1.0 + np.abs(times))
    rows = np.clip(np.searchsorted(log.times, times + slack, side="right") - 1, 0, len(log.times) - 1)
    return Film(times, rows, fps)


@dataclass
class Track:
    """Path of one body through a film, relative to the scene's origin."""

    positions: np.ndarray  # (pictures, 3), m
    orientations: np.ndarray  # (pictures, 4), (w, x, y, z); neighbours never on opposite sides


@dataclass
class View:
    """Viewing frame at each picture; all positions are relative to it."""

    origins: np.ndarray  # (pictures, 3)
    turns: np.ndarray | None  # (pictures, 4), or None for the common axes
    followed: int | None = None  # body that the view goes along with though nobody asked for it

    def point(self, points: np.ndarray, picture: int) -> np.ndarray:
        return self.direction(np.asarray(points) - self.origins[picture], picture)

    def direction(self, vectors: np.ndarray, picture: int) -> np.ndarray:
        if self.turns is None:
            return np.asarray(vectors, dtype=float)
        return turned(conjugate(self.turns[picture]), np.asarray(vectors, dtype=float))


FOLLOW_FROM = 20.0  # times what is looked at: further away nothing of it would be seen


def view(log: Log, film: Film, body: int | None = None, extent: float = np.inf, anchors: np.ndarray | None = None) -> View:
    """Viewing frame of a body that is held still; else the common frame with its origin near the action.

    Where all bodies rush through the common frame together, as in orbit, the view goes along with the first, without
    turning. `extent` is the size of what is looked at, m; `anchors` as for `track`.
    """
    if body is not None:
        if not is_known(log, body):
            raise ValueError(f"body `{log.bodies[body].name}` has no state in the log: it cannot be held still; choose another")
        return View(*interpolated(log, film, body))
    known = [number for number in range(len(log.bodies)) if is_known(log, number)]
    ways = [way_of(log, film, number, _anchor(anchors, number)) for number in known]
    if _rush_together(ways, extent):
        return View(ways[0], None, known[0])
    near = _first_contact(log, film)
    if near is None:
        near = np.mean([way[0] for way in ways], axis=0) if ways else np.zeros(3)
    # Whole metres, and zero for scenes near the origin: displayed coordinates are those of the log.
    origin = np.where(np.abs(near) > 100.0, np.round(near), 0.0)
    return View(np.broadcast_to(origin, (len(film.times), 3)), None)


def _rush_together(ways: list[np.ndarray], extent: float) -> bool:
    if len(ways) < 2:
        return False
    far = [np.linalg.norm(way - way[0], axis=1).max() for way in ways]
    apart = max(np.linalg.norm((way - ways[0]) - (way[0] - ways[0][0]), axis=1).max() for way in ways)
    return bool(min(far) > FOLLOW_FROM * (extent + apart))


def _first_contact(log: Log, film: Film) -> np.ndarray | None:
    for row in film.rows:
        contacts = log.contacts_of(int(row))
        if len(contacts):
            return np.array(contacts["point"][0])
    return None


def _anchor(anchors: np.ndarray | None, body: int) -> np.ndarray:
    return np.zeros(3) if anchors is None else anchors[body]


def is_known(log: Log, body: int) -> bool:
    """True if the state of a body is set anywhere in the log."""
    return len(_known_rows(log.states[:, body])) > 0


def _known_rows(states: np.ndarray) -> np.ndarray:
    finite = np.isfinite(states["position"]).all(axis=1) & np.isfinite(states["orientation"]).all(axis=1)
    return np.flatnonzero(finite)


def way_of(log: Log, film: Film, body: int, anchor: np.ndarray) -> np.ndarray:
    """Position of a body's point (`anchor`, in its frame) in the common frame at each picture."""
    positions, orientations = interpolated(log, film, body)
    return positions + turned(orientations, np.broadcast_to(anchor, positions.shape))


def track(log: Log, film: Film, body: int, seen: View, anchor: np.ndarray = np.zeros(3)) -> Track:
    """Path of a body's point `anchor` (in its frame) and its orientations."""
    _, orientations = interpolated(log, film, body)
    positions = way_of(log, film, body, anchor) - seen.origins
    if seen.turns is not None:
        back = conjugate(seen.turns)
        positions, orientations = turned(back, positions), product(back, orientations)
    return Track(positions, continuous(orientations))


def interpolated(log: Log, film: Film, body: int) -> tuple[np.ndarray, np.ndarray]:
    """Position and orientation at each picture: linear between two rows, at constant rate about a fixed axis.

    Rows in which the state is not set do not count: before the first that is, the body waits there. The origin for a body
    whose state is never set.
    """
    rows = log.states[:, body]
    known = _known_rows(rows)
    if len(known) == 0:
        return np.zeros((len(film.times), 3)), np.tile([1.0, 0.0, 0.0, 0.0], (len(film.times), 1))
    behind = np.searchsorted(known, film.rows, side="right")
    before, after = known[np.maximum(behind - 1, 0)], known[np.minimum(behind, len(known) - 1)]
    span = log.times[after] - log.times[before]
    share = np.clip((film.times - log.times[before]) / np.where(span > 0.0, span, 1.0), 0.0, 1.0)
    p0, p1 = rows["position"][before], rows["position"][after]
    return p0 + share[:, None] * (p1 - p0), slerp(rows["orientation"][before], rows["orientation"][after], share)


def travel(log: Log, film: Film, seen: View, anchors: np.ndarray | None = None) -> float:
    """Largest distance of a body's anchor from the scene's origin, m."""
    known = [number for number in range(len(log.bodies)) if is_known(log, number)]
    ways = [track(log, film, number, seen, _anchor(anchors, number)).positions for number in known]
    return max((float(np.linalg.norm(way, axis=1).max()) for way in ways), default=0.0)


# --- quaternions (w, x, y, z), arrays of them along the first axis --------------------------------------------------


def conjugate(q: np.ndarray) -> np.ndarray:
    return np.asarray(q) * (1.0, -1.0, -1.0, -1.0)


def product(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    a, b = np.asarray(a), np.asarray(b)
    w = a[..., :1] * b[..., :1] - np.sum(a[..., 1:] * b[..., 1:], axis=-1, keepdims=True)
    v = a[..., :1] * b[..., 1:] + b[..., :1] * a[..., 1:] + np.cross(a[..., 1:], b[..., 1:])
    return np.concatenate([w, v], axis=-1)


def turned(q: np.ndarray, v: np.ndarray) -> np.ndarray:
    q, v = np.asarray(q), np.asarray(v)
    twice = 2.0 * np.cross(q[..., 1:], v)
    return v + q[..., :1] * twice + np.cross(q[..., 1:], twice)


def slerp(q0: np.ndarray, q1: np.ndarray, share: np.ndarray) -> np.ndarray:
    dot = np.sum(q0 * q1, axis=1)
    q1 = np.where(dot[:, None] < 0.0, -q1, q1)
    angle = np.arccos(np.clip(np.abs(dot), 0.0, 1.0))
    small = angle < 1e-6
    sine = np.where(small, 1.0, np.sin(angle))
    w0 = np.where(small, 1.0 - share, np.sin((1.0 - share) * angle) / sine)
    w1 = np.where(small, share, np.sin(share * angle) / sine)
    q = w0[:, None] * q0 + w1[:, None] * q1
    return q / np.linalg.norm(q, axis=1, keepdims=True)


def continuous(q: np.ndarray) -> np.ndarray:
    """Rotations with signs such that neighbours are near: q and -q are one rotation, but not one curve."""
    flips = np.sum(q[1:] * q[:-1], axis=1) < 0.0
    signs = np.where(np.concatenate([[0], np.cumsum(flips)]) % 2 == 0, 1.0, -1.0)
    return q * signs[:, None]


def from_z(directions: np.ndarray) -> np.ndarray:
    """Shortest rotations from +z to directions of any length but zero, axes (.., 3)."""
    d = np.asarray(directions, dtype=float)
    d = d / np.linalg.norm(d, axis=-1, keepdims=True)
    q = np.stack([1.0 + d[..., 2], -d[..., 1], d[..., 0], np.zeros(d.shape[:-1])], axis=-1)
    q = np.where(d[..., 2:] < -1.0 + 1e-12, (0.0, 1.0, 0.0, 0.0), q)
    return q / np.linalg.norm(q, axis=-1, keepdims=True)

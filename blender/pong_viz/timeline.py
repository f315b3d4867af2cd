# SPDX-License-Identifier: GPL-3.0-or-later
"""From rows of a log to frames of a film. Numpy only."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .log import Log


@dataclass
class Film:
    """Which instants are shown."""

    times: np.ndarray  # of each picture, s in the log
    rows: np.ndarray  # the row of the log whose contacts it shows: the last one not after it
    fps: int


def film(log: Log, fps: int = 30, speed: float = 1.0, start: float | None = None, end: float | None = None) -> Film:
    """Pictures at a steady rate; `speed` 0.1 is ten times slower than life."""
    first = log.times[0] if start is None else max(start, log.times[0])
    last = log.times[-1] if end is None else min(end, log.times[-1])
    if not last >= first:
        raise ValueError(f"nothing to show from {first} s to {last} s; the log runs from {log.times[0]} to {log.times[-1]} s")
    count = int(np.floor((last - first) * fps / speed + 1e-9)) + 1
    times = first + np.arange(count) * speed / fps
    # A time that differs from that of a row by rounding alone belongs to it.
    slack = 1e-9 * (1.0 + np.abs(times))
    rows = np.clip(np.searchsorted(log.times, times + slack, side="right") - 1, 0, len(log.times) - 1)
    return Film(times, rows, fps)


@dataclass
class Track:
    """The way of one body through a film, relative to the scene's origin."""

    positions: np.ndarray  # (pictures, 3), m
    orientations: np.ndarray  # (pictures, 4), (w, x, y, z); neighbours never on opposite sides


@dataclass
class View:
    """From where the film is seen: a frame at each picture, all positions are relative to it."""

    origins: np.ndarray  # (pictures, 3)
    turns: np.ndarray | None  # (pictures, 4), or None for the common axes

    def point(self, points: np.ndarray, picture: int) -> np.ndarray:
        return self.direction(np.asarray(points) - self.origins[picture], picture)

    def direction(self, vectors: np.ndarray, picture: int) -> np.ndarray:
        if self.turns is None:
            return np.asarray(vectors, dtype=float)
        return turned(conjugate(self.turns[picture]), np.asarray(vectors, dtype=float))


def view(log: Log, film: Film, body: int | None = None) -> View:
    """Seen from the common frame, its origin moved to where the bodies start; or from a body that is held still."""
    if body is None:
        starts = np.asarray(log.states["position"][film.rows[0]])
        starts = starts[np.isfinite(starts).all(axis=1)]
        near = starts.mean(axis=0) if len(starts) else np.zeros(3)
        # Whole metres, and nothing for scenes near the origin: coordinates on the screen stay those of the log.
        origin = np.where(np.abs(near) > 100.0, np.round(near), 0.0)
        return View(np.broadcast_to(origin, (len(film.times), 3)), None)
    positions, orientations = interpolated(log, film, body)
    return View(positions, orientations)


def track(log: Log, film: Film, body: int, seen: View) -> Track:
    """A body's way; it stays where it is first known while its state is not set."""
    positions, orientations = interpolated(log, film, body)
    positions = positions - seen.origins
    if seen.turns is not None:
        back = conjugate(seen.turns)
        positions, orientations = turned(back, positions), product(back, orientations)
    return Track(positions, continuous(orientations))


def interpolated(log: Log, film: Film, body: int) -> tuple[np.ndarray, np.ndarray]:
    """Position and orientation at each picture: straight between two rows, at constant rate about a fixed axis."""
    after = np.minimum(film.rows + 1, len(log.times) - 1)
    span = log.times[after] - log.times[film.rows]
    share = np.clip((film.times - log.times[film.rows]) / np.where(span > 0.0, span, 1.0), 0.0, 1.0)
    rows = log.states[:, body]
    p0, p1 = rows["position"][film.rows], rows["position"][after]
    q0, q1 = rows["orientation"][film.rows], rows["orientation"][after]
    known = np.isfinite(p0).all(axis=1) & np.isfinite(p1).all(axis=1)
    positions = np.where(known[:, None], p0 + share[:, None] * (p1 - p0), 0.0)
    orientations = np.where(known[:, None], slerp(q0, q1, share), (1.0, 0.0, 0.0, 0.0))
    return positions, orientations


def travel(log: Log, film: Film, seen: View) -> float:
    """How far the origin of any body gets from the scene's, m."""
    ways = [track(log, film, number, seen).positions for number in range(len(log.bodies))]
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
    """The same rotations with signs such that neighbours are near: q and -q are one rotation, but not one curve."""
    flips = np.sum(q[1:] * q[:-1], axis=1) < 0.0
    signs = np.where(np.concatenate([[0], np.cumsum(flips)]) % 2 == 0, 1.0, -1.0)
    return q * signs[:, None]


def from_z(direction: np.ndarray) -> np.ndarray:
    """The shortest turn that takes +z to a direction of any length but zero."""
    d = direction / np.linalg.norm(direction)
    if d[2] < -1.0 + 1e-12:
        return np.array([0.0, 1.0, 0.0, 0.0])
    q = np.array([1.0 + d[2], -d[1], d[0], 0.0])
    return q / np.linalg.norm(q)

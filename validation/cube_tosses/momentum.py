"""Inertia of the cube from momentum, without any law of contact: touches of one corner between two free flights.

The impulse of a touch is J = m·Δv. It acts at a known place, the corner, so I·Δω = r × J. Velocities before and after come
from the flights around the touch, so nothing is assumed of what happens in it.

Both sides have errors, which bias a slope: that of r × J over Δω is too low, and the inverse slope of Δω over r × J too
high. The slope with an instrument is not biased: the moment that a vertical impulse in proportion to the speed of approach
would have, which follows from the flight before the touch alone.
"""

from dataclasses import dataclass

import numpy as np

from validation.cube_tosses.data import CORNERS, FRAME, GRAVITY, ORIENTATION, POSITION, PUBLISHED_BODY
from validation.kit import rotation

FLIGHT = 5  # frames of free flight on each side of a touch
CLEAR = 1  # frames between a touch and each flight, so that no flight has a frame of the touch
LONGEST = 4  # frames in a touch
NEAR = 1e-3  # m: a corner below that may touch
OTHERS_ABOVE = 15e-3  # m: the other corners stay that far away


@dataclass(frozen=True)
class Touch:
    """One touch of one corner, along the common axes."""

    toss: int
    turning: np.ndarray  # change of the angular velocity, rad/s
    moment: np.ndarray  # r × J, N·m·s
    instrument: np.ndarray  # moment of a vertical impulse as large as the speed of approach, m²/s

    @property
    def row(self):
        """The three vectors as nine numbers."""
        return np.concatenate([self.turning, self.moment, self.instrument])


@dataclass(frozen=True)
class Flight:
    """Free flight fitted to consecutive frames, about the instant zero."""

    place: np.ndarray  # m
    velocity: np.ndarray  # m/s
    orientation: np.ndarray  # quaternion
    turning: np.ndarray  # rad/s, along the common axes

    def at(self, time):
        """Place and orientation at an instant."""
        fall = np.array([0.0, 0.0, -GRAVITY / 2 * time**2])
        return self.place + self.velocity * time + fall, rotation.product(
            rotation.of_rotation_vector(self.turning * time), self.orientation
        )

    def velocity_at(self, time):
        """Velocity at an instant."""
        return self.velocity - np.array([0.0, 0.0, GRAVITY * time])


def flight_of(toss, frames, zero):
    """Flight through the frames: parabola with the known gravity, and constant angular velocity of a body with one inertia."""
    time = FRAME * (np.asarray(frames) - zero)
    lines = np.stack([np.ones(len(time)), time], axis=1)
    fall = np.outer(time**2, [0.0, 0.0, GRAVITY / 2])
    place, velocity = np.linalg.lstsq(lines, toss[frames, POSITION] + fall, rcond=None)[0]
    middle = toss[frames[len(frames) // 2], ORIENTATION]
    turns = rotation.rotation_vector(rotation.product(toss[frames, ORIENTATION], rotation.inverse(middle)))
    turn, turning = np.linalg.lstsq(lines, turns, rcond=None)[0]
    return Flight(place, velocity, rotation.product(rotation.of_rotation_vector(turn), middle), turning)


def corner_heights(toss, table):
    """Height of each corner over the table, frames × 8, m."""
    up = rotation.matrix(toss[:, ORIENTATION])[:, 2, :]
    return toss[:, 2:3] + up @ CORNERS.T - table


def touches(tosses, table):
    """All touches of a single corner between two free flights."""
    found = []
    for number, toss in enumerate(tosses):
        heights = corner_heights(toss, table)
        near = heights.min(axis=1) < NEAR
        edges = np.flatnonzero(np.diff(near.astype(int)))
        # Frames begin…end are near the table.
        for begin, end in zip(edges[:-1] + 1, edges[1:]):
            first, last = begin - CLEAR - FLIGHT, end + CLEAR + FLIGHT
            alone = near[begin] and end - begin < LONGEST and first >= 0 and last < len(toss)
            if not alone or near[first:begin].any() or near[end + 1 : last + 1].any():
                continue
            if (np.sort(heights[begin - 1 : end + 2], axis=1)[:, 1] < OTHERS_ABOVE).any():
                continue
            corner = int(np.argmin(heights[begin : end + 1].min(axis=0)))
            before, after = np.arange(first, begin - CLEAR), np.arange(end + 1 + CLEAR, last + 1)
            found.append(touch_of(number, toss, corner, before, after, (begin + end) / 2))
    return found


def touch_of(number, toss, corner, before, after, zero):
    """Changes of velocities in a touch, at the instant at which the flights before and after are nearest."""
    first, second = flight_of(toss, before, zero), flight_of(toss, after, zero)
    apart, closing = second.place - first.place, second.velocity - first.velocity
    # Both flights fall alike, so the distance of their places is linear in time.
    instant = float(np.clip(-(apart @ closing) / (closing @ closing), -1.5 * FRAME, 1.5 * FRAME))
    impulse = PUBLISHED_BODY.mass * (second.velocity_at(instant) - first.velocity_at(instant))
    # The cube turns while it touches, so the place of the corner is the measured one.
    arm = rotation.turned(between(toss, zero + instant / FRAME), CORNERS[corner])
    expected = rotation.turned(first.at(0.0)[1], CORNERS[corner])
    approach = first.velocity[2] + np.cross(first.turning, expected)[2]
    return Touch(
        number,
        second.turning - first.turning,
        np.cross(arm, impulse),
        np.cross(expected, [0.0, 0.0, -approach]),
    )


def between(toss, frame):
    """Measured orientation at a frame or between two."""
    lower = int(np.floor(frame))
    first, second = toss[lower, ORIENTATION], toss[lower + 1, ORIENTATION]
    turn = rotation.rotation_vector(rotation.product(second, rotation.inverse(first)))
    return rotation.product(rotation.of_rotation_vector((frame - lower) * turn), first)


def _sum(a, b):
    """Sum of the products over touches and components; leading axes are those of resamples."""
    return np.sum(a * b, axis=(-1, -2))


def inertia(rows, axis=None):
    """Inertia by the instrument, kg·m², of rows of touches. `axis` is there for the bootstrap, and not used."""
    turning, moment, instrument = rows[..., :3], rows[..., 3:6], rows[..., 6:]
    return _sum(instrument, moment) / _sum(instrument, turning)


def inertia_too_low(rows, axis=None):
    """Slope of the moments over the changes of angular velocity, kg·m²."""
    turning, moment = rows[..., :3], rows[..., 3:6]
    return _sum(turning, moment) / _sum(turning, turning)


def inertia_too_high(rows, axis=None):
    """Inverse slope of the changes of angular velocity over the moments, kg·m²."""
    turning, moment = rows[..., :3], rows[..., 3:6]
    return _sum(moment, moment) / _sum(turning, moment)

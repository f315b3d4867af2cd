"""Protocol of Acosta, Yang and Posa (2022): where a simulation starts, and how its path is compared with the measured one.

The places that differ from the published protocol are arguments: `corrected` starts, and the horizon after the touch.
"""

from dataclasses import dataclass

import numpy as np

from validation.cube_tosses.data import (
    ANGULAR_VELOCITY,
    FRAME,
    GRAVITY,
    HALF_EDGE,
    ORIENTATION,
    POSITION,
    VELOCITY,
    lowest_corner,
)
from validation.kit import rotation

SUBSTEPS = 10
STEP = FRAME / SUBSTEPS  # s, 0.676 ms
FRAMES_BEFORE = 3  # between the start and the first frame in which a corner could touch
HORIZON = 0.15  # s after the touch


@dataclass(frozen=True)
class Case:
    """One toss as a simulation meets it: start, and measured states from the start on."""

    number: int
    start: np.ndarray  # 13 numbers
    measured: np.ndarray  # frames × 13, the first one at the start


def first_frame(toss):
    """Frame of the start: three before the centre is so low that a corner could touch, or the first frame."""
    low = np.flatnonzero(toss[:, 2] <= np.sqrt(3.0) * HALF_EDGE)
    return max(0, (int(low[0]) if len(low) else len(toss)) - FRAMES_BEFORE)


def start_state(toss, frame, corrected=False):
    """State at the start: the measured pose, with velocities of the free flight before it.

    The vertical velocity is that of a parabola through the flight. The published programs take it one frame too early, at
    the last frame of the fit; `corrected` takes it at the start. A flight of fewer than four frames gives no fit.
    """
    state = toss[frame].copy()
    if frame < 4:
        return state
    turn = rotation.product(rotation.inverse(toss[0, ORIENTATION]), toss[frame, ORIENTATION])
    state[ANGULAR_VELOCITY] = rotation.rotation_vector(turn) / (frame * FRAME)
    flight = toss[:frame, POSITION]
    time = FRAME * np.arange(frame)
    _, climb = np.linalg.lstsq(
        np.stack([np.ones(frame), time], axis=1), flight[:, 2] + GRAVITY / 2 * time**2, rcond=None
    )[0]
    instant = frame * FRAME if corrected else time[-1]
    state[VELOCITY] = [*(flight[-1, :2] - flight[0, :2]) / time[-1], climb - GRAVITY * instant]
    return state


def touch_frame(measured, table=0.0):
    """First frame in which the lowest corner is at the table or below it; None if there is no such frame."""
    below = np.flatnonzero(lowest_corner(measured) <= table)
    return int(below[0]) if len(below) else None


def whole_tosses(tosses, numbers, corrected=False):
    """Cases from the start to the end of the record."""
    cases = []
    for number in numbers:
        frame = first_frame(tosses[number])
        start = start_state(tosses[number], frame, corrected)
        cases.append(Case(number, start, tosses[number][frame:]))
    return cases


def after_touch(tosses, numbers, horizon=HORIZON):
    """Cases that end `horizon` after the touch, with corrected starts."""
    cases = []
    for number in numbers:
        frame = first_frame(tosses[number])
        measured = tosses[number][frame:]
        touch = touch_frame(measured)
        if touch is not None:
            end = touch + round(horizon / FRAME) + 1
            cases.append(Case(number, start_state(tosses[number], frame, True), measured[:end]))
    return cases


@dataclass(frozen=True)
class Errors:
    """Errors of one run, means over its frames from the start on."""

    e_q: float  # the published metric
    place: float  # of the edge
    turn: float  # rad


def errors(case, poses):
    """Errors of simulated poses (frames × 7) against the measured ones."""
    measured = case.measured
    away = np.linalg.norm(poses[:, POSITION] - measured[:, POSITION], axis=1)
    turn = rotation.angle_between(measured[:, ORIENTATION], poses[:, ORIENTATION])
    return Errors(
        float(np.mean(away**2) / HALF_EDGE + np.mean(turn**2)),
        float(np.mean(away) / (2 * HALF_EDGE)),
        float(np.mean(turn)),
    )


def same_face(case, poses):
    """Tests whether simulation and measurement end on the same face of the cube."""
    up = [
        rotation.turned(rotation.inverse(last), np.array([0.0, 0.0, 1.0]))
        for last in (case.measured[-1, ORIENTATION], poses[-1, ORIENTATION])
    ]
    faces = [(int(np.argmax(np.abs(axis))), bool(axis[np.argmax(np.abs(axis))] > 0)) for axis in up]
    return faces[0] == faces[1]


# Tosses with even numbers identify parameters; those with odd numbers test them.
TEST = range(1, 550, 2)


def training(count=150):
    """Numbers of the first `count` even tosses."""
    return range(0, 2 * count, 2)

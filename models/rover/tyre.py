"""Closed forms of a wheel's ring of spheres on level ground, for scenes and outcomes, without the engine."""

import math

from dimensions import *  # noqa: F403


def balls(height, spin=0.0, phase=0.0):
    """(position ahead of the axle, force) of each loaded sphere of a wheel with its axle at `height` that rolls at
    `spin`, rad/s. `phase`: offset of a sphere from the lowest point, in steps from sphere to sphere."""
    step = 2 * math.pi / BALLS
    for i in range(-BALLS // 4, BALLS // 4 + 1):
        angle = (i + phase) * step
        ahead = RING_RADIUS * math.sin(angle)
        depth = BALL_RADIUS + RING_RADIUS * math.cos(angle) - height
        if depth > 0.0:
            x = min(depth / DAMPING_RAMP, 1.0)
            sinking = BALL_DAMPING * (3 - 2 * x) * x * x * spin * ahead
            yield ahead, max(0.0, BALL_STIFFNESS * depth + sinking)


def load(height, spin=0.0, phase=0.0):
    return sum(force for _, force in balls(height, spin, phase))


def mean_load(height, spin=0.0, phases=8):
    return sum(load(height, spin, i / phases) for i in range(phases)) / phases


def rolling_moment(height, spin, phases=8):
    """Rolling resistance moment, since ground forces are larger ahead of the axle than behind; mean of a turn, N·m."""
    pairs = [pair for i in range(phases) for pair in balls(height, spin, i / phases)]
    return sum(ahead * force for ahead, force in pairs) / phases


def height_under(carried, spin=0.0, phase=None):
    """Height of the axle at which the wheel carries a force: mean of a turn, or with a sphere at a phase."""
    low, high = WHEEL_RADIUS - 0.2, WHEEL_RADIUS
    for _ in range(60):
        middle = (low + high) / 2
        carries = mean_load(middle, spin) if phase is None else load(middle, spin, phase)
        low, high = (middle, high) if carries > carried else (low, middle)
    return (low + high) / 2


CORNER_WEIGHT = GROSS_MASS * GRAVITY / 4
STATIC_HEIGHT = height_under(CORNER_WEIGHT)

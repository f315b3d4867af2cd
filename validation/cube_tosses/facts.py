"""Facts that the data give without a law of contact, and faults of published material, each shown by a run."""

import numpy as np

from validation.cube_tosses import momentum, protocol
from validation.cube_tosses.data import (
    ANGULAR_VELOCITY,
    FRAME,
    GRAVITY,
    HALF_EDGE,
    ORIENTATION,
    PUBLISHED_BODY,
    at_rest,
    lowest_corner,
    table_height,
)
from validation.cube_tosses.engines.with_bullet import Bullet, BulletAsPublished
from validation.kit import rotation
from validation.kit.statistics import interval


def table(tosses):
    """Height of the table with its interval, and the standard deviation from toss to toss, m."""
    heights = table_height(tosses)
    return interval(heights), float(np.std(heights, ddof=1))


def inertia(tosses, height):
    """Inertia from momentum (`momentum.py`): interval by the instrument, the two slopes that are biased, number of touches."""
    rows = np.array([touch.row for touch in momentum.touches(tosses, height)])
    return (
        interval(rows, momentum.inertia),
        interval(rows, momentum.inertia_too_low),
        interval(rows, momentum.inertia_too_high),
        len(rows),
    )


def axes_of_turning(tosses, count=100, clear=5e-3):
    """Angles between measured and integrated orientation at the end of each free flight before the first touch, rad, with the
    angular velocity taken along the axes of the cube, and along the common axes. Medians over `count` tosses."""
    own, common = [], []
    for toss in tosses[:count]:
        free = np.flatnonzero(lowest_corner(toss) < clear)
        end = int(free[0]) if len(free) else len(toss)
        if end < 10:
            continue
        turns = rotation.of_rotation_vector(
            (toss[: end - 1, ANGULAR_VELOCITY] + toss[1:end, ANGULAR_VELOCITY]) / 2 * FRAME
        )
        q_own = q_common = toss[0, ORIENTATION]
        for turn in turns:
            q_own, q_common = rotation.product(q_own, turn), rotation.product(turn, q_common)
        own.append(rotation.angle_between(toss[end - 1, ORIENTATION], q_own))
        common.append(rotation.angle_between(toss[end - 1, ORIENTATION], q_common))
    return float(np.median(own)), float(np.median(common))


def tilt_at_rest(tosses):
    """Standard deviations of the tilt of the upper face at rest about x and y, rad: an error of the measured orientation."""
    tilts = []
    for toss in tosses:
        rest = at_rest(toss)
        if len(rest) < 5:
            continue
        up = rotation.matrix(rest[-5:, ORIENTATION]).mean(axis=0)[2]
        axis = int(np.argmax(np.abs(up)))
        upper = rotation.matrix(rest[-1, ORIENTATION])[:, axis] * np.sign(up[axis])
        tilts.append(upper[:2])
    return np.std(tilts, axis=0, ddof=1)


def early_parabola(tosses):
    """Measured vertical velocity at the start less the published one, m/s, over all tosses: the slope of a parabola through the
    frames around the start, against that of the published fit, which is evaluated a frame early."""
    less = []
    for toss in tosses:
        frame = protocol.first_frame(toss)
        near = np.arange(frame - 4, frame + 3)
        if near[0] < 0 or frame < 4 or lowest_corner(toss[near]).min() < 2e-3:
            continue
        time = (near - frame) * FRAME
        climb = np.polyfit(time, toss[near, 2] + GRAVITY / 2 * time**2, 1)[0]
        less.append([climb - protocol.start_state(toss, frame, corrected)[9] for corrected in (False, True)])
    less = np.array(less)
    return interval(less[:, 0]), interval(less[:, 1])


def inertia_of_bullet():
    """Inertia that pybullet computes with: without and with the flag that makes it read the file, kg·m²."""
    used = []
    for engine in (BulletAsPublished(), Bullet()):
        engine.configure({"stiffness": 1e3, "damping": 10.0, "mu": 0.5})
        used.append(float(engine.inertia_in_use()[0]))
    return tuple(used)


def lines(tosses):
    """The facts as lines of text."""
    height, spread = table(tosses)
    yield f"table: {height.text(2, 1e3)} mm (centre at rest less {1e3 * HALF_EDGE:.1f} mm; {1e3 * spread:.2f} mm from toss to toss)"
    by_instrument, low, high, count = inertia(tosses, height.value)
    yield f"inertia from momentum in {count} touches of one corner, without a law of contact: {by_instrument.text(2, 1e3)} g·m²"
    yield f"slopes of ordinary regressions, which errors bias: {low.text(2, 1e3)} and {high.text(2, 1e3)}; published: {1e3 * PUBLISHED_BODY.inertia:.2f}"
    own, common = axes_of_turning(tosses)
    yield f"free flights integrated: off by {np.degrees(own):.2f}° along the axes of the cube, by {np.degrees(common):.1f}° along the common axes"
    tilt = tilt_at_rest(tosses)
    yield f"tilt of the upper face at rest: {1e3 * tilt[0]:.1f} and {1e3 * tilt[1]:.1f} mrad, standard deviations"
    published, corrected = early_parabola(tosses)
    yield f"vertical velocity at the start, measured less published: {published.text(3)} m/s; g·frame is {GRAVITY * FRAME:.3f} m/s; corrected: {corrected.text(3)} m/s"

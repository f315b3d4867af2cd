"""Outcomes of the tripod and their predictions. Run by mechanisms/run.py."""

import math

import numpy as np
import rig
from dimensions import FRICTION, GRAVITY, MASS, PUSH, RADIUS, STIFFNESS, TALL
from kit.rules import honest
from kit.rows import Fact, Limit, Row

WEIGHT = MASS * GRAVITY
HOLDING = 2e-3  # s, step with the arm
SET_DOWN = 60.0  # s that the arm presses: where it is soft, 1e3 N/m, forces across fade in 10 s


def above(made, attitude, start):
    """Displacement of the origin normal to the ground, m."""
    return float((made.place("tripod") - start) @ attitude[:, 2])


def drop(step):
    """Released with its feet just touching, without damping: it heaves about mg/3k between zero and twice that."""
    made, attitude = rig.free(step, sunk=False, plain=True)
    start, heights = made.place("tripod"), []
    made.run(0.5, watch=lambda m: heights.append(above(m, attitude, start)))
    deepest = -min(heights)
    yield Row("sinks to 2mg/3k", deepest, 2 * WEIGHT / (3 * STIFFNESS), 1e-3, "m")
    yield Row("heaves at √(3k/m)", frequency(heights, step), math.sqrt(3 * STIFFNESS / MASS), 1e-3, "rad/s")
    yield from honest(made)


def frequency(heights, step):
    """Frequency from the first to the last upward crossing of the mean, with linear interpolation between samples."""
    swing = np.array(heights) - 0.5 * (max(heights) + min(heights))
    at = np.flatnonzero((swing[:-1] < 0) & (swing[1:] >= 0))
    times = (at - swing[at] / (swing[at + 1] - swing[at])) * step
    return 2 * math.pi * (len(times) - 1) / (times[-1] - times[0])


def settle(step):
    """Dropped from 5 mm with damping, it comes to rest; in the middle it is restarted."""
    made, attitude = rig.free(step, sunk=False)
    made.data.qpos[:3] += 0.005 * attitude[:, 2]
    made.start()
    start = made.place("tripod") - 0.005 * attitude[:, 2]
    made.run(0.2)
    middle = made.save()
    made.run(1.3)
    yield from honest(made)
    end = made.save().tobytes()
    made.restore(middle)
    made.run(1.3)
    yield Row("at rest it stands mg/3k deep", -above(made, attitude, start), WEIGHT / (3 * STIFFNESS), 1e-3, "m")
    for foot in rig.feet(made, attitude[:, 2]):
        yield Row("each foot bears a third", foot, WEIGHT / 3, 1e-3, "N")
    yield Fact("restarted in the middle: the same bits", made.save().tobytes() == end)


def stands(step):
    """Stand on a slope without sliding or tipping, turned on it."""
    slope, yaw = math.radians(15.0), math.radians(40.0)
    made, attitude = rig.free(step, slope, yaw)
    made.run(1.5)
    for i, (load, predicted) in enumerate(zip(rig.feet(made, attitude[:, 2]), rig.loads(slope, yaw))):
        yield Row(f"on 15 deg, turned by 40 deg: foot {i}", load, predicted, 2e-3, "N")


def slides(step):
    """Below tan θ = μ it sticks without creep, above it slides by Coulomb's law."""
    made, attitude = rig.free(step, math.atan(0.97 * FRICTION))
    made.run(1.5)
    start = made.place("tripod")
    made.run(1.0)
    yield Limit("0.97 of tan θ = μ: it creeps in a second by", np.abs(made.place("tripod") - start).max(), 1e-8, "m")
    for share in (1.03, 1.2):
        slope = math.atan(share * FRICTION)
        made, attitude = rig.free(step, slope)
        made.run(0.5)
        before = made.data.qvel[:3] @ attitude[:, 1]
        made.run(0.5)
        sped = float(before - made.data.qvel[:3] @ attitude[:, 1]) / 0.5
        predicted = GRAVITY * (math.sin(slope) - FRICTION * math.cos(slope))
        yield Row(f"{share:g} of it: g(sin θ − μ cos θ)", sped, predicted, 0.01, "m/s²")


def tips(step):
    """A tall one tips over the edge between two feet when its weight points beyond it."""
    edge = math.atan(0.5 * RADIUS / TALL)
    for share, tipped in ((0.97, False), (1.03, True)):
        made, attitude = rig.free(step, share * edge, height=TALL)
        up = made.data.xmat[made.model.body("tripod").id].reshape(3, 3)[:, 2].copy()
        made.run(2.5, watch=lambda m, up=up: leaning(m, up) > 0.3)
        leant = leaning(made, up)
        what = f"at {share:g} of {math.degrees(edge):.2f} deg"
        if tipped:
            yield Limit(f"{what} it tips: has turned by", leant, 0.3, "rad", least=True)
        else:
            yield Limit(f"{what} it stands: has turned by", leant, 2e-3, "rad")


def leaning(made, up):
    return float(math.acos(min(1.0, made.data.xmat[made.model.body("tripod").id].reshape(3, 3)[:, 2] @ up)))


def set_down(step):
    """The arm presses it onto a slope: the law turns it until no moment is left, so all feet have equal loads."""
    made, arm, normal = rig.held(step)
    press(arm, normal)
    made.run(1.0, arm.control, watch=lambda m: m.contacts() > 0)
    first = made.contacts()
    made.run(SET_DOWN, arm.control)
    yield Limit("feet that touch first", first, 1)
    for i, load in enumerate(rig.feet(made, normal)):
        yield Row(f"then, of a push with {PUSH:g} N, foot {i}", load, PUSH / 3, 0.02, "N")
    yield from honest(made)


def press(arm, normal, moment=(0.0, 0.0, 0.0)):
    """Commands a push against the slope."""
    arm.command("tip", push=np.r_[-PUSH * normal, moment])


def rows(thorough):
    step = rig.ANALYSIS if thorough else rig.TRAINING
    yield "drop", drop(rig.ANALYSIS)
    yield "drop at level training", drop(rig.TRAINING)
    yield "settling", settle(step)
    yield "slope", stands(step)
    yield "sliding", slides(step)
    yield "tipping", tips(step)
    yield "set down by the arm", set_down(HOLDING)
    if thorough:
        yield "set down by the arm, half the step", set_down(HOLDING / 2)


DRAWN = ("base", "link_*", "tripod")  # bodies that logs and films show beside what touches


def shown(prepare):
    """Run for logs and films: the arm sets the tripod down."""
    made, arm, normal = rig.held(HOLDING, gap=0.2)
    prepare(made)
    press(arm, normal)
    made.run(50.0, arm.control)

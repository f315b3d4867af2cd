"""Outcomes of the round peg and their predictions. Run by mechanisms/run.py."""

import math

import numpy as np
import rig
from dimensions import TURN, UPRIGHT_AT
from kit import mjcf
from kit.rules import honest
from kit.rows import Fact, Limit, Row

SHALLOW = 0.020  # m of insertion for the diagram
NEAR = 0.08  # loads so near to the sides are left out: the springs of contact sink in by up to 0.4 mm, which tilts the peg


def diagram(count, seed=1):
    """Random loads: a peg in two-point contact slides in if they are within Whitney's parallelogram, else it jams."""
    random = np.random.default_rng(seed)
    slope = SHALLOW / (rig.DIAMETER * rig.FRICTION)
    wrong, slid, tried, imbalance = [], 0, 0, 0.0
    while tried < count:
        # Uniform over twice the parallelogram: across ±1/μ, and along its slanted sides.
        across, beyond = random.uniform(-1.8, 1.8) / rig.FRICTION, random.uniform(-2.0, 2.0) * slope
        moment = rig.FRICTION * (1 + slope) * across + beyond
        out = rig.whitney(SHALLOW, across, moment)
        if abs(out - 1.0) < NEAR:
            continue
        moved, made = rig.moves(SHALLOW, across, moment)
        imbalance = max(imbalance, made.imbalance)
        tried, slid = tried + 1, slid + moved
        if moved != (out < 1.0):
            wrong.append((across, moment, out))
    yield Limit(f"of {count} loads, those that slide or jam against the diagram", len(wrong), 0)
    yield Fact("some of them slid, some jammed", 0 < slid < count)
    yield Limit("forces that have no reaction, of the greatest", imbalance, 1e-9)
    for across, moment, out in wrong[:5]:
        print(f"      wrong: Fx/Fz {across:.3f}, M/(r Fz) {moment:.3f}, {out:.3f} of the way to the side")


def held(tilt, stiffness=None):
    """A peg that enters slowly, free sideways; its tilt is held, or by a spring about its tip, N·m/rad."""
    half = tilt / 2
    turn = "" if stiffness is None else f'<joint name="turn" axis="0 1 0" stiffness="{stiffness:g}" damping="0.5"/>'
    return (
        f'<body name="peg" pos="0 0 -0.004" quat="{mjcf.numbers((math.cos(half), 0, math.sin(half), 0))}">'
        '<joint name="down" type="slide" axis="0 0 -1"/><joint name="across" type="slide" axis="1 0 0" damping="20"/>'
        f"{turn}{rig.INERTIAL}</body>"
    )


def driven(made, speed=0.02):
    """A stiff feed: position and speed of the joint `down`; its force is in `feed`, N."""
    drive = made.model.joint("down").dofadr[0]

    def control(m):
        error = speed * m.time - m.joint("down")
        m.data.qfrc_applied[drive] = 2e5 * error + 1e3 * (speed - m.speed("down"))

    return control


def two_places():
    """With its tilt held, the peg makes a second contact exactly at the depth l where l·sin θ + d·cos θ = D."""
    for depth in (0.02, 0.05):
        tilt = rig.tilt_at(depth)
        # Both joints turn with the body, so the displacement is along its own axis.
        made = rig.machine(held(tilt))
        # A light push to one side keeps the first contact.
        push = made.model.joint("across").dofadr[0]
        feed = driven(made)

        def control(m):
            feed(m)
            m.data.qfrc_applied[push] = 0.5

        made.run(0.3, control)
        one = made.contacts()
        made.run(5.0, control, watch=lambda m: m.contacts() > 1)
        yield Row(
            f"a peg with a tilt of {math.degrees(tilt):.3f} deg touches twice from the depth l",
            -tip(made),
            depth,
            0.02,
            "m",
        )
        yield Row("places touched before", one, 1, 0.0)


def tip(made):
    """Lowest height of the middle of the peg's tip circle, m."""
    return float(made.place("peg")[2])


TILT = rig.tilt_at(UPRIGHT_AT)


def compliant(step):
    """Held by a spring about its tip, the peg turns upright as it enters; friction in two contacts is 2μ·K(θ₀ − θ)/l."""
    made = rig.machine(held(TILT, TURN), step=step)
    feed = driven(made)
    for depth in (0.03, 0.045, 0.06):
        made.run(10.0, feed, watch=lambda m: -tip(m) > depth)
        angle = TILT + made.joint("turn")
        push = TURN * (TILT - angle) / -tip(made)
        yield Row(f"tilt at the depth {depth * 1e3:.0f} mm", angle, rig.tilt_at(-tip(made), push), 0.02, "rad")
        yield Row("force of the feed there", feed_force(made), 2 * rig.FRICTION * push, 0.03, "N")
    yield from honest(made)


def feed_force(made):
    return float(made.data.qfrc_applied[made.model.joint("down").dofadr[0]])


def half_step(depth=0.03):
    for name, step in (("training", rig.TRAINING), ("analysis", rig.ANALYSIS)):
        forces = []
        for each in (step, step / 2):
            made = rig.machine(held(TILT, TURN), step=each)
            made.run(5.0, driven(made), watch=lambda m: -tip(m) > depth)
            forces.append(feed_force(made))
        yield Row(
            f"level {name}, {depth * 1e3:g} mm deep: force of the feed at half the step", *forces[::-1], 2e-3, "N"
        )


def restarted():
    """Valid while both points touch."""
    made = rig.machine(held(TILT, TURN), step=rig.TRAINING)
    feed = driven(made)
    made.run(5.0, feed, watch=lambda m: -tip(m) > 0.03)
    middle = made.save()
    made.run(0.1, feed)
    end = made.save().tobytes()
    made.restore(middle)
    made.run(0.1, feed)
    yield Fact("restarted while both places touch: the same bits", made.save().tobytes() == end)


ROWS_PER_SECOND = 100  # of logs and films, which show a third of the speed of life


def shown(prepare):
    """Run for logs and films: the compliant insertion."""
    made = rig.machine(held(TILT, TURN))
    prepare(made)
    made.run(10.0, driven(made), watch=lambda m: -tip(m) > 0.08)


def rows(thorough):
    yield "two places", two_places()
    yield "compliant insertion", compliant(rig.ANALYSIS)
    yield "Whitney's diagram", diagram(200 if thorough else 24)
    yield "restart", restarted()
    if thorough:
        yield "compliant insertion, level training", compliant(rig.TRAINING)
        yield "half the step", half_step()

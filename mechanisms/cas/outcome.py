"""Outcomes of the attachment and their predictions. Run by mechanisms/run.py: `rows(thorough)` yields (title, rows)."""

import time

import campaign
import dimensions as d
import handover
import numpy as np
import rig
import seat
import statics
from dimensions import ANALYSIS, TRAINING
from kit import conclusion
from kit.rules import honest
from kit.rows import Fact, Limit, Row
from seat import PULL

TURNING = 4000.0  # N·m: far enough for all flanks to slip
LOADS = {
    "a pull of 6 kN at (60, 40) mm": (0.0, 0.0, -PULL, -PULL * 0.04, PULL * 0.06, 0.0),
    "that, 400 N sideways and 300 N m about z": (400.0, -200.0, -PULL, -PULL * 0.04, PULL * 0.06, 300.0),
}
STARTS = [  # m and rad from the seat
    (0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    (0.008, 0.004, 0.015, 0.0, 0.0, 0.010),
    (-0.006, 0.008, 0.018, 0.004, 0.004, -0.012),
    (0.0, -0.010, 0.018, -0.003, 0.002, 0.005),
]
EDGES = [(1.0, 0.0, 0.0), (-0.5, 0.2, 0.06)]  # directions of offset (m) and yaw (rad), which are scaled to the opening
MORE_EDGES = [(0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (0.8, -0.6, 0.0), (0.3, 0.3, -0.1), (-1.0, -0.3, 0.02)]


def vane_loads(step):
    """Three grooves of two flanks without friction: six unknowns, six equations."""
    for what, load in LOADS.items():
        made = seat.pulled(step, load)
        forces, predicted = rig.on_vanes(made), statics.loads(load)
        off = np.abs(forces - predicted).max()
        yield Limit(f"{what}: forces of the vanes off the six equations", off, 2e-3 * PULL / 3, "N")
    beside = np.array((0.06, 0.04))
    made = seat.pulled(step, next(iter(LOADS.values())))
    for name, force, share in zip(rig.VANES, rig.on_vanes(made)[:, 2], statics.shares(PULL, beside)):
        yield Row(f"{name}, along z: F/3·(1 + 2·r·e/R)", force, share, 2e-3, "N")
    yield Row("payload goes in by F/(6·k·cos²β)", -made.place("payload")[2], statics.sunk(PULL), 2e-3, "m")
    yield from honest(made)


def seated(step):
    """Final poses from several starts beside the seat, without and with friction."""
    load = (0.0, 0.0, -PULL, 0.0, 0.0, 0.0)
    runs = [seat.pulled(step, load, start, seconds=6.0) for start in STARTS]
    poses = np.array([rig.pose(made) for made in runs])
    spread = np.ptp(poses, axis=0)
    yield Limit("no friction: places after four starts differ by", spread[:3].max(), 1e-6, "m")
    yield Limit("and turns by", spread[3:].max(), 1e-6, "rad")
    yield from honest(*runs)
    runs = [seat.pulled(step, load, start, friction=None) for start in STARTS]
    poses = np.array([rig.pose(made) for made in runs])
    sideways, turned = (PULL * b for b in statics.band())
    places = np.linalg.norm(poses[:, :2], axis=1)
    yield Limit("friction 0.1: sideways from the seat, at most μΣN/(3·k·sin²β)", places.max(), sideways, "m")
    yield Limit("turned about z, at most μF/(6·k·sin²β·(1 + μ²)·R)", np.abs(poses[:, 5]).max(), turned, "rad")
    yield Limit("in by at least F/(6·k·cosβ·(cosβ + μ·sinβ))", -poses[:, 2].max(), statics.sunk(PULL, 0.1), "m", True)
    yield Limit("in by at most F/(6·k·cosβ·(cosβ − μ·sinβ))", -poses[:, 2].min(), statics.sunk(PULL, -0.1), "m")
    yield from honest(*runs)


def turned(step):
    """Friction against a moment about the axis of the pull."""
    made, (under, after) = seat.turned(step, TURNING)
    what = f"{TURNING:g} N m against friction: turned by (M/R − μF)/(6·k·sin²β·(1 + μ²)·R)"
    yield Row(what, under, statics.slipped(PULL, TURNING), 0.01, "rad")
    yield Row("and without it again: all that friction can keep", after, PULL * statics.band()[1], 0.02, "rad")
    yield from honest(made)


def at_the_edge(direction, share):
    """Offset and yaw at which the most misaligned pin is at that share of half the opening."""
    low, high = 0.0, 2.0
    for _ in range(60):
        middle = (low + high) / 2
        x, y, yaw = (middle * c for c in direction)
        low, high = (middle, high) if statics.out_of_line((x, y), yaw) < share else (low, middle)
    return (low * direction[0], low * direction[1]), low * direction[2]


def claw_row(what, made, share=1.0):
    return Row(what, seat.claw_force(made), seat.preload(made, share), 1e-3, "N")


def captures(step, directions):
    """Starts 5 % within the opening of the vanes are captured; 5 % beyond it the payload stops on a crest."""
    within, beyond = 0.95, 1.05
    yield Limit("5 % within the opening: friction of the crest holds no ball", within, statics.surely_in())
    for direction in directions:
        for share in (within, beyond):
            offset, yaw = at_the_edge(direction, share)
            made = seat.Capture(step, offset, yaw).run()
            where = f"{1e3 * offset[0]:.1f}, {1e3 * offset[1]:.1f} mm, {np.degrees(yaw):.2f}°"
            wanted = share < 1.0
            yield Fact(f"{where}: {'captured' if wanted else 'not captured'}", made.seated() == wanted)
            if wanted:
                yield claw_row("preload of the claw, torque over lever", made.machine)
            yield Fact("no contact tunnelled", made.machine.flags == 0)


def handed_over(step):
    """Trunk, two arms, vanes and claw."""
    began = time.process_time()
    made, sequence = handover.run(step)
    spent = (time.process_time() - began) / (made.time / made.step)
    force, moment = handover.expected()[[0, 3]]
    first, second = (sequence.seen["both"][h.name] for h in handover.ARMS)
    yield Row("both hold: force d·k1·k2/(k1 + k2)", second[0], force, 1e-3, "N")
    yield Row("moment, alike", second[3], moment, 1e-3, "N m")
    yield Limit("what one arm gives the other takes: sum", np.abs(first + second)[[0, 1, 2, 3]].max(), 1e-3, "N, N m")
    speed = statics.released_speed(d.SECOND, force)
    yield Row("the first lets go: greatest speed of one damped spring", sequence.fastest, speed, 2e-3, "m/s")
    left = np.abs(sequence.seen["release"][d.SECOND.name]).max()
    yield Limit("6 s later the second arm gives", left, 1e-3 * force, "N, N m")
    yield from clamped(made)
    yield from honest(made)
    print(f"      processor time of a step of {step * 1e3:g} ms, with the account of energy: {spent * 1e6:.0f} µs")


def clamped(made):
    """Run in which the claw is stalled and no arm holds the payload."""
    yield claw_row("no arm holds it: preload of the claw, torque over lever", made)
    for name, force in zip(rig.VANES, rig.on_vanes(made)[:, 2]):
        yield Row(f"of this {name} bears a third", force, seat.preload(made) / 3, 0.02, "N")
    sideways = seat.preload(made) * statics.band()[0]
    yield Limit(
        "sideways from the seat: what friction allows", np.linalg.norm(made.place("payload")[:2]), sideways, "m"
    )


def any_misalignment(step):
    """Six components at once, compared with the two stiffness matrices in series."""
    off = (0.010, -0.008, 0.006, 0.004, 0.003, -0.005)
    _, sequence = handover.run(step, until="release", off=off)
    measured, predicted = sequence.seen["both"][d.SECOND.name], handover.expected(off)
    for axis, one, other in zip(rig.AXES, measured, predicted):
        yield Row(f"{axis}: matrices in series, small angles", one, other, 0.03, "N, N m")


def turned_by(made):
    """Rotation about the line of the balls of vanes 2 and 3, which is along x, rad."""
    return abs(rig.pose(made)[3])


def off_nominal(step):
    """Failures: the claw gives half of its torque; a pin is missing."""
    made = seat.Capture(step, voltage=-0.5).run(14.0)
    yield Fact("half of the torque: captured", made.seated())
    yield claw_row("preload of the claw", made.machine, 0.5)
    share = 0.1
    made = seat.on_two(step, share, (d.SECOND,))
    turn, borne = statics.tilt_on_two(d.SECOND, share * d.CLAW_STALL / d.LEVER, 1)
    yield Row("pin 1 missing, the arm holds: payload turns by", turned_by(made), turn, 0.03, "rad")
    yield Row("the other two vanes bear", rig.on_vanes(made)[:, 2].sum(), borne, 0.03, "N")
    yield Limit("and that of the missing pin", abs(rig.on_vanes(made)[0, 2]), 0.0, "N")
    yield from honest(made)
    made = seat.on_two(step, share, ())
    yield Limit(
        "no arm: no balance; after the same time it has turned by ten times as much",
        turned_by(made),
        10 * turn,
        "rad",
        True,
    )


def half_step(step):
    one, other = (handover.run(s) for s in (step, step / 2))
    for phase in ("both", "claw"):
        forces = [sequence.seen[phase][d.SECOND.name][0] for _, sequence in (other, one)]
        yield Row(f"second arm, along x, at the end of {phase}, half the step", *forces, 1e-3, "N")
    forces = [seat.claw_force(made) for made, _ in (other, one)]
    yield Row("claw, half the step", *forces, 1e-3, "N")
    apart = np.abs(rig.pose(one[0]) - rig.pose(other[0]))[:3].max()
    yield Limit("places at the end differ by", apart, 1e-6, "m")


def restart(step):
    yield Fact("restarted while the claw pulls: the same bits", seat.same_bits_after_restart(step, 5.0, 0.5))


DRAWN = ("payload", "claw")  # bodies that logs and films show beside what touches


def shown(prepare):
    """Run for logs and films: `prepare` receives the machine before it moves."""
    handover.run(TRAINING.step, prepare)


def rows(thorough):
    yield "loads of the three vanes, without friction", vane_loads(TRAINING.step)
    yield "one seat, level training", seated(TRAINING.step)
    yield "friction of the vanes", turned(TRAINING.step)
    yield "limits of capture, level training", captures(TRAINING.step, EDGES)
    yield "from the trunk to the platform, level training", handed_over(TRAINING.step)
    yield "off-nominal", off_nominal(TRAINING.step)
    yield "restart", restart(TRAINING.step)
    yield "worst case of the campaign", conclusion.again(campaign.STUDY, d.HERE)
    if thorough:
        same = handover.same_bits_after_restart(TRAINING.step, 13.0, 2.0)
        yield "restart of the whole", [Fact("restarted while the second arm grasps: the same bits", same)]
        yield "any misalignment of the arms", any_misalignment(TRAINING.step)
        yield "more limits of capture", captures(TRAINING.step, MORE_EDGES)
        yield "half the step", half_step(TRAINING.step)
        yield "limits of capture at half the step", captures(TRAINING.step / 2, EDGES)
        yield "one seat, level analysis", seated(ANALYSIS.step)
        yield "from the trunk to the platform, level analysis", handed_over(ANALYSIS.step)

"""Checks of the law of force-moment accommodation in contact with the pad."""

import dataclasses

import numpy as np
import rig
from dimensions import PAD_DAMPING, PUSH
from kit.arm import Law
from kit.arm import dimensions as d
from kit.arm.kinematics import resolve
from kit.rules import honest
from kit.rows import Fact, Limit, Row
from margin import Linear

RATE = 0.01  # m/s, commanded towards the pad


def commanded(arm, normal, push=0.0, rate=0.0):
    """Presses, or moves, against the normal of the pad."""
    arm.command("tip", rates=np.r_[-rate * normal, 0, 0, 0], push=np.r_[-push * normal, 0, 0, 0])


def pressed(made, normal):
    return float(made.wrench("tip")[:3] @ normal)


def press(step):
    """Response to a pressing force, its reduction, and a commanded rate, compared with the law and its dead band."""
    law = Law()
    made, arm, normal = rig.machine(step)
    commanded(arm, normal, PUSH)
    made.run(4.0, arm.control)
    middle, remembered = made.save(), arm.save()
    made.run(8.0, arm.control)
    first = pressed(made, normal)
    yield Row(f"pressing with {PUSH:g} N from outside: less the dead band", first, PUSH - law.band, 0.01, "N")
    commanded(arm, normal, 0.5 * PUSH)
    made.run(10.0, arm.control)
    yield Row("then with half of it: more by the dead band", pressed(made, normal), PUSH / 2 + law.band, 0.01, "N")
    commanded(arm, normal, rate=RATE)
    made.run(10.0, arm.control)
    predicted = law.band + RATE / law.admittance
    yield Row(f"moving on at {RATE * 1e3:g} mm/s: band + rate/admittance", pressed(made, normal), predicted, 0.01, "N")
    commanded(arm, normal, push=10 * law.push)
    made.run(10.0, arm.control)
    yield Row("pressing with ten times the greatest force", pressed(made, normal), law.push - law.band, 0.01, "N")
    yield from honest(made)
    yield from again(made, arm, middle, remembered, first)
    yield from halved(step, normal, first)


def again(made, arm, middle, remembered, first):
    """Two runs from the middle of the run, for comparison."""
    ends = []
    for _ in range(2):
        made.restore(middle)
        arm.restore(remembered)
        made.run(2.0, arm.control)
        ends.append(np.concatenate([made.save(), arm.state.aim, arm.state.felt]).tobytes())
    yield Fact("restarted in the middle: the same bits", ends[0] == ends[1])


def halved(step, normal, first):
    made, arm, _ = rig.machine(step / 2)
    commanded(arm, normal, PUSH)
    made.run(12.0, arm.control)
    yield Row("the first force at half the step", pressed(made, normal), first, 1e-3, "N")


def limits():
    """Free motion commanded too fast: the tip moves straight, and no faster than the law or a joint allows."""
    made, arm, normal = rig.machine(step=4e-3, gap=5.0)
    along = np.array([0.6, 0.0, 0.8])
    # At full speed of a joint the servos lag behind a Jacobian that changes.
    for law, what, straight in ((Law(), "the law", 0.01), (Law(rate=10.0), "its fastest joint", 0.06)):
        arm.law = law
        arm.command("tip", rates=np.r_[5.0 * along, 0, 0, 0])
        made.run(4.0, arm.control)
        jacobian = arm.jacobian()
        speed = jacobian[:3] @ arm.speeds()
        joints = resolve(jacobian, np.r_[along, 0, 0, 0], law.damping)
        predicted = min(law.rate, d.SPEED / np.abs(joints).max())
        yield Row(
            f"commanded 5 m/s, limited by {what}: speed of the tip", float(speed @ along), predicted, 0.02, "m/s"
        )
        across = np.linalg.norm(speed - (speed @ along) * along) / np.linalg.norm(speed)
        yield Limit("across the way that is commanded, of the speed", across, straight)


def trips():
    """Pressed by its operator beyond the trip force: brakes on, until the next command."""
    made, arm, normal = rig.machine(law=Law(trip=200.0))
    commanded(arm, normal, PUSH)
    made.run(4.0, arm.control, lambda m: arm.state.mode == "tripped")
    felt = float(np.linalg.norm(arm.state.felt[:3]))
    yield Row("it trips at 200 N", felt, 200.0, 0.01, "N")
    yield Fact("and its brakes are on", arm.state.mode == "tripped" and not arm.state.released.any())
    commanded(arm, normal, 0.5 * PUSH)
    made.run(0.5, arm.control)
    yield Fact("while it still feels that, it trips again", arm.state.mode == "tripped")
    arm.command("joints", rates=resolve(arm.jacobian(), np.r_[0.01 * normal, 0, 0, 0], arm.law.damping))
    made.run(5.0, arm.control)
    yield Limit("rates of joints take it away from the pad: force", pressed(made, normal), 0.0, "N")


def margins(stiffnesses):
    """Contact oscillations decay below the admittance limit of the linearised arm, and grow above it, at the predicted
    rate."""
    for stiffness in stiffnesses:
        law = Law(admittance=1e-4, band=0.0, band_turn=1e9)
        made, arm, normal = rig.machine(stiffness=stiffness, law=law)
        commanded(arm, normal, PUSH)
        # Softer contact comes to rest more slowly; what is left must not meet the limit of rate with more admittance.
        made.run(6.0 * max(1.0, 2e4 / stiffness), arm.control)
        middle, remembered = made.save(), arm.save()
        linear = Linear(made, arm, normal, stiffness, PAD_DAMPING)
        limit = linear.limit()
        yield Limit(
            f"pad of {stiffness:g} N/m: its limit over the admittance of the law",
            limit / Law().admittance,
            1.0,
            least=True,
        )
        for factor in (0.8, 1.25):
            made.restore(middle)
            arm.restore(remembered)
            arm.law = dataclasses.replace(law, admittance=factor * limit)
            yield _swing(made, arm, normal, factor, linear.root(factor * limit), linear.root(limit))


def _swing(made, arm, normal, factor, root, critical):
    """Growth over whole oscillations of the mode that loses stability; below the limit the other modes decay as well."""
    turn = 2 * np.pi / abs(np.angle(root if factor > 1.0 else critical)) * arm.law.period
    grown = growth(made, arm, normal, turn)
    what = f"{factor:g} of the limit: growth in one oscillation of {turn:.3f} s"
    if factor > 1.0:
        return Row(what, grown, abs(root) ** (turn / arm.law.period), 0.01)
    return Limit(what, grown, 1.0)


def growth(made, arm, normal, turn):
    """Growth of the force's oscillation over whole periods, once the other modes have decayed."""
    made.run(2.0, arm.control)
    swings = []
    for _ in range(3):
        forces = []
        made.run(turn, arm.control, lambda m, forces=forces: forces.append(pressed(m, normal)))
        swings.append(max(forces) - min(forces))
    return float(np.sqrt(swings[2] / swings[0]))

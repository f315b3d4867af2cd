"""Outcomes of the arm and their predictions. Run by mechanisms/run.py."""

import itertools

import mujoco
import numpy as np
import rig
from contact import commanded, limits, margins, press, pressed, trips
from kit.arm import kinematics
from kit.arm import dimensions as d
from kit.rows import Limit, Row

# N and N·m on the tip, chosen so that every joint carries a share: about ±100 N·m each.
LOAD = np.linalg.lstsq(
    kinematics.jacobian(d.READY, *rig.BASE).T, 100.0 * np.array([1.0, -1.0, 1.0, 1.0, -1.0, 1.0, 1.0]), rcond=None
)[0]


def smooth(share):
    """Smooth step from 0 to 1 with continuous acceleration."""
    share = min(1.0, max(0.0, share))
    return share**3 * (10.0 - 15.0 * share + 6.0 * share**2)


def kinematic():
    """MuJoCo's tip and Jacobian compared with products of rotations; round trip of the inverse kinematics."""
    made, arm, _ = rig.machine()
    random = np.random.default_rng(1)
    tip, off, slope, back = made.model.body("tip").id, 0.0, 0.0, 0.0
    for _ in range(20):
        angles = random.uniform(-2.0, 2.0, 7)
        arm.pose(angles)
        _, _, place, attitude = kinematics.forward(angles, *rig.BASE)
        off = max(off, np.abs(made.place("tip") - place).max())
        off = max(off, np.abs(made.data.xmat[tip].reshape(3, 3) - attitude).max())
        linear, angular = np.zeros((3, made.model.nv)), np.zeros((3, made.model.nv))
        mujoco.mj_jacBody(made.model, made.data, linear, angular, tip)
        engine = np.vstack([linear, angular])[:, arm.dofs]
        slope = max(slope, np.abs(engine - kinematics.jacobian(angles, *rig.BASE)).max())
        back = max(back, comes_back(random))
    yield Limit("place and attitude of the tip against products of rotations, 20 postures", off, 1e-9, "m")
    yield Limit("its Jacobian", slope, 1e-9, "m")
    yield Limit("inverse kinematics: the tip it comes to, off the one that is wanted", back, 1e-8, "m")
    yield Row("length from tip to tip, stretched", stretched(), 17.6, 0.01, "m")


def comes_back(random):
    """Inverse kinematics from the ready posture to a pose up to a few metres away."""
    wanted = np.array(d.READY) + random.uniform(-0.3, 0.3, 7)
    _, _, place, attitude = kinematics.forward(wanted)
    found = kinematics.reach(d.READY, place, attitude)
    return np.inf if found is None else np.abs(kinematics.forward(found)[2] - place).max()


def stretched():
    """Booms in line, shoulder and wrist turned so that both end effectors point along them; the elbow stays offset."""
    quarter = np.pi / 2
    return max(
        d.END - float(kinematics.forward((0.0, a, b, np.pi, c, e, 0.0))[2][2])
        for a, b, c, e in itertools.product((-quarter, quarter), repeat=4)
    )


def stiffness():
    """Deflection of the tip under a load with all brakes on: J·K⁻¹·Jᵀ·w."""
    made, arm, _ = rig.machine(step=4e-3, gap=1.0)
    tip = made.model.body("tip").id
    place, attitude = made.place("tip"), made.data.xmat[tip].reshape(3, 3).copy()

    def control(m):
        arm.control(m)
        m.data.xfrc_applied[tip] = LOAD * smooth(m.time / 20.0)

    made.run(24.0, control)
    given = np.concatenate(
        [made.place("tip") - place, kinematics.turn_between(attitude, made.data.xmat[tip].reshape(3, 3))]
    )
    jacobian = kinematics.jacobian(d.READY, *rig.BASE)
    soft = 1.0 / np.array(d.GEAR_STIFFNESS) + 1.0 / d.BRAKE_STIFFNESS
    predicted = jacobian @ (soft * (jacobian.T @ LOAD))
    yield Row(
        "how far the loaded tip gives way, brakes on: |J K⁻¹ Jᵀ w|", length(given), length(predicted), 0.005, "m"
    )
    yield Row("how far it turns", turned(given), turned(predicted), 0.005, "rad")
    off = np.linalg.norm(given - predicted) / np.linalg.norm(predicted)
    yield Limit("all six components: what is off, of the whole", off, 0.005)


def length(six):
    return float(np.linalg.norm(six[:3]))


def turned(six):
    return float(np.linalg.norm(six[3:]))


def stall(joint=2):
    """One motor drives the ball into the pad until it stalls; the others are braked."""
    made, arm, normal = rig.machine(step=4e-3)
    rates = np.zeros(7)
    rates[joint] = -0.0015 * np.sign(normal @ arm.jacobian()[:3, joint])
    arm.command("joints", rates=rates, released=[joint])
    made.run(20.0, arm.control)
    found = []
    # The arm still swings on its gears, which have little damping: the mean over a few swings counts.
    made.run(20.0, arm.control, lambda m: found.append(pressed(m, normal)))
    links = arm.angles() + made.data.qpos[arm.places + 1]
    lever = abs(normal @ kinematics.jacobian(links, *rig.BASE)[:3, joint])
    what = "shoulder pitch stalls: force of the tip, τ/(J·n)"
    yield Row(what, float(np.mean(found)), d.TORQUE / lever, 0.005, "N")


def brakes():
    """A moment about the first joint's axis, below and above the slip torque."""
    made, arm, _ = rig.machine(step=4e-3, gap=1.0)
    tip, axis = made.model.body("tip").id, rig.BASE[1][:, 2]
    start = arm.angles().copy()

    def loaded(most):
        def control(m):
            arm.control(m)
            m.data.xfrc_applied[tip, 3:] = axis * most(m.time)

        return control

    hold = loaded(lambda t: 0.95 * d.BRAKE_TORQUE * (smooth(t / 20.0) - smooth((t - 30.0) / 20.0)))
    made.run(24.0, hold)
    before = arm.angles().copy()
    bent = before[0] - start[0]
    made.run(6.0, hold)
    yield Row(
        "a brake at 0.95 of its slip torque twists by τ/k",
        bent,
        0.95 * d.BRAKE_TORQUE / d.BRAKE_STIFFNESS,
        0.01,
        "rad",
    )
    yield Limit("and creeps in 6 s by at most", np.abs(arm.angles() - before).max(), 2e-6, "rad")
    made.run(24.0, hold)
    yield Limit("the load taken away, it is back to", np.abs(arm.angles() - start).max(), 2e-6, "rad")
    began = made.time
    made.run(24.0, loaded(lambda t: 1.05 * d.BRAKE_TORQUE * smooth((t - began) / 20.0)))
    yield Limit("at 1.05 of it, it slips by", arm.angles()[0] - start[0], 0.01, "rad", least=True)
    yield Limit("the other brakes hold within", np.abs(arm.angles() - start)[1:].max(), 3.5e-4, "rad")
    slipped, began = arm.angles()[0], made.time
    made.run(24.0, loaded(lambda t: 1.05 * d.BRAKE_TORQUE * (1.0 - smooth((t - began) / 20.0))))
    yield Limit("the load taken away, it does not come back but by", slipped - arm.angles()[0], 3.5e-4, "rad")


def rows(thorough):
    yield "kinematics", kinematic()
    yield "stiffness of the tip", stiffness()
    yield "stalled joint", stall()
    yield "brakes", brakes()
    yield "steady contact, level training", press(rig.TRAINING)
    yield "limits", limits()
    yield "trip", trips()
    yield "margin of contact", margins((2e4,) if not thorough else (5e3, 2e4, 1e5))
    if thorough:
        yield "steady contact, level analysis", press(rig.ANALYSIS)


DRAWN = ("base", "link_*", "tip")  # bodies that logs and films show beside what touches


def shown(prepare):
    """Run for logs and films: the arm presses on the pad, then with half the force, and retreats."""
    made, arm, normal = rig.machine(gap=0.25)
    prepare(made)
    commanded(arm, normal, 300.0)
    made.run(14.0, arm.control)
    commanded(arm, normal, 150.0)
    made.run(6.0, arm.control)
    commanded(arm, normal, rate=-0.1)
    made.run(4.0, arm.control)

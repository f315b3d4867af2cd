"""Push-off by standoffs, plungers and paddles after the release of the bolts: speeds from their energy.

The latches are stowed. Either the active half stands still and the module leaves, or two bare halves part in free flight.
"""

import math

import mujoco

import dimensions as d
import mechanism
import statics
from dimensions import common
from kit.machine import Machine
from kit.rules import honest
from kit.rows import Limit, Row

BOLTED_FOR = 0.2  # s
APART = 0.085  # m: nothing touches any more
BARE = mechanism.Load(common.RING_MASS, common.RING_INERTIA, (0.0, 0.0, 0.0))
STEP = 1e-4  # s, of the prediction


def predicted(mass):
    """Speed at which a mass leaves: one degree of freedom, springs and dampers of the parts, masses of the plungers."""
    z, v, moving = 0.0, 0.0, mass + 4 * d.PLUNGER_MASS
    while z < APART:
        v += STEP * (pushed(z, v) / moving)
        z += STEP * v
    return v


def pushed(z, v):
    """Force of all parts at a height and a speed, N; a part does not pull."""
    paddle, raised = statics.paddle(z), 0.0
    if paddle > 0.0:
        sine = (z + common.FITTING_BOTTOM - common.HINGE[2]) / common.PADDLE_LENGTH
        raised = d.PADDLE_HINGE_DAMPING * v / (common.PADDLE_LENGTH**2 * (1.0 - sine**2))
    standoff, plunger = statics.standoff(z), statics.plunger(z)
    parts = ((8, standoff, d.STANDOFF_DAMPING * v), (4, plunger, d.PLUNGER_SLIDE_DAMPING * v), (4, paddle, raised))
    return sum(count * max(0.0, force - lost) for count, force, lost in parts if force > 0.0)


def rig(level, load, station):
    scene = mechanism.Scene(level, load, mechanism.Start(gap=0.0), station)
    machine = Machine(mechanism.text(scene), mechanism.carried(scene).values())
    machine.model.opt.disableactuator = 1 << mechanism.arm.GROUP
    sunk = statics.plunger(0.0) / statics.PLUNGER - statics.plunger(0.0) / statics.TIP
    turned = math.radians(common.PADDLE_DEG) - math.asin(
        (common.FITTING_BOTTOM - common.HINGE[2]) / common.PADDLE_LENGTH
    )
    for i in range(4):
        for joint, value in ((f"plunger_{i}", sunk), (f"paddle_{i}", turned)):
            machine.data.qpos[machine.model.joint(joint).qposadr[0]] = value
    machine.data.eq_active[machine.model.equality("bolts").id] = 1
    machine.start()
    return machine


def speed(machine, joint):
    return float(machine.data.qvel[machine.model.joint(joint).dofadr[0] + 2])


def apart(machine):
    others = machine.place("station")[2] if 'name="station"' in machine.text else 0.0
    return machine.place("passive")[2] - others > APART


def part(machine):
    machine.run(BOLTED_FOR)
    machine.data.eq_active[machine.model.equality("bolts").id] = 0
    machine.run(10.0, watch=apart)


def module(level):
    load = mechanism.Load()
    machine = rig(level, load, None)
    part(machine)
    left = speed(machine, "module")
    yield Row(
        "module: ½·m·v² over what the springs held, ½·Σk·δ²",
        0.5 * load.mass * left**2 / statics.stored(0.0),
        1.0,
        0.05,
    )
    yield Row(
        "module: speed, with what dampers of plungers, paddles and standoffs take",
        left,
        predicted(load.mass),
        0.01,
        "m/s",
    )
    yield from honest(machine)


def bare(level, station):
    """Both halves of the mechanism alone; the active one with its linkages and indicators."""
    machine = rig(level, BARE, station)
    part(machine)
    away, back = speed(machine, "module"), speed(machine, "station")
    reduced = 1.0 / (1.0 / BARE.mass + 1.0 / station)
    yield Row(
        f"bare halves of {BARE.mass:g} and {station:g} kg: speed at which they part",
        away - back,
        predicted(reduced),
        0.02,
        "m/s",
    )
    yield Limit("momentum of all, of that of the passive half", abs(momentum(machine)) / (BARE.mass * away), 1e-6)


def momentum(machine):
    """Momentum along z of both halves with all their parts, N·s."""
    mujoco.mj_subtreeVel(machine.model, machine.data)
    bodies = [machine.model.body(name).id for name in ("station", "passive")]
    return sum(float(machine.model.body_subtreemass[i] * machine.data.subtree_linvel[i][2]) for i in bodies)


def rows(level, all_masses=False):
    yield from module(level)
    for station in d.ACTIVE_MASSES if all_masses else d.ACTIVE_MASSES[:1]:
        yield from bare(level, station)

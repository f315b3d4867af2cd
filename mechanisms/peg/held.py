"""The peg on the arm, without a wrist: with accommodation, or with a stiff arm."""

import numpy as np
import rig
import whitney
from dimensions import CHAMFER, FRICTION, HOLE, LENGTH, OFFSET, RADIUS, TILT
from kit import mjcf
from kit.arm import Arm, Law, body, kinematics
from kit.arm.dimensions import READY
from kit.machine import Machine
from kit.rules import honest
from kit.rows import Fact, Limit, Row

STEP = 2e-3  # s
RATE = 0.005  # m/s along the tool
# Chosen for a peg: it turns easily, about the end of the peg.
YIELDING = Law(admittance=1e-4, admittance_turn=5e-4, band=2.0, band_turn=0.3)
INSISTING = Law(admittance=0.0, admittance_turn=0.0, trip=100.0)
BOTTOM = 0.08  # m


def machine(law, step=STEP):
    """The tip of the peg is offset and tilted to the axis of the hole as on the feed."""
    _, _, place, attitude = kinematics.forward(READY)
    turned = attitude @ kinematics.rotation(np.array([0.0, 1.0, 0.0]), -TILT)
    tip = place - LENGTH * attitude[:, 2]
    hole = tip - turned @ np.array([OFFSET, 0.0, CHAMFER + 0.001])
    arm = body(payload=f'<body name="peg" pos="0 0 {-LENGTH:g}">{rig.shaft()}</body>')
    text = mjcf.model(
        "peg", rig.extension(), rig.hole(hole, kinematics.quaternion(turned)) + arm.world, arm.more, step
    )
    made = Machine(text, ["hole", "peg"])
    controller = Arm(made, law=law, point=(0.0, 0.0, -LENGTH))
    controller.pose(READY)
    return made, controller


def push(controller):
    """Commands motion along the tool."""
    attitude = kinematics.forward(READY)[3]
    controller.command("tip", rates=np.r_[-RATE * attitude[:, 2], 0, 0, 0])


def sunk(made):
    """Interference of the tilted peg, m: the sum of both contact depths."""
    depth, lean = -rig.height(made), rig.lean(made)
    return depth * np.sin(lean) + 2 * RADIUS * np.cos(lean) - 2 * HOLE


def inserted(step=STEP):
    """Accommodation about the end of the peg lets the hole turn it; without, its contacts are pressed into the walls."""
    made, controller = machine(YIELDING, step)
    push(controller)
    made.run(5.0, controller.control, lambda m: rig.height(m) < -0.01)
    greatest = []
    through = made.run(
        30.0, controller.control, lambda m: greatest.append(rig.resistance(m)) or rig.height(m) < -BOTTOM
    )
    yield Fact(f"the arm accommodates: through to {BOTTOM * 1e3:g} mm", through)
    yield Limit("greatest force of insertion below the first 10 mm", max(greatest), 40.0, "N")
    push_of_one = rig.resistance(made) / (2 * FRICTION)
    yield Row(
        "what leans over the width of the hole: what both places sink in",
        sunk(made),
        2 * push_of_one / whitney.SPRING,
        0.1,
        "m",
    )
    yield from honest(made)
    made, controller = machine(INSISTING, step)
    push(controller)
    made.run(20.0, controller.control, lambda m: rig.height(m) < -0.06)
    lean = rig.lean(made)
    yield Row("it does not: the peg keeps its lean, 60 mm deep", lean, TILT, 0.02, "rad")
    predicted = 0.5 * sunk(made) * whitney.SPRING * (2 * FRICTION + lean)
    yield Row(
        "force of insertion, 2μN and what the mouth's push leans, N from the springs",
        rig.resistance(made),
        predicted,
        0.02,
        "N",
    )
    made.run(10.0, controller.control, lambda m: controller.state.mode == "tripped")
    yield Fact(f"it trips at {INSISTING.trip:g} N before the bottom", controller.state.mode == "tripped")

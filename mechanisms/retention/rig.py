"""Bay with driven claws and keel jaws, and a truss on the arm, as MJCF."""

import dimensions as d
import numpy as np
from dimensions import model
from kit import mjcf
from kit.arm import body, kinematics
from kit.arm.dimensions import READY
from kit.machine import Machine

OBJECTS = {"bay": "../../models/payload_retention/bay.ron", "payload": "../../models/payload_retention/payload.ron"}
CLAWS = [f"claw_{name}" for name in model.LATCHES]
JAWS = {"port": -1, "starboard": 1}
STEEL, BLUE, GOLD = "0.55 0.57 0.6 1", "0.3 0.45 0.65 0.35", "0.75 0.6 0.3 1"


def claw(name):
    """Claw, with angle 0 when closed."""
    reach, heel = model.CLAW_REACH, model.CLAW_HEEL
    face = model.PIN_RADIUS - model.HINGE_Z - model.CLAW_BITE
    middle = (-(reach + heel) / 2, 0.0, face + model.CLAW_THICKNESS / 2)
    size = ((reach - heel) / 2, model.CLAW_HALF_WIDTH, model.CLAW_THICKNESS / 2)
    return (
        f'<body name="claw_{name}" pos="{mjcf.numbers(model.hinge(name))}"><joint name="claw_{name}" axis="0 1 0" '
        f'armature="{d.CLAW_ARMATURE}" limited="true" range="-0.1 {d.OPEN:.12g}"/><inertial pos="{mjcf.numbers(middle)}" '
        f'mass="{d.CLAW_MASS}" diaginertia="0.05 0.05 0.05"/><geom type="box" pos="{mjcf.numbers(middle)}" '
        f'size="{mjcf.numbers(size)}" rgba="{GOLD}"/></body>'
    )


def jaw(label, side):
    """Keel jaw, with position 0 when open, growing towards the pin."""
    return (
        f'<body name="keel_jaw_{label}" pos="{mjcf.numbers(model.keel_jaw(side))}"><joint name="keel_jaw_{label}" '
        f'type="slide" axis="0 {-side} 0" armature="{d.JAW_ARMATURE}" limited="true" range="0 {d.JAW_TRAVEL:.12g}" '
        f'solreflimit="0.005 1" solimplimit="0.99 0.999 1e-4"/>'
        f'<inertial pos="0 0 0" mass="{d.JAW_MASS}" diaginertia="0.2 0.2 0.2"/><geom type="box" '
        f'pos="0 {side * 0.015} -0.03" size="0.12 0.015 0.06" rgba="{GOLD}"/></body>'
    )


def truss(attitude):
    """Truss on the tip of the arm, its axes along those of the bay; the contact frame is at the seat of all pins."""
    middle = mjcf.numbers(model.MASS_CENTER)
    pins = "".join(
        f'<geom type="cylinder" fromto="{x} {side * (model.SILL_Y - 0.12)} 0 {x} {side * (model.SILL_Y + 0.12)} 0" '
        f'size="{model.PIN_RADIUS}" rgba="{STEEL}"/>'
        for x, side in model.LATCHES.values()
    )
    place = attitude.T @ -np.array(model.GRAPPLE)
    size = mjcf.numbers([s / 2 for s in d.TRUSS_SIZE])
    return (
        f'<body name="truss" pos="{mjcf.numbers(place)}" quat="{mjcf.numbers(mjcf.quaternion_of(attitude.T))}"><inertial '
        f'pos="{middle}" mass="{d.TRUSS_MASS}" diaginertia="{mjcf.numbers(d.TRUSS_INERTIA)}"/>'
        f'<geom type="box" pos="{middle}" size="{size}" rgba="{BLUE}"/>{pins}</body>'
    )


def carriers():
    """Bodies of the movable groups, in the order of the sensor."""
    return ["world", *CLAWS, *(f"keel_jaw_{label}" for label in JAWS), "truss"]


def carried():
    claws = {f"bay/{name}/claw": f"claw_{name}" for name in model.LATCHES}
    jaws = {f"bay/keel_jaw_{label}": f"keel_jaw_{label}" for label in JAWS}
    return {"bay": "world", **claws, **jaws, "payload": "truss"}


def machine(off=(0.0, 0.0, 0.0), step=d.TRAINING, friction=None):
    """The truss at an offset from its seat, held by the arm in its posture READY; claws and keel jaws open.

    `friction`: of all surfaces.
    """
    _, _, tip, attitude = kinematics.forward(READY)
    base = np.array(model.GRAPPLE) + off - tip
    arm = body(place=base, payload=truss(attitude))
    latches = "".join(claw(name) for name in model.LATCHES) + "".join(jaw(*entry) for entry in JAWS.items())
    motors = "".join(mjcf.motor(name, name, d.CLAW_STALL, d.CLAW_FREE_SPEED) for name in CLAWS)
    motors += "".join(
        mjcf.motor(f"keel_jaw_{label}", f"keel_jaw_{label}", d.JAW_STALL, d.JAW_FREE_SPEED) for label in JAWS
    )
    extension = mjcf.contact_instance(OBJECTS, [("bay", "payload")], carried(), folder=str(d.HERE), friction=friction)
    more = f"{arm.more}<actuator>{motors}</actuator>"
    made = Machine(mjcf.model("retention", extension, arm.world + latches, more, step), carriers())
    open_claws(made)
    made.start()
    return made


def open_claws(made, angle=d.OPEN):
    for name in CLAWS:
        made.data.qpos[made.model.joint(name).qposadr[0]] = angle


def drive(machine, name, voltage):
    machine.data.ctrl[machine.model.actuator(name).id] = voltage

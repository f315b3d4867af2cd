"""Carriage and pads: preload by the ball screw, and opening of the joint."""

import math

import models
from dimensions import PADS
from kit import mjcf
from kit.machine import Machine
from kit.rows import Limit, Row
from scene import screw, screw_force

RAISED = 0.5  # s in which a moment rises


def joint_rig(count, first=0.0):
    """A payload whose plate the stalled carriage pulls onto a ring of pads; its rod ends in a ball on the carriage."""
    motor, mass = screw("retract")
    world = (
        '<body name="carriage" pos="0 0 -0.1"><joint name="retract" type="slide" axis="0 0 -1" damping="200" '
        f'armature="{mass:.12g}"/><inertial pos="0 0 0" mass="20" diaginertia="0.2 0.2 0.2"/></body>'
        '<body name="payload" pos="0 0 0.002"><freejoint/><inertial pos="0 0 0" mass="200" diaginertia="60 60 60"/></body>'
    )
    more = (
        '<equality><connect body1="payload" body2="carriage" anchor="0 0 0" solref="0.002 1" solimp="0.999 0.9999 0.0001"/></equality>'
        f"<actuator>{motor}</actuator>"
    )
    things = {"pads": "text1", "plate": "text2"}
    extension = mjcf.contact_instance(
        things,
        [("pads", "plate")],
        {"pads": "world", "plate": "payload"},
        [models.pads(count, first, 0.0, 0.0).text(), models.plate(0.0).text()],
    )
    return Machine(mjcf.model("preload", extension, world, more, 2e-4, "RK4"), ["world", "payload"])


def opening_moment(machine, count, direction, predicted):
    """Moment across the axis, raised slowly near the prediction, at which fewer than `count` pads touch, N·m."""
    payload = machine.model.body("payload").id
    start, most, below = machine.time, 0.0, 0.9 * predicted

    def control(m):
        nonlocal most
        passed = m.time - start
        smooth = 0.5 * (1.0 - math.cos(math.pi * min(1.0, passed / RAISED)))
        most = below * smooth + 0.2 * predicted * max(0.0, passed - 1.5 * RAISED)
        m.data.xfrc_applied[payload, 3:] = (most * math.cos(direction), most * math.sin(direction), 0.0)
        m.data.ctrl[m.model.actuator("screw").id] = 1.0

    machine.run(1.5 * RAISED + 1.0, control, watch=lambda m: m.contacts() < count)
    return most


def press(machine):
    def control(m):
        m.data.ctrl[m.model.actuator("screw").id] = 1.0

    machine.run(0.6, control)


def rows():
    for count in (8, 24):
        machine = joint_rig(count)
        press(machine)
        force = -machine.wrench("world")[2]
        if count == 8:
            yield Row("preload is the stall torque·2πη/lead", force, screw_force(), 2e-3, "N")
        moment = opening_moment(machine, count, 0.0, screw_force() * PADS.circle / 2)
        yield Row(f"a ring of {count} pads opens at M = P·r/2", moment, screw_force() * PADS.circle / 2, 0.005, "N m")
    # Three pads: a moment that unloads one of them lifts it at P·r/2; rotated by half a turn it unloads two, at P·r.
    for direction, predicted in ((math.pi / 2, 1.0), (-math.pi / 2, 0.5)):
        machine = joint_rig(3)
        press(machine)
        moment = opening_moment(machine, 3, direction, predicted * screw_force() * PADS.circle)
        yield Row(
            f"three pads open at M = {predicted:g}·P·r", moment, predicted * screw_force() * PADS.circle, 0.005, "N m"
        )
    yield Limit("forces that have no reaction, of the greatest", machine.imbalance, 1e-12)

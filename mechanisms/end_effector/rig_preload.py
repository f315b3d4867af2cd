"""Carriage, pads and teeth: what the ball screw presses, when the joint opens, what the teeth carry."""

import math

from kit import mjcf, ron
from kit.machine import Machine
from kit.rows import Limit, Row

# The carriage's motor and screw. Chosen; real numbers are not public.
STALL_TORQUE = 4.8  # of the carriage motor at the screw, N·m
SCREW_LEAD = 4.0e-3  # m a turn
EFFICIENCY = 0.85
MOTOR_FREE_SPEED = 80.0  # rad/s at the screw
ROTOR_INERTIA = 2e-4  # kg·m² at the screw
PAD_CIRCLE = 0.150  # radius on which the pads lie, m
PAD_RADIUS = 0.010
PAD_STIFFNESS = 4e6  # of one pad, N/m
PAD_DAMPING = 2e4  # N·s/m
RAISED = 0.5  # s in which a moment rises


def preload():
    """Axial force of a stalled carriage, N."""
    return STALL_TORQUE * 2.0 * math.pi * EFFICIENCY / SCREW_LEAD


def screw(joint):
    """The motor through the screw, and the rotor's inertia as it is felt along the slide (kg)."""
    ratio = 2.0 * math.pi / SCREW_LEAD
    return mjcf.motor("screw", joint, preload(), MOTOR_FREE_SPEED / ratio), ROTOR_INERTIA * ratio**2


def around(count, radius, first=0.0):
    """Places on a circle about z."""
    angles = [first + 2.0 * math.pi * i / count for i in range(count)]
    return [(radius * math.cos(a), radius * math.sin(a)) for a in angles]


def pads(count, first=0.0, height=0.0, friction=0.0):
    """Balls whose tops are at `height`."""
    balls = [
        ron.primitive("Sphere", f"pad_{i:02}", center=(x, y, height - PAD_RADIUS), radius=PAD_RADIUS)
        for i, (x, y) in enumerate(around(count, PAD_CIRCLE, first))
    ]
    return ron.model("pads", ron.elastic(PAD_STIFFNESS, PAD_DAMPING, friction), balls)


def plate(friction=0.0):
    """All that lies above z = 0 of the payload."""
    face = ron.primitive("Plane", "face", normal=(0, 0, -1), offset=0)
    return ron.model("plate", ron.rigid(friction), [face])


def joint_rig(count, first=0.0):
    """A payload whose plate the stalled carriage pulls on a ring of pads; its rod ends in a ball on the carriage."""
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
        things, [("pads", "plate")], {"pads": "world", "plate": "payload"}, [pads(count, first), plate()]
    )
    return Machine(mjcf.model("preload", extension, world, more, 2e-4, "RK4"), ["world", "payload"])


def opening_moment(machine, count, direction, predicted):
    """A moment across the axis is raised, slowly near the prediction, until fewer than `count` pads touch, N·m."""
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
            yield Row("preload is the stall torque·2πη/lead", force, preload(), 2e-3, "N")
        moment = opening_moment(machine, count, 0.0, preload() * PAD_CIRCLE / 2)
        yield Row(f"a ring of {count} pads opens at M = P·r/2", moment, preload() * PAD_CIRCLE / 2, 0.005, "N m")
    # Three pads: the moment that unloads one of them lifts it at P·r/2; turned half round it unloads two, at P·r.
    for direction, predicted in ((math.pi / 2, 1.0), (-math.pi / 2, 0.5)):
        machine = joint_rig(3)
        press(machine)
        moment = opening_moment(machine, 3, direction, predicted * preload() * PAD_CIRCLE)
        yield Row(
            f"three pads open at M = {predicted:g}·P·r", moment, predicted * preload() * PAD_CIRCLE, 0.005, "N m"
        )
    yield Limit("forces that have no reaction, of the greatest", machine.imbalance, 1e-12)

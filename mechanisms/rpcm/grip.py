"""The cone in the jaws of the gripper: self-locking or slipping; forces that pull it out and drive it in."""

import dimensions as d
import numpy as np
import rig
import statics
from kit import mjcf
from kit.machine import Machine

SPEED = 5e-4  # m/s: of a cone that is pulled or pushed through stalled jaws
RISE = 0.2  # s in which the motors come
SLIPPED = 2e-3  # m
STEEL = "0.55 0.57 0.6 1"


def jaw(name, side, at):
    """Jaw on a slide towards the cone; its position is 0 where it just touches a cone with its base at `at`."""
    beyond = side * (d.CONE_RADIUS + 0.012)
    drawn = rig.geom("box", (-d.CONE_LENGTH / 2, beyond, 0), (d.CONE_LENGTH / 2, 0.012, 0.012), STEEL)
    return (
        f'<body name="jaw_{name}" pos="{mjcf.numbers(at)}"><joint name="jaw_{name}" type="slide" axis="0 {-side} 0" '
        f'armature="{d.JAW_ARMATURE}" limited="true" range="{-d.JAW_OPEN} {d.CONE_RADIUS}"/>'
        f'<inertial pos="0 0 0" mass="{d.JAW_MASS}" diaginertia="1e-4 1e-4 1e-4"/>{drawn}</body>'
    )


def jaws(at):
    return "".join(jaw(name, side, at) for name, side in d.SIDES.items())


def motors():
    return "".join(mjcf.motor(f"jaw_{name}", f"jaw_{name}", d.JAW_STALL, d.JAW_SPEED) for name in d.SIDES)


def cone_body():
    """Carrier of the cone, fixed to the box."""
    return f'<body name="cone" pos="{mjcf.numbers(rig.root())}"/>'


def carried(trial, tool="world"):
    """Groups of cone and jaws, and their carrier bodies."""
    fingers = {f"jaws/jaw_{name}": f"jaw_{name}" for name in d.SIDES}
    return {"cone": "cone", "jaws": tool, **fingers}, {"cone": f"cone_{trial}.ron", "jaws": f"jaws_{trial}.ron"}


def machine(trial, joint=rig.FREE, step=d.ANALYSIS.step):
    """A box, free or on a slide along x, with its cone between grounded jaws, which just touch it."""
    groups, objects = carried(trial)
    extension = mjcf.contact_instance(objects, [("cone", "jaws")], groups, folder=str(d.HERE))
    world = rig.body((0, 0, 0), inside=cone_body(), slope=d.half_angle(trial), joint=joint) + jaws(rig.root())
    made = Machine(
        mjcf.model("rpcm_grip", extension, world, f"<actuator>{motors()}</actuator>", step), list(groups.values())
    )
    return made


def close(made, voltage=1.0):
    for name in d.SIDES:
        made.data.ctrl[made.model.actuator(f"jaw_{name}").id] = voltage * min(1.0, made.time / RISE)


def slips(trial, seconds=0.7):
    """Release of an otherwise free cone: whether it leaves the jaws, its displacement, m, and the machine."""
    made = machine(trial)
    slipped = made.run(seconds, close, watch=lambda m: m.place("box")[0] > SLIPPED)
    return slipped, made.place("box")[0], made


def drawn_through(way, step=d.ANALYSIS.step):
    """Force along `way` (1 out, −1 in) that moves the nominal cone steadily through stalled jaws, N; and the machine."""
    made = machine("nominal", rig.ALONG, step)
    box = made.model.body("box").id
    begun = 1.5 * RISE

    def control(m):
        close(m)
        goal = way * SPEED * max(0.0, m.time - begun)
        rate = way * SPEED * (m.time > begun)
        made.data.xfrc_applied[box, 0] = 1e6 * (goal - m.place("box")[0]) + 2e3 * (rate - made.speed("along"))

    made.run(1.0, control)
    return way * made.data.xfrc_applied[box, 0], made


def predicted(way):
    """A moving motor loses force with its speed, and pushes harder if driven back; the stall law holds at standstill."""
    slope = d.HALF_ANGLE
    closing = way * SPEED * np.tan(slope) / d.JAW_SPEED
    return (statics.pull_out if way > 0 else statics.push_in)(slope) * (1 - closing)

"""The whole sequence: a gripper on the arm takes the box by its cone, inserts it, pulls it out, releases it and retreats.

Phases: *close*, *in*, *press*, *out*, *halt*, *open*, *away*, *done*. The gripper comes aside of the cone and turned.
"""

import math

import dimensions as d
import grip
import jam
import rig
import statics
from kit import mjcf
from kit.machine import Machine
from kit.restart import same_bits

BEGIN = d.STOP - d.LENGTH / 2 - 0.060  # where the box begins
REST = d.STOP - d.LENGTH / 2
ASIDE, TURNED = 0.002, 0.005  # of the gripper from the cone: m to the left, rad
LAST = {"close": 0.8, "in": 8.0, "press": 0.5, "out": 8.0, "halt": 0.5, "open": 0.6, "away": 1.0}  # s, at most
WAYS = {"in": 1.0, "press": 1.0, "out": -1.0, "away": -1.0}


def tool():
    """The gripper: its origin is the target of the cone's base. One linkage moves both jaws."""
    turned = mjcf.numbers(mjcf.quaternion_about_z(TURNED))
    place = rig.root() + (BEGIN, ASIDE, 0.0)
    inertia = mjcf.numbers((0.05, 0.05, 0.05))
    palm = rig.geom("box", (-d.CONE_LENGTH - 0.03, 0, 0), (0.01, 0.05, 0.02), grip.STEEL)
    return (
        f'<body name="tool" pos="{mjcf.numbers(place)}" quat="{turned}"><freejoint/>'
        f'<inertial pos="0 0 0" mass="{d.TOOL_MASS:g}" diaginertia="{inertia}"/>{palm}{grip.jaws((0, 0, 0))}</body>'
    )


def machine(step=d.TRAINING.step):
    groups, objects = grip.carried("nominal", "tool")
    pairs = [("cone", "jaws"), ("rails", "box"), ("socket", "plug")]
    objects |= {"rails": "rails.ron", "box": "box.ron", "socket": "socket.ron", "plug": "plug.ron"}
    groups |= {"rails": "world", "box": "box", "socket": "world", "plug": "box"}
    extension = mjcf.contact_instance(objects, pairs, groups, folder=str(d.HERE))
    world = rig.drawn_rails() + rig.body((BEGIN, 0, 0), inside=grip.cone_body()) + tool()
    linkage = '<equality><joint joint1="jaw_left" joint2="jaw_right" solref="0.004 1"/></equality>'
    more = f"<actuator>{grip.motors()}</actuator>{linkage}"
    made = Machine(mjcf.model("rpcm_exchange", extension, world, more, step), list(groups.values()), list(groups))
    for name in d.SIDES:
        made.data.qpos[made.model.joint(f"jaw_{name}").qposadr[0]] = -0.5 * d.JAW_OPEN
    made.start()
    return made


class Sequencer:
    """Sequencer with its state in its attributes, so `copy.deepcopy` saves it beside the state of the machine.

    `voltage`: of closing motors, of the greatest.
    """

    def __init__(self, voltage=1.0):
        self.voltage = voltage
        self.phase, self.since, self.stop, self.slipped = "close", 0.0, 0.0, 0.0
        self.arm = jam.Wrist((0.0, 0.0, 0.0), TURNED, "tool")
        self.gripped = None

    def __call__(self, made):
        if self.phase != "done" and self._finished(made):
            self._leave(made)
        self.arm.way = WAYS.get(self.phase, 0.0)
        self.arm(made)
        for name in d.SIDES:
            closed = self.phase not in ("open", "away", "done")
            stopped = made.joint(f"jaw_{name}") < -0.5 * d.JAW_OPEN
            made.data.ctrl[made.model.actuator(f"jaw_{name}").id] = (
                self.voltage if closed else 0.0 if stopped else -1.0
            )
        if self.gripped is not None and self.phase in ("in", "press", "out"):
            self.slipped = max(self.slipped, abs(along(made) - self.gripped))

    def _leave(self, made):
        if self.phase == "close":
            self.gripped = along(made)
        if self.phase == "press":
            self.stop = float(made.on("rails")[0])
        phases = [*LAST, "done"]
        self.phase, self.since = phases[phases.index(self.phase) + 1], made.time

    def _finished(self, made):
        x = made.place("box")[0]
        there = (self.phase == "in" and x > REST - 1e-5) or (self.phase == "out" and x < BEGIN)
        return there or made.time - self.since > LAST[self.phase]


def along(made):
    """Position of the box relative to the gripper along the rails, m."""
    return float(made.place("box")[0] - made.place("tool")[0])


def run(step=d.TRAINING.step, voltage=1.0, until="done"):
    """Runs to the beginning of a phase; returns the machine and the sequencer."""
    made, sequencer = machine(step), Sequencer(voltage)
    while sequencer.phase != until:
        made.advance(sequencer)
    return made, sequencer


def driven_in(voltage):
    """Force on the stop when the push overcomes weak jaws: the cone enters them at the speed of the arm, N."""
    opening = d.SPEED * math.tan(d.HALF_ANGLE) / d.JAW_SPEED
    return statics.push_in(d.HALF_ANGLE) * (voltage + opening) - statics.spring()


def same_bits_after_restart(before=2.0, after=0.5):
    return same_bits(machine, Sequencer(), before, after)

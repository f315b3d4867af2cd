"""The whole sequence: the arm pushes the pallet in and onto the stops, hooks tie it down and release it, the arm pulls.

Phases: *in*, *press* (the arm comes into line), *tie*, *held* (the arm gives way), *untie*, *out*, *done*.
"""

from dataclasses import dataclass

import arm
import dimensions as d
import numpy as np
import rig
from dimensions import TRAINING, Level, model
from kit.restart import same_bits

OVERTRAVEL = 0.040  # of the tip beyond the seated pallet, m
SPEED = 0.030  # m/s
RISE = 1.0  # s to this speed
WEAK = 400.0  # N: an arm that pulls with less than one hook
LIMITS = {"press": 4.0, "tie": 6.0, "held": 2.0, "untie": 4.0}  # s, at most
LASTING = 0.4  # s for which hooks stand before they count as stalled
STALLED = 2e-4  # rad/s


@dataclass(frozen=True)
class Case:
    """A pallet from `start` to the stops and back. `offset`, `yaw`: misalignment of the arm to the rails."""

    level: Level = TRAINING
    start: float = model.SEATED_X - 0.150
    offset: tuple = (0.010, 0.005)  # m
    yaw: float = -0.005  # rad
    stuck: bool = False  # the motor of the left hook goes on closing, and the arm is weak
    step: float | None = None


class Sequencer:
    """Sequencer with its state in its attributes, so `copy.deepcopy` saves it beside the state of the machine."""

    PHASES = ("in", "press", "tie", "held", "untie", "out", "done")
    HOOKS = {"tie": 1.0, "held": 1.0, "untie": -1.0}

    def __init__(self, case):
        self.case, self.arm = case, arm.Drive(most=WEAK if case.stuck else d.ARM_FORCE)
        self.phase, self.since, self.calm = "in", 0.0, 0.0
        self.x, self.rate = case.start, 0.0  # where the tip leads the pallet
        self.stops, self.ends = {}, {}

    def __call__(self, machine):
        if self.phase != "done" and self._finished(machine):
            self.stops[self.phase], self.ends[self.phase] = rig.stops(machine), machine.time
            self.phase = self.PHASES[self.PHASES.index(self.phase) + 1]
            self.since = self.calm = machine.time
            if self.phase == "held":
                self.x = machine.place("pallet")[0]
        self._hooks(machine)
        self._lead(machine)
        machine.data.xfrc_applied[machine.model.body("pallet").id] = 0.0
        self.arm(machine)

    def _hooks(self, machine):
        for name in rig.HOOKS:
            opened = machine.joint(name) < d.HOOK_OPEN + 0.05
            voltage = self.HOOKS.get(self.phase, 0.0)
            if self.case.stuck and name == "hook_left" and "held" in self.ends:
                voltage = 1.0
            machine.data.ctrl[machine.model.actuator(name).id] = 0.0 if opened and voltage < 0.0 else voltage

    def _lead(self, machine):
        way = {"in": 1.0, "out": -1.0}.get(self.phase, 0.0)
        risen = min(1.0, (machine.time - self.since) / RISE)
        self.rate = way * SPEED * risen
        self.x += self.rate * machine.step
        aside = 1.0 if self.phase == "in" else 0.0
        if self.phase == "press":
            aside = max(0.0, 1.0 - (machine.time - self.since) / 2.0)
        y, z = (aside * o for o in self.case.offset)
        self.arm.yaw = aside * self.case.yaw
        self.arm.lead((self.x + d.FIXTURE[0], y, z), (self.rate, 0.0, 0.0))

    def _finished(self, machine):
        if self.phase == "in":
            return self.x >= model.SEATED_X + OVERTRAVEL
        if self.phase == "out":
            return self.x <= self.case.start
        if max(abs(machine.speed(name)) for name in rig.HOOKS) > STALLED:
            self.calm = machine.time
        stalled = self.phase == "tie" and machine.time - self.calm > LASTING
        return stalled or machine.time - self.since >= LIMITS[self.phase]


def machine(case):
    return rig.machine(case.start, case.level, step=case.step)


def run(case, prepare=None):
    """Runs the case; `prepare(machine)` is called at the start. Returns the machine, the sequencer, and the largest
    force of the arm."""
    made, sequencer = machine(case), Sequencer(case)
    if prepare is not None:
        prepare(made)
    most = dict.fromkeys(Sequencer.PHASES, 0.0)
    while sequencer.phase != "done":
        made.advance(sequencer)
        most[sequencer.phase] = max(most[sequencer.phase], float(np.linalg.norm(sequencer.arm.force)))
    made.run(1.0, sequencer)
    return made, sequencer, most


def pressed():
    """Arm and two bumpers as springs in series, N."""
    bumpers = 2.0 / (1.0 / model.BUMPER_STIFFNESS + 1.0 / model.STEEL_STIFFNESS)
    return OVERTRAVEL / (1.0 / d.ARM_STIFFNESS[0] + 1.0 / bumpers)


def tied():
    """Force of both hooks with stalled motors, N."""
    return 2.0 * d.HOOK_STALL / d.LEVER


def same_bits_after_restart(case, before, after):
    return same_bits(lambda: machine(case), Sequencer(case), before, after)

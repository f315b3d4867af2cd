"""A berthing: the machine, the sequencer that drives it, and what fails."""

import copy
import pathlib
import re
from dataclasses import dataclass, field

import numpy as np

import arm
import linkage
import mechanism
import sequencer as seq
from dimensions import TRAINING, Level
from kit.machine import Machine

LATCHES = range(seq.LATCHES)


@dataclass(frozen=True)
class Case:
    """Approach of the module, and failures."""

    level: Level = TRAINING
    offset: tuple = (0.020, -0.015)  # of the passive ring, m
    turn: tuple = (-0.006, 0.008, 0.012)  # rotation vector, rad: yaw -0.34, pitch 0.46, roll 0.69 degrees
    gap: float = mechanism.d.START_GAP
    load: mechanism.Load = field(default_factory=mechanism.Load)
    dead_indicator: int | None = None  # gives no signal
    stalled: tuple = ()  # (latch, angle of its crank from which its motor has no power)
    unberth: bool = False
    folder: pathlib.Path = mechanism.HERE  # of the contact models


class Berthing(Machine):
    def __init__(self, case):
        start = mechanism.Start(case.offset, case.turn, case.gap, mechanism.d.APPROACH_SPEED)
        self.case, self.sequencer = case, seq.Sequencer(case.unberth, case.gap)
        scene = mechanism.Scene(case.level, case.load, start)
        super().__init__(mechanism.text(scene, case.folder), mechanism.carried(scene).values())
        self.cranks = [self.model.joint(f"crank_{i}") for i in LATCHES]
        self.data.qvel[self.model.joint("module").dofadr[0] + 2] = -start.speed
        self.off_loop, self.moved_early = 0.0, 0.0
        self.start()

    def told(self):
        """Sensor values for the sequencer; a dead indicator reports nothing."""
        dead = self.case.dead_indicator
        stroke = [0.0 if i == dead else self.joint(f"plunger_{i}") for i in LATCHES]
        turn = [0.0 if i == dead else self.joint(f"paddle_{i}") for i in LATCHES]
        crank, speed = [self.joint(f"crank_{i}") for i in LATCHES], [self.speed(f"crank_{i}") for i in LATCHES]
        return seq.Sensed(self.time, stroke, turn, crank, speed)

    def control(self, _=None):
        sensed = self.told()
        commands = self.sequencer.step(sensed)
        voltage = list(commands.voltage)
        if self.case.stalled and sensed.crank[self.case.stalled[0]] >= self.case.stalled[1]:
            voltage[self.case.stalled[0]] = 0.0
        self.data.ctrl[:4] = voltage
        self.data.ctrl[4:] = arm.command(self.case.offset, self.case.turn, commands.gap)
        self.model.opt.disableactuator = 0 if commands.arm_on else 1 << arm.GROUP
        self.data.eq_active[self.model.equality("bolts").id] = commands.bolts
        self._watch(sensed)

    def _watch(self, sensed):
        """Checks that the loops stay closed and no latch moves too early."""
        followers = [self.joint(f"follower_{i}") for i in LATCHES]
        self.off_loop = max(self.off_loop, *(abs(linkage.freudenstein(*p)) for p in zip(sensed.crank, followers)))
        if self.sequencer.phase == seq.APPROACH:
            moved = max(abs(crank - mechanism.d.STOWED) for crank in sensed.crank)
            self.moved_early = max(self.moved_early, moved)

    def until(self, phase, seconds=60.0):
        """Runs until a phase has begun; returns whether it has."""
        return self.run(seconds, self.control, lambda m: m.sequencer.phase >= phase)

    def phase(self):
        return seq.PHASES[self.sequencer.phase]

    def gap(self):
        return float(self.place("passive")[2])

    def tilt(self):
        """Rotation vector of the module, rad, for small angles."""
        w, *v = self.data.qpos[self.model.joint("module").qposadr[0] + 3 :][:4]
        return 2.0 * np.array(v) * np.sign(w)


def same_bits_after_restart(case, before, after):
    """Runs for `before` s, then for `after` s, repeats the latter in another machine, and compares the bits of both ends."""
    first = Berthing(case)
    first.run(before, first.control)
    middle, sequencer = first.save(), copy.deepcopy(first.sequencer)
    first.run(after, first.control)
    second = Berthing(case)
    second.restore(middle)
    second.sequencer = sequencer
    second.run(after, second.control)
    return first.save().tobytes() == second.save().tobytes()


def without_friction(root):
    """Copies the contact models below a folder, with μ = 0 everywhere; returns the folder that replaces ours."""
    for folder in (mechanism.HERE, mechanism.d.COMMON):
        copied = root / folder.relative_to(mechanism.HERE.parent.parent)
        copied.mkdir(parents=True)
        for model in folder.glob("*.ron"):
            (copied / model.name).write_text(re.sub(r"mu: [0-9.]+", "mu: 0.0", model.read_text(encoding="utf-8")))
    return root / mechanism.HERE.relative_to(mechanism.HERE.parent.parent)

"""Lowering of the truss into its guides by the arm; keel jaws centre it, claws pull it down."""

import copy

import dimensions as d
import numpy as np
import rig
from dimensions import model
from kit.arm import Arm, Law
from kit.arm.dimensions import READY

OFF = (0.020, 0.0, 0.050)  # m from the seat: aft, and above
SEATED = (0.0, 0.0, 0.0)
LOWER = np.array((0.0, 0.0, -0.005, 0.0, 0.0, 0.0))  # m/s
PRESS = np.array((0.0, 0.0, -300.0, 0.0, 0.0, 0.0))  # N
YIELDING = Law(trip=20e3)
TIMES = {"lower": 18.0, "keel": 22.0, "claws": 31.0}  # s at which each phase ends


class Berthing:
    """The machine, its arm and the sequence. `dead`: a claw without motor power. `begin`: the first phase; from another
    than `lower` the truss is in its seat at first.
    """

    def __init__(self, step=d.TRAINING, dead=None, begin="lower"):
        phases = list(TIMES)
        self.ahead = 0.0 if begin == "lower" else TIMES[phases[phases.index(begin) - 1]]  # s of the sequence left out
        self.machine = rig.machine(OFF if begin == "lower" else SEATED, step)
        self.dead, self.phase = dead, None
        self.arm = Arm(self.machine, law=YIELDING)
        self.arm.pose(READY)

    def control(self, machine):
        time = machine.time + self.ahead
        phase = next((name for name, end in TIMES.items() if time < end - 1e-9), "held")
        if phase != self.phase:
            self.phase = phase
            self.arm.command("tip", LOWER if phase == "lower" else None, PRESS if phase == "lower" else None)
        for label in rig.JAWS:
            rig.drive(machine, f"keel_jaw_{label}", 0.0 if phase == "lower" else 1.0)
        for name in rig.CLAWS:
            closing = phase in ("claws", "held") and name != self.dead
            rig.drive(machine, name, -1.0 if closing else 0.0)
        self.arm.control(machine)

    def run(self, seconds=TIMES["claws"]):
        self.machine.run(seconds, self.control)

    def held(self):
        """Force of each claw on its pin, N, by name of the latch."""
        return {name: float(self.machine.wrench(f"claw_{name}")[2]) for name in model.LATCHES}

    def save(self):
        return self.machine.save(), self.arm.save(), self.phase

    def restore(self, saved):
        self.machine.restore(saved[0])
        self.arm.restore(saved[1])
        self.phase = saved[2]


def preload(x):
    """Force of a claw with a stalled motor: torque over the lever about the hinge of a pin at x in its socket, N."""
    return d.CLAW_STALL / (model.HINGE_X - x)


def same_bits_after_restart(before, after):
    """Runs for `before` s, then for `after` s, repeats the latter in another machine, and compares the bits of both ends."""
    first = Berthing()
    first.run(before)
    saved = copy.deepcopy(first.save())
    first.run(after)
    second = Berthing()
    second.restore(saved)
    second.run(after)
    return first.machine.save().tobytes() == second.machine.save().tobytes()

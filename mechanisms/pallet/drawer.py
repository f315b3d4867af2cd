"""The law of a drawer: a push beside the drag turns the pallet in its rails, and the rails rub.

With all side rollers seized, two of them, a base L apart, hold it with N = F·e/L each: F = D + 2·μ·N, so that
F = D/(1 − 2·μ·e/L). Nothing moves it from e = L/(2·μ) on.
"""

import arm
import dimensions as d
import numpy as np
import rig
from dimensions import model

from kit.machine import Machine

DRAG = 200.0  # N, in the middle of the pallet
SHORT = 0.600  # m: base of the rollers with which a push within the pallet's width jams
LONG = 2 * model.SIDE_ROLLER_X
SPEED = 0.020  # m/s
RISE = 0.5  # s in which the drag comes
STRUT = (2e5, 4e4)  # N/m and N·s/m along the way in
STRUT_TURNING = 1e4  # N·m·s/rad: its wrist gives way, damped
STARTED = 3e-4  # m: a pallet that went so far is free
BEFORE_STOPS = {SHORT: 0.350, LONG: 0.150}  # m from the stops where it begins: all wheels are in the rails


class Push:
    """A tip that moves inwards at a constant speed and pushes at (FIXTURE x, e); it holds nothing else until commanded."""

    def __init__(self, offset, base, most):
        along = (STRUT[0], 0.0, 0.0), (STRUT[1], 10.0, 10.0)
        self.arm = arm.Drive((d.FIXTURE[0], offset, 0.0), most, *along, STRUT_TURNING, limp=True)
        self.start = model.SEATED_X - BEFORE_STOPS[base] + d.FIXTURE[0]

    def __call__(self, machine):
        body = machine.model.body("pallet").id
        machine.data.xfrc_applied[body] = 0.0
        machine.data.xfrc_applied[body, 0] = -DRAG * min(1.0, machine.time / RISE)
        self.arm.lead((self.start + SPEED * machine.time, 0.0, 0.0), (SPEED, 0.0, 0.0))
        self.arm(machine)

    def lever(self, machine):
        """Lever of the push about the drag, including the moment of the wrist, m."""
        return self.arm.at(machine)[2][1] - self.arm.moment[2] / self.arm.force[0]


def machine(base, level, step=None, kind=Machine):
    return rig.machine(model.SEATED_X - BEFORE_STOPS[base], level, base, seized=True, step=step, kind=kind)


def share(made, push):
    """2·μ·e/L with the present lever and base: a rotated pallet has its rollers nearer to each other."""
    front, rear = made.place("roller_front_right"), made.place("roller_rear_left")
    return 2.0 * model.FRICTION * push.lever(made) / (front[0] - rear[0])


def steady(offset, base, level, step=None, seconds=5.5, kind=Machine):
    """Push, and prediction of the law for lever and base, in steady sliding; and the machine."""
    made, push = machine(base, level, step, kind), Push(offset, base, 1e6)
    made.run(seconds - 0.5, push)
    seen = []
    made.run(0.5, push, watch=lambda m: seen.append((push.arm.force[0], share(m, push))))
    pushed, shared = np.mean(seen, axis=0)
    return pushed, DRAG / (1.0 - shared), made


def jammed(offset, base, most, level, step=None, kind=Machine):
    """A pallet that a push does not move: machine, push, and its displacement in the last second, m."""
    made, push = machine(base, level, step, kind), Push(offset, base, most)
    made.run(3.5, push)
    before = made.place("pallet")[0]
    made.run(1.0, push)
    return made, push, abs(made.place("pallet")[0] - before)


def accommodate(made, push, seconds=10.0):
    """2·μ·e/L at which the pallet begins to move, as the wrist yields to the moment about the middle of the rollers."""
    push.arm.follow(made)
    push.arm.accommodating = True
    seen, stood = [], made.place("pallet")[0]

    def watch(m):
        seen.append(share(m, push))
        return m.place("pallet")[0] - stood > STARTED

    return made.run(seconds, push, watch), seen[-1]

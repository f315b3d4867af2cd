"""The sequencer of a docking: capture, attenuate, align, retract, hook, hold; unhook, unlatch, push off."""

import dimensions as d
import numpy as np
import stewart
from dimensions import IDSS
from vehicles import LATCHES

STRIKER_EDGE = IDSS.RIM_RADIUS + IDSS.STRIKER_RECESS - IDSS.STRIKER_BACK  # inner edge of its back face, from the axis
BEHIND, BACK_IN_PLACE = (
    0.002,
    0.001,
)  # m: by which a catch must reach over its striker; how near it is to where it rests
PHASES = (
    "capture",
    "attenuate",
    "align",
    "retract",
    "slow",
    "hook",
    "hold",
    "unhook",
    "unlatch",
    "away",
    "done",
    "abort",
)
TIMES = {
    "attenuate": 4.0,
    "align": 6.0,
    "retract": d.RETRACT_TIME,
    "slow": d.SLOW_TIME,
    "hook": 3.5,
    "hold": 0.5,
    "unhook": 3.5,
    "unlatch": 0.4,
    "away": 2.6,
}
# A motor that is driven back gives its stall torque and damps nothing, so hooks swing for seconds after a heavy vehicle
# has met its pads. They hold their preload when all of them have stood for a while.
HOOKS_STAND, HOOKS_STAND_FOR, HOOK_MOST = 5e-4, 0.2, 12.0  # rad/s; s; s after which the sequence goes on all the same
HOOK_VOLTAGE = {"hook": 1.0, "hold": 1.0, "unhook": -0.5}
RELEASED = ("unlatch", "away", "done", "abort")


def catch(made, i):
    """Tip of a latch in the frame of the target's port."""
    target, latch = made.data.body("target"), made.data.body(f"latch_{i}")
    return target.xmat.reshape(3, 3).T @ (latch.xpos - target.xpos)


def holds(made, i):
    """Sensor of a latch: behind its striker, over its edge, and returned to its position."""
    place = catch(made, i)
    over = np.hypot(place[0], place[1]) > STRIKER_EDGE + BEHIND
    return place[2] < -IDSS.STRIKER_BACK and over and abs(made.joint(f"latch_{i}")) < BACK_IN_PLACE


def smooth(share):
    """Smooth step from 0 to 1 with continuous speed and acceleration."""
    s = min(max(share, 0.0), 1.0)
    return s**3 * (10.0 - 15.0 * s + 6.0 * s * s)


def blend(one, other, share):
    """Impedance interpolated between two."""
    stiffness = one.stiffness + share * (other.stiffness - one.stiffness)
    return d.Impedance(stiffness, one.damping + share * (other.damping - one.damping))


class Sequencer:
    """Sequencer with its state in its attributes, so `copy.deepcopy` saves it beside the state of the machine.

    `dead_latch`: number of a latch that stays retracted; `stuck_leg`: number of a leg that keeps its length;
    `give_up`: s after which a capture that has not come is aborted.
    """

    def __init__(self, dead_latch=None, stuck_leg=None, give_up=8.0, hard=True, from_phase="capture"):
        self.dead_latch, self.stuck_leg, self.give_up, self.hard = dead_latch, stuck_leg, give_up, hard
        self.phase, self.since, self.began = from_phase, 0.0, {from_phase: 0.0}
        self.captured_at, self.before = None, d.CAPTURING
        self.swung = 0.0  # when a hook moved last

    def __call__(self, made):
        self._go_on(made)
        self._legs(made)
        self._latches(made)
        if self.hard:
            self._hooks(made)

    def _go_on(self, made):
        waited = made.time - self.since
        if self.phase == "capture":
            if all(holds(made, i) for i in LATCHES):
                self.captured_at = made.time
                self._enter("attenuate", made)
            elif waited > self.give_up:
                self._enter("abort", made)
        elif self.phase in TIMES and waited >= TIMES[self.phase] - 0.5 * made.step and self._hooked(made, waited):
            self._enter(PHASES[PHASES.index(self.phase) + 1], made)

    def _hooked(self, made, waited):
        """True if all hooks stand, in the phase `hook`; always in another phase."""
        if self.phase != "hook" or not self.hard:
            return True
        if max(abs(made.speed(f"hook_{i}")) for i in range(d.HOOKS)) > HOOKS_STAND:
            self.swung = made.time
        return made.time - self.swung >= HOOKS_STAND_FOR or waited >= HOOK_MOST

    def _enter(self, phase, made):
        self.before = self._law(made.time)
        self.phase, self.since = phase, made.time
        self.began[phase] = made.time

    def _law(self, time):
        """Impedance of the legs, blended from the phase before to this one."""
        goal = {"capture": d.CAPTURING, "abort": d.CAPTURING, "attenuate": d.ATTENUATING}.get(self.phase, d.ALIGNING)
        share = min((time - self.since) / d.RAMP, 1.0)
        return blend(self.before, goal, share)

    def height(self, time):
        """Commanded height of the ring's face above the hard plane."""
        slow_at, deepest = d.MATED + d.SLOW_FROM, d.MATED - d.PULLED_DEEPER
        if self.phase in ("capture", "attenuate", "align", "abort"):
            return d.EXTENDED
        if self.phase == "retract":
            return d.EXTENDED + smooth((time - self.since) / d.RETRACT_TIME) * (slow_at - d.EXTENDED)
        if self.phase == "slow":
            return slow_at + smooth((time - self.since) / d.SLOW_TIME) * (deepest - slow_at)
        return deepest

    def _legs(self, made):
        laws = [self._law(made.time)] * stewart.LEGS
        slides = stewart.slides(self.height(made.time))
        if self.stuck_leg is not None:
            laws[self.stuck_leg], slides[self.stuck_leg] = d.STUCK, 0.0
        stewart.command(made.model, made.data, slides, laws)

    def _latches(self, made):
        for i in LATCHES:
            opened = self.phase in RELEASED or i == self.dead_latch
            made.data.ctrl[made.model.actuator(f"latch_{i}").id] = -d.LATCH_PULL if opened else 0.0

    def _hooks(self, made):
        """Open hooks are braked; while opening, each stops at its initial angle."""
        for i in range(d.HOOKS):
            number, dof = made.model.actuator(f"hook_{i}").id, made.model.joint(f"hook_{i}").dofadr[0]
            braked = self.phase not in HOOK_VOLTAGE or (
                self.phase == "unhook" and made.joint(f"hook_{i}") < -d.HOOK_OPEN
            )
            made.data.ctrl[number] = 0.0 if braked else HOOK_VOLTAGE[self.phase]
            made.model.dof_frictionloss[dof] = d.HOOK_STALL if braked else 0.0

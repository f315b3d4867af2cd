"""The whole: one arm carries the payload from the trunk, another takes it over and leads it into the vanes, the claw
draws it down.

Phases: *carry*, *grasp* (the second arm closes, and its place is not where the first one holds), *both*, *release* (of
the first arm), *bring*, *claw*, *held* (the second arm has let go), *done*.
"""

from dataclasses import dataclass, field

import dimensions as d
import numpy as np
import rig
import statics
from kit.restart import same_bits

TRUNK, MEETING = np.array((1.2, 0.3, 0.9, 0, 0, 0.1)), np.array((0.4, 0.0, 0.5, 0, 0, 0))
OFF = (0.020, 0.0, 0.0, 0.010, 0.0, 0.0)  # of the second arm from where the first one holds, m and rad
ASIDE = np.array((0.012, -0.008, 0.0, 0.0, 0.0, 0.008))  # by which the second arm is out of line over the platform
ABOVE, BELOW = 0.090, -0.020  # m: where it leads to, from the seat
ARMS = (d.FIRST, d.SECOND)
LASTS = {"carry": 12.0, "grasp": 2.0, "both": 6.0, "release": 6.0, "bring": 18.0, "claw": 7.0, "held": 2.0}  # s
PHASES = (*LASTS, "done")


@dataclass
class Sequence:
    """Sequencer with its complete state, so `copy.deepcopy` saves it beside the state of the machine."""

    off: tuple = OFF
    voltage: float = -1.0  # of the claw
    phase: str = "carry"
    since: float = 0.0
    seen: dict = field(default_factory=dict)  # wrenches of the arms at the end of each phase
    fastest: float = 0.0  # along x, while the first arm lets go, m/s

    def control(self, made):
        if self.phase != "done" and made.time - self.since >= LASTS[self.phase] - 1e-9:
            self.seen[self.phase] = {h.name: rig.wrench_of(made, h) for h in ARMS}
            self.phase, self.since = PHASES[PHASES.index(self.phase) + 1], made.time
        rig.grasping(made, ARMS, self.holding())
        self._lead(made, made.time - self.since)
        rig.drive(made, self.voltage if self.phase in ("claw", "held", "done") else 0.0)
        if self.phase == "release":
            self.fastest = max(self.fastest, abs(float(made.data.qvel[made.model.body("payload").dofadr[0]])))

    def holding(self):
        if self.phase in ("held", "done"):
            return ()
        first = self.phase in ("carry", "grasp", "both")
        second = self.phase != "carry"
        return tuple(h.name for h, holds in zip(ARMS, (first, second)) if holds)

    def _lead(self, made, gone):
        share = smooth(gone / (LASTS["carry"] - 5.0)) if self.phase == "carry" else 1.0
        rig.lead(made, d.FIRST, TRUNK + share * (MEETING - TRUNK))
        drawn = {"carry": 0.0, "grasp": smooth(gone / LASTS["grasp"])}.get(self.phase, 1.0)
        pose, off = MEETING, drawn * np.array(self.off)
        if self.phase in PHASES[4:]:
            pose, off = self._over(gone if self.phase == "bring" else LASTS["bring"]), np.zeros(6)
        rig.lead(made, d.SECOND, pose, off)

    def _over(self, gone):
        """Moves first above the vanes, then down."""
        over = ASIDE + (0, 0, ABOVE, 0, 0, 0)
        start = MEETING + self.off
        down = smooth((gone - 9.0) / 7.0) * (BELOW - ABOVE)
        return start + smooth(gone / 8.0) * (over - start) + (0, 0, down, 0, 0, 0)


def smooth(share):
    """Smooth step from 0 to 1 with no speed at both ends."""
    return 0.5 - 0.5 * np.cos(np.pi * min(max(share, 0.0), 1.0))


def machine(step):
    made = rig.machine(step, ARMS, pose=TRUNK)
    rig.grasping(made, ARMS, (d.FIRST.name,))
    made.start()
    return made


def run(step, prepare=None, until="done", **options):
    """Runs to the beginning of a phase. `prepare(machine)` receives the initial machine."""
    made, sequence = machine(step), Sequence(**options)
    if prepare is not None:
        prepare(made)
    made.run(sum(LASTS.values()) + 1.0, sequence.control, lambda _: sequence.phase == until)
    return made, sequence


def expected(off=OFF):
    """Wrench of the second arm when both hold, about its fixture, from springs in series."""
    arm = np.array(d.SECOND.fixture) - d.CENTER
    at_center = statics.motion(-arm) @ np.asarray(off)
    wrench = statics.series(d.FIRST, d.SECOND, at_center)
    return np.r_[wrench[:3], wrench[3:] - np.cross(arm, wrench[:3])]


def same_bits_after_restart(step, before, after):
    return same_bits(lambda: machine(step), Sequence().control, before, after)

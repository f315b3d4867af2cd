"""Loads of the box on its rails, for kit/loads.py: the gripper takes it, pushes it home, and pulls it out."""

from dataclasses import dataclass

import dimensions as d
import exchange
import statics

LOADED = ("box", "cone", "jaw_left", "jaw_right")
LEVELS = {"training": d.TRAINING, "analysis": d.ANALYSIS}
CHECKED = "home"
WITHIN = 0.02  # the cone leaves its jaws a little


@dataclass(frozen=True)
class Case:
    """`voltage`: of the motors of the jaws, of the greatest. `until`: phase of the sequence at whose begin a run ends."""

    level: d.Level = d.TRAINING
    voltage: float = 1.0
    until: str = "done"


def run_case(case, watch):
    made, sequencer = exchange.machine(case.level.step), exchange.Sequencer(case.voltage)
    watch(made, lambda: sequencer.phase)
    while sequencer.phase != case.until:
        made.advance(sequencer)


def predicted(case):
    """Push of the arm on the cone at the stop."""
    return {("cone", "force"): d.ARM_FORCE} if case.until == "out" and case.voltage == 1.0 else {}

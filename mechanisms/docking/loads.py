"""Loads of a docking, for kit/loads.py: fields of a case are those of `docking.Case` and those below, angles in rad."""

from dataclasses import dataclass

import dimensions as d
import docking
import rig_hard
from sequence import Sequencer

LOADED = ("target", "ring", "hook_0")
LEVELS = {"training": d.TRAINING, "analysis": d.ANALYSIS}
CHECKED = "hooked"


@dataclass(frozen=True)
class Case(docking.Case):
    """`until`: phase at whose begin a run ends; `align` leaves hard capture out. `begin`: `capture`, with the approach,
    or `hook`, with vehicles that are pulled together already."""

    until: str = "done"
    begin: str = "capture"


def run_case(case, watch):
    made = docking.captured(d.MATED, case.level) if case.begin == "hook" else docking.approach(case)
    sequencer = Sequencer(case.dead_latch, case.stuck_leg, case.give_up, from_phase=case.begin)
    watch(made, lambda: sequencer.phase)
    docking.go_on(made, sequencer, case.until)


def predicted(case):
    """Preload of a hook whose motor has stalled."""
    return {("hook_0", "force"): rig_hard.predicted_hook()[0]} if case.until == "unhook" else {}

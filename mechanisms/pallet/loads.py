"""Loads of the pallet, for kit/loads.py: fields of a case are those of `stowage.Case` and `until`."""

from dataclasses import dataclass

import dimensions as d
import rig
import stowage

LOADED = ("pallet", *rig.HOOKS, *(name for name in d.model.WHEELS if d.model.is_roller(name)))
LEVELS = {"training": d.TRAINING, "analysis": d.ANALYSIS}
CHECKED = "tied"
WITHIN = 0.02  # friction of hooks on their pins


@dataclass(frozen=True)
class Case(stowage.Case):
    """`until`: phase of the sequence at whose begin a run ends."""

    until: str = "done"


def run_case(case, watch):
    made, sequencer = stowage.machine(case), stowage.Sequencer(case)
    watch(made, lambda: sequencer.phase)
    while sequencer.phase != case.until:
        made.advance(sequencer)


def predicted(case):
    """Force of each hook with a stalled motor."""
    return {(name, "force"): 0.5 * stowage.tied() for name in rig.HOOKS} if case.until == "held" else {}

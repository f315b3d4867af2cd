"""Loads of the arm on its pad, for kit/loads.py: it presses with a commanded force."""

from dataclasses import dataclass

import contact
import dimensions as d
import rig
from kit.arm import Law

LOADED = ("tip", "pad")
LEVELS = {"training": rig.TRAINING, "analysis": rig.ANALYSIS}
CHECKED = "press"


@dataclass(frozen=True)
class Case:
    """`gap` before the pad at first, m; `seconds`: length of the run."""

    level: float = rig.TRAINING
    gap: float = 0.002
    seconds: float = 8.0


def run_case(case, watch):
    made, arm, normal = rig.machine(case.level, gap=case.gap)
    contact.commanded(arm, normal, d.PUSH)
    watch(made, lambda: arm.state.mode)
    made.run(case.seconds, arm.control)


def predicted(case):
    """Commanded force less the dead band of the law; the pad has no friction."""
    force = min(d.PUSH, Law().push) - Law().band
    return {("tip", "force"): force, ("pad", "force"): force}

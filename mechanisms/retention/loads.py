"""Loads of the retention latches, for kit/loads.py: the truss is berthed by the arm, or stands in its seat already."""

from dataclasses import dataclass

import dimensions as d
import latch
from dimensions import model

LOADED = ("truss", *(f"claw_{name}" for name in model.LATCHES))
LEVELS = {"training": d.TRAINING, "analysis": d.ANALYSIS}
CHECKED = "seated"


@dataclass(frozen=True)
class Case:
    """`begin`: a phase of the berthing, `lower`, `keel` or `claws`; from `keel` on the truss is in its seat at first.

    `dead`: a claw without power. `seconds`: length of the run.
    """

    level: float = d.TRAINING
    begin: str = "lower"
    dead: str | None = None
    seconds: float = latch.TIMES["claws"]


def run_case(case, watch):
    made = latch.Berthing(case.level, case.dead, case.begin)
    watch(made.machine, lambda: made.phase)
    made.run(case.seconds)


def predicted(case):
    """Force of each claw that closes: torque over the lever to its pin."""
    closed = (name for name in model.LATCHES if f"claw_{name}" != case.dead)
    return {(f"claw_{name}", "force"): latch.preload(0.0) for name in closed}

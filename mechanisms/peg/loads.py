"""Loads of the peg and its hole, for kit/loads.py: the wrist pushes it in."""

from dataclasses import dataclass

import dimensions as d
import numpy as np
import rig
import whitney

LOADED = ("peg", "hole")
LEVELS = {"training": rig.TRAINING, "analysis": rig.ANALYSIS}
CHECKED = "insert"
STRONG = 1000.0  # N of a feed that does not stop
PLACES = {"chamfer": (whitney.chamfer,), "one place": (whitney.mouth,), "two places": (whitney.mouth, whitney.wall)}


@dataclass(frozen=True)
class Case:
    """`centre`: of compliance, m from the tip. `limit`: of the feed, N. `depth` at which a run ends, m, or `seconds`."""

    level: float = rig.TRAINING
    centre: float = d.NEAR
    limit: float = 2000.0
    depth: float = 0.07
    seconds: float = 10.0


def run_case(case, watch):
    made = rig.machine(case.centre, case.level, case.limit)
    watch(made)
    made.run(case.seconds, rig.feed, lambda m: rig.height(m) < -case.depth)


def predicted(case):
    """Force of all places that touch, after Whitney, where the feed has force enough."""
    if case.limit < STRONG:
        return {}
    support = whitney.Support(case.centre)
    phase = whitney.insertion(support, -case.depth)[0]
    found, lean, _ = whitney.pushes(support, -case.depth, PLACES[phase])
    whole = sum(push * kind(-case.depth, lean)[0] for push, kind in zip(found, PLACES[phase]))
    force = float(np.linalg.norm(whole))
    return {("peg", "force"): force, ("hole", "force"): force}

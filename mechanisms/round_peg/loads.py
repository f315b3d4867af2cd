"""Loads of the round peg, for kit/loads.py: held by a spring about its tip, it turns upright as it enters."""

from dataclasses import dataclass

import dimensions as d
import numpy as np
import outcome
import rig

LOADED = ("peg",)
LEVELS = {"training": rig.TRAINING, "analysis": rig.ANALYSIS}
CHECKED = "upright"
WITHIN = 0.03


@dataclass(frozen=True)
class Case:
    """`speed` of the feed, m/s; `depth` at which a run ends, m."""

    level: float = rig.TRAINING
    speed: float = 0.02
    depth: float = 0.06


def run_case(case, watch):
    made = rig.machine(outcome.held(outcome.TILT, d.TURN), step=case.level)
    watch(made)
    made.run(10.0, outcome.driven(made, case.speed), lambda m: -outcome.tip(m) > case.depth)


def predicted(case):
    """Friction of both places, 2μN, with the pushes N = K(θ₀ − θ)/l of the spring; the pushes balance each other."""
    push = 0.0
    for _ in range(30):
        push = d.TURN * (outcome.TILT - rig.tilt_at(case.depth, push)) / case.depth
    return {("peg", "force"): 2 * d.FRICTION * float(np.abs(push))}

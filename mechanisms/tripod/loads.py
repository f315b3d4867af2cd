"""Loads of the tripod, for kit/loads.py: it falls on a slope, or stands there."""

import math
from dataclasses import dataclass

import dimensions as d
import numpy as np
import rig

LOADED = ("tripod",)
LEVELS = {"training": rig.TRAINING, "analysis": rig.ANALYSIS}
CHECKED = "fall"


@dataclass(frozen=True)
class Case:
    """`slope`: of the ground, rad. `yaw`: by which the tripod is turned on it, rad. `fall`: of its feet, m.

    `height`: of the mass centre above the feet, m. `seconds`: length of the run.
    """

    level: float = rig.TRAINING
    slope: float = 0.0
    yaw: float = 0.0
    height: float = d.HEIGHT
    fall: float = 0.0
    seconds: float = 1.5


def run_case(case, watch):
    made, attitude = rig.free(case.level, case.slope, case.yaw, case.height, sunk=case.fall == 0.0)
    made.data.qpos[:3] += case.fall * attitude[:, 2]
    made.start()
    watch(made)
    made.run(case.seconds)


def predicted(case):
    """At rest the ground bears the weight; its moment about the middle of the feet is that of the weight."""
    if math.tan(case.slope) >= d.FRICTION or math.tan(case.slope) >= 0.5 * d.RADIUS / case.height:
        return {}  # it slides or tips
    weight = d.MASS * d.GRAVITY
    found = {("tripod", "force"): weight}
    if case.slope > 0.0:
        found["tripod", "moment"] = float(np.sin(case.slope)) * case.height * weight
    return found

"""Loads of the hexapod, for kit/loads.py: it stands on three feet on a slope, or walks."""

from dataclasses import dataclass

import dimensions as d
import numpy as np
import rig
import scenes

LOADED = tuple(f"tibia_{i}" for i in rig.LEGS)
LEVELS = {"training": d.TRAINING, "analysis": d.ANALYSIS}
CHECKED = "stand"
WITHIN = 0.03  # feet also push outwards, where balance says nothing: servos give way


@dataclass(frozen=True)
class Case:
    """`slope` of the ground, towards `azimuth`, rad. `walk`: over level ground, or over terrain if `terrain`, else it
    stands on three feet. `seconds`: length of the run.
    """

    level: d.Level = d.TRAINING
    slope: float = 0.0
    azimuth: float = 0.0
    walk: bool = False
    terrain: bool = False
    seconds: float = 2.0


def run_case(case, watch):
    if case.walk:
        walk = scenes.Walk(case.level.step, scenes.tiles_for(case.seconds * d.STRIDE / d.PERIOD) if case.terrain else 0)
        watch(walk.hexapod)
        walk.go(case.seconds, walk.hexapod.advance)
        return
    hexapod = scenes.standing_on_three(case.level.step, rig.slope(case.slope, case.azimuth))
    watch(hexapod)
    hexapod.run(case.seconds)


def predicted(case):
    """Loads of three feet on level ground from balance."""
    if case.walk or case.slope != 0.0:
        return {}
    places = scenes.on_three()
    centre = scenes.centre(places) + (0.0, 0.0, d.HEIGHT + d.FOOT_RADIUS)
    borne = scenes.loads([places[i] for i in scenes.THREE], centre, np.array(rig.LEVEL))
    return {(f"tibia_{i}", "force"): float(load) for i, load in zip(scenes.THREE, borne)}

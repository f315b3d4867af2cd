"""Loads of the rover's wheels, for kit/loads.py: it stands or drives over a floor, a stone or rocks."""

from dataclasses import dataclass

import dimensions as d
import rig
import scenes
from dimensions import model
from kit.rows import Row

LOADED = tuple(f"wheel_{name}" for name in rig.WHEELS)
LEVELS = {"training": d.TRAINING, "analysis": d.ANALYSIS, "rigid": d.RIGID}
CHECKED = "stand"
BEGIN = {"floor": 0.0, "stone": -2.2, "terrain": -2.3}  # m along x


@dataclass(frozen=True)
class Case:
    """`ground`: floor (for the level rigid), stone or terrain. `speed`, m/s; `seconds`: length of the run."""

    level: d.Level = d.TRAINING
    ground: str = "stone"
    speed: float = 0.7
    seconds: float = 6.0


def run_case(case, watch):
    above = 0.01 if case.ground == "terrain" else 0.0
    made = rig.machine(case.level, case.ground, x=BEGIN[case.ground], height=above)
    rig.rolling(made, case.level, case.speed)
    watch(made)
    made.run(case.seconds, scenes.crawl(case.speed, case.level))


def predicted(case):
    """Loads at rest: a rocker gives a third of what it bears to its front wheel, and a bogie halves the rest."""
    if case.ground != "floor" or case.speed != 0.0:
        return {}
    borne = d.CHASSIS_MASS / 2 + d.ROCKER_MASS
    third = borne / 3 + d.STEER_MASS + model.WHEEL_MASS
    masses = {"front": third, "middle": third + d.BOGIE_MASS / 2, "rear": third + d.BOGIE_MASS / 2}
    return {(f"wheel_{name}", "force"): masses[name.split("_")[0]] * model.GRAVITY for name in rig.WHEELS}


def more_rows():
    """Loads at rest say nothing of inertia: moments of the chassis per kg, in MuJoCo and in the model's rover."""
    made = rig.machine(d.RIGID, "floor")
    body = made.model.body("chassis")
    unsprung = d.GROSS_MASS - d.CHASSIS_MASS
    for axis, measured, moment in zip("xyz", body.inertia, model.CHASSIS_INERTIA):
        of_model = moment / (model.GROSS_MASS - unsprung)
        yield Row(f"inertia of the chassis about {axis}, per kg", measured / body.mass[0], of_model, 1e-6, "m²")

"""Dispersed stands on three feet on a slope: whether it stands, slips or tips, compared with statics.

The slope rises slowly, towards any azimuth, under a hexapod whose body is shifted and whose mass centre is raised. All
three feet slip together at tan θ = μ; a foot is empty where gravity through the mass centre meets the plane on the line
of the other two. Soft servos let the body lean, which statics of a rigid body does not know: cases within 5 % of the
nearer limit are counted apart. Neither does it know what servos can give; `torque` says where one stalled. All
dispersions are chosen.
"""

import math

import dimensions as d
import mujoco
import numpy as np
import rig
import scenes
from kit.campaign import ANY_WAY, Study, Uniform
from kit.machine import wrenches

RISE, END, TICK = 1.5, 2.5, 0.01  # s: the slope is there; the end
WENT = 0.020  # m in the last second: beyond the limit by 5 % it slides five times as far
LOST = 0.080  # m from where it began: a hexapod that went so far is lost, and its loads no longer count
STEP = d.TRAINING.step
DISPERSED = {
    "slope": Uniform(math.radians(10.0), math.radians(40.0)),
    "azimuth": ANY_WAY,
    "friction": Uniform(0.7 * d.FRICTION, 1.3 * d.FRICTION),
    "ahead": Uniform(-0.05, 0.05),  # shift of the body, m
    "left": Uniform(-0.05, 0.05),
    "raised": Uniform(0.0, 0.08),  # of the body's mass centre by its cargo, m
    "mass": Uniform(0.8, 1.2),  # factor of the body's
}


def begin(values):
    places = scenes.on_three(shift=(values["ahead"], values["left"]))
    made = rig.machine(STEP, friction=values["friction"])
    made.scale_mass("body", values["mass"])
    made.model.body("body").ipos[:] = (0.0, 0.0, values["raised"])
    mujoco.mj_setConst(made.model, made.data)
    rig.pose(made, places, d.HEIGHT + d.FOOT_RADIUS)
    return made


def steepest(made, values):
    """tan θ at which a rigid hexapod slips or tips. Loads of the feet are linear in tan θ, so two slopes suffice."""
    feet, centre = rig.feet(made)[list(scenes.THREE)], rig.mass_centre(made)
    level, tilted = (
        scenes.loads(feet, centre, np.array(rig.slope(math.atan(t), values["azimuth"]))) * math.hypot(1.0, t)
        for t in (0.0, 1.0)
    )
    empty = [one / (one - other) for one, other in zip(level, tilted) if other < one]
    return min(values["friction"], *empty)


def attempt(values):
    made = begin(values)
    allowed, load, torque, began, stood = steepest(made, values), 0.0, 0.0, made.place("body"), None
    while made.time < END - 1e-9 and np.linalg.norm(made.place("body") - began) < LOST:
        share = min(1.0, (made.time + TICK) / RISE)
        made.model.opt.gravity[:] = rig.slope(share * values["slope"], values["azimuth"])
        load = max(load, float(wrenches(made.stride(TICK))[:, -6:, 2].max()))
        torque = max(torque, float(np.abs(made.data.actuator_force).max()))
        if stood is None and made.time > RISE:
            stood = made.place("body")
    return {
        "success": int(made.time > END - 1e-9 and np.linalg.norm(made.place("body") - stood) < WENT),
        "margin": 1.0 - math.tan(values["slope"]) / allowed,
        "load": load,
        "torque": torque,
        "tunnelled": int(made.tunnelled),
    }


STUDY = Study(
    "hexapod",
    DISPERSED,
    attempt,
    {
        "load": ("greatest load of a foot", "N", 1.0),
        "torque": ("greatest torque of a servo", "N·m", 1.0),
    },
    success="stood",
    band=0.05,
)

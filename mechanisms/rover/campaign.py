"""Dispersed step heights at the front wheels: whether the motors lift them over the edge, compared with statics.

The rover stands with its front wheels at the edge. All motors' torques rise slowly to what they can give, and stay. The
wheels come off the ground if there is a balance of forces with this torque (`statics.needed`). They rise slowly near
the limit: cases within 6 % of it are counted apart, as the checks of outcome.py allow. All dispersions are chosen.
"""

import math

import dimensions as d
import mujoco
import numpy as np
import rig
import scenes
import statics
from dimensions import model
from kit.campaign import Study, Uniform

GAP = 2e-3  # m from the tyre to the edge when a run begins
STANDS, RISE, END, TICK = 0.8, 1.4, 3.2, 0.02  # s: it stands at the edge; in which torques rise; the end
LIFTED = 2e-3  # m
STRONGEST = 200.0  # N·m: with so much torque only friction counts
DISPERSED = {
    "height": Uniform(0.08, 0.24),  # of the step, m
    "torque": Uniform(0.5 * d.STALL_TORQUE, 1.2 * d.STALL_TORQUE),  # N·m
    "friction": Uniform(0.7 * model.FRICTION, 1.3 * model.FRICTION),
    "cargo": Uniform(0.9, 1.1),  # factor of the chassis's mass
    "ahead": Uniform(-0.15, 0.15),  # mass centre of the chassis, m
}


def begin(values):
    height = min(values["height"], model.WHEEL_RADIUS)
    reach = math.sqrt(model.WHEEL_RADIUS**2 - (model.WHEEL_RADIUS - height) ** 2)
    x = -d.AXLE_X["front"] - reach - GAP
    made = rig.machine(d.RIGID, x=x, more_ground=values["height"], friction=values["friction"])
    made.scale_mass("chassis", values["cargo"])
    made.model.body("chassis").ipos[0] = values["ahead"]
    mujoco.mj_setConst(made.model, made.data)
    made.start()
    return made


def motors(made):
    """Motor control of `scenes.crawl` in MuJoCo's own terms: GAIN·(commanded − speed), within the limit of `cap`."""
    numbers = [made.model.actuator(f"drive_{name}").id for name in rig.WHEELS]
    made.model.actuator_gainprm[numbers, 0] = scenes.GAIN
    made.model.actuator_biasprm[numbers, 2] = -scenes.GAIN
    return numbers


def torque_needed(values):
    """Motor torque, N·m. Statics counts in weights: with more cargo the same torque is a smaller share."""
    mass = d.GROSS_MASS + (values["cargo"] - 1.0) * d.CHASSIS_MASS
    ahead = values["ahead"] * d.CHASSIS_MASS * values["cargo"] / mass * d.GROSS_MASS / d.CHASSIS_MASS
    of_weight = statics.needed("front", values["height"], values["friction"], ahead, STRONGEST, 14)
    return of_weight * mass / d.GROSS_MASS


def attempt(values):
    made = begin(values)
    numbers, wheel, load, low = motors(made), "wheel_front_left", 0.0, None
    first = 6 * made.carriers.index(made.model.body(wheel).id)
    while made.time < END - 1e-9:
        share = max(0.0, min(1.0, (made.time - STANDS) / RISE))
        cap = scenes.LEAST + share * (values["torque"] - scenes.LEAST)
        made.model.actuator_forcerange[numbers] = (-cap, cap)
        made.data.ctrl[numbers] = min(1.0, made.time / 0.2) * scenes.CRAWL / model.WHEEL_RADIUS
        seen = made.stride(TICK)[:, 3 + first : 6 + first]
        load = max(load, float(np.sqrt((seen * seen).sum(axis=1).max())))
        if low is None and made.time > STANDS:
            low = made.place(wheel)[2]
        if low is not None and made.place(wheel)[2] > low + LIFTED:
            break
    return {
        "success": int(made.time < END - 1e-9),
        "margin": 1.0 - torque_needed(values) / values["torque"],
        "load": load,
        "tunnelled": int(made.tunnelled),
    }


STUDY = Study(
    "rover",
    DISPERSED,
    attempt,
    {"load": ("greatest load of a front wheel", "N", 1.0)},
    success="lifted",
    band=0.06,
)

"""Dispersed off-centre pushes: whether the pallet enters or jams, compared with the law of a drawer.

A push F at e beside the middle, a drag D in the middle, and seized side rollers a base L apart. The pallet stands turned
against its rails; both loads rise together, and stay; a damper takes its momentum. It goes where 2·μ·e/L < 1 − D/F,
with lever and base of a pallet that is turned as far as clearance and yielding rollers let it. Near the limit friction
need not be shared evenly by both rollers (README.md), so cases within 5 % of it are counted apart. All dispersions are
chosen.
"""

import math

import dimensions as d
import drawer
import rig
from dimensions import model
from kit.campaign import Study, Uniform
from kit.machine import wrenches

RISE, TURNED, END, TICK = 1.0, 1.7, 2.2, 0.01  # s: loads are there; the wrist's damper has let it turn; the end
DAMPER = 1e4  # N·s/m along the way in: it takes the momentum that the pallet has before it jams
WENT = 1e-3  # m in the last half second: 5 % within the limit it goes twice as far
STIFFNESS = 1.0 / (1.0 / model.WHEEL_STIFFNESS + 1.0 / model.STEEL_STIFFNESS)  # of a roller on its rail
ROLLERS = [rig.carriers().index(name) for name in model.WHEELS if model.is_roller(name)]
DISPERSED = {
    "offset": Uniform(0.2, 2.0),  # m
    "side": Uniform(-1.0, 1.0),  # left above zero
    "base": Uniform(0.9 * drawer.SHORT, 1.1 * drawer.SHORT),  # m
    "friction": Uniform(0.7 * model.FRICTION, 1.3 * model.FRICTION),
    "drag": Uniform(0.7 * drawer.DRAG, 1.3 * drawer.DRAG),  # N
    "push": Uniform(800.0, 1200.0),  # N
    "mass": Uniform(0.9, 1.1),  # factor
}


def turned(base, give=0.0):
    """Angle of a pallet whose rollers, a base apart, touch both rails with a depth of `give`, rad."""
    room, low, high = model.LATERAL_CLEARANCE / 2 + give, 0.0, 0.5
    for _ in range(60):
        middle = 0.5 * (low + high)
        across = base / 2 * math.sin(middle) - model.SIDE_ROLLER_Y * (1.0 - math.cos(middle))
        low, high = (middle, high) if across < room else (low, middle)
    return low


def margin(values):
    """Relative margin of 2·μ·e/L below 1 − D/F."""
    load = 0.0
    for _ in range(50):
        angle = turned(values["base"], load / STIFFNESS)
        lever = values["offset"] * math.cos(angle) - d.FIXTURE[0] * math.sin(angle)
        apart = values["base"] * math.cos(angle) - 2 * model.SIDE_ROLLER_Y * math.sin(angle)
        load = values["push"] * lever / apart
    return 1.0 - 2 * values["friction"] * lever / apart / (1.0 - values["drag"] / values["push"])


def begin(values, side):
    made = rig.machine(model.SEATED_X - 0.35, d.TRAINING, values["base"], True, friction=values["friction"])
    made.scale_mass("pallet", values["mass"])
    # The wrist yields with damping, as in the push of drawer.py.
    made.model.dof_damping[:6] = (DAMPER, 10.0, 10.0, *[drawer.STRUT_TURNING] * 3)
    half = -side * turned(values["base"]) / 2
    made.data.qpos[3:7] = (math.cos(half), 0.0, 0.0, math.sin(half))
    made.start()
    return made


def pushed(made, values, side, share):
    body = made.model.body("pallet").id
    arm = made.data.xmat[body].reshape(3, 3) @ (d.FIXTURE[0], side * values["offset"], 0.0)
    push = share * values["push"]
    made.data.xfrc_applied[body] = (push - share * values["drag"], 0, 0, 0, 0, -arm[1] * push)


def attempt(values):
    side = math.copysign(1.0, values["side"])
    made, load, turned_at = begin(values, side), 0.0, None
    while made.time < END - 1e-9:
        pushed(made, values, side, min(1.0, (made.time + TICK) / RISE))
        sides = wrenches(made.stride(TICK))[:, ROLLERS, 1]
        load = max(load, float(abs(sides).max()))
        if turned_at is None and made.time > TURNED:
            turned_at = made.place("pallet")[0]
    return {
        "success": int(made.place("pallet")[0] - turned_at > WENT),
        "margin": margin(values),
        "peak_load": load,
        "tunnelled": int(made.tunnelled),
    }


STUDY = Study(
    "pallet",
    DISPERSED,
    attempt,
    {"peak_load": ("greatest load of a side roller", "N", 1.0)},
    success="gone in",
    band=0.05,
)

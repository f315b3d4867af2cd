"""Dispersed misaligned approaches of a payload: capture by the vanes, and seating by the claw.

It is captured if each ball comes down between the crests of its vane (`statics.out_of_line` below 1). In the last
μr/√(1 + μ²) before that, 5 % of the opening at the greatest friction here, friction on the edge of a crest may hold it:
cases so near to the limit are counted apart. All dispersions are chosen.
"""

import math

import dimensions as d
import mujoco
import numpy as np
import rig
import seat
import statics
from kit.campaign import ANY_WAY, OverDisc, Study, Uniform
from kit.machine import wrenches

TICK = 0.01  # s
NOT_BELOW = 4.0  # s after which a payload that stands on a crest is given up
CLOSES, END, STILL = 6.0, 9.0, 1e-5  # s that the claw takes to close; s at most; rad/s of a claw that is stalled
DISPERSED = {
    "offset": OverDisc(0.065),  # m
    "offset_way": ANY_WAY,
    "yaw": Uniform(-0.08, 0.08),  # rad
    "friction": Uniform(0.7 * d.FRICTION, 1.3 * d.FRICTION),
    "feed": Uniform(0.03, 0.05),  # m/s
    "mass": Uniform(0.9, 1.1),  # factor of the payload's
}
VANES = [rig.GROUPS.index(name) for name in rig.VANES]


def place(values):
    return values["offset"] * math.cos(values["offset_way"]), values["offset"] * math.sin(values["offset_way"])


def begin(values):
    made = seat.Capture(d.TRAINING.step, place(values), values["yaw"], feed=values["feed"], mu=values["friction"])
    made.machine.scale_mass("payload", values["mass"])
    mujoco.mj_setConst(made.machine.model, made.machine.data)
    rig.place(made.machine, (*place(values), made.ABOVE, 0.0, 0.0, values["yaw"]), d.OPEN)
    made.machine.start()
    return made


def attempt(values):
    made = begin(values)
    machine, load = made.machine, 0.0
    while machine.time < (END if made.closing else NOT_BELOW) - 1e-9:
        made.control(machine)
        forces = wrenches(machine.stride(TICK))[:, VANES, :3]
        load = max(load, float(np.sqrt((forces * forces).sum(axis=2).max())))
        if machine.time > CLOSES and abs(machine.speed("claw")) < STILL:
            break
    seated = made.seated()
    return {
        "success": int(seated),
        "margin": 1.0 - statics.out_of_line(place(values), values["yaw"]),
        "load": load,
        "preload": seat.claw_force(machine) if seated else math.nan,
        "tunnelled": int(machine.tunnelled),
    }


STUDY = Study(
    "cas",
    DISPERSED,
    attempt,
    {"load": ("greatest force on a vane", "N", 1.0), "preload": ("force of the claw on a seated payload", "N", 1.0)},
    success="seated",
    band=0.05,
)

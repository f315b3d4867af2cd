"""Dispersed offsets and angles of a box at the mouth of its rails: whether it enters or jams.

The box begins just before its second touch. It goes on if the arm holds it nearer to the middle than the limit of the
jam (`statics.jams_from`), which depends on tilt, friction and the wrist. Springs of contact and a box that moves on while
the push rises change the limit a little; cases within 5 % of it are counted apart. All dispersions are chosen.
"""

import math

import dimensions as d
import jam
import rig
import statics
from kit.campaign import Study, Uniform

BEFORE = 2e-3  # m before the second touch
RISE, END = 0.6, 0.9  # s: the push has risen to what the arm can; the end
WENT = 1e-3  # m from then on; a box that does not jam goes with the speed of the arm, six times as far
DISPERSED = {
    "tilt": Uniform(0.02, 0.06),  # rad
    "side": Uniform(-1.0, 1.0),  # turned to the left above zero
    "offset": Uniform(-0.05, 0.08),  # m from the middle of the rear, on it; above zero the push turns it further
    "friction": Uniform(0.7 * d.FRICTION, 1.3 * d.FRICTION),
    "push": Uniform(0.8 * d.ARM_FORCE, 1.2 * d.ARM_FORCE),  # N
    "turning": Uniform(0.7 * d.ARM_TURNING, 1.3 * d.ARM_TURNING),  # N·m/rad of the wrist
    "mass": Uniform(0.9, 1.1),  # factor
}


def place(tilt, side):
    """Position of a box whose front corner touches the rail to which it is turned."""
    x, y = d.LENGTH / 2 - d.ROUNDING, d.WIDTH / 2 - d.ROUNDING
    deep = statics.second_touch(tilt) - BEFORE
    across = d.GAP / 2 - d.ROUNDING - x * math.sin(tilt) - y * math.cos(tilt)
    return deep - x * math.cos(tilt) + y * math.sin(tilt), side * across, 0.0


def begin(values, side):
    tilt = side * values["tilt"]
    made = rig.machine(place(values["tilt"], side), tilt, connector=False, friction=values["friction"])
    made.scale_mass("box", values["mass"])
    grip = (-d.LENGTH / 2, -side * values["offset"], 0.0)
    return made, jam.Wrist(grip, tilt, most=values["push"], turning=values["turning"])


def margin(values):
    return 1.0 - values["offset"] / statics.jams_from(values["tilt"], values["friction"], values["turning"])


def attempt(values):
    side = math.copysign(1.0, values["side"])
    made, wrist = begin(values, side)
    peak, before = 0.0, None
    for _ in range(round(END / made.step)):
        made.hurry(wrist)
        peak = max(peak, abs(float(made.wrench("box")[5])))
        if before is None and made.time > RISE:
            before = jam.depth(made, side)
    return {
        "success": int(jam.depth(made, side) - before > WENT),
        "margin": margin(values),
        "peak_moment": peak,
        "tunnelled": int(made.tunnelled),
    }


STUDY = Study(
    "rpcm",
    DISPERSED,
    attempt,
    {"peak_moment": ("greatest moment of the rails on the box", "N·m", 1.0)},
    success="gone in",
    band=0.05,
)

#!/usr/bin/env python3
"""Builds retention latches of a payload bay (four on the sills, one on the keel), a payload with its pins, and scenes.

Made through the modelling toolkit: python build.py [FOLDER] [--blend FILE] with Blender as a Python module. It writes
bay.ron, payload.ron, arm.ron and the scenes (scenes.py). Every dimension stands in dimensions.py; README.md says where
each comes from.
"""

import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]
import authoring as a  # noqa: E402
import geometry as g  # noqa: E402
import scenes  # noqa: E402
from dimensions import *  # noqa: E402, F403

SIDES = ((-1, "port"), (1, "starboard"))
SURFACES_OF_BAY = {
    "latch": a.surface(STEEL_STIFFNESS, a.linear(0.0, ramp=DAMPING_RAMP), a.bristle(FRICTION)),
}
SURFACES_OF_PAYLOAD = {
    "pin": a.surface(
        STEEL_STIFFNESS, a.linear(PIN_DAMPING, ramp=DAMPING_RAMP), a.bristle(FRICTION, damping=PIN_STICKING_DAMPING)
    ),
    "plunger": a.surface(PLUNGER_STIFFNESS, a.linear(PLUNGER_DAMPING, ramp=DAMPING_RAMP)),
}


def box(name, least, most):
    half_spaces = []
    for axis in range(3):
        outward = tuple(float(i == axis) for i in range(3))
        half_spaces += [(g.scaled(outward, -1.0), -least[axis]), (outward, most[axis])]
    return a.polyhedron(name, half_spaces)


# --- longeron latches ------------------------------------------------------------------------------------------------

def guide(name, end, clearance):
    """One side of a latch: the wall of its socket and the flare above it. `end`: -1 forward, 1 aft."""
    flare = (-end * math.cos(math.radians(FLARE_DEG)), 0.0, math.sin(math.radians(FLARE_DEG)))
    half_spaces = [
        ((-end, 0.0, 0.0), -(PIN_RADIUS + clearance)),
        g.plane(flare, (end * GUIDE_HALF_WIDTH, 0.0, TIP_Z)),
        ((0.0, 0.0, 1.0), TIP_Z),
        ((end, 0.0, 0.0), GUIDE_HALF_WIDTH + GUIDE_BACK),
        ((0.0, 0.0, -1.0), PIN_RADIUS + FLOOR_THICKNESS),
        ((0.0, -1.0, 0.0), GUIDE_HALF_DEPTH),
        ((0.0, 1.0, 0.0), GUIDE_HALF_DEPTH),
    ]
    return a.polyhedron(name, half_spaces)


def claw(name):
    """The upper half of the latch, in the frame of its hinge; modelled closed."""
    face = PIN_RADIUS - HINGE_Z - CLAW_BITE
    block = box(
        "face",
        (-CLAW_REACH, -CLAW_HALF_WIDTH, face),
        (-CLAW_HEEL, CLAW_HALF_WIDTH, face + CLAW_THICKNESS),
    )
    place = (HINGE_X, 0.0, HINGE_Z)
    return a.group(name, primitives=[block], bound="Obb", movable=True, position=place)


def latch(name):
    x, side = LATCHES[name]
    clearance = PRIMARY_CLEARANCE if name.startswith("primary") else SECONDARY_CLEARANCE
    floor = box(
        "floor",
        (-PIN_RADIUS - clearance, -GUIDE_HALF_DEPTH, -PIN_RADIUS - FLOOR_THICKNESS),
        (PIN_RADIUS + clearance, GUIDE_HALF_DEPTH, -PIN_RADIUS),
    )
    socket = [guide("guide_forward", -1, clearance), guide("guide_aft", 1, clearance), floor]
    parts = [a.group("socket", primitives=socket), claw("claw")]
    return a.group(name, groups=parts, position=(x, side * SILL_Y, 0.0))


# --- keel latch ------------------------------------------------------------------------------------------------------

def keel_jaw_group(side, label):
    """One side of the keel latch: a wall with a flare above it, in the frame of `keel_jaw`; it slides along y."""
    flare = (0.0, -side, 1.0)
    half_spaces = [
        ((0.0, -side, 0.0), 0.0),
        g.plane(flare, (0.0, 0.0, KEEL_WALL_TOP)),
        ((0.0, 0.0, 1.0), KEEL_WALL_TOP + KEEL_MOUTH),
        ((0.0, side, 0.0), KEEL_MOUTH + GUIDE_BACK),
        ((0.0, 0.0, -1.0), KEEL_DEPTH),
        ((-1.0, 0.0, 0.0), KEEL_HALF_LENGTH),
        ((1.0, 0.0, 0.0), KEEL_HALF_LENGTH),
    ]
    wall = a.polyhedron("wall", half_spaces)
    return a.group(f"keel_jaw_{label}", primitives=[wall], movable=True, position=keel_jaw(side))


def bay():
    groups = [latch(name) for name in LATCHES] + [keel_jaw_group(side, label) for side, label in SIDES]
    return a.model("bay", SURFACES_OF_BAY, a.group("bay", groups=groups, surface="latch"))


# --- payload -----------------------------------------------------------------------------------------------------------

def scuff_plate(side):
    """Contact features of the plate with the guides: its flange's lines at 45°, parallel to their flares, and a chord
    of its flat."""
    face = -side * PIN_LENGTH / 2  # from the middle of the latch
    back = face - side * (SCUFF_RADIUS - SCUFF_FLAT_RADIUS)
    lines = [a.segment("flat", (-SCUFF_FLAT_RADIUS, face, 0.0), (SCUFF_FLAT_RADIUS, face, 0.0))]
    for end, where in ((-1, "forward"), (1, "aft")):
        x, z = end * math.sin(math.radians(FLARE_DEG)), -math.cos(math.radians(FLARE_DEG))
        inner = (SCUFF_FLAT_RADIUS * x, face, SCUFF_FLAT_RADIUS * z)
        lines.append(a.segment(f"flange_{where}", inner, (SCUFF_RADIUS * x, back, SCUFF_RADIUS * z)))
    return a.group("scuff_plate", primitives=lines)


def trunnion(name):
    x, side = LATCHES[name]
    pin = a.group("pin", primitives=[a.sphere("barrel", (0.0, 0.0, 0.0), PIN_RADIUS)], bound="Sphere")
    plunger = a.ray(
        "plunger", (0.0, 0.0, 0.0), (0.0, 0.0, -1.0), PIN_RADIUS + PLUNGER_STROKE, response="Axial", surface="plunger"
    )
    parts = [pin, scuff_plate(side), a.group("ready_to_latch", primitives=[plunger])]
    return a.group(f"trunnion_{name}", groups=parts, position=(x, side * SILL_Y, 0.0))


def payload():
    keel = [
        a.sphere("shank", (0.0, 0.0, KEEL_Z), KEEL_PIN_RADIUS),
        a.sphere("end", (0.0, 0.0, KEEL_Z - KEEL_PIN_END), KEEL_PIN_RADIUS),
    ]
    groups = [trunnion(name) for name in LATCHES] + [a.group("keel_pin", primitives=keel)]
    return a.model("payload", SURFACES_OF_PAYLOAD, a.group("payload", groups=groups, surface="pin"))


def arm():
    """Frame of the arm's tip, without contact: scenes name no pair with it."""
    tip = a.point("tip", (0.0, 0.0, 0.0))
    return a.model("arm", {"none": a.surface(1.0)}, a.group("arm", primitives=[tip], surface="none"))


if __name__ == "__main__":
    a.main([bay(), payload(), arm()], HERE, scenes.texts())

#!/usr/bin/env python3
"""Builds the wheels of an exposed pallet, the guide rails it slides into like a drawer, and scenes of its insertion.

Made through the modelling toolkit: python build.py [FOLDER] [--blend FILE] with Blender as a Python module. It writes
pallet.ron, rails.ron, arm.ron and the scenes (scenes.py). Every dimension stands in dimensions.py; README.md says where
each comes from.

x is the way in, y to the left, z up. The rails' origin lies midway between them where their straight parts begin, the
pallet's in its middle, at the height of the axles. The wheels are movable groups: the host turns them on their axles.
"""

import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]
import authoring as a  # noqa: E402
import geometry as g  # noqa: E402
import scenes  # noqa: E402
from dimensions import *  # noqa: E402, F403

SURFACES_OF_PALLET = {
    "wheel": a.surface(WHEEL_STIFFNESS, a.linear(WHEEL_DAMPING, ramp=DAMPING_RAMP), a.bristle(FRICTION)),
    "bumper": a.surface(BUMPER_STIFFNESS, a.linear(BUMPER_DAMPING, ramp=DAMPING_RAMP), a.bristle(FRICTION)),
    "chassis": a.surface(STEEL_STIFFNESS, a.linear(STEEL_DAMPING, ramp=DAMPING_RAMP), a.bristle(FRICTION)),
}
SURFACES_OF_RAILS = {
    "rail": a.surface(STEEL_STIFFNESS, a.linear(0.0, ramp=DAMPING_RAMP), a.bristle(FRICTION)),
}


# --- pallet --------------------------------------------------------------------------------------------------------

def wheel(name):
    """One wheel at its position: an ellipsoid, which is a wheel with a crowned tread."""
    semi_axes = [wheel_radius(name)] * 3
    semi_axes[axle(name)] = wheel_half_width(name)
    tread = a.ellipsoid("tread", (0.0, 0.0, 0.0), semi_axes)
    return a.group(
        name, primitives=[tread], bound="Sphere", surface="wheel", movable=True, position=WHEELS[name]
    )


def pallet():
    corners = []
    for side, label in SIDES:
        corner = (PALLET_LENGTH / 2, side * CHASSIS_HALF_WIDTH)
        corners.append(a.segment(f"corner_{label}", (*corner, -CHASSIS_HALF_HEIGHT), (*corner, CHASSIS_HALF_HEIGHT)))
    bumpers = []
    for side, label in SIDES:
        middle = (BUMPER_TIP_X - BUMPER_RADIUS, side * BUMPER_Y, 0.0)
        bumpers.append(a.sphere(f"bumper_{label}", middle, BUMPER_RADIUS))
    body = [
        a.group("chassis", primitives=corners, surface="chassis"),
        a.group("bumpers", primitives=bumpers, surface="bumper"),
    ]
    root = a.group("pallet", groups=body + [wheel(name) for name in WHEELS], surface="chassis")
    return a.model("pallet", SURFACES_OF_PALLET, root)


# --- rails -----------------------------------------------------------------------------------------------------------

def flange(name, side, up):
    """The lower (`up` -1) or upper (+1) flange of a channel: its run, and the slope that leads wheels onto it."""
    run = MAIN_WHEEL_RADIUS + VERTICAL_CLEARANCE / 2
    outer = run + VERTICAL_FLARE + FLANGE_THICKNESS
    slope = (-VERTICAL_FLARE, 0.0, -up * FLARE_LENGTH)
    half_spaces = [
        ((0.0, 0.0, -up), -run),
        g.plane(slope, (0.0, 0.0, up * run)),
        ((0.0, 0.0, up), outer),
        ((-1.0, 0.0, 0.0), FLARE_LENGTH),
        ((1.0, 0.0, 0.0), STOP_X),
        ((0.0, -side, 0.0), -FLANGE_INNER_Y),
        ((0.0, side, 0.0), WEB_Y + WEB_THICKNESS),
    ]
    return a.polyhedron(name, half_spaces)


def web(name, side):
    """The side guide of a channel: track of the side rollers, and the flare that centres them."""
    half_spaces = [
        ((0.0, -side, 0.0), -WEB_Y),
        g.plane((-LATERAL_FLARE, -side * FLARE_LENGTH, 0.0), (0.0, side * WEB_Y, 0.0)),
        ((0.0, side, 0.0), WEB_Y + LATERAL_FLARE + WEB_THICKNESS),
        ((-1.0, 0.0, 0.0), FLARE_LENGTH),
        ((1.0, 0.0, 0.0), STOP_X),
        ((0.0, 0.0, -1.0), WEB_HALF_HEIGHT),
        ((0.0, 0.0, 1.0), WEB_HALF_HEIGHT),
    ]
    return a.polyhedron(name, half_spaces)


def stop(name, side):
    half_spaces = [
        ((-1.0, 0.0, 0.0), -STOP_X),
        ((1.0, 0.0, 0.0), STOP_X + STOP_THICKNESS),
        ((0.0, 1.0, 0.0), side * BUMPER_Y + STOP_HALF_WIDTH),
        ((0.0, -1.0, 0.0), -side * BUMPER_Y + STOP_HALF_WIDTH),
        ((0.0, 0.0, 1.0), STOP_HALF_WIDTH),
        ((0.0, 0.0, -1.0), STOP_HALF_WIDTH),
    ]
    return a.polyhedron(name, half_spaces)


def rails():
    groups = []
    for side, label in SIDES:
        channel = [flange("lower_flange", side, -1), flange("upper_flange", side, 1), web("web", side)]
        groups.append(a.group(f"rail_{label}", primitives=channel))
    groups.append(a.group("stops", primitives=[stop(f"stop_{label}", side) for side, label in SIDES]))
    return a.model("rails", SURFACES_OF_RAILS, a.group("rails", groups=groups, surface="rail"))


def arm():
    """Frame of the arm's tip, without contact: scenes name no pair with it."""
    tip = a.point("tip", (0.0, 0.0, 0.0))
    return a.model("arm", {"none": a.surface(1.0)}, a.group("arm", primitives=[tip], surface="none"))


if __name__ == "__main__":
    a.main([pallet(), rails(), arm()], HERE, scenes.texts())

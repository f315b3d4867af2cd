#!/usr/bin/env python3
"""Builds platform.ron and payload.ron through the modelling toolkit: python build.py [FOLDER] [--blend FILE], with
Blender as a Python module.
"""

import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent.parent / "models")]
import authoring as a  # noqa: E402
import dimensions as d  # noqa: E402

FRICTION = a.bristle(d.FRICTION)


def flank(name, side):
    """One half of a groove along x: below a slope from the root up to the crest."""
    outer, below = d.OPENING + d.CREST, d.BASE - d.ROOT_Z
    slope = (0.0, -side * math.sin(d.FLANK), math.cos(d.FLANK))
    half_spaces = [
        (slope, d.ROOT_Z * slope[2]),
        ((0.0, 0.0, 1.0), d.CREST_Z),
        ((0.0, 0.0, -1.0), below),
        ((0.0, -side, 0.0), 0.0),
        ((0.0, side, 0.0), outer),
        ((1.0, 0.0, 0.0), d.HALF_LENGTH),
        ((-1.0, 0.0, 0.0), d.HALF_LENGTH),
    ]
    return a.polyhedron(name, half_spaces)


def vane(name, azimuth):
    place = (d.RADIUS * math.cos(azimuth), d.RADIUS * math.sin(azimuth), 0.0)
    turned = (math.cos(azimuth / 2), 0.0, 0.0, math.sin(azimuth / 2))
    flanks = [flank("left", 1), flank("right", -1)]
    return a.group(name, primitives=flanks, movable=True, position=place, orientation=turned)


def claw():
    half_spaces = [
        ((0.0, 0.0, -1.0), 0.0),
        ((0.0, 0.0, 1.0), d.CLAW_THICKNESS),
        ((1.0, 0.0, 0.0), d.CLAW_REACH),
        ((-1.0, 0.0, 0.0), d.CLAW_HEEL),
        ((0.0, 1.0, 0.0), d.CLAW_HALF_WIDTH),
        ((0.0, -1.0, 0.0), d.CLAW_HALF_WIDTH),
    ]
    return a.group("claw", primitives=[a.polyhedron("jaw", half_spaces)], movable=True, position=d.HINGE)


def platform():
    surface = a.surface(d.STIFFNESS, a.linear(d.DAMPING, ramp=d.RAMP), FRICTION)
    groups = [vane(*entry) for entry in d.AZIMUTHS.items()] + [claw()]
    return a.model("platform", {"steel": surface}, a.group("platform", groups=groups, surface="steel"))


def payload():
    """Balls of the three pins, and the bar; the platform provides the stiffness."""
    pins = [
        a.sphere(f"pin_{i + 1}", (d.RADIUS * math.cos(azimuth), d.RADIUS * math.sin(azimuth), 0.0), d.PIN)
        for i, azimuth in enumerate(d.AZIMUTHS.values())
    ]
    bar = a.capsule("bar", (0.0, -d.BAR_HALF, d.BAR_Z), (0.0, d.BAR_HALF, d.BAR_Z), d.BAR_RADIUS)
    surface = a.surface(float("inf"), a.linear(0.0, ramp=d.RAMP), FRICTION)
    return a.model("payload", {"steel": surface}, a.group("payload", primitives=[*pins, bar], surface="steel"))


if __name__ == "__main__":
    a.main([platform(), payload()], HERE)

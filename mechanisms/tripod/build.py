#!/usr/bin/env python3
"""Builds the tripod and its ground, through the modelling toolkit: python build.py with Blender as a Python module. It
writes tripod.ron and ground.ron."""

import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "models")]
import authoring as a  # noqa: E402
from dimensions import DAMPING, FRICTION, RADIUS, STICKING_DAMPING, STIFFNESS  # noqa: E402


def foot(number):
    """Foot as a separate movable group, so that its load can be read. Its frame is that of the tripod."""
    azimuth = math.radians(90.0 + 120.0 * number)
    place = (RADIUS * math.cos(azimuth), RADIUS * math.sin(azimuth), 0.0)
    return a.group(f"foot_{number}", primitives=[a.point("point", place)], surface="foot", movable=True)


def tripod():
    """Origin at the middle of the circle of the feet; z points up."""
    surface = a.surface(STIFFNESS, a.linear(DAMPING), a.bristle(FRICTION, damping=STICKING_DAMPING))
    return a.model("tripod", {"foot": surface}, a.group("tripod", groups=[foot(i) for i in range(3)]))


def ground():
    """Half space below z = 0."""
    plane = a.flat_ground("top", (0.0, 0.0, 1.0), 0.0)
    surface = a.surface("inf", friction=a.bristle(FRICTION))
    return a.model("ground", {"rock": surface}, a.group("ground", primitives=[plane], surface="rock"))


if __name__ == "__main__":
    a.main([tripod(), ground()], HERE)

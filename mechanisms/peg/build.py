#!/usr/bin/env python3
"""Builds the peg and its hole with a chamfer, through the modelling toolkit: python build.py with Blender as a Python
module. It writes peg.ron and hole.ron."""

import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "models")]
import authoring as a  # noqa: E402
from dimensions import (  # noqa: E402
    CHAMFER,
    DAMPING,
    DEPTH,
    FRICTION,
    HOLE,
    LENGTH,
    RADIUS,
    SLOPE,
    STICKING_DAMPING,
    STIFFNESS,
)


def peg():
    """Peg with its origin at the middle of the tip; z points along it, out of the hole."""
    surface = a.surface(STIFFNESS, a.linear(DAMPING), a.bristle(FRICTION, damping=STICKING_DAMPING))
    body = a.cylinder("body", (0.0, 0.0, 0.0), (0.0, 0.0, LENGTH), RADIUS)
    return a.model("peg", {"steel": surface}, a.group("peg", primitives=[body], surface="steel"))


def hole():
    """Hole with its origin where the chamfer ends; z points out of it."""
    wide = HOLE + CHAMFER * math.tan(SLOPE)
    # The end of the chamfer is an edge, on which the side of the peg leans. It belongs to the chamfer: a tip that comes
    # down the chamfer passes it smoothly. As the edge of the wall it would push a tilted tip back out of the hole.
    chamfer = a.bore("chamfer", (0.0, 0.0, CHAMFER), (0.0, 0.0, 0.0), (wide, HOLE), mouths=(True, True))
    wall = a.bore("wall", (0.0, 0.0, 0.0), (0.0, 0.0, -DEPTH), HOLE, mouths=(False, False))
    surface = a.surface("inf", friction=a.bristle(FRICTION))
    return a.model("hole", {"steel": surface}, a.group("hole", primitives=[chamfer, wall], surface="steel"))


if __name__ == "__main__":
    a.main([peg(), hole()], HERE)

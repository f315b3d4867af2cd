#!/usr/bin/env python3
"""Builds the tool and the pad of the arm's checks, through the modelling toolkit: python build.py with Blender as a
Python module. It writes tool.ron and pad.ron."""

import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "models")]
import authoring as a  # noqa: E402
from dimensions import PAD_DAMPING, PAD_STIFFNESS, TOOL_RADIUS  # noqa: E402


def tool():
    """A ball at the tip; its force goes through the tip, so it has no moment there."""
    ball = a.sphere("ball", (0.0, 0.0, 0.0), TOOL_RADIUS)
    return a.model("tool", {"steel": a.surface("inf")}, a.group("tool", primitives=[ball], surface="steel"))


def pad():
    surface = a.surface(PAD_STIFFNESS, a.linear(PAD_DAMPING))
    plane = a.flat_ground("face", (0.0, 0.0, 1.0), 0.0)
    return a.model("pad", {"rubber": surface}, a.group("pad", primitives=[plane], surface="rubber"))


if __name__ == "__main__":
    a.main([tool(), pad()], HERE)

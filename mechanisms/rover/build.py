#!/usr/bin/env python3
"""Builds floor.ron, step.ron, rigid_wheel.ron and rigid_drum.ron through the modelling toolkit: python build.py [FOLDER] [--blend FILE], with Blender as a Python
module. Tyres and other grounds are those of models/rover as they are.
"""

import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent), str(HERE.parent.parent / "models")]
import authoring as a  # noqa: E402
import dimensions as d  # noqa: E402

LENGTH, HALF_WIDTH, DEPTH = 4.0, 2.0, 1.0  # of the block
STONE = {"stone": a.surface(float("inf"), a.linear(0.0, ramp=d.RIGID_RAMP), a.bristle(d.model.FRICTION))}


def floor():
    """Infinite level floor for rigid wheels."""
    plane = a.flat_ground("plane", (0.0, 0.0, 1.0), 0.0)
    return a.model("floor", STONE, a.group("floor", primitives=[plane], surface="stone"))


def step():
    """A block with its top at z = 0 and its face at x = 0: its carrier is at any height."""
    half_spaces = [
        ((0.0, 0.0, 1.0), 0.0),
        ((0.0, 0.0, -1.0), DEPTH),
        ((-1.0, 0.0, 0.0), 0.0),
        ((1.0, 0.0, 0.0), LENGTH),
        ((0.0, 1.0, 0.0), HALF_WIDTH),
        ((0.0, -1.0, 0.0), HALF_WIDTH),
    ]
    block = a.polyhedron("block", half_spaces)
    return a.model("step", STONE, a.group("step", primitives=[block], surface="stone"))


def rigid_wheel(name, tread):
    """Rigid wheel of models/rover/rig_rigid.ron with damping from zero depth: on level ground its depth is 0.4 mm only."""
    damping = a.linear(d.model.RIGID_DAMPING, ramp=d.RIGID_RAMP)
    friction = a.bristle(d.model.FRICTION, stiffness=2 * d.model.RIGID_STIFFNESS, damping=d.model.BALL_DAMPING)
    turning = a.group("wheel", primitives=[tread], bound="Sphere", surface="tyre", movable=True)
    axle = a.group("carriage", primitives=[a.sphere("axle", (0.0, 0.0, 0.0), d.model.HUB_RADIUS)], surface="tyre")
    surfaces = {"tyre": a.surface(d.model.RIGID_STIFFNESS, damping, friction)}
    return a.model(name, surfaces, a.group(name, groups=[axle, turning]))


def rigid_wheels():
    radius, half = d.model.WHEEL_RADIUS, d.model.WHEEL_WIDTH / 2
    egg = a.ellipsoid("tread", (0.0, 0.0, 0.0), (radius, half, radius))
    drum = a.cylinder("tread", (0.0, -half, 0.0), (0.0, half, 0.0), radius)
    return [rigid_wheel("rigid_wheel", egg), rigid_wheel("rigid_drum", drum)]


if __name__ == "__main__":
    a.main([floor(), step(), *rigid_wheels()], HERE)

#!/usr/bin/env python3
"""Builds the tripod, its ground and its scene (validation case V2) through the modelling toolkit: python build.py
[FOLDER] [--blend FILE] with Blender as a Python module.

The origin of the tripod is the centre of the circle of its feet, in the plane of the feet; z points up. The ground is
rigid and fills all below z = 0.
"""

import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import authoring as a  # noqa: E402
from geometry import on_circle  # noqa: E402

RADIUS = 0.5  # of the circle on which the feet stand, m
FOOT_STIFFNESS = 1e5  # of each foot on a rigid ground, N/m
FRICTION = 0.5


def tripod():
    feet = [a.point(f"foot_{i}", on_circle(RADIUS, 90.0 + 120.0 * i)) for i in range(3)]
    surfaces = {"foot": a.surface(FOOT_STIFFNESS, a.linear(0.0), a.bristle(FRICTION))}
    return a.model("tripod", surfaces, a.group("tripod", primitives=feet, bound="Sphere", surface="foot"))


def ground():
    surfaces = {"ground": a.surface(float("inf"), a.linear(0.0), a.bristle(FRICTION))}
    top = a.flat_ground("top", (0.0, 0.0, 1.0), 0.0)
    return a.model("ground", surfaces, a.group("ground", primitives=[top], surface="ground"))


def scene():
    """Dropped from rest with its feet just touching: it heaves about mg/(3k) at sqrt(3k/m)."""
    lines = [
        "// The tripod let go with its feet just touching the ground. Written by build.py.",
        "(",
        '    format: "pong-scene",',
        "    version: 1,",
        '    name: "tripod",',
        '    models: { "tripod": "tripod.ron", "ground": "ground.ron" },',
        "    objects: [",
        '        (name: "ground", model: "ground", bodies: [(motion: Fixed)]),',
        '        (name: "tripod", model: "tripod", bodies: [(',
        "            motion: Free, mass: 10.0, inertia: Diagonal(1.0, 1.0, 1.5), mass_center: (0.0, 0.0, 0.3),",
        "        )]),",
        "    ],",
        '    pairs: [("tripod", "ground")],',
        "    gravity: (0.0, 0.0, -9.81),",
        "    integrator: RungeKutta4,",
        "    step: 1e-4,",
        "    duration: 1.0,",
        "    record_every: 10,",
        "    ledger: true,",
        ")",
    ]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    a.main([tripod(), ground()], HERE, {"scene_drop.ron": scene()})

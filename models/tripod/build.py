#!/usr/bin/env python3
"""Builds the tripod and its ground (validation case V2). Run it from anywhere: python3 build.py [folder]."""

import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import model_writer as w  # noqa: E402

RADIUS = 0.5  # of the circle on which the feet stand, m
FOOT_STIFFNESS = 1e5  # of each foot on a rigid ground, N/m
FRICTION = 0.5


def tripod():
    feet = [w.point(f"foot_{i}", w.on_circle(RADIUS, 90.0 + 120.0 * i)) for i in range(3)]
    surfaces = {"foot": f"(stiffness: {FOOT_STIFFNESS!r}, normal: Linear(damping: 0.0), friction: Bristle(mu: {FRICTION}))"}
    about = [
        "Three points on a circle: the tripod of validation case V2. Written by build.py.",
        "The group's origin is the centre of the circle, in the plane of the feet; z points up.",
    ]
    return w.model("tripod", surfaces, w.group("tripod", primitives=feet, bound="Sphere", surface="foot"), about)


def ground():
    surfaces = {"ground": f"(stiffness: inf, normal: Linear(damping: 0.0), friction: Bristle(mu: {FRICTION}))"}
    about = ["A rigid half space below z = 0. Written by build.py."]
    root = w.group("ground", primitives=[w.flat_ground("top", (0.0, 0.0, 1.0), 0.0)], surface="ground")
    return w.model("ground", surfaces, root, about)


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


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else HERE
    w.write(folder / "tripod.ron", tripod())
    w.write(folder / "ground.ron", ground())
    w.write(folder / "scene_drop.ron", scene())


if __name__ == "__main__":
    main()

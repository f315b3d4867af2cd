#!/usr/bin/env python3
"""Builds the peg, the hole and their scenes (validation case V20) through the modelling toolkit: python build.py
[FOLDER] [--blend FILE] with Blender as a Python module.

The origin of the peg is the centre of its tip; z points along the peg, away from the bottom of the hole. The origin of
the hole is the centre of its mouth; z points out of the hole.
"""

import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import authoring as a  # noqa: E402
import geometry as g  # noqa: E402
from scene_text import numbers  # noqa: E402

SIDES = 16  # of the polygons that stand for peg and bore
PEG_DIAMETER = 0.100  # across the peg's edges, m
PEG_LENGTH = 0.200
CLEARANCE = 0.001  # of the bore: its width across flats less the peg's diameter, m
HOLE_DEPTH = 0.150
BLOCK_RADIUS = 0.100  # across the flats of the block around the bore, m
STIFFNESS = 1e6  # of each of the two surfaces, N/m
DAMPING = 400.0  # N·s/m: see README
FRICTION = 0.5
OVERLAP = 2e-5  # by which the scenes press the peg into wall and mouth, m

STEP = 360.0 / SIDES
SURFACES = {"peg": a.surface(STIFFNESS, a.linear(DAMPING), a.bristle(FRICTION))}


def peg():
    """Edges along the peg, each facing the middle of a flat of the bore; the tip is at z = 0, the peg above it."""
    radius = PEG_DIAMETER / 2
    edges = []
    for i in range(SIDES):
        tip = g.on_circle(radius, i * STEP, 0.0)
        edges.append(a.segment(f"edge_{i:02}", tip, g.add(tip, (0.0, 0.0, PEG_LENGTH))))
    return a.model("peg", SURFACES, a.group("peg", primitives=edges, bound="Obb", surface="peg"))


def wedge(i):
    """One wedge of the block: its flat towards the bore, its two flanks internal faces."""
    azimuth = i * STEP
    outwards = g.on_circle(1.0, azimuth)
    flanks = []
    for side in (-1, 1):
        along = g.on_circle(1.0, azimuth + side * STEP / 2)
        flanks.append((g.scaled(g.cross((0.0, 0.0, 1.0), along), side), 0.0))
    half_spaces = [
        (g.scaled(outwards, -1.0), -(PEG_DIAMETER + CLEARANCE) / 2),
        (outwards, BLOCK_RADIUS),
        flanks[0],
        flanks[1],
        ((0.0, 0.0, 1.0), 0.0),
        ((0.0, 0.0, -1.0), HOLE_DEPTH),
    ]
    return a.polyhedron(f"wedge_{i:02}", half_spaces, inactive=(2, 3))


def hole():
    wedges = [a.group(f"side_{i:02}", primitives=[wedge(i)], bound="Obb") for i in range(SIDES)]
    return a.model("hole", SURFACES, a.group("hole", groups=wedges, bound="Aabb", surface="peg"))


def tilt_for(depth):
    """Tilt at which the peg, inserted to a depth, overlaps wall and mouth by OVERLAP each (bisection)."""
    reach = PEG_DIAMETER + CLEARANCE + 2 * OVERLAP

    def spanned(tilt):
        return PEG_DIAMETER * math.cos(tilt) + (depth + PEG_DIAMETER / 2 * math.sin(tilt)) * math.tan(tilt)

    low, high = 0.0, 0.2
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if spanned(middle) < reach else (low, middle)
    return low


def scene(name, depth):
    """The peg, pressed at an angle into the hole and released at rest. No gravity."""
    tilt = tilt_for(depth)
    place = (PEG_DIAMETER / 2 * math.cos(tilt) - PEG_DIAMETER / 2 - CLEARANCE / 2 - OVERLAP, 0.0, -depth)
    turn = (math.cos(tilt / 2), 0.0, math.sin(tilt / 2), 0.0)
    quaternion = "(" + ", ".join(repr(round(c, 15)) for c in turn) + ")"
    limit = FRICTION * PEG_DIAMETER
    lines = [
        f"// {name}: insertion {depth} m, limit mu*D = {limit} m. Written by build.py.",
        "(",
        '    format: "pong-scene",',
        "    version: 1,",
        f'    name: "{name}",',
        '    models: { "peg": "peg.ron", "hole": "hole.ron" },',
        "    objects: [",
        '        (name: "hole", model: "hole", bodies: [(motion: Fixed)]),',
        '        (name: "peg", model: "peg", bodies: [(',
        "            motion: Free, mass: 1.0, inertia: Diagonal(0.004, 0.004, 0.00125), mass_center: (0.0, 0.0, 0.1),",
        f"            position: {numbers(g.rounded(place))}, orientation: {quaternion},",
        "        )]),",
        "    ],",
        '    pairs: [("peg", "hole")],',
        "    integrator: RungeKutta4,",
        "    step: 1e-4,",
        "    duration: 0.5,",
        "    record_every: 50,",
        "    ledger: true,",
        ")",
    ]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    scenes = {"scene_shallow.ron": scene("shallow", 0.03), "scene_deep.ron": scene("deep", 0.08)}
    a.main([peg(), hole()], HERE, scenes)

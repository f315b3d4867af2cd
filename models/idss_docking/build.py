#!/usr/bin/env python3
"""Builds two docking interfaces after the International Docking System Standard.

Made through the modelling toolkit: python build.py [FOLDER] [--blend FILE] with Blender as a Python module. It writes
idss_active.ron, idss_passive.ron and the scene. Every dimension stands in dimensions.py; README.md says where each comes from.

Both sides are drawn in their own docking frame: origin in the middle of the soft-capture ring's face, z out of the
vehicle. Mated, the passive frame is the active one turned by 180 degrees about x. Petals are facets of a cone, so
that a petal of one side fits between two of the other with the same clearance everywhere.
"""

import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import authoring as a  # noqa: E402
import geometry as g  # noqa: E402
import scenes  # noqa: E402
from dimensions import *  # noqa: E402, F403

# --- surfaces --------------------------------------------------------------------------------------------------------

SURFACES = {
    "structure": a.surface(1e6, normal=a.linear(damping=4400.0, ramp=0.0002), friction=a.bristle(mu=0.2)),
    "latch": a.surface(2e5, normal=a.linear(damping=60.0, ramp=0.0002), friction=a.bristle(mu=0.1)),
}

DOWN = (0.0, 0.0, -1.0)


# --- rings ---------------------------------------------------------------------------------------------------------

def radial_wall(azimuth, side):
    """Half space on one side (+1: of smaller azimuth) of the half plane through the axis at an azimuth."""
    return (g.scaled(g.cross(UP, g.on_circle(1.0, azimuth)), side), 0.0)


def ring_sector(name, azimuth, radii, heights):
    """One straight sector of a ring; its two ends are internal faces."""
    outwards = g.on_circle(1.0, azimuth)
    half_spaces = [
        (g.scaled(outwards, -1.0), -radii[0]),
        (outwards, radii[1]),
        (UP, heights[1]),
        (DOWN, -heights[0]),
        radial_wall(azimuth + STEP / 2, 1),
        radial_wall(azimuth - STEP / 2, -1),
    ]
    return a.polyhedron(name, half_spaces, inactive=(4, 5))


def facet_corner(radius, azimuth, z=0.0):
    """Corner of the polygon with flats at `radius`, at the smaller azimuth of a facet."""
    return g.on_circle(radius / math.cos(math.radians(STEP / 2)), azimuth - STEP / 2, z)


def ring(radii, heights, prefix):
    """A ring as a tree: three groups of sectors."""
    thirds = []
    for third in range(3):
        sectors = []
        for i in range(third * FACETS // 3, (third + 1) * FACETS // 3):
            sectors.append(ring_sector(f"{prefix}_{i:02}", i * STEP, radii, heights))
        thirds.append(a.group(f"{prefix}_third_{third}", primitives=sectors, bound="Above"))
    return thirds


def rim_segments(petals, z):
    """The inner edge between the side's own petals, where the other side's petals slide in."""
    lines = []
    for i in range(FACETS):
        azimuth = i * STEP
        nearest = min(abs((azimuth - p + 180.0) % 360.0 - 180.0) for p in petals)
        if nearest > 30.0:
            ends = (facet_corner(RIM_RADIUS, azimuth, z), facet_corner(RIM_RADIUS, azimuth + STEP, z))
            lines.append(a.segment(f"rim_{i:02}", *ends))
    return lines


# --- petals ----------------------------------------------------------------------------------------------------------

def on_cone(azimuth, facet, z):
    """Point on the outer side of the petals: facet given by its middle azimuth."""
    radius = (CONE_RADIUS - z) / math.cos(math.radians(azimuth - facet))
    return g.on_circle(radius, azimuth, z)


def cone_normal(facet):
    return g.unit(g.add(g.on_circle(1.0, facet), UP))


def petal(azimuth):
    """A petal as one convex piece, three facets outside and a flat inside, and its edges: (piece, segments)."""
    radial = g.on_circle(1.0, azimuth)
    skins = [g.plane(cone_normal(facet), on_cone(facet, facet, 0.0)) for facet in (azimuth - STEP, azimuth, azimuth + STEP)]
    root_inside = g.on_circle(PETAL_ROOT_INSIDE, azimuth)
    tip_inside = g.on_circle(PASSAGE_RADIUS, azimuth, PETAL_HEIGHT)
    middle = on_cone(azimuth, azimuth, 0.0)
    inside = g.plane_through(root_inside, tip_inside, g.add(tip_inside, g.cross(UP, radial)), middle)
    half_spaces = skins + [inside]
    segments = []
    tips = []
    for side, label in ((-1, "left"), (1, "right")):
        root = on_cone(azimuth + side * PETAL_ROOT_HALF_ANGLE, azimuth + side * STEP, 0.0)
        tip = on_cone(azimuth + side * PETAL_TIP_HALF_ANGLE, azimuth, PETAL_HEIGHT)
        flank = g.plane_through(root, tip, (0.0, 0.0, PETAL_HEIGHT / 2), middle)
        knee = g.rounded(g.meet(flank, skins[1], skins[1 + side]))
        half_spaces.append(flank)
        segments.append(a.segment(f"{label}_low_edge", root, knee))
        segments.append(a.segment(f"{label}_high_edge", knee, tip))
        tips.append(tip)
    half_spaces += [(DOWN, 0.0), (UP, PETAL_HEIGHT)]
    segments.append(a.segment("tip", *tips))
    return a.polyhedron("body", half_spaces), segments


def petal_groups(azimuths):
    groups = []
    for i, azimuth in enumerate(azimuths):
        body, segments = petal(azimuth)
        parts = [
            a.group("solid", primitives=[body], bound="Above"),
            a.group("edges", primitives=segments, bound="Above"),
        ]
        groups.append(a.group(f"petal_{i}", groups=parts, bound="Above"))
    return groups


# --- latches and strikers -----------------------------------------------------------------------------------------

def latch(i, azimuth):
    """A sliding pawl: catch face across the docking axis, bevelled nose along the petal."""
    profile = [(0.0, 0.0), (-0.030, 0.026), (-0.050, 0.026), (-0.050, 0.0)]  # (x, z): catch edge, nose, top, back
    half_spaces = []
    for (x0, z0), (x1, z1) in zip(profile, profile[1:] + profile[:1]):
        half_spaces.append(g.plane((z1 - z0, 0.0, x0 - x1), (x0, 0.0, z0)))
    half_spaces += [((0.0, 1.0, 0.0), LATCH_HALF_WIDTH), ((0.0, -1.0, 0.0), LATCH_HALF_WIDTH)]

    def across(name, x, z):
        return a.segment(name, (x, -LATCH_HALF_WIDTH, z), (x, LATCH_HALF_WIDTH, z))

    contents = [
        a.polyhedron("pawl", half_spaces),
        across("catch_edge", *profile[0]),
        across("nose_edge", *profile[1]),
    ]
    return a.group(
        f"latch_{i}",
        primitives=contents,
        bound="Sphere",
        surface="latch",
        movable=True,
        position=latch_tip(azimuth),
        orientation=g.quaternion_of_axes(*latch_frame(azimuth)),
    )


def striker(i, azimuth):
    """A bar behind the ring's edge: its slope is the cam, its back face holds the latch. z points out of the ring."""
    radial = g.on_circle(1.0, azimuth)
    along = g.cross(UP, radial)
    slope = g.unit(g.sub(UP, radial))  # towards the axis and out of the ring
    slope_point = g.on_circle(RIM_RADIUS + STRIKER_RECESS - STRIKER_FRONT, azimuth, -STRIKER_FRONT)
    half_spaces = [
        g.plane(slope, slope_point),
        (UP, -STRIKER_FRONT),
        (DOWN, STRIKER_BACK),
        (radial, RIM_RADIUS),
        (along, STRIKER_HALF_WIDTH),
        (g.scaled(along, -1.0), STRIKER_HALF_WIDTH),
    ]

    def edge(name, depth):
        inner = g.on_circle(RIM_RADIUS + STRIKER_RECESS - depth, azimuth, -depth)
        half = g.scaled(along, STRIKER_HALF_WIDTH)
        return a.segment(name, g.sub(inner, half), g.add(inner, half))

    contents = [a.polyhedron("bar", half_spaces), edge("front_edge", STRIKER_FRONT), edge("back_edge", STRIKER_BACK)]
    return a.group(f"striker_{i}", primitives=contents, bound="Above")


# --- the two sides -------------------------------------------------------------------------------------------------

def hard_ring(z):
    radii = (HARD_RING_INNER_RADIUS, HARD_RING_OUTER_RADIUS)
    return a.group("hard_ring", groups=ring(radii, (z - HARD_RING_HEIGHT, z), "hard"), bound="Above")


def active():
    """Origin: middle of the vehicle's hard-capture plane, z out of the vehicle. The soft-capture ring and its three
    latches are movable: the host supplies their states. A latch slides along its own x axis.
    """
    pads = []
    for i in range(PADS_PER_RING):
        pads.append(a.point(f"pad_{i:02}", g.on_circle(PAD_RADIUS, (i + 0.5) * 360.0 / PADS_PER_RING)))
    body = (RIM_RADIUS, RING_OUTER_RADIUS)
    ring_parts = [
        a.group("ring_body", groups=ring(body, (-RING_HEIGHT, 0.0), "sector"), bound="Above"),
        a.group("rim", primitives=rim_segments(ACTIVE_PETALS, 0.0), bound="Above"),
        a.group("pads", primitives=pads, bound="Above"),
    ]
    ring_parts += petal_groups(ACTIVE_PETALS)
    ring_parts += [latch(i, azimuth) for i, azimuth in enumerate(ACTIVE_PETALS)]
    soft_ring = a.group(
        "ring", groups=ring_parts, bound="Sphere", movable=True, position=(0.0, 0.0, RING_EXTENSION)
    )
    root = a.group("vehicle", groups=[hard_ring(0.0), soft_ring], bound="Aabb", surface="structure")
    return a.model("idss_active", SURFACES, root)


def passive():
    """Origin: middle of the soft-capture ring's face, z out of the vehicle."""
    plates = []
    for i in range(FACETS // 3):
        azimuth = i * 3 * STEP
        for k in (-1, 0, 1):
            facet = azimuth + k * STEP
            radii = (PLATE_INNER_RADIUS, PLATE_OUTER_RADIUS)
            sector = ring_sector(f"plate_{i}_{k + 1}", facet, radii, (-0.020, 0.0))
            plates.append(sector)
    body = (RIM_RADIUS, RING_OUTER_RADIUS)
    parts = [
        hard_ring(-RING_HEIGHT),
        a.group("ring_body", groups=ring(body, (-RING_HEIGHT, -PLATE_RELIEF), "sector"), bound="Above"),
        a.group("striker_plates", primitives=plates, bound="Above"),
        a.group("rim", primitives=rim_segments(PASSIVE_PETALS, -PLATE_RELIEF), bound="Above"),
    ]
    parts += petal_groups(PASSIVE_PETALS)
    # When mated, azimuth a of the active side is -a here.
    parts += [striker(i, -azimuth) for i, azimuth in enumerate(ACTIVE_PETALS)]
    root = a.group("vehicle", groups=parts, bound="Aabb", surface="structure")
    return a.model("idss_passive", SURFACES, root)


if __name__ == "__main__":
    a.main([active(), passive()], HERE, scenes.texts())

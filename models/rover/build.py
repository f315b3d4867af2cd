#!/usr/bin/env python3
"""Builds a rover on four wheels, the grounds it drives on, a wheel on a rig of several kinds, and their scenes.

Made through the modelling toolkit: python build.py [FOLDER] [--blend FILE] with Blender as a Python module. It writes
the models, terrain.obj and the scenes (scenes.py). Every dimension stands in dimensions.py; README.md says where each
comes from.

x is ahead, y to the left, z up. The rover's origin lies midway between its wheels, at the height of the axles. Hubs and
wheels are movable groups: hubs ride on the suspension's springs, wheels turn in the hubs' bearings.
"""

import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]
import authoring as a  # noqa: E402
import scenes  # noqa: E402
import terrain  # noqa: E402
import tyre  # noqa: E402
from dimensions import *  # noqa: E402, F403

TILE = 5.0  # length of ground whose rocks form a group, m


def soft(stiffness, damping, friction):
    return a.surface(stiffness, a.linear(damping, ramp=DAMPING_RAMP), friction)


SURFACES_OF_ROVER = {
    "tyre": soft(
        BALL_STIFFNESS, BALL_DAMPING, a.bristle(FRICTION, stiffness=BALL_BRISTLE, damping=BALL_BRISTLE_DAMPING)
    ),
    "stop": soft(STOP_STIFFNESS, STOP_DAMPING, a.bristle(FRICTION)),
    "frame": soft(FRAME_STIFFNESS, FRAME_DAMPING, a.bristle(FRICTION)),
}
SURFACES_OF_GROUND = {"stone": a.surface(math.inf, a.linear(0.0, ramp=DAMPING_RAMP), a.bristle(FRICTION))}


# --- wheels and rover ------------------------------------------------------------------------------------------------

def ring(name, count, radius, ring_radius):
    """Spheres around the axle, y; the first is lowest."""
    balls = []
    for i in range(count):
        angle = math.radians(360.0 * i / count)
        middle = (-ring_radius * math.sin(angle), 0.0, -ring_radius * math.cos(angle))
        balls.append(a.sphere(f"{name}_{i:02}", middle, radius))
    return balls


def wheel(name, position=None):
    tyre_ = a.group("tyre", primitives=ring("ball", BALLS, BALL_RADIUS, RING_RADIUS), surface="tyre")
    inner = ring("ball", STOP_BALLS, STOP_BALL_RADIUS, STOP_RADIUS - STOP_BALL_RADIUS)
    stop = a.group("stop", primitives=inner, surface="stop")
    return a.group(name, groups=[tyre_, stop], bound="Sphere", movable=True, position=position)


def hub(name, position):
    housing = a.sphere("housing", (0.0, 0.0, 0.0), HUB_RADIUS)
    return a.group(name, primitives=[housing], bound="Sphere", surface="frame", movable=True, position=position)


def frame():
    """Two longerons and three beams across, of capsules: the parts of the chassis that can hit rocks."""
    balls = []
    along = round(2 * FRAME_X / FRAME_PITCH)
    across = round(2 * FRAME_Y / FRAME_PITCH)
    for side, label in SIDES:
        for i in range(along + 1):
            balls.append(((-FRAME_X + i * FRAME_PITCH, side * FRAME_Y, FRAME_Z), f"longeron_{label}_{i:02}"))
    for where, x in (("front", FRAME_X), ("middle", 0.0), ("rear", -FRAME_X)):
        for i in range(1, across):
            balls.append(((x, -FRAME_Y + i * FRAME_PITCH, FRAME_Z), f"beam_{where}_{i:02}"))
    return [a.sphere(name, middle, FRAME_RADIUS) for middle, name in balls]


def rover():
    groups = [a.group("chassis", primitives=frame())]
    for name, place in WHEELS.items():
        groups += [hub(f"hub_{name}", place), wheel(f"wheel_{name}", place)]
    return a.model("rover", SURFACES_OF_ROVER, a.group("rover", groups=groups, surface="frame"))


# --- grounds ---------------------------------------------------------------------------------------------------------

def ground():
    """Infinite level ground."""
    floor = a.flat_ground("floor", (0.0, 0.0, 1.0), 0.0)
    return a.model("ground", SURFACES_OF_GROUND, a.group("ground", primitives=[floor], surface="stone"))


def relief():
    vertices, triangles = terrain.mesh()
    return a.triangle_mesh("relief", vertices, triangles, file="terrain.obj")


def rocky():
    rocks = terrain.places(ROCKS, 1, (0.06, 0.40), [])
    boulders = terrain.places(BOULDERS, 2, (0.06, 0.30), rocks)
    tiles = {}
    for i, (x, y, size, seed) in enumerate(rocks):
        tiles.setdefault(int(x / TILE), []).append(a.polyhedron(f"rock_{i:02}", terrain.rock(x, y, size, seed)))
    for i, (x, y, size, _) in enumerate(boulders):
        tiles.setdefault(int(x / TILE), []).append(a.sphere(f"boulder_{i:02}", *terrain.boulder(x, y, size)))
    rocks_ = [a.group(f"tile_{i}", primitives=tiles[i]) for i in sorted(tiles)]
    groups = [a.group("ground", primitives=[relief()]), a.group("rocks", groups=rocks_)]
    return a.model("terrain", SURFACES_OF_GROUND, a.group("terrain", groups=groups, surface="stone"))


def block(name, x, y, z, slope=0.0):
    """A block between limits along x, y and z, whose ends slope in by `slope`, metres in its height."""
    half_spaces = [
        ((0.0, 0.0, 1.0), z[1]), ((0.0, 0.0, -1.0), -z[0]),
        ((0.0, 1.0, 0.0), y[1]), ((0.0, -1.0, 0.0), -y[0]),
    ]
    tall = z[1] - z[0]
    length = math.hypot(tall, slope)
    for end in (0, 1):
        out = 2 * end - 1
        normal = (out * tall / length, 0.0, slope / length)
        half_spaces.append((normal, normal[0] * x[end] + normal[2] * z[0]))
    return a.polyhedron(name, half_spaces)


def step():
    """Level ground with a step up."""
    floor = a.flat_ground("floor", (0.0, 0.0, 1.0), 0.0)
    rise = block("step", (0.0, 3.0), (-1.0, 1.0), (-0.5, scenes.STEP))
    return a.model("step", SURFACES_OF_GROUND, a.group("step", groups=[
        a.group("floor", primitives=[floor]), a.group("rise", primitives=[rise]),
    ], surface="stone"))


def stone():
    """Level ground with a stone in the way of the left wheels."""
    floor = a.flat_ground("floor", (0.0, 0.0, 1.0), 0.0)
    middle = TRACK / 2
    rock = block("stone", (-0.35, 0.35), (middle - 0.3, middle + 0.3), (-0.1, scenes.STONE), slope=0.2)
    return a.model("stone", SURFACES_OF_GROUND, a.group("stone", groups=[
        a.group("floor", primitives=[floor]), a.group("rock", primitives=[rock]),
    ], surface="stone"))


def track():
    """A strip of triangles: a stone beside the wheel's path at x = 2, a bar across it at x = 4."""
    columns = [round(-1.0 + CELL * i, 9) for i in range(29)]
    vertices = [(x, y, 0.0) for x in columns for y in (-0.75, -0.25, 0.25, 0.75)]
    triangles = []
    for i in range(len(columns) - 1):
        for j in range(3):
            corner = 4 * i + j
            triangles += [(corner, corner + 4, corner + 5), (corner, corner + 5, corner + 1)]
    beside = block("beside", (1.9, 2.1), (0.2, 0.5), (-0.1, 0.2))
    bar = block("bar", (3.95, 4.05), (-0.5, 0.5), (-0.1, scenes.BAR))
    return a.model("track", SURFACES_OF_GROUND, a.group("track", groups=[
        a.group("strip", primitives=[a.triangle_mesh("strip", vertices, triangles)]),
        a.group("stones", primitives=[beside, bar]),
    ], surface="stone"))


# --- one wheel on a rig ------------------------------------------------------------------------------------------------

def rig(name, tread, stiffness, damping):
    """A carriage with one wheel, of the primitives `tread`."""
    friction = a.bristle(FRICTION, stiffness=2 * stiffness, damping=BALL_BRISTLE_DAMPING)
    surfaces = {"tyre": soft(stiffness, damping, friction), "frame": SURFACES_OF_ROVER["frame"]}
    carriage = a.group("carriage", primitives=[a.sphere("axle", (0.0, 0.0, 0.0), HUB_RADIUS)], surface="frame")
    turning = a.group("wheel", primitives=tread, bound="Sphere", surface="tyre", movable=True)
    return a.model(name, surfaces, a.group(name, groups=[carriage, turning]))


def rigs():
    # One primitive should sink under the weight as the ring of spheres does.
    one = round(tyre.CORNER_WEIGHT / (WHEEL_RADIUS - tyre.STATIC_HEIGHT), -1)
    egg = a.ellipsoid("tread", (0.0, 0.0, 0.0), (WHEEL_RADIUS, WHEEL_WIDTH / 2, WHEEL_RADIUS))
    ball = a.sphere("tread", (0.0, 0.0, 0.0), WHEEL_RADIUS)
    drum = a.cylinder("tread", (0.0, -WHEEL_WIDTH / 2, 0.0), (0.0, WHEEL_WIDTH / 2, 0.0), WHEEL_RADIUS)
    return [
        rig("rig_balls", ring("ball", BALLS, BALL_RADIUS, RING_RADIUS), BALL_STIFFNESS, BALL_DAMPING),
        rig("rig_ellipsoid", [egg], one, 6 * BALL_DAMPING),
        rig("rig_sphere", [ball], one, 6 * BALL_DAMPING),
        rig("rig_cylinder", [drum], one, 6 * BALL_DAMPING),
        rig("rig_rigid", [egg], RIGID_STIFFNESS, RIGID_DAMPING),
    ]


if __name__ == "__main__":
    a.main([rover(), ground(), rocky(), step(), stone(), track(), *rigs()], HERE, scenes.texts())

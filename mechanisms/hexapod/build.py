#!/usr/bin/env python3
"""Builds foot.ron, plane.ron and terrain.ron with terrain.obj through the modelling toolkit: python build.py [FOLDER]
[--blend FILE], with Blender as a Python module.
"""

import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent.parent / "models")]
import authoring as a  # noqa: E402
import dimensions as d  # noqa: E402

ROCK = {"rock": a.surface(float("inf"), friction=a.bristle(d.FRICTION))}
DECIMALS = 4  # of heights


def foot():
    """A ball at the end of a tibia, in the frame of the tibia's joint."""
    ball = a.sphere("ball", (d.TIBIA, 0.0, 0.0), d.FOOT_RADIUS)
    rubber = a.surface(d.STIFFNESS, a.linear(d.DAMPING), a.bristle(d.FRICTION, damping=d.STICKING_DAMPING))
    return a.model("foot", {"rubber": rubber}, a.group("foot", primitives=[ball], surface="rubber"))


def plane():
    top = a.flat_ground("top", (0.0, 0.0, 1.0), 0.0)
    return a.model("plane", ROCK, a.group("plane", primitives=[top], surface="rock"))


def height(x, y):
    """Height of the terrain; equal at both ends of a tile."""
    turns = (
        (tall, along * x / d.TILE + across * y / (2 * d.TILE_HALF_WIDTH), p) for tall, along, across, p in d.WAVES
    )
    return round(sum(tall * math.sin(2 * math.pi * turn + phase) for tall, turn, phase in turns), DECIMALS)


def relief():
    """Squares cut into two triangles."""
    columns, rows = round(d.TILE / d.CELL) + 1, round(2 * d.TILE_HALF_WIDTH / d.CELL) + 1
    places = [(i % (columns - 1), i, j) for i in range(columns) for j in range(rows)]
    across = [round(j * d.CELL - d.TILE_HALF_WIDTH, DECIMALS) for j in range(rows)]
    vertices = [(round(i * d.CELL, DECIMALS), across[j], height(k * d.CELL, across[j])) for k, i, j in places]
    triangles = []
    for i in range(columns - 1):
        for j in range(rows - 1):
            corner = i * rows + j
            triangles.append((corner, corner + rows, corner + rows + 1))
            triangles.append((corner, corner + rows + 1, corner + 1))
    return vertices, triangles


def terrain():
    mesh = a.triangle_mesh("relief", *relief(), thickness=0.05, file="terrain.obj")
    return a.model("terrain", ROCK, a.group("terrain", primitives=[mesh], surface="rock"))


if __name__ == "__main__":
    a.main([foot(), plane(), terrain()], HERE)

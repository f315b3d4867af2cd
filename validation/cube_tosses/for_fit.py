"""Writes the cube tosses as a scene and a data file for `pong fit` (docs/fit.md):

python3 -m validation.cube_tosses.for_fit DIR [PART]

tosses.csv has the records around a touch of every third toss, from toss PART (0, 1 or 2; 0 unless given): three sets that
share no toss. whole.csv has the poses of all whole tosses, for `--momentum`.
"""

import sys
from pathlib import Path

import numpy as np

from validation.cube_tosses import data
from validation.cube_tosses.data import CORNERS, FRAME, lowest_corner
from validation.cube_tosses.engines.with_pong import TABLE

RECORDS = 165
FRAMES = 26  # of a record
BEFORE = 2  # frames before the touch
# Standard deviations of one axis.
NOISE = {"position": 0.0005, "rotation": 0.008, "velocity": 0.02, "angular_velocity": 0.3}
POSE = "record,time,x,y,z,qw,qx,qy,qz"
COLUMNS = f"{POSE},vx,vy,vz,wx,wy,wz"
# The damping of the law sets in over a depth, so that the force is continuous.
CUBE = """(
    format: "pong-model", version: 1, name: "cube",
    surfaces: {{ "acrylic": (stiffness: 2e4, normal: Linear(damping: 30, ramp: 5e-4), friction: Bristle(mu: 0.2, stiffness: 1.3e4, damping: 30)) }},
    root: (name: "cube", surface: "acrylic", primitives: [{points}]),
)"""
SCENE = """(
    format: "pong-scene", version: 1, name: "toss", models: { "cube": "cube.ron", "table": "table.ron" },
    objects: [
        (name: "cube", model: "cube", bodies: [(motion: Free, mass: 0.37, inertia: Diagonal(8.1e-4, 8.1e-4, 8.1e-4), position: (0, 0, 0.2))]),
        (name: "table", model: "table", bodies: [(motion: Fixed, position: (0, 0, -0.00117))]),
    ],
    pairs: [("cube", "table")], gravity: (0, 0, -9.81), integrator: RungeKutta4, step: 6.76e-4, duration: 0.2,
)"""


def records(tosses, part=0):
    """Number and frames of every third toss that has enough of them around its first touch."""
    found = []
    for number in range(part, len(tosses), 3):
        below = np.flatnonzero(lowest_corner(tosses[number]) < 0.0)
        first = int(below[0]) - BEFORE if len(below) else -1
        if first >= 0 and first + FRAMES <= len(tosses[number]):
            found.append((number, tosses[number][first : first + FRAMES]))
    return found[:RECORDS]


def text(chosen):
    """Text of the data file."""
    lines = [f"# noise.{name} = {value}" for name, value in NOISE.items()] + ["# angular_velocity = body", COLUMNS]
    return "\n".join(lines + rows(chosen)) + "\n"


def rows(chosen):
    """Lines of records, by number."""
    return [
        f"{number},{frame * FRAME:.9f}," + ",".join(f"{value:.9g}" for value in state)
        for number, states in chosen
        for frame, state in enumerate(states)
    ]


def write(folder, part=0):
    """Writes toss.ron, cube.ron, table.ron, tosses.csv and whole.csv."""
    folder.mkdir(parents=True, exist_ok=True)
    points = ", ".join(
        f'Point(name: "p{number}", position: ({", ".join(repr(float(x)) for x in corner)}))'
        for number, corner in enumerate(CORNERS)
    )
    tosses = data.load()
    files = {
        "toss.ron": SCENE,
        "cube.ron": CUBE.format(points=points),
        "table.ron": TABLE,
        "tosses.csv": text(records(tosses, part)),
        "whole.csv": "\n".join([POSE, *rows((number, toss[:, :7]) for number, toss in enumerate(tosses))]) + "\n",
    }
    for name, content in files.items():
        (folder / name).write_text(content)
    print(f"{folder}: {', '.join(files)}")


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3) or sys.argv[2:] not in ([], ["0"], ["1"], ["2"]):
        sys.exit("usage: python3 -m validation.cube_tosses.for_fit DIR [PART], PART 0, 1 or 2")
    write(Path(sys.argv[1]), *map(int, sys.argv[2:]))

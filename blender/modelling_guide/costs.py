# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures the costs of primitives, bounds and leaves stated in docs/modelling.md, and writes its tables.

    python3 costs.py [--pong FILE] [--rounds N] [--print]

Every row is a scene that `pong run` runs. A time is the median time per step that it prints, less that of the same scene
without pairs, both the least of the rounds: all evaluation of contact and nothing of the motion.
"""

import argparse
import csv
import math
import pathlib
import re
import subprocess
import tempfile
from dataclasses import dataclass

PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs/modelling.md"


# --- models and scenes as text -------------------------------------------------------------------------------------


def vector(values):
    return "(" + ", ".join(repr(float(v)) for v in values) + ")"


def point(name, place):
    return f'Point(name: "{name}", position: {vector(place)})'


def segment(name, start, end):
    return f'LineSegment(name: "{name}", ends: ({vector(start)}, {vector(end)}))'


def polyhedron(name, vertices, faces):
    return f'Polyhedron(name: "{name}", vertices: [{", ".join(map(vector, vertices))}], faces: {faces})'


BOX_FACES = [[0, 1, 3, 2], [2, 3, 7, 6], [6, 7, 5, 4], [4, 5, 1, 0], [2, 6, 4, 0], [7, 3, 1, 5]]
BOX_EDGES = [(a, b) for a in range(8) for b in range(a + 1, 8) if bin(a ^ b).count("1") == 1]


def corners(low, high):
    return [(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])]


def box_solid(name, low, high):
    return [polyhedron(name, corners(low, high), BOX_FACES)]


def box_corners(low, high):
    return [point(f"corner_{i}", place) for i, place in enumerate(corners(low, high))]


def box_edges(low, high):
    places = corners(low, high)
    return [segment(f"edge_{a}_{b}", places[a], places[b]) for a, b in BOX_EDGES]


def group(name, primitives, bound="Aabb"):
    return f'(name: "{name}", bound: {bound}, primitives: [{", ".join(primitives)}])'


def model(name, content, stiffness, bound="Aabb", damping=0.0, contact="Marked"):
    """`content`: primitives, or groups as text. Stiffness in N/m (0: rigid), damping in N·s/m, of each contact, or of a
    solid over its default area."""
    what = "groups" if content[0].startswith("(") else "primitives"
    surface = f'"s": (stiffness: {stiffness}, normal: Linear(damping: {float(damping)!r}))' if stiffness else '"s": (stiffness: inf)'
    return (f'(format: "pong-model", version: 1, name: "{name}", surfaces: {{ {surface} }}, '
            f'root: (name: "{name}", bound: {bound}, surface: "s", contact: {contact}, {what}: [{", ".join(content)}]))')


@dataclass
class Case:
    """Two models, the motion of the first, and the duration."""

    label: str
    a: str
    b: str
    motion: str
    step: float = 1e-4
    duration: float = 1.0

    def scene(self, paired):
        return (f'(format: "pong-scene", version: 1, name: "case", models: {{ "a": "a.ron", "b": "b.ron" }}, objects: ['
                f'(name: "a", model: "a", bodies: [({self.motion})]), (name: "b", model: "b", bodies: [(motion: Fixed)])], '
                f'pairs: [{"(" + chr(34) + "a" + chr(34) + ", " + chr(34) + "b" + chr(34) + ")" if paired else ""}], '
                f'gravity: (0.0, 0.0, -9.81), integrator: SemiImplicitEuler, step: {self.step}, duration: {self.duration}, '
                f'record_every: 100)')


@dataclass
class Outcome:
    """Results of a run."""

    us: float  # time of contact per step
    states: list  # rows of states.csv of the first body
    contacts: int  # in the last record


def run(case, options):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "a.ron").write_text(case.a)
        (folder / "b.ron").write_text(case.b)
        for paired in (True, False):
            (folder / f"{paired}.ron").write_text(case.scene(paired))
        least = {True: math.inf, False: math.inf}
        for _ in range(options.rounds):
            for paired in least:
                least[paired] = min(least[paired], step_us(folder, f"{paired}.ron", options))
        return Outcome(least[True] - least[False], *last_of(folder / "out"))


def step_us(folder, scene, options):
    more = ["-o", str(folder / "out")] if scene == "True.ron" else []
    done = subprocess.run([options.pong, "run", scene, *more], cwd=folder, capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"{scene}: {done.stderr[:2000]}")
    return float(re.search(r"Time per step: median ([\d.]+) µs", done.stdout)[1])


def last_of(folder):
    rows = list(csv.reader((folder / "states.csv").open()))
    states = [[float(x) for x in row[2:9]] for row in rows[1:] if row[1] == "a"]
    contacts = list(csv.reader((folder / "contacts.csv").open()))[1:]
    end = rows[-1][0]
    return states, sum(row[0] == end for row in contacts)


# --- a box on a floor and on a rail --------------------------------------------------------------------------------

LOW, HIGH = (-0.1, -0.1, 0.0), (0.1, 0.1, 0.1)
GROUNDS = {"floor": ((-1.0, -1.0, -0.1), (1.0, 1.0, 0.0)), "rail": ((-0.06, -1.0, -0.1), (0.06, 1.0, 0.0))}
BOX_MOTION = ("motion: Free, mass: 2.0, inertia: Diagonal(0.0083, 0.0083, 0.0133), mass_center: (0.0, 0.0, 0.05), "
              "orientation: (0.9999995, 0.0007, 0.0, 0.0007)")


def bottom_grid(count):
    places = [(-0.1 + 0.2 * i / (count - 1), -0.1 + 0.2 * j / (count - 1), 0.0) for i in range(count) for j in range(count)]
    return [point(f"point_{i}", place) for i, place in enumerate(places)]


def box_cases(ground):
    """Label -> (primitives of the box, of the ground)."""
    low, high = GROUNDS[ground]
    solid = box_solid("ground", low, high)
    edges = box_edges(low, high) + box_corners(low, high)
    return {
        "8 points | polyhedron": (box_corners(LOW, HIGH), solid),
        "25 points below | polyhedron": (bottom_grid(5), solid),
        "12 segments | polyhedron": (box_edges(LOW, HIGH), solid),
        "polyhedron | 12 segments, 8 points": (box_solid("box", LOW, HIGH), edges),
        "polyhedron, 12 segments | the same": (box_solid("box", LOW, HIGH) + box_edges(LOW, HIGH),
                                               solid + box_edges(low, high)),
        "solid | solid": (box_solid("box", LOW, HIGH), solid),
    }


def box_table(options):
    rows = []
    for label in box_cases("floor"):
        cells = label.split(" | ")
        for ground in GROUNDS:
            a, b = box_cases(ground)[label]
            contact = "Solid" if label.startswith("solid") else "Marked"
            models = model("a", a, 1e5, damping=100.0, contact=contact), model("b", b, 0, contact=contact)
            done = run(Case(label, *models, BOX_MOTION), options)
            cells += [rested(done), f"{done.us:.2f}"]
        rows.append(cells)
    return ["box is", "ground is", "on the floor", "µs", "on the rail", "µs"], rows


def rested(done):
    x, y, z, w, i, j, _k = done.states[-1]
    upright = 1.0 - 2.0 * (i * i + j * j)
    if z < -0.01 or upright < 0.99:
        return "falls through" if abs(upright) > 0.99 else "tips off"
    return f"rests, {done.contacts} contacts"


# --- a wheel on a floor --------------------------------------------------------------------------------------------

RADIUS, HALF_WIDTH, SPEED, LOAD = 0.25, 0.05, 0.1, 50.0
WHEEL_MOTION = (f"motion: Free, mass: {LOAD}, inertia: Diagonal(1e6, 1e6, 1e6), position: (0.0, 0.0, {RADIUS}), "
                f"linear_velocity: ({SPEED}, 0.0, 0.0), angular_velocity: (0.0, {SPEED / RADIUS}, 0.0)")
FLOOR = ((-1.0, -1.0, -0.1), (2.0, 1.0, 0.0))


def rim(count, y):
    return [(RADIUS * math.sin(2 * math.pi * i / count), y, -RADIUS * math.cos(2 * math.pi * i / count)) for i in range(count)]


def rim_segments(count):
    ends = zip(rim(count, -HALF_WIDTH), rim(count, HALF_WIDTH))
    return [segment(f"tread_{i}", a, b) for i, (a, b) in enumerate(ends)]


def rim_points(count):
    return [point(f"tread_{i}", p) for i, p in enumerate(rim(count, -HALF_WIDTH) + rim(count, HALF_WIDTH))]


def rim_solid(count):
    sides = [[count + i, count + (i + 1) % count, (i + 1) % count, i] for i in range(count)]
    faces = [*sides, [*range(count)], [*range(count, 2 * count)][::-1]]
    return [polyhedron("wheel", rim(count, -HALF_WIDTH) + rim(count, HALF_WIDTH), faces)]


def floor_mesh(cells=30):
    width = (FLOOR[1][0] - FLOOR[0][0]) / cells
    count = cells + 1
    places = [(FLOOR[0][0] + width * i, -1.0 + 2.0 * j / cells, 0.0) for i in range(count) for j in range(count)]
    triangles = []
    for i in range(cells):
        for j in range(cells):
            a, b, c, d = i * count + j, (i + 1) * count + j, (i + 1) * count + j + 1, i * count + j + 1
            triangles += [(a, b, c), (a, c, d)]
    text = ", ".join(f"({a}, {b}, {c})" for a, b, c in triangles)
    return [f'TriangleMesh(name: "floor", vertices: [{", ".join(map(vector, places))}], triangles: [{text}])']


def wheel_cases():
    solid, mesh = box_solid("floor", *FLOOR), floor_mesh()
    ball = [f'Sphere(name: "wheel", center: (0.0, 0.0, 0.0), radius: {RADIUS})']
    egg = [f'Ellipsoid(name: "wheel", center: (0.0, 0.0, 0.0), semi_axes: ({RADIUS}, {HALF_WIDTH}, {RADIUS}))']
    rails = [segment(f"rail_{i}", (-1.0, y, 0.0), (2.0, y, 0.0)) for i, y in enumerate((-0.03, 0.03))]
    return {
        "sphere | polyhedron": (ball, solid),
        "sphere | 1,800 triangles": (ball, mesh),
        "ellipsoid | polyhedron": (egg, solid),
        "ellipsoid | 1,800 triangles": (egg, mesh),
        "24 segments across | polyhedron": (rim_segments(24), solid),
        "96 segments across | polyhedron": (rim_segments(96), solid),
        "2 × 24 points | polyhedron": (rim_points(24), solid),
        "polyhedron of 24 sides | 2 segments along": (rim_solid(24), rails),
        "polyhedron of 96 sides | 2 segments along": (rim_solid(96), rails),
    }


def wheel_table(options):
    rows = []
    for label, (a, b) in wheel_cases().items():
        done = run(Case(label, model("a", a, 1e6, damping=4e3), model("b", b, 0), WHEEL_MOTION, duration=4.0), options)
        heights = [row[2] for row in done.states[len(done.states) // 4 :]]
        rows.append([*label.split(" | "), f"{1e3 * (max(heights) - min(heights)):.3f}", f"{done.us:.2f}"])
    return ["wheel is", "floor is", "axle moves up and down, mm", "µs"], rows


# --- bounds and leaves ---------------------------------------------------------------------------------------------

SWAY = "motion: Prescribed(Sinusoid(axis: (0.0, 0.0, 1.0), travel: 0.001, frequency: 10.0))"
GRID, PITCH, ROD = 8, 0.1, 64


def slanted(x, y, along, aside=0.0):
    """A point on a rod through (x, y) along (1, 1, 1)."""
    return (x + along + aside, y + along - aside, along)


def rods(bound):
    """64 slanted rods of 64 points, each a leaf."""
    return [group(f"rod_{i}_{j}", [point(f"p_{n}", slanted(i * PITCH, j * PITCH, 0.6 * n / ROD)) for n in range(ROD)], bound)
            for i in range(GRID) for j in range(GRID)]


def bars(bound):
    """64 slanted bars, each a leaf, beside the rods; every eighth one is touched."""
    made = []
    for i in range(GRID):
        for j in range(GRID):
            gap = -0.001 if (i + j) % 8 == 0 else 0.02
            ends = [slanted(i * PITCH + gap + dx, j * PITCH + dy, along)
                    for along in (0.0, 0.6) for dx in (0.0, 0.01) for dy in (-0.01, 0.01)]
            made.append(group(f"bar_{i}_{j}", [polyhedron("bar", ends, hull_faces(ends))], bound))
    return made


def hull_faces(places):
    """Faces of a sheared box with corners in the order of `corners`, with outward normals."""
    middle = [sum(p[k] for p in places) / 8 for k in range(3)]
    faces = []
    for face in BOX_FACES:
        a, b, c = (places[i] for i in face[:3])
        u, v = [b[k] - a[k] for k in range(3)], [c[k] - b[k] for k in range(3)]
        normal = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        outward = sum(n * (a[k] - middle[k]) for k, n in enumerate(normal)) > 0.0
        faces.append(face if outward else face[::-1])
    return faces


def bound_table(options):
    rows = []
    for bound in ("Aabb", "Sphere", "Obb"):
        case = Case(bound, model("a", rods(bound), 1e5, bound), model("b", bars(bound), 0, bound), SWAY, duration=0.2)
        done = run(case, options)
        rows.append([f"64 `{bound}`", str(done.contacts), f"{done.us:.1f}"])
    single = Case("one leaf", model("a", leaf_of(rods("Aabb")), 1e5), model("b", leaf_of(bars("Aabb")), 0), SWAY, duration=0.2)
    done = run(single, options)
    rows.append(["all in one leaf", str(done.contacts), f"{done.us:.1f}"])
    return ["bounds of the leaves", "contacts", "µs"], rows


def leaf_of(groups):
    """Primitives of all leaves in one."""
    found = []
    for index, text in enumerate(groups):
        inner = text[text.index("[") + 1 : text.rindex("]")]
        found.append(inner.replace('name: "', f'name: "g{index}_'))
    return found


SIDE, SPACING = 64, 0.02


def leaf_table(options):
    """A sheet of 4,096 points over 256 tiles, some of them raised, in leaves of different sizes."""
    tiles = [polyhedron(f"tile_{i}_{j}", *tile(i, j)) for i in range(16) for j in range(16)]
    rows = []
    for side in (64, 16, 8, 4, 2, 1):
        leaves = [group(f"leaf_{i}_{j}", [point(f"p_{x}_{y}", (SPACING * x, SPACING * y, 0.0))
                                          for x in range(i, i + side) for y in range(j, j + side)])
                  for i in range(0, SIDE, side) for j in range(0, SIDE, side)]
        done = run(Case(str(side), model("a", leaves, 1e5), model("b", tiles, 0), SWAY, duration=0.2), options)
        rows.append([f"{side * side:,}", f"{len(leaves):,}", str(done.contacts), f"{done.us:.1f}"])
    return ["points in a leaf", "leaves", "contacts", "µs"], rows


def tile(i, j):
    top = 0.002 if (3 * i + 5 * j) % 32 == 0 else -0.03
    low = (0.08 * i - 0.01, 0.08 * j - 0.01, -0.05)
    return corners(low, (low[0] + 0.079, low[1] + 0.079, top)), BOX_FACES


TABLES = {"box": box_table, "wheel": wheel_table, "bounds": bound_table, "leaves": leaf_table}


# --- the page ------------------------------------------------------------------------------------------------------


def as_text(head, rows):
    widths = [max(len(row[k]) for row in [head, *rows]) for k in range(len(head))]
    lines = ["| " + " | ".join(cell.ljust(width) for cell, width in zip(row, widths)) + " |" for row in [head, *rows]]
    return "\n".join([lines[0], "|" + "|".join("-" * (width + 2) for width in widths) + "|", *lines[1:]])


def put(page, name, text):
    begin, end = f"<!-- measured: {name} -->", f"<!-- end: {name} -->"
    before, rest = page.split(begin)
    return f"{before}{begin}\n\n{text}\n\n{end}{rest.split(end)[1]}"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--pong", default="pong", help="the program; a release build")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--print", action="store_true", help="leave the page as it is")
    parser.add_argument("--only", choices=TABLES)
    options = parser.parse_args()
    for name, measure in TABLES.items():
        if options.only not in (None, name):
            continue
        text = as_text(*measure(options))
        print(f"{name}\n{text}\n")
        if not options.print:
            PAGE.write_text(put(PAGE.read_text(), name, text))


main()

#!/usr/bin/env python3
"""Drops meshes on a plane and on each other: they must come to rest, and energy must never be gained.

    python3 drop_meshes.py PONG CACHE               the meshes of meshes.toml, got by fetch_meshes.py CACHE before
    python3 drop_meshes.py PONG CACHE --only mug    one mesh
    python3 drop_meshes.py PONG --made              five meshes that this program makes: no network needed

PONG is the program `pong`. Standard library only, Python 3.11. Each mesh is turned at random (the same way every time) and
dropped on a plane, and then on another mesh, which falls on the plane below it: the next convex one of the table, or with
--neighbours the next one. Where two meshes that are not convex are refused, the lower one is divided by `pong decompose`.
Prints a row for each run; exit status 1 if a run does not pass.
"""

import argparse
import concurrent.futures
import csv
import math
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import made_meshes  # noqa: E402

TABLE = pathlib.Path(__file__).resolve().parent / "meshes.toml"
G = 9.81  # m/s²
DENSITY = 1000.0  # kg/m³
SINK = 5e-4  # depth, over the size, at which 1/20 of size² carries the weight
DAMPING_RATIO = 0.2  # there
FRICTION = 0.5
STEP = 0.1  # over the time √(sink/g), in which the nominal depth answers
# Drag on rotation only, as of air: without it round bodies roll for a long time, as solids have no rolling resistance. A
# body of the inertia 0.1·m·size² loses its spin in this time over √(size/g).
DRAG_TIME = 0.5
FALLS = 30  # duration of a run, in times √(size/g)
# What is not at rest then falls again for this many times as long: a round body that leans on another one rolls along it
# slowly until it lies, because the drag holds it back, and nothing else does.
LONGER = 5
# Start poses, quaternions (w, x, y, z), of bodies that lie on a round side and whose centre of mass is beside its axis: they
# roll for minutes towards the place where it is lowest, against the drag. The spool falls on an end.
START = {"spool": (math.sqrt(0.5), 0.0, math.sqrt(0.5), 0.0)}
DROP = 0.1  # height of the fall over the size
AT_REST = 1e-3  # speed at the end over √(g·size); angular speed times size likewise
GAINED = 1e-3  # growth of the mechanical energy over what was lost in the run


# --- meshes -----------------------------------------------------------------------------------------------------------

def read_obj(path):
    vertices, triangles = [], []
    for line in path.read_text(encoding="utf-8").splitlines():
        kind, *fields = line.split() or [""]
        if kind == "v":
            vertices.append(tuple(map(float, fields)))
        elif kind == "f":
            triangles.append(tuple(int(field.split("/")[0]) - 1 for field in fields))
    return vertices, triangles


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def mass_properties(vertices, triangles):
    """Mass, centre and the inertia (xx, yy, zz, xy, xz, yz) about it of the even body inside a closed mesh."""
    volume, first, second = 0.0, [0.0] * 3, [[0.0] * 3 for _ in range(3)]
    for corners in triangles:
        a, b, c = (vertices[i] for i in corners)
        part = dot(a, cross(b, c)) / 6
        total = [a[i] + b[i] + c[i] for i in range(3)]
        volume += part
        for i in range(3):
            first[i] += part * total[i] / 4
            for j in range(3):
                squares = a[i] * a[j] + b[i] * b[j] + c[i] * c[j]
                second[i][j] += part * (total[i] * total[j] + squares) / 20
    center = [moment / volume for moment in first]
    spread = [[DENSITY * (second[i][j] - volume * center[i] * center[j]) for j in range(3)] for i in range(3)]
    diagonal = [spread[1][1] + spread[2][2], spread[0][0] + spread[2][2], spread[0][0] + spread[1][1]]
    return DENSITY * volume, center, [*diagonal, -spread[0][1], -spread[0][2], -spread[1][2]]


class Mesh:
    """A closed mesh with its mass, and the names of its files."""

    def __init__(self, name, vertices, triangles):
        self.name, self.vertices, self.triangles = name, vertices, triangles
        self.mass, self.center, self.inertia = mass_properties(vertices, triangles)
        extents = [max(v[i] for v in vertices) - min(v[i] for v in vertices) for i in range(3)]
        self.size = max(extents)

    def foundation(self):
        return self.mass * G / (0.05 * self.size**2 * SINK * self.size)


def from_cache(cache, most):
    """Meshes of the table that are solids: closed, not crossing themselves, no pinched vertex."""
    rows = tomllib.loads(TABLE.read_text(encoding="utf-8"))["mesh"]
    sound = [row for row in rows if row["closed"] and not row["piercing_pairs"] and not row["pinched_vertices"]]
    for row in sound:
        path = cache / f"{row['name']}.obj"
        if not path.exists():
            sys.exit(f"{path} is missing; run fetch_meshes.py {cache}")
    names = [row["name"] for row in sound if row["triangles"] <= most]
    convex = {row["name"] for row in sound if row["convex"]}
    return [Mesh(name, *read_obj(cache / f"{name}.obj")) for name in names], convex


def below(meshes, number, convex):
    """The mesh on which another one is dropped: the next one that is convex, or the next one if `convex` is None."""
    after = [*meshes[number + 1 :], *meshes[:number]]
    return next(mesh for mesh in after if convex is None or mesh.name in convex)


# --- scenes -----------------------------------------------------------------------------------------------------------

def numbers(values):
    return "(" + ", ".join(f"{value:.12g}" for value in values) + ")"


def surface(mesh):
    """Stiffness of 1e5 N/m over the area that K makes of it, and damping in proportion."""
    frequency = math.sqrt(G / (SINK * mesh.size))
    return (
        f'"s": (stiffness: 1e5, foundation: {mesh.foundation():.6e}, normal: Linear(damping: '
        f"{1e5 * 2 * DAMPING_RATIO / frequency:.6g}), friction: Bristle(mu: {FRICTION}))"
    )


def write_mesh(mesh, folder):
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in mesh.vertices]
    lines += ["f " + " ".join(str(i + 1) for i in corners) for corners in mesh.triangles]
    (folder / f"{mesh.name}.obj").write_text("\n".join(lines) + "\n", encoding="utf-8")


def whole(mesh, folder):
    """Writes the model of a mesh as it is."""
    write_mesh(mesh, folder)
    primitive = f'TriangleMesh(name: "mesh", file: "{mesh.name}.obj")'
    text = (
        f'(format: "pong-model", version: 1, name: "{mesh.name}", surfaces: {{ {surface(mesh)} }},\n'
        f'    root: (name: "{mesh.name}", surface: "s", contact: Solid, primitives: [{primitive}]))\n'
    )
    (folder / f"{mesh.name}.ron").write_text(text, encoding="utf-8")


def divided(pong, mesh, folder):
    """Writes the model of a mesh in convex pieces; raises RuntimeError if it cannot be divided."""
    arguments = [pong, "decompose", f"{mesh.name}.obj", "-o", f"{mesh.name}.ron", "--surface", "s", "--stiffness", "1e5"]
    done = subprocess.run(arguments, cwd=folder, capture_output=True, text=True, check=False)
    path = folder / f"{mesh.name}.ron"
    if done.returncode not in (0, 1) or not path.exists():
        raise RuntimeError("not divided: " + (done.stderr.strip().splitlines() or ["?"])[-1])
    text = path.read_text(encoding="utf-8")
    start = text.index("surfaces:")
    path.write_text(text[:start] + f"surfaces: {{ {surface(mesh)} }},\n" + text[text.index("root:", start):], encoding="utf-8")


def turned(q, v):
    w, x, y, z = q
    t = tuple(2 * c for c in cross((x, y, z), v))
    u = cross((x, y, z), t)
    return tuple(v[i] + w * t[i] + u[i] for i in range(3))


def any_turn(name):
    """A random unit quaternion that depends on the name alone, or that of START."""
    if name in START:
        return START[name]
    source = random.Random(name)
    q = [source.gauss(0, 1) for _ in range(4)]
    return [c / math.sqrt(sum(c * c for c in q)) for c in q]


def body(mesh, q, floor):
    """Line of a free body whose centre of mass is above the origin and whose lowest vertex is at a height; and its top."""
    heights = [turned(q, v)[2] for v in mesh.vertices]
    middle = turned(q, mesh.center)
    position = (-middle[0], -middle[1], floor - min(heights))
    inertia = ", ".join(f"{key}: {value:.12g}" for key, value in zip(("xx", "yy", "zz", "xy", "xz", "yz"), mesh.inertia))
    line = (
        f'(name: "{mesh.name}", model: "{mesh.name}", bodies: [(motion: Free, mass: {mesh.mass:.12g}, '
        f"inertia: Full({inertia}), mass_center: {numbers(mesh.center)}, position: {numbers(position)}, "
        f"orientation: {numbers(q)})]),"
    )
    return line, position[2] + max(heights)


def write_scene(meshes, folder, falls=FALLS):
    """Scene of meshes above a plane, the first one lowest. The run takes `falls` times √(size/g)."""
    plane = (
        '(format: "pong-model", version: 1, name: "plane", surfaces: { "s": (stiffness: inf, friction: Bristle(mu: '
        f'{FRICTION})) }},\n    root: (name: "plane", surface: "s", primitives: [Plane(name: "floor", normal: (0, 0, 1), '
        "offset: 0)]))\n"
    )
    (folder / "plane.ron").write_text(plane, encoding="utf-8")
    objects, height = ['(name: "plane", model: "plane", bodies: [(motion: Fixed)]),'], 0.0
    drags = []
    for mesh in meshes:
        line, height = body(mesh, any_turn(mesh.name), height + DROP * mesh.size)
        objects.append(line)
        drag = 0.1 * mesh.mass * mesh.size**2 / (DRAG_TIME * math.sqrt(mesh.size / G))
        ends = f'first: On(body: "plane"), second: On(body: "{mesh.name}")'
        drags.append(f"({ends}, stiffness: (0, 0, 0, 0, 0, 0), damping: (0, 0, 0, {drag:.6g}, {drag:.6g}, {drag:.6g})),")
    names = ["plane", *(mesh.name for mesh in meshes)]
    pairs = [(a, b) for i, a in enumerate(names) for b in names[i + 1 :]]
    step = STEP * math.sqrt(SINK * min(mesh.size for mesh in meshes) / G)
    duration = falls * math.sqrt(max(mesh.size for mesh in meshes) / G)
    text = (
        '(format: "pong-scene", version: 1, name: "drop",\n    models: { '
        + ", ".join(f'"{name}": "{name}.ron"' for name in names)
        + " },\n    objects: [\n        "
        + "\n        ".join(objects)
        + "\n    ],\n    springs: [\n        "
        + "\n        ".join(drags)
        + "\n    ],\n    pairs: ["
        + ", ".join(f'("{a}", "{b}")' for a, b in pairs)
        + f"],\n    gravity: (0, 0, {-G}), integrator: RungeKutta4, step: {step:.6g}, duration: {duration:.6g},\n"
        + "    record_every: 5, ledger: true,\n)\n"
    )
    (folder / "scene.ron").write_text(text, encoding="utf-8")


# --- runs -------------------------------------------------------------------------------------------------------------

def rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def run(pong, folder):
    """Runs a scene; raises RuntimeError with its message if it does not run."""
    arguments = [pong, "run", "--quiet", "--csv", "-o", "out", "scene.ron"]
    done = subprocess.run(arguments, cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(done.stderr.strip())
    return done.stderr.strip()


def judged(meshes, folder):
    """Speed at the end over √(g·size), and the growth of the mechanical energy over what was lost."""
    keys = ("kinetic_j", "potential_j", "springs_j", "contacts_j")
    energies = [sum(float(row[key]) for key in keys) for row in rows(folder / "out" / "energies.csv")][1:]
    least, growth = energies[0], 0.0
    for energy in energies:
        growth, least = max(growth, energy - least), min(least, energy)
    fastest = 0.0
    for mesh in meshes:
        last = [row for row in rows(folder / "out" / "states.csv") if row["body"] == mesh.name][-1]
        speed = math.hypot(*(float(last[f"v{axis}_m_per_s"]) for axis in "xyz"))
        turning = math.hypot(*(float(last[f"w{axis}_rad_per_s"]) for axis in "xyz"))
        fastest = max(fastest, (speed + turning * mesh.size) / math.sqrt(G * mesh.size))
        if float(last["z_m"]) < -2 * mesh.size:
            raise RuntimeError(f"{mesh.name} fell through the plane")
    return fastest, growth / (energies[0] - least)


def name_of(meshes):
    """Name of a run: what falls, on what, on the plane."""
    return " on ".join([*(mesh.name for mesh in reversed(meshes)), "plane"])


def drop(pong, meshes):
    """Row of a run: what was dropped, and what came out; the last field says whether it passed."""
    what = name_of(meshes)
    started, note = time.monotonic(), ""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        try:
            for mesh in meshes:
                whole(mesh, folder)
            write_scene(meshes, folder)
            try:
                note = run(pong, folder)
            except RuntimeError as error:
                if "decompose" not in str(error) or len(meshes) == 1:
                    raise
                divided(pong, meshes[0], folder)
                note = "lower one divided; " + run(pong, folder)
            fastest, growth = judged(meshes, folder)
            if fastest >= AT_REST:
                note += f"{'; ' if note else ''}{fastest:.1e} at first, again for {LONGER} times as long"
                write_scene(meshes, folder, FALLS * LONGER)
                run(pong, folder)
                fastest, grown = judged(meshes, folder)
                growth = max(growth, grown)
        except RuntimeError as error:
            return what, None, None, time.monotonic() - started, str(error).splitlines()[-1][:200], False
    passed = fastest < AT_REST and growth < GAINED
    return what, fastest, growth, time.monotonic() - started, note.replace("\n", "; ")[:160], passed


def table(pong, cases, jobs):
    """Runs all cases, prints a row for each, and returns how many passed."""
    passed = 0
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for what, fastest, growth, seconds, note, good in pool.map(lambda meshes: drop(pong, meshes), cases):
            passed += good
            figures = "" if fastest is None else f"speed {fastest:.1e}, gained {growth:.1e}, "
            print(f"{'   ' if good else 'OFF'} {what}: {figures}{seconds:.1f} s{' — ' + note if note else ''}", flush=True)
    return passed


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("pong", help="the program that runs scenes")
    parser.add_argument("cache", type=pathlib.Path, nargs="?", help="folder with the meshes of fetch_meshes.py")
    parser.add_argument("--made", action="store_true", help="meshes that this program makes")
    parser.add_argument("--only", metavar="NAME", help="one mesh")
    parser.add_argument("--without", metavar="RUN", help="leave out a run, named as in the table")
    parser.add_argument("--neighbours", action="store_true", help="drop each mesh on the next one, convex or not")
    parser.add_argument("--triangles-max", type=int, default=100_000, metavar="N", help="leave larger meshes out")
    parser.add_argument("--jobs", type=int, default=1, help="runs side by side")
    arguments = parser.parse_args()
    if arguments.made == (arguments.cache is not None):
        parser.error("give a CACHE or --made")
    pong = str(pathlib.Path(shutil.which(arguments.pong) or arguments.pong).resolve())
    if arguments.made:
        meshes, convex = [Mesh(name, *mesh) for name, mesh in made_meshes.meshes().items()], None
    else:
        meshes, convex = from_cache(arguments.cache, arguments.triangles_max)
    chosen = [i for i, mesh in enumerate(meshes) if arguments.only in (None, mesh.name)]
    if not chosen:
        parser.error(f"no mesh {arguments.only}; use one of {', '.join(mesh.name for mesh in meshes)}")
    alone = [[meshes[i]] for i in chosen]
    pairs = [[below(meshes, i, None if arguments.neighbours else convex), meshes[i]] for i in chosen]
    if arguments.without is not None:
        if arguments.without not in map(name_of, alone + pairs):
            parser.error(f"no run {arguments.without!r}")
        alone, pairs = ([run for run in runs if name_of(run) != arguments.without] for runs in (alone, pairs))
    print("speed: at the end, over √(g·size); gained: growth of mechanical energy over what was lost")
    results = [table(pong, cases, arguments.jobs) for cases in (alone, pairs)]
    print(f"on the plane {results[0]} of {len(alone)}, on each other {results[1]} of {len(pairs)}")
    sys.exit(0 if results == [len(alone), len(pairs)] else 1)


if __name__ == "__main__":
    main()

"""Instructions of `pong`, and of a C program that restores contact states, for reading several sizes (ci/readers)."""

import base64
import concurrent.futures
import json
import math
import pathlib
import re
import struct
import subprocess
import sys
import time

# Largest exponent of the size in the cost of reading: a sort or a tree of boxes is well below, a square is 2.
EXPONENT_MAX = 1.3
TINY = 12

HEAD = 'format: "pong-model", version: 1, name: "m", surfaces: { "s": (stiffness: 1e6) },'


def model(elements, what="primitives"):
    return f'({HEAD} root: (name: "m", surface: "s", {what}: [{elements}]))'


def triples(rows):
    return ", ".join("(%r, %r, %r)" % tuple(row) for row in rows)


def ball(faces):
    """Circles and as many meridians: positions, and faces of three or four corners."""
    circles = max(3, round(math.sqrt(faces / 2)))
    around = 2 * circles
    places = [(0.0, 0.0, 1.0), (0.0, 0.0, -1.0)]
    for circle in range(1, circles):
        angle = math.pi * circle / circles
        for k in range(around):
            turn = 2 * math.pi * k / around
            places.append((math.sin(angle) * math.cos(turn), math.sin(angle) * math.sin(turn), math.cos(angle)))
    at = lambda circle, k: 2 + (circle - 1) * around + k % around
    corners = []
    for k in range(around):
        corners.append((0, at(1, k), at(1, k + 1)))
        corners.append((1, at(circles - 1, k + 1), at(circles - 1, k)))
        corners += [(at(c, k), at(c + 1, k), at(c + 1, k + 1), at(c, k + 1)) for c in range(1, circles - 1)]
    return places, corners


def sheet(triangles):
    """A square of hills."""
    side = max(1, round(math.sqrt(triangles / 2)))
    places = [(x * 0.1, y * 0.1, 0.03 * math.sin(x) * math.cos(0.7 * y)) for y in range(side + 1) for x in range(side + 1)]
    found = []
    for y in range(side):
        for x in range(side):
            a = y * (side + 1) + x
            found += [(a, a + 1, a + side + 2), (a, a + side + 2, a + side + 1)]
    return places, found


def solid(folder, count):
    places, corners = ball(count)
    faces = ", ".join(str(list(face)) for face in corners)
    (folder / "m.ron").write_text(model(f'Polyhedron(name: "p", vertices: [{triples(places)}], faces: [{faces}])'))
    return [PONG, "check", "m.ron"]


def mesh(folder, count):
    places, found = sheet(count)
    text = f'TriangleMesh(name: "p", vertices: [{triples(places)}], triangles: [{triples(found)}])'
    (folder / "m.ron").write_text(model(text))
    return [PONG, "check", "m.ron"]


def groups(folder, count):
    one = lambda k: f'(name: "g{k}", primitives: [Sphere(name: "b", center: ({0.1 * k!r}, 0.0, 0.0), radius: 0.04)])'
    (folder / "m.ron").write_text(model(", ".join(map(one, range(count))), "groups"))
    return [PONG, "check", "m.ron"]


def surfaces(folder, count):
    named = ", ".join(f'"s{k}": (stiffness: 1e6)' for k in range(count))
    balls = ", ".join(
        f'Sphere(name: "b{k}", center: ({0.1 * k!r}, 0.0, 0.0), radius: 0.04, surface: "s{k}")' for k in range(count)
    )
    text = model(balls).replace('"s": (stiffness: 1e6)', '"s": (stiffness: 1e6), ' + named)
    (folder / "m.ron").write_text(text)
    return [PONG, "check", "m.ron"]


def obj(folder, count):
    places, found = sheet(count)
    lines = ["v %r %r %r" % place for place in places]
    lines += ["f %d %d %d" % tuple(corner + 1 for corner in triangle) for triangle in found]
    (folder / "m.obj").write_text("\n".join(lines) + "\n")
    (folder / "m.ron").write_text(model('TriangleMesh(name: "p", file: "m.obj")'))
    return [PONG, "check", "m.ron"]


def stl(folder, count):
    places, found = sheet(count)
    corner = lambda place: struct.pack("<3f", *place)
    body = b"".join(bytes(12) + b"".join(corner(places[k]) for k in triangle) + bytes(2) for triangle in found)
    (folder / "m.stl").write_bytes(bytes(80) + struct.pack("<I", len(found)) + body)
    (folder / "m.ron").write_text(model('TriangleMesh(name: "p", file: "m.stl")'))
    return [PONG, "check", "m.ron"]


def gltf(folder, places, found, nodes):
    numbers = b"".join(struct.pack("<3f", *place) for place in places)
    indices = b"".join(struct.pack("<3I", *triangle) for triangle in found)
    low, high = [[float(struct.unpack("<f", struct.pack("<f", f(p[k] for p in places)))[0]) for k in range(3)] for f in (min, max)]
    blob = base64.b64encode(numbers + indices).decode()
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": list(range(len(nodes)))}],
        "nodes": nodes,
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": len(places), "type": "VEC3", "min": low, "max": high},
            {"bufferView": 1, "componentType": 5125, "count": 3 * len(found), "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": len(numbers)},
            {"buffer": 0, "byteOffset": len(numbers), "byteLength": len(indices)},
        ],
        "buffers": [{"byteLength": len(numbers) + len(indices), "uri": "data:application/octet-stream;base64," + blob}],
    }
    (folder / "m.gltf").write_text(json.dumps(document))
    return [PONG, "import", "m.gltf", "-o", "out.ron", "--stiffness", "1e6"]


def gltf_mesh(folder, count):
    return gltf(folder, *sheet(count), [{"name": "n", "mesh": 0}])


def gltf_nodes(folder, count):
    nodes = [{"name": "n", "mesh": 0, "translation": [2.0 * k, 0.0, 0.0]} for k in range(count)]
    return gltf(folder, *sheet(2), nodes)


BALL = '(name: "ball", motion: Free, mass: 1.0, inertia: Diagonal(1.0, 1.0, 1.0), position: (0.0, 0.0, 0.999))'
SCENE = """(format: "pong-scene", version: 1, name: "s", models: {{ "ball": "ball.ron", "floor": "floor.ron" }},
objects: [(name: "ball", model: "ball", bodies: [({ball})]), (name: "floor", model: "floor", bodies: [(motion: Fixed)])],
pairs: [("ball", "floor")], gravity: (0.0, 0.0, -9.81), integrator: SemiImplicitEuler, step: 1e-3, duration: {duration!r},
record_every: 1)"""


def scene_of(folder, ball, steps):
    (folder / "ball.ron").write_text(model('Sphere(name: "b", center: (0.0, 0.0, 0.0), radius: 1.0)'))
    (folder / "floor.ron").write_text(model('Plane(name: "p", normal: (0.0, 0.0, 1.0), offset: 0.0)'))
    (folder / "s.ron").write_text(SCENE.format(ball=ball, duration=1e-3 * steps))


def scene(folder, count):
    rows = ", ".join(f"(time: {0.01 * k!r}, position: (0.0, 0.0, {1 + 0.001 * math.sin(k)!r}))" for k in range(count))
    scene_of(folder, f"motion: Prescribed(Table([{rows}]))", 1)
    return [PONG, "run", "s.ron", "--quiet"]


def log(folder, count):
    scene_of(folder, "motion: Free, mass: 1.0, inertia: Diagonal(1.0, 1.0, 1.0), position: (0.0, 0.0, 0.999)", count)
    subprocess.run([PONG, "run", "s.ron", "--quiet", "--log", "log"], cwd=folder, check=True, capture_output=True)
    return [PONG, "log", "log", "--csv", "csv"]


def restored(folder, count):
    """Instructions of restoring, without those of loading, pressing and saving."""
    groups(folder, count)
    return [RESTORER, "m.ron", str(count), "20"], [RESTORER, "m.ron", str(count), "0"]


KINDS = {
    "model: one solid": solid,
    "model: one mesh": mesh,
    "model: groups": groups,
    "model: surfaces": surfaces,
    "OBJ": obj,
    "STL": stl,
    "glTF: one mesh": gltf_mesh,
    "glTF: nodes of one name": gltf_nodes,
    "scene: a table of poses": scene,
    "log: frames": log,
    "contact state, 20 times": restored,
}


def instructions(folder, command):
    """Instructions of a command, and its duration alone, s."""
    if isinstance(command, tuple):
        (refs, alone), (without, alone_without) = (instructions(folder, one) for one in command)
        return refs - without, alone - alone_without
    begin = time.monotonic()
    subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True)
    alone = time.monotonic() - begin
    for written in folder.glob("out.ron"):
        written.unlink()
    for written in folder.glob("csv/*"):
        written.unlink()
    valgrind = ["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null", *command]
    done = subprocess.run(valgrind, cwd=folder, check=True, capture_output=True, text=True)
    return int(re.search(r"I\s+refs:\s+([\d,]+)", done.stderr)[1].replace(",", "")), alone


def count(name, size):
    folder = SCRATCH / f"{name.replace(' ', '_').replace(':', '')}_{size}"
    folder.mkdir()
    try:
        return instructions(folder, KINDS[name](folder, size))
    except subprocess.CalledProcessError as error:
        sys.exit(f"{name}, {size}: {error.cmd[0]} fails: {error.stderr}")


def main():
    is_long = "--long" in sys.argv[4:]
    sizes = [1_000, 10_000, 100_000] if is_long else [500, 4_000]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        told = {name: {size: pool.submit(count, name, size) for size in [TINY, *sizes]} for name in KINDS}
    failed = False
    print(f"{'millions of instructions':26}" + "".join(f"{size:>22,}" for size in sizes) + "   exponent")
    for name, by_size in told.items():
        empty = by_size[TINY].result()[0]
        counts = [by_size[size].result() for size in sizes]
        cells = "".join(f"{refs / 1e6:13,.1f} ({alone:5.2f} s)" if is_long else f"{refs / 1e6:22,.1f}" for refs, alone in counts)
        first, last = counts[0][0] - empty, counts[-1][0] - empty
        exponent = math.log(last / first) / math.log(sizes[-1] / sizes[0])
        too_much = exponent > EXPONENT_MAX
        failed |= too_much
        print(f"{name:26}{cells}{exponent:11.2f}" + ("  more than the size" if too_much else ""))
    sys.exit(failed)


PONG, RESTORER = (str(pathlib.Path(path).resolve()) for path in sys.argv[1:3])
SCRATCH = pathlib.Path(sys.argv[3])
main()

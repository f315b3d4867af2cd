"""Copies what a fuzz target begins with into a folder: gather.py TARGET FOLDER.

Small files of models/, examples of the documents, meshes made here, and fuzz/regressions/TARGET."""

import base64
import json
import pathlib
import re
import struct
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
BYTES_MAX = 9000

CUBE = [(x, y, z) for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)]
SIDES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (1, 3, 7, 5), (0, 4, 6, 2)]
TRIANGLES = [t for a, b, c, d in SIDES for t in ((a, b, c), (a, c, d))]


def files(*patterns):
    found = [path for pattern in patterns for path in sorted(ROOT.glob(pattern))]
    return [path.read_bytes() for path in found if path.stat().st_size <= BYTES_MAX]


def models():
    yield from (text for text in files("models/*/*.ron", "fuzz/seeds/c_models/*.ron", "crates/pong-model/tests/models/*")
                if b"pong-model" in text)


def scenes():
    yield from (text for text in files("models/*/scene_*.ron") if b"pong-scene" in text)
    guide = (ROOT / "docs/scene_format.md").read_text()
    scene = re.search(r"```ron scene\n(.*?)```", guide, re.S)[1]
    yield scene.encode()
    for fields in re.findall(r"```ron field\n(.*?)```", guide, re.S):
        if "integrator" in fields:
            yield re.sub(r" *integrator:.*\n", lambda _: fields, scene).encode()
    for name in ("loads", "springs"):
        for entries in re.findall(rf"```ron {name}\n(.*?)```", guide, re.S):
            yield scene.replace("    gravity:", f"    {name}: [{entries}],\n    gravity:").encode()


def obj():
    places = "".join(f"v {x} {y} {z}\n" for x, y, z in CUBE)
    corner = "".join
    quads = corner("f " + " ".join(str(v + 1) for v in side) + "\n" for side in SIDES)
    triangles = corner("f " + " ".join(f"{v + 1}//{v + 1}" for v in t) + "\n" for t in TRIANGLES)
    yield (places + quads).encode()
    yield ("o cube\n" + places + triangles).encode()
    yield ("mtllib none.mtl\no a\nusemtl steel\n" + places + quads + "o b\nf -1 -2 -3\nl 1 2 3\np 4\n").encode()


def stl():
    head = b"made here".ljust(80)
    facets = b"".join(struct.pack("<12fH", *[0] * 3, *[x for v in t for x in CUBE[v]], 0) for t in TRIANGLES)
    yield head + struct.pack("<I", len(TRIANGLES)) + facets
    text = "".join(
        "facet normal 0 0 1\nouter loop\n" + "".join("vertex {} {} {}\n".format(*CUBE[v]) for v in t)
        + "endloop\nendfacet\n" for t in TRIANGLES[:4])
    yield f"solid cube\n{text}endsolid cube\n".encode()


def gltf():
    places = b"".join(struct.pack("<3f", *place) for place in CUBE)
    corners = b"".join(struct.pack("<3H", *t) for t in TRIANGLES)
    data = places + corners
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0], "extras": {"pong": {"surfaces": {"steel": {"stiffness": 1e6}}}}}],
        "nodes": [
            {"name": "root", "children": [1], "extras": {"pong": {"movable": True, "surface": "steel"}}},
            {"name": "cube", "mesh": 0, "translation": [0, 0, 1], "rotation": [0, 0, 0, 1], "scale": [1, 1, 1],
             "extras": {"pong": {"kind": "Polyhedron"}}},
        ],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "materials": [{"name": "m", "extras": {"pong": {"surface": "steel", "inactive": False}}}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3", "min": [-1] * 3, "max": [1] * 3},
            {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": 96}, {"buffer": 0, "byteOffset": 96, "byteLength": 72}],
        "buffers": [{"byteLength": len(data)}],
    }
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(data), 0x4E4942) + data
    yield b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks
    address = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    document["buffers"] = [{"byteLength": len(data), "uri": address}]
    yield json.dumps(document).encode()
    for kind in ("TriangleMesh", "Sphere", "Point", "Plane"):
        document["nodes"][1]["extras"]["pong"]["kind"] = kind
        yield json.dumps(document).encode()


def bytes_of_every_kind():
    """For targets whose inputs are choices: many first bytes, with anything behind them."""
    word = 1
    for number in range(64):
        seed = bytearray([(number * 37) % 256])
        for _ in range(60 + 16 * number):
            word = word * 6364136223846793005 % 2**64 + 1442695040888963407
            seed.append(word >> 33 & 0xFF)
        yield bytes(seed)


SEEDS = {
    "model": models, "scene": scenes, "obj": obj, "stl": stl, "gltf": gltf, "contact_state": bytes_of_every_kind,
    "log": bytes_of_every_kind, "c_calls": bytes_of_every_kind,
}


def main(target, folder):
    seeds = list(SEEDS[target]()) + files(f"fuzz/regressions/{target}/*")
    for number, seed in enumerate(seeds):
        (pathlib.Path(folder) / f"seed_{number:04}").write_bytes(seed)


main(*sys.argv[1:])

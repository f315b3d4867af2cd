"""The convex bodies of contact models, for pictures and for other engines."""

import pathlib

from kit.files import module_of

ROOT = pathlib.Path(__file__).resolve().parents[2]


def read(path):
    """A model file as dictionaries and lists, by its path from the root of the repository."""
    reader = module_of(ROOT / "hosts/mujoco/docking/ron.py", "ron_of_models")
    return reader.read((ROOT / path).read_text(encoding="utf-8"))


def polyhedra(group, carrier):
    """(carrying movable group, or `carrier`; polyhedron) of a group and those below it."""
    for primitive in group.get("primitives", []):
        if primitive["is"] == "Polyhedron":
            yield carrier, primitive
    for below in group.get("groups", []):
        yield from polyhedra(below, below["name"] if below.get("movable") else carrier)


def mesh(name, vertices):
    """An asset of MJCF: the convex hull of these points."""
    return f'<mesh name="{name}" inertia="legacy" vertex="{" ".join(f"{x:.12g}" for v in vertices for x in v)}"/>'

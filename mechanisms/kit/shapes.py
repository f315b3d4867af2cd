"""The convex bodies of contact models, for pictures and for other engines."""

import pathlib

from pong import model as models

ROOT = pathlib.Path(__file__).resolve().parents[2]


def read(path):
    """A model file as data, by its path from the root of the repository."""
    return models.read(ROOT / path)


def polyhedra(group, carrier):
    """(carrying movable group, or `carrier`; polyhedron) of a group and those below it."""
    for primitive in group.get("primitives", []):
        if "Polyhedron" in primitive:
            yield carrier, primitive["Polyhedron"]
    for below in group.get("groups", []):
        yield from polyhedra(below, below["name"] if below.get("movable") else carrier)


def mesh(name, vertices):
    """An asset of MJCF: the convex hull of these points."""
    return f'<mesh name="{name}" inertia="legacy" vertex="{" ".join(f"{x:.12g}" for v in vertices for x in v)}"/>'

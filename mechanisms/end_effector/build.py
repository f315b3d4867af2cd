#!/usr/bin/env python3
"""Builds the contact models of models.py through the modelling toolkit: python build.py [FOLDER] [--blend FILE] with
Blender as a Python module. The dimensions stand in dimensions.py; README.md says where each comes from.
"""

import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent), str(HERE.parent.parent / "models")]
import authoring as a  # noqa: E402
import models  # noqa: E402

MAKERS = {
    "Sphere": lambda name, f: a.sphere(name, f["center"], f["radius"]),
    "Plane": lambda name, f: a.flat_ground(name, f["normal"], f["offset"]),
    "Capsule": lambda name, f: a.capsule(name, *f["ends"], f["radius"]),
    "Cylinder": lambda name, f: a.cylinder(name, *f["ends"], f["radius"]),
    "Cone": lambda name, f: a.cone(name, *f["ends"], f["radii"]),
    "Polyhedron": lambda name, f: a.mesh_polyhedron(name, f["vertices"], f["faces"]),
    "Ray": lambda name, f: a.ray(name, f["origin"], f["direction"], f["length"], response=f["response"]),
}


def surface(described):
    friction = a.bristle(described.friction, damping=described.bristle_damping) if described.friction else None
    if described.stiffness is None:
        return a.surface(float("inf"), friction=friction)
    return a.surface(described.stiffness, a.linear(described.damping), friction)


def root(described):
    parts = [MAKERS[part.kind](part.name, dict(part.fields)) for part in described.parts]
    if not described.links:
        return a.group(described.name, primitives=parts, surface="steel")
    links = [a.group(name, primitives=parts, movable=True) for name in described.links]
    return a.group(described.name, groups=links, surface="steel")


def main():
    made = [a.model(m.name, {"steel": surface(m.surface)}, root(m)) for m in models.committed().values()]
    a.main(made, HERE)


if __name__ == "__main__":
    main()

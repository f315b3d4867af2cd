#!/usr/bin/env python3
"""Builds tie_downs.ron and pins.ron through the modelling toolkit: python build.py [FOLDER] [--blend FILE], with Blender
as a Python module. Pallet and rails are models/htv_pallet/pallet.ron and rails.ron as they are.
"""

import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent), str(HERE.parent.parent / "models")]
import authoring as a  # noqa: E402
import dimensions as d  # noqa: E402

FRICTION = a.bristle(d.model.FRICTION)


def hook(name, side):
    """A block from the hinge to beyond the pin; its face at x = 0 pulls the pin along x."""
    inner, outer = (d.LEVER + d.HOOK_BEYOND, 0.0)
    half_spaces = [
        ((1.0, 0.0, 0.0), 0.0),
        ((-1.0, 0.0, 0.0), d.HOOK_THICKNESS),
        ((0.0, -side, 0.0), inner),
        ((0.0, side, 0.0), outer),
        ((0.0, 0.0, 1.0), d.HOOK_HALF_HEIGHT),
        ((0.0, 0.0, -1.0), d.HOOK_HALF_HEIGHT),
    ]
    place = (d.FACE_X, side * (d.PIN_Y + d.LEVER), 0.0)
    return a.group(f"hook_{name}", primitives=[a.polyhedron("block", half_spaces)], movable=True, position=place)


def tie_downs():
    surface = a.surface(d.HOOK_STIFFNESS, a.linear(d.HOOK_DAMPING, ramp=d.model.DAMPING_RAMP), FRICTION)
    root = a.group("tie_downs", groups=[hook(*entry) for entry in d.SIDES.items()], surface="steel")
    return a.model("tie_downs", {"steel": surface}, root)


def pins():
    """Two pins with crowned barrels, on the pallet; the hooks provide the stiffness."""
    barrels = [a.sphere(f"pin_{name}", (d.PIN_X, side * d.PIN_Y, 0.0), d.PIN_RADIUS) for name, side in d.SIDES.items()]
    surface = a.surface(float("inf"), a.linear(0.0, ramp=d.model.DAMPING_RAMP), FRICTION)
    return a.model("pins", {"steel": surface}, a.group("pins", primitives=barrels, surface="steel"))


if __name__ == "__main__":
    a.main([tie_downs(), pins()], HERE)

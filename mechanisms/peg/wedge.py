"""Wedging of the peg of sixteen edges in the hole of sixteen wedges: models/peg_in_hole, validation case V20."""

import pathlib

import numpy as np
from kit import mjcf
from kit.machine import Machine
from kit.rows import Fact, Limit

MODELS = pathlib.Path(__file__).resolve().parents[2] / "models" / "peg_in_hole"
# Scenes scene_shallow.ron and scene_deep.ron: depth and pose, in which both contacts are 0.02 mm deep.
SCENES = {
    0.03: ((-0.000550016, 0.0, -0.03), (0.999849906978035, 0.0, 0.017325227733444, 0.0)),
    0.08: ((-0.000524224, 0.0, -0.08), (0.999978877468634, 0.0, 0.006499585876932, 0.0)),
}
LIMIT = 0.05  # m: friction times diameter


def released(depth):
    """Release without gravity, for half a second, from rest."""
    place, turned = SCENES[depth]
    body = (
        f'<body name="peg" pos="{mjcf.numbers(place)}" quat="{mjcf.numbers(turned)}"><freejoint/>'
        '<inertial pos="0 0 0.1" mass="1" diaginertia="0.004 0.004 0.00125"/></body>'
    )
    objects = {"hole": "hole.ron", "peg": "peg.ron"}
    extension = mjcf.contact_instance(objects, [("hole", "peg")], {"hole": "world"}, folder=str(MODELS), capacity=256)
    made = Machine(mjcf.model("peg_in_hole", extension, body, "", 2e-4), ["world", "peg"])
    made.run(0.5)
    return made


def rows():
    for depth in SCENES:
        made = released(depth)
        held = made.contacts() > 0
        way = float(np.linalg.norm(made.place("peg") - SCENES[depth][0]))
        if depth < LIMIT:
            yield Fact(f"{depth * 1e3:g} mm deep, less than μD = {LIMIT * 1e3:g} mm: it stays wedged", held)
            yield Limit("and swings on its springs by no more than they were pressed", way, 1e-4, "m")
        else:
            yield Fact(f"{depth * 1e3:g} mm deep: it comes free", not held)
            # Damped bristles return less energy than stored, so the motion is slow; success is a distance beyond the
            # springs' depth.
            yield Limit("and has gone", way, 1e-4, "m", least=True)

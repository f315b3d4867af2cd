#!/usr/bin/env python3
"""Depth of one foot drawn over the plane at a constant speed: why feet hop with some contacts (README.md).

python3 mechanisms/hexapod/lift.py        with the plugin as for mechanisms/run.py; with Drake where `pip install drake` was

With Pong the push depends on the depth alone, r = N/K. MuJoCo and Drake's SAP find pushes as the least of a convex
function, in which a place that slides is pushed away as well: by μ·C·v, and μ·(C + K·step)·v. So the depth is

    MuJoCo       (N·(1 + μ²/impratio) − μ·C·v)/K
    Drake, SAP   (N − μ·(C + K·step)·v)/K

and a foot that slides faster than N/(μ·C) cannot stay on the ground.
"""

import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import dimensions as d  # noqa: E402
import numpy as np  # noqa: E402
import own  # noqa: E402
import rig  # noqa: E402

from kit import in_drake as drake  # noqa: E402
from kit import mjcf, own_contact  # noqa: E402
from kit.machine import Machine  # noqa: E402

STEP, MASS = 1e-3, 1.0
LOAD = MASS * d.GRAVITY
SPEEDS = (0.05, 0.1, 0.2, 0.3)  # m/s
HEAVY = 1e7  # kg: what is drawn along does not slow down
FOOT = {"foot": own_contact.Surface(d.STIFFNESS, d.DAMPING, d.FRICTION)}


def text():
    body = (
        f'<body name="foot" pos="{-d.TIBIA:g} 0 {d.FOOT_RADIUS - LOAD / d.STIFFNESS:.12g}">'
        f'<joint name="along" type="slide" axis="1 0 0" armature="{HEAVY:g}"/><joint name="up" type="slide" axis="0 0 1"/>'
        f'<inertial pos="{d.TIBIA:g} 0 0" mass="{MASS:g}" diaginertia="1 1 1"/>'
        f'<geom name="foot" type="sphere" pos="{d.TIBIA:g} 0 0" size="{d.FOOT_RADIUS:g}" mass="0"/></body>'
    )
    ground = '<geom name="ground" type="plane" size="9 9 1"/>'
    objects = {"ground": "plane.ron", "foot": "foot.ron"}
    extension = mjcf.contact_instance(
        objects, [("foot", "ground")], {"ground": "world", "foot": "foot"}, folder=str(HERE)
    )
    return mjcf.model("lift", extension, ground + body, "", STEP, gravity=(0.0, 0.0, -d.GRAVITY))


def depth(kind, speed):
    """Mean of the third second, m: the remaining transient oscillates about it."""
    made = kind(text(), ["world", "foot"])
    made.data.qvel[0] = speed
    made.start()
    for _ in range(round(2.0 / STEP)):
        made.hurry()
    seen = []
    for _ in range(round(1.0 / STEP)):
        made.hurry()
        seen.append(d.FOOT_RADIUS - made.place("foot")[2])
    return float(np.mean(seen))


def engines():
    """Name → (class of machine, predicted depth at a speed)."""
    still, mu = LOAD / d.STIFFNESS, d.FRICTION
    raised = still * (1 + mu**2 / own_contact.SPRINGS.impratio)
    yield "Pong", Machine, lambda v: still
    yield (
        "springs",
        lambda t, c: own_contact.Own(t, c, own_contact.SPRINGS, FOOT, ["ground"]),
        lambda v: raised - mu * d.DAMPING * v / d.STIFFNESS,
    )
    if not drake.at_hand():
        return
    yield (
        "Drake sap",
        lambda t, c: drake.InDrake(t, c, drake.SAP, FOOT, ["ground"]),
        lambda v: still - mu * (d.DAMPING / d.STIFFNESS + STEP) * v,
    )
    yield "Drake lagged", lambda t, c: drake.InDrake(t, c, drake.LAGGED, FOOT, ["ground"]), lambda v: still


def limits():
    """Spring of a foot of the standing hexapod with each set of own.py, and its consequences."""
    load = d.MASS * d.GRAVITY / 6
    across = load * math.sin(math.atan(0.5 * d.FRICTION))
    for name in ("MuJoCo", "springs", "hard"):
        stands, contact = own.settled(own.other(own.Own, own.SETS[name])), own.SETS[name]
        deep = float(np.mean(d.FOOT_RADIUS - rig.feet(stands)[:, 2]))
        inverse_mass = stands.model.body_invweight0[stands.model.body("tibia_0").id, 0]
        stiffness, damping = d.STIFFNESS, d.DAMPING
        if contact.solref:
            stiffness, damping = own_contact.as_springs(contact, inverse_mass, deep)
        yield (
            name,
            [
                ("as a spring, N/m", stiffness),
                ("as a damper, N·s/m", damping),
                ("load over that spring, µm", 1e6 * load / stiffness),
                ("depth at rest, µm", 1e6 * deep),
                ("it hops from N/(μ·C), mm/s", 1e3 * load / (d.FRICTION * damping)),
                ("creep on half the slope, mm/s", 1e3 * across / (contact.impratio * damping)),
            ],
        )


def main():
    columns = {}
    for name, kind, predicted in engines():
        columns[name] = [(f"{v:g} m/s: depth, µm", 1e6 * depth(kind, v)) for v in SPEEDS]
        columns["predicted" + " " * len(columns)] = [("", 1e6 * predicted(v)) for v in SPEEDS]
    own_contact.table(columns, 28)
    print("\na foot of the standing hexapod with MuJoCo's own contact")
    own_contact.table(dict(limits()), 28)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Comparison of the same hexapod with MuJoCo's contact, in Drake and with Pong: standing, slopes, a walk on the plane.

python3 mechanisms/hexapod/own.py        with the plugin as for mechanisms/run.py; with Drake where `pip install drake` was
"""

import math
import pathlib
import sys
from dataclasses import replace
from functools import partial

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import dimensions as d  # noqa: E402
import numpy as np  # noqa: E402
import rig  # noqa: E402
import scenes  # noqa: E402

from kit import in_drake as drake  # noqa: E402
from kit import own_contact  # noqa: E402

STEP, SECONDS = d.TRAINING.step, 10.0
SETS = {
    "MuJoCo": own_contact.DEFAULT,
    "springs": own_contact.SPRINGS,
    "hard": own_contact.hard(STEP),
    # Added after the comparison: differences caused by the friction's regularization alone.
    "impratio": replace(own_contact.DEFAULT, impratio=100.0),
}
FEET = {f"foot_{i}": own_contact.Surface(d.STIFFNESS, d.DAMPING, d.FRICTION) for i in rig.LEGS}


class Feet:
    """Interface of a hexapod for the scenes."""

    def forces(self):
        """Force on each foot, along the axes of the world, N."""
        forces, feet = np.zeros((6, 3)), [self.model.geom(name).id for name in FEET]
        for first, second, _, force in self.pushes():
            foot, sign = (second, 1.0) if second in feet else (first, -1.0)
            forces[feet.index(foot)] += sign * force
        return forces


class Own(Feet, own_contact.Own):
    pass


class InDrake(Feet, drake.InDrake):
    pass


def other(engine, how):
    """A class of machine. `engine`: Own or InDrake; `how`: its set of parameters."""
    return lambda text, carriers: engine(text, carriers, how, FEET, ["ground"])


def settled(made):
    """Hexapod at rest on level ground, set down just touching: the same start for every contact."""
    hexapod = rig.machine(STEP, made=made)
    for _ in range(round(1.0 / STEP)):
        hexapod.hurry()
    return hexapod


def tilted(share, made):
    """Settled, then the slope rises within two seconds to a share of tan θ = μ, and half a second of rest."""
    hexapod, steps = settled(made), round(2.0 / STEP)
    for k in range(steps):
        hexapod.model.opt.gravity[:] = rig.slope(math.atan(share * d.FRICTION) * (k + 1) / steps)
        hexapod.hurry()
    for _ in range(round(0.5 / STEP)):
        hexapod.hurry()
    return hexapod


def moves(hexapod, seconds):
    """Displacement of the body, m; its mean acceleration down the slope, m/s²; forces of the feet in each step, N."""
    start, speed, forces = hexapod.place("body"), hexapod.data.qvel[0], []
    for _ in range(round(seconds / STEP)):
        hexapod.hurry()
        forces.append(np.array(hexapod.forces()))
    way = float(np.linalg.norm(hexapod.place("body") - start))
    return way, (speed - hexapod.data.qvel[0]) / seconds, np.array(forces)


def figures(made):
    """Figures of one contact: depth of the feet, creep, slide, walk."""
    stands = settled(made)
    yield "sum of loads at rest, N", stands.forces()[:, 2].sum()
    yield "feet are deep, µm", 1e6 * float(np.mean(d.FOOT_RADIUS - rig.feet(stands)[:, 2]))
    for share in (0.5, 0.97):
        yield f"{share} of tan θ = μ: way in {SECONDS:g} s, µm", 1e6 * moves(tilted(share, made), SECONDS)[0]
    for share in (1.03, 1.2):
        angle = math.atan(share * d.FRICTION)
        _, slid, forces = moves(tilted(share, made), 1.0)
        coulomb = d.GRAVITY * (math.sin(angle) - d.FRICTION * math.cos(angle))
        yield f"{share}: acceleration over g(sin θ − μ cos θ)", slid / coulomb
        yield f"{share}: time with no foot loaded", float(np.mean(~forces.any(axis=(1, 2))))
        across = np.linalg.norm(forces[:, :, :2], axis=2).sum()
        yield f"{share}: friction over load, foot by foot", across / forces[:, :, 2].sum()
        yield f"{share}: friction up the slope over load", forces[:, :, 0].sum() / forces[:, :, 2].sum()
    walk = scenes.Walk(STEP, made=made)
    walk.go(2.5)
    start = walk.way()
    walk.go(4 * d.PERIOD)
    yield "walk: speed over stride/period", (walk.way() - start) / (4 * d.STRIDE)
    yield "walk: feet slid, of the way", walk.slip_share()
    yield "processor time of a simulated second, s", own_contact.processor_time(settled(made), 5.0)


def main():
    """Makes one column after another: `own.py Pong hard` makes these two."""
    columns = {"Pong": partial(figures, None)}
    columns |= {name: partial(figures, other(Own, contact)) for name, contact in SETS.items()}
    if drake.at_hand():
        columns |= {f"Drake-{way}": partial(figures, other(InDrake, way)) for way in (drake.SAP, drake.LAGGED)}
    own_contact.compare(columns)


if __name__ == "__main__":
    main()

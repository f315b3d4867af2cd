#!/usr/bin/env python3
"""The same peg on the same wrist with the contact of MuJoCo and of Drake, beside Pong's and beside Whitney's theory.

python3 mechanisms/peg/own.py        with the plugin as for mechanisms/run.py; with Drake where `pip install drake` was

A bore is no geom of MuJoCo, nor of Drake's contact at points. The hole is SIDES convex pieces, each with a flat of the
wall and one of the chamfer. Two flats are square to the plane in which the peg moves, so in that plane the hole is exact;
its corners are HOLE·(1/cos(π/SIDES) − 1) further out, 0.49 mm with 16.
"""

import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import dimensions as d  # noqa: E402
import rig  # noqa: E402
import whitney  # noqa: E402

from kit import own_contact  # noqa: E402

STEP = rig.ANALYSIS
SIDES, THICK = 16, 0.02  # m of the wall
DEPTHS = {"near": (-0.5e-3, 0.01, 0.03, 0.05, 0.07), "far": (-1e-3, 0.01, 0.03, 0.05, 0.07)}
SETS = {"MuJoCo": own_contact.DEFAULT, "springs": own_contact.SPRINGS, "hard": own_contact.hard(STEP)}
# Pong's peg has its stiffness shared by its two ends; so has each place here.
SURFACE = own_contact.Surface(d.STIFFNESS / 2, d.DAMPING / 2, d.FRICTION)


def pieces(sides=SIDES):
    """Vertices of each piece, in the frame of the hole: wall and chamfer together are convex."""
    section = [(d.HOLE, -d.DEPTH), (d.HOLE, 0.0), (d.HOLE + d.CHAMFER * math.tan(d.SLOPE), d.CHAMFER)]
    section += [(section[-1][0] + THICK, d.CHAMFER), (section[-1][0] + THICK, -d.DEPTH)]
    for k in range(sides):
        turned = [2 * math.pi * k / sides + end * math.pi / sides for end in (-1, 1)]
        reach = 1.0 / math.cos(math.pi / sides)
        yield [(x * reach * math.cos(a), x * reach * math.sin(a), z) for x, z in section for a in turned]


def with_hole(text, sides):
    names = [f"piece_{k}" for k in range(sides)]
    geoms = "".join(f'<geom name="{name}" type="mesh" mesh="{name}" mass="0"/>' for name in names)
    assets = "".join(own_contact.mesh(name, piece) for name, piece in zip(names, pieces(sides)))
    return own_contact.with_geoms(text, {"hole": geoms}, assets), names


def own(contact, sides=SIDES):
    def made(text, carriers):
        text, names = with_hole(text, sides)
        return own_contact.Own(text, carriers, contact, {"shaft": SURFACE}, names)

    return made


def figures(made):
    """Force and lean against depth, the jam, processor time."""
    for name, centre in rig.CENTRES.items():
        peg = rig.machine(centre, STEP, made=made)
        for depth in DEPTHS[name]:
            reach(peg, depth)
            yield f"{name}, {depth * 1e3:g} mm deep: force, N", rig.resistance(peg)
            yield f"{name}, {depth * 1e3:g} mm deep: lean, mrad", 1e3 * rig.lean(peg)
    for name, centre in rig.CENTRES.items():
        peg = rig.machine(centre, rig.TRAINING, d.LIMIT, made=made)
        spent = own_contact.processor_time(peg, 8.0, rig.feed)
        yield f"{name}, at most {d.LIMIT:g} N: depth after 8 s, mm", -1e3 * rig.height(peg)
    yield "processor time of a simulated second at 1 ms, s", spent


def reach(peg, depth):
    while rig.height(peg) > -depth and peg.time < 10.0:
        peg.hurry(rig.feed)
    peg.start()


def predicted(spring):
    """By Whitney's theory with springs of contact, N/m; a rigid contact is an infinite one."""
    whitney.SPRING = spring
    for name, depths in DEPTHS.items():
        for depth in depths:
            _, force, lean = whitney.insertion(whitney.Support(rig.CENTRES[name]), -depth)
            yield f"{name}, {depth * 1e3:g} mm deep: force, N", force
            yield f"{name}, {depth * 1e3:g} mm deep: lean, mrad", 1e3 * lean
    for name, centre in rig.CENTRES.items():
        jam = whitney.jams(whitney.Support(centre), d.LIMIT)
        yield f"{name}, at most {d.LIMIT:g} N: jams at, mm", 1e3 * jam if jam else "through"
    yield "", "–"


def main():
    columns = {"theory": list(predicted(d.STIFFNESS / 2)), "Pong": list(figures(None))}
    columns |= {name: list(figures(own(contact))) for name, contact in SETS.items()}
    columns["rigid theory"] = list(predicted(math.inf))
    own_contact.table(columns)


if __name__ == "__main__":
    main()

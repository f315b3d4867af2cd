#!/usr/bin/env python3
"""Comparison of the same peg and wrist with the contact of MuJoCo, of Drake and of Pong, and Whitney's theory.

python3 mechanisms/peg/own.py        with the plugin as for mechanisms/run.py; with Drake where `pip install drake` was

A bore is no geom of MuJoCo, nor of Drake's contact at points. The hole is SIDES convex pieces, each with a flat of the
wall and one of the chamfer. Two flats are square to the plane in which the peg moves, so in that plane the hole is exact;
its corners are HOLE·(1/cos(π/SIDES) − 1) further out, 0.49 mm with 16.
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
import whitney  # noqa: E402

from kit import in_drake as drake  # noqa: E402
from kit import own_contact, shapes  # noqa: E402

STEP = 5e-4  # s
SIDES, THICK = 16, 0.02  # m of the wall
DEPTHS = {"near": (-1e-3, 0.01, 0.03, 0.05, 0.07), "far": (-1.5e-3, 0.01, 0.03, 0.05, 0.07)}  # m, as in outcome.py
SETS = {"MuJoCo": own_contact.DEFAULT, "springs": own_contact.SPRINGS, "hard": own_contact.hard(STEP)}
ONE_POINT = replace(own_contact.SPRINGS, one_point=True)  # added after the comparison, to explain it
# Pong's peg shares its stiffness between its two ends; so does each contact here.
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
    assets = "".join(shapes.mesh(name, piece) for name, piece in zip(names, pieces(sides)))
    return own_contact.with_geoms(text, {"hole": geoms}, assets), names


def own(contact, sides=SIDES):
    def made(text, carriers):
        text, names = with_hole(text, sides)
        return own_contact.Own(text, carriers, contact, {"shaft": SURFACE}, names)

    return made


def in_drake(way, sides=SIDES):
    def made(text, carriers):
        text, names = with_hole(text, sides)
        return drake.InDrake(text, carriers, way, {"shaft": SURFACE}, names)

    return made


def figures(made):
    """Force and tilt against depth, the jam, processor time."""
    for name, centre in rig.CENTRES.items():
        peg, greatest = rig.machine(centre, STEP, made=made), []
        for depth in DEPTHS[name]:
            force, lean = around(peg, depth, greatest)
            yield f"{name}, {depth * 1e3:g} mm deep: force, N", force
            yield f"{name}, {depth * 1e3:g} mm deep: lean, mrad", 1e3 * lean
        yield f"{name}: greatest force from there to 3 mm deep, N", max(greatest)
    for name, centre in rig.CENTRES.items():
        peg = rig.machine(centre, rig.TRAINING, d.LIMIT, made=made)
        spent = own_contact.processor_time(peg, 8.0, rig.feed)
        depth = -1e3 * rig.height(peg)
        yield f"{name}, at most {d.LIMIT:g} N: depth after 8 s, mm", depth if depth < 95 else "through"
    yield "processor time of a simulated second at 1 ms, s", spent


def around(peg, depth, greatest):
    """Means over the last quarter of a millimetre before a depth and the first one after it, since some contacts chatter.

    `greatest` gets the forces between the first such place and the depth of 3 mm.
    """
    seen = []
    while rig.height(peg) > -depth - 0.25e-3 and peg.time < 10.0:
        peg.advance(rig.feed)
        height = rig.height(peg)
        if height < -depth + 0.25e-3:
            seen.append((rig.resistance(peg), rig.lean(peg)))
        elif greatest and height > -3e-3:
            greatest.append(rig.resistance(peg))
    greatest += [force for force, _ in seen if depth < 3e-3]
    return np.mean(seen, axis=0)


def predicted(spring):
    """Whitney's theory with contact springs, N/m. `None`: rigid, for depths only; not at the transition to two contacts."""
    whitney.SPRING = spring or 1e9
    for name, depths in DEPTHS.items():
        support = whitney.Support(rig.CENTRES[name])
        for depth in depths:
            _, force, lean = whitney.insertion(support, -depth)
            yield f"{name}, {depth * 1e3:g} mm deep: force, N", force
            yield f"{name}, {depth * 1e3:g} mm deep: lean, mrad", 1e3 * lean
        on_the_way = [whitney.insertion(support, -z)[1] for z in np.arange(depths[0], 3e-3, 1e-5)] if spring else ["–"]
        yield f"{name}: greatest force from there to 3 mm deep, N", max(on_the_way)
    for name, centre in rig.CENTRES.items():
        jam = whitney.jams(whitney.Support(centre), d.LIMIT)
        yield (
            f"{name}, at most {d.LIMIT:g} N: depth after 8 s, mm",
            (1e3 * jam if jam else "through") if spring else "–",
        )
    yield "", "–"


def main():
    """Makes one column after another: `own.py theory Pong` makes these two."""
    columns = {"theory": lambda: predicted(d.STIFFNESS / 2), "Pong": partial(figures, rig.Machine)}
    columns |= {name: partial(figures, own(contact)) for name, contact in SETS.items()}
    ways = (drake.SAP, drake.LAGGED) if drake.at_hand() else ()
    columns |= {f"Drake-{way}": partial(figures, in_drake(way)) for way in ways}
    # Sets that explain the differences: four flats, and one point for each of them; a rigid contact.
    columns["4-springs"] = partial(figures, own(ONE_POINT, 4))
    columns |= {f"4-Drake-{way}": partial(figures, in_drake(way, 4)) for way in ways[:1]}
    columns["rigid theory"] = lambda: predicted(None)
    own_contact.compare(columns)


if __name__ == "__main__":
    main()

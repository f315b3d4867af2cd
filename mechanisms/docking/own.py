#!/usr/bin/env python3
"""The same approaches with MuJoCo's own contact: captured or not, when, and with which forces?

python3 mechanisms/docking/own.py        with the plugin as for mechanisms/run.py

RUNS approaches within the initial contact conditions, level training, dispersed as in campaign.py but drawn here, so that
they stay the same. MuJoCo's geoms are the polyhedra of the same contact models,
as convex meshes; edges and pads, which are primitives of their own in Pong, are edges and faces of these.
"""

import math
import pathlib
import sys
import time
from dataclasses import replace
from functools import partial

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import campaign  # noqa: E402
import dimensions as d  # noqa: E402
import docking  # noqa: E402
import numpy as np  # noqa: E402
import vehicles  # noqa: E402
from sequence import Sequencer  # noqa: E402

from kit import own_contact, shapes  # noqa: E402
from kit.machine import Machine  # noqa: E402

RUNS = 10
STEP = d.TRAINING.step
SETS = {"MuJoCo": own_contact.DEFAULT, "springs": own_contact.SPRINGS, "hard": own_contact.hard(STEP)}
# Of a pair, by the rules for two surfaces (docs/theory.md, 3): structure on structure, latch on structure.
STRUCTURE = own_contact.Surface(5e5, 4400.0 / 2, 0.2)
LATCH_SHARE = 1e6 / 1.2e6
LATCH = own_contact.Surface(2e5 * LATCH_SHARE, 60.0 * LATCH_SHARE**2 + 4400.0 * (1 - LATCH_SHARE) ** 2, 2 * 0.02 / 0.3)


def solids(vehicle):
    """(name of a geom, the body that carries it, vertices) of all polyhedra of a contact model."""
    root = shapes.read(vehicles.SOFT[vehicle])["root"]
    for index, (carrier, solid) in enumerate(shapes.polyhedra(root, vehicle)):
        yield f"{vehicle}_{index}", carrier, solid["vertices"]


def own(contact, structure=STRUCTURE):
    def made(text, carriers):
        geoms, assets, movers, grounds = {}, "", {}, []
        for vehicle in vehicles.SOFT:
            for name, body, vertices in solids(vehicle):
                assets += shapes.mesh(name, vertices)
                geoms[body] = geoms.get(body, "") + f'<geom name="{name}" type="mesh" mesh="{name}" mass="0"/>'
                if vehicle == "target":
                    grounds.append(name)
                else:
                    movers[name] = LATCH if body.startswith("latch") else structure
        return own_contact.Own(own_contact.with_geoms(text, geoms, assets), carriers, contact, movers, grounds)

    return made


def within_disc(radius, a, b):
    """Even over a disc, of two numbers from 0 to 1."""
    way = 2 * math.pi * b
    return (radius * math.sqrt(a) * math.cos(way), radius * math.sqrt(a) * math.sin(way))


def case(run):
    """Each run has a generator of its own."""
    u = np.random.default_rng([1, run]).uniform(size=11)
    return docking.Case(
        speed=d.CLOSING[0] + (d.CLOSING[1] - d.CLOSING[0]) * u[0],
        lateral=within_disc(d.LATERAL, u[1], u[2]),
        lateral_rate=within_disc(d.LATERAL_RATE, u[3], u[4]),
        tilt=within_disc(d.TILT, u[5], u[6]),
        roll=d.ROLL * (2 * u[7] - 1),
        rates=tuple(d.RATE * (2 * u[8:11] - 1)),
        give_up=campaign.GIVE_UP,
    )


def attempt(run, kind):
    """One approach: captured, when, greatest force between the vehicles, stroke, processor time of a simulated second."""
    made = docking.approach(case(run), hard=False, kind=kind)
    sequencer, spent, force, stroke = Sequencer(give_up=campaign.GIVE_UP, hard=False), 0.0, 0.0, 0.0
    while sequencer.phase != "abort" and not campaign.ended(made, sequencer):
        began = time.process_time()
        made.hurry(sequencer)
        spent += time.process_time() - began
        if made.contacts():
            force = max(force, float(np.linalg.norm(made.wrench("target")[:3])))
        stroke = max(stroke, -made.joint("ring_z"))
    return sequencer.captured_at, force, stroke, spent / made.time


def figures(kind):
    results = []
    for run in range(RUNS):
        at, force, stroke, spent = attempt(run, kind)
        results.append((at, force, stroke, spent))
        yield f"run {run}: captured at, s", at or "no"
        yield f"run {run}: greatest force, N", force
        yield f"run {run}: stroke, mm", 1e3 * stroke
    yield f"captured, of {RUNS}", sum(at is not None for at, *_ in results)
    yield "median of the greatest force, N", float(np.median([force for _, force, *_ in results]))
    yield "processor time of a simulated second, s", float(np.mean([spent for *_, spent in results]))


def main():
    """One column after another: `own.py Pong hard` makes these two."""
    columns = {"Pong": lambda: figures(Machine)}
    columns |= {name: partial(figures, own(contact)) for name, contact in SETS.items()}
    # Added after the comparison, to explain it.
    columns["damped/10"] = partial(
        figures, own(own_contact.SPRINGS, replace(STRUCTURE, damping=STRUCTURE.damping / 10))
    )
    own_contact.compare(columns)


if __name__ == "__main__":
    main()

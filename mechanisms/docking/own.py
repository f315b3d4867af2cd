#!/usr/bin/env python3
"""Comparison of the same approaches with the contact of MuJoCo and of Drake: capture, its time, and forces.

python3 mechanisms/docking/own.py        with the plugin as for mechanisms/run.py; with Drake where `pip install drake` was
python3 mechanisms/docking/own.py Drake-sap/2 6    this column, and of the ten approaches this one
python3 mechanisms/docking/own.py free   the ring on its legs touches nothing: MuJoCo and Drake must move it alike

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
import mujoco  # noqa: E402
import numpy as np  # noqa: E402
import stewart  # noqa: E402
import vehicles  # noqa: E402
from rig_ring import turned  # noqa: E402
from sequence import Sequencer  # noqa: E402

from kit import in_drake as drake  # noqa: E402
from kit import own_contact, shapes  # noqa: E402
from kit.machine import Machine  # noqa: E402
from kit.rows import Limit, Row, show  # noqa: E402

RUNS = 10
TABLE = ("Pong", "MuJoCo", "springs", "hard", "damped/10", "converged-springs", "Drake-sap", "Drake-lagged")
IMPRATIOS = ("1000", "10000", "100000")
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


def other(engine, how, structure=STRUCTURE):
    """A class of machine. `engine`: Own or InDrake; `how`: its set of parameters."""

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
        return engine(own_contact.with_geoms(text, geoms, assets), carriers, how, movers, grounds)

    return made


def converged(kind):
    """The set with a MuJoCo solver that iterates to convergence.

    Its tolerance is a share of the mean inertia, and the target has 420 t: by default it ends when legs of 2.5 kg may
    still be far off.
    """

    def made(text, carriers):
        machine = kind(text, carriers)
        options = machine.model.opt
        options.tolerance, options.iterations, options.ls_tolerance, options.ls_iterations = 0.0, 200, 1e-6, 200
        return machine

    return made


def within_disc(radius, a, b):
    """Uniform point of a disc from two numbers in 0…1."""
    way = 2 * math.pi * b
    return (radius * math.sqrt(a) * math.cos(way), radius * math.sqrt(a) * math.sin(way))


def case(run):
    """Random case of a run; each run has its own generator."""
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


def gap(made):
    """Largest gap of the six closures, m."""
    return docking.wrong_kinematics(made)[1]


def attempt(run, kind):
    """Result of one approach: capture and its time, largest force between the vehicles, stroke, gap of the closures,
    processor time of a simulated second."""
    made = docking.approach(case(run), hard=False, kind=kind)
    sequencer, spent, force, stroke, opened = Sequencer(give_up=campaign.GIVE_UP, hard=False), 0.0, 0.0, 0.0, 0.0
    while sequencer.phase != "abort" and not campaign.ended(made, sequencer):
        began = time.process_time()
        made.hurry(sequencer)
        spent += time.process_time() - began
        if made.contacts():
            force = max(force, float(np.linalg.norm(made.wrench("target")[:3])))
        stroke, opened = max(stroke, -made.joint("ring_z")), max(opened, gap(made))
    return sequencer.captured_at, force, stroke, opened, spent / made.time


def figures(kind, runs=range(RUNS)):
    results = []
    for run in runs:
        results.append(attempt(run, kind))
        at, force, stroke, *_ = results[-1]
        yield f"run {run}: captured at, s", at or "no"
        yield f"run {run}: greatest force, N", force
        yield f"run {run}: stroke, mm", 1e3 * stroke
    times, forces, strokes, gaps, spent = zip(*results)
    caught = [at for at in times if at is not None]
    yield f"captured, of {len(runs)}", len(caught)
    yield "mean time of capture, s", float(np.mean(caught)) if caught else "none"
    yield "median of the greatest force, N", float(np.median(forces))
    yield "median of the stroke, mm", 1e3 * float(np.median(strokes))
    yield "closures of the legs open by, µm", 1e6 * max(gaps)
    yield "processor time of a simulated second, s", float(np.mean(spent))


# --- common parts: nothing touches
# -------------------------------------------------------------------------------------

ASIDE, LEANING, SECONDS = np.array((0.03, -0.02, -0.04)), np.array((0.05, -0.08, 0.10)), 3.0  # m, rad, s


def let_go(kind, step):
    """The ring, displaced sideways and released on its legs, far from the target: its pose, slides of the legs and the
    chaser each 10 ms."""
    made = docking.approach(docking.Case(gap=3.0, level=replace(d.TRAINING, step=step)), hard=False, kind=kind)
    stewart.set_pose(made.model, made.data, stewart.NEUTRAL + ASIDE, turned(LEANING))
    made.start()
    sequencer, every, seen, opened = Sequencer(give_up=campaign.GIVE_UP, hard=False), round(0.01 / step), [], 0.0
    for k in range(round(SECONDS / step)):
        made.hurry(sequencer)
        if (k + 1) % every == 0:
            mujoco.mj_kinematics(made.model, made.data)  # MuJoCo's step leaves the places of before
            place, frame = stewart.pose(made.model, made.data)
            slides = [made.joint(f"leg_{i}") for i in range(stewart.LEGS)]
            seen.append(np.hstack([place, frame.ravel(), slides, made.place("chaser")]))
            opened = max(opened, gap(made))
    return np.array(seen), opened


def free():
    """Free motion in both engines: semi-implicit Euler in each, so they differ by the step and by the stiffness of the
    loops."""
    differences = []
    for step in (STEP, STEP / 2):
        (mine, _), (theirs, opened) = (
            let_go(kind, step)
            for kind in (other(own_contact.Own, own_contact.DEFAULT), other(drake.InDrake, drake.SAP))
        )
        differences.append(float(np.abs(mine - theirs).max()))
        what = f"step {step * 1e3:g} ms: place, turn, slides and chaser in Drake differ from MuJoCo's by"
        yield Limit(what, differences[-1], 5e-6 * step / STEP, "m, rad")
        yield Limit("   loops are open in Drake by", opened, 1e-6, "m")
        yield Limit("   the ring moved by", float(np.ptp(mine[:, :3], axis=0).max()), 0.04, "m", least=True)
    yield Row("half the step makes the difference", differences[1] / differences[0], 0.5, 0.1)


def kinds():
    """Classes of machine by column name."""
    springs, damped = own_contact.SPRINGS, replace(STRUCTURE, damping=STRUCTURE.damping / 10)
    made = {"Pong": Machine, **{name: other(own_contact.Own, contact) for name, contact in SETS.items()}}
    # Added after the comparison, to explain it.
    made["damped/10"] = other(own_contact.Own, springs, damped)
    made |= {f"impratio-{n}": other(own_contact.Own, replace(springs, impratio=float(n))) for n in IMPRATIOS}
    made |= {f"converged-{name}": converged(other(own_contact.Own, contact)) for name, contact in SETS.items()}
    made["one-point"] = other(own_contact.Own, replace(springs, one_point=True))
    if drake.at_hand():
        for way in (drake.SAP, drake.LAGGED):
            made[f"Drake-{way}"] = other(drake.InDrake, way)
            made[f"Drake-{way}/2"] = other(drake.InDrake, way, replace(STRUCTURE, friction=STRUCTURE.friction / 2))
    return made


def main():
    """Makes a table of the named columns and approaches; without names, the table of the page."""
    named = sys.argv[1:]
    if named == ["free"]:
        sys.exit(show("the ring let go, nothing touches", free()) if drake.at_hand() else 0)
    runs = [int(word) for word in named if word.isdigit()] or range(RUNS)
    columns = {name: partial(figures, kind, runs) for name, kind in kinds().items()}
    wanted = [word for word in named if not word.isdigit()] or [name for name in TABLE if name in columns]
    own_contact.table({name: list(columns[name]()) for name in wanted})


if __name__ == "__main__":
    main()

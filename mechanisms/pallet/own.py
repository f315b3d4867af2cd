#!/usr/bin/env python3
"""Comparison of the same pallet and rails with the contact of MuJoCo, of Drake and of Pong, and the law of a drawer.

python3 mechanisms/pallet/own.py        with the plugin as for mechanisms/run.py; with Drake where `pip install drake` was

Wheels are ellipsoids and rails are the polyhedra of models/htv_pallet for all of them: the geometry is the same.
"""

import pathlib
import sys
from functools import partial

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import drawer  # noqa: E402
import rig  # noqa: E402
from dimensions import TRAINING, model  # noqa: E402

from kit import in_drake as drake  # noqa: E402
from kit import mjcf, own_contact, shapes  # noqa: E402

SETS = {"MuJoCo": own_contact.DEFAULT, "springs": own_contact.SPRINGS, "hard": own_contact.hard(TRAINING.step)}
CASES = ((0.4, drawer.SHORT), (0.7, drawer.SHORT), (1.0, drawer.SHORT), (1.1, drawer.LONG))
# Wheel and rail as springs in series (docs/theory.md, 3).
SHARE = model.STEEL_STIFFNESS / (model.WHEEL_STIFFNESS + model.STEEL_STIFFNESS)
SURFACE = own_contact.Surface(model.WHEEL_STIFFNESS * SHARE, model.WHEEL_DAMPING * SHARE**2, model.FRICTION)


def tread(name):
    semi_axes = [model.wheel_radius(name)] * 3
    semi_axes[model.axle(name)] = model.wheel_half_width(name)
    return f'<geom name="tread_{name}" type="ellipsoid" size="{mjcf.numbers(semi_axes)}" mass="0"/>'


def with_shapes(text):
    rails = [
        solid["vertices"] for _, solid in shapes.polyhedra(shapes.read("models/htv_pallet/rails.ron")["root"], "")
    ]
    names = [f"rail_{k}" for k in range(len(rails))]
    drawn = "".join(f'<geom name="{name}" type="mesh" mesh="{name}"/>' for name in names)
    assets = "".join(shapes.mesh(name, vertices) for name, vertices in zip(names, rails))
    treads = {name: tread(name) for name in model.WHEELS}
    return own_contact.with_geoms(text, {"world": drawn, **treads}, assets), names


def other(engine, how):
    """A class of machine. `engine`: Own or InDrake; `how`: its set of parameters."""

    def made(text, carriers):
        text, rails = with_shapes(text)
        return engine(text, carriers, how, {f"tread_{name}": SURFACE for name in model.WHEELS}, rails)

    return made


def figures(kind):
    for offset, base in CASES:
        force, predicted, _ = drawer.steady(offset, base, TRAINING, kind=kind)
        yield f"e {offset:g} m, base {base:g} m: push, N", force
        yield "  over D/(1 − 2μe/L) of its lever and base", force / predicted
    yield "e 0.7 m: time with no contact", apart(kind)
    for most in (1000.0, 1500.0):
        made, push, went = drawer.jammed(1.6, drawer.SHORT, most, TRAINING, kind=kind)
        yield f"jammed, {most:g} N: 2μe/L", drawer.share(made, push)
        yield f"jammed, {most:g} N: way in a second, mm", 1e3 * went
    made, push, _ = drawer.jammed(1.6, drawer.SHORT, 1000.0, TRAINING, kind=kind)
    freed, share = drawer.accommodate(made, push)
    yield "accommodation: 2μe/L when it goes", share if freed else "not freed"
    made = drawer.machine(drawer.SHORT, TRAINING, kind=kind)
    spent = own_contact.processor_time(made, 3.0, drawer.Push(0.7, drawer.SHORT, 1e6))
    yield "processor time of a simulated second, s", spent


def apart(kind):
    """Share of half a second of steady sliding without any contact."""
    made, push, without = drawer.machine(drawer.SHORT, TRAINING, kind=kind), drawer.Push(0.7, drawer.SHORT, 1e6), []
    made.run(5.0, push)
    made.run(0.5, push, lambda m: without.append(m.contacts() == 0))
    return sum(without) / len(without)


def main():
    """Makes one column after another: `own.py Pong hard` makes these two."""
    columns = {"Pong": partial(figures, rig.Machine)}
    columns |= {name: partial(figures, other(own_contact.Own, contact)) for name, contact in SETS.items()}
    if drake.at_hand():
        columns |= {f"Drake-{way}": partial(figures, other(drake.InDrake, way)) for way in (drake.SAP, drake.LAGGED)}
    own_contact.compare(columns)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Draws picture.png without a screen: the latches have caught, the legs take up the motion.

MUJOCO_GL=egl python3 mechanisms/docking/picture.py        with the plugin as for mechanisms/run.py
"""

import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import docking  # noqa: E402
import vehicles  # noqa: E402
from kit import picture, shapes  # noqa: E402
from sequence import Sequencer  # noqa: E402

COLOURS = {"chaser": "0.75 0.75 0.8 1", "ring": "0.85 0.7 0.35 1", "target": "0.4 0.5 0.65 0.35"}
LATCH = "0.8 0.3 0.2 1"
CHOSEN = {**vehicles.SOFT, "target ": vehicles.HARD["hard_target"]}


def drawn():
    """(assets, body → geoms) of what is to be seen of the contact models."""
    assets, geoms = "", {}
    for name, path in CHOSEN.items():
        for index, (carrier, solid) in enumerate(shapes.polyhedra(shapes.read(path)["root"], name.strip())):
            mesh = f"{name.strip()}_{len(name)}_{index}"
            assets += shapes.mesh(mesh, solid["vertices"])
            colour = COLOURS.get(carrier, LATCH)
            text = f'<geom type="mesh" mesh="{mesh}" rgba="{colour}" mass="0"/>'
            geoms[carrier] = geoms.get(carrier, "") + text
    return f"<asset>{assets}</asset>", geoms


def main():
    assets, geoms = drawn()
    made, sequencer = docking.approach(docking.Case(), drawn=geoms, assets=assets), Sequencer()
    made.run(20.0, sequencer, watch=lambda m: sequencer.phase == "attenuate" and m.time > sequencer.since + 0.5)
    made.model.stat.meansize = 0.1  # of discs and arrows; the vehicles are much larger than what is seen
    middle = made.place("ring") - (0.0, 0.0, 0.15)
    picture.take(made, HERE / "picture.png", middle, distance=2.0, azimuth=140, elevation=-22, force_scale=2e-3)


if __name__ == "__main__":
    main()

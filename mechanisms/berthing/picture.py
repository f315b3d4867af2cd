#!/usr/bin/env python3
"""Draws picture.png without a screen: the latches pull the module in.

MUJOCO_GL=egl python3 mechanisms/berthing/picture.py        with the plugin as for mechanisms/run.py
"""

import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import berth  # noqa: E402
import sequencer as seq  # noqa: E402
from kit import picture  # noqa: E402


def main():
    machine = berth.Berthing(berth.Case())
    machine.until(seq.CAPTURE)
    machine.run(10.0, machine.control, watch=lambda m: m.gap() < 0.045)
    machine.model.vis.scale.contactwidth, machine.model.vis.scale.contactheight = 0.06, 0.02
    picture.take(machine, HERE / "picture.png", (0.45, 0.15, -0.06), 1.25, 165, -18, 4e-4)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Draws picture.png without a screen: the truss in its latches, held by the arm, claws closed.

MUJOCO_GL=egl python3 mechanisms/retention/picture.py        with the plugin as for mechanisms/run.py
"""

import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import latch  # noqa: E402
from kit import picture  # noqa: E402


def main():
    made = latch.Berthing()
    made.run()
    picture.take(made.machine, HERE / "picture.png", (0, 0, 1.5), distance=17, azimuth=130, elevation=-22)


if __name__ == "__main__":
    main()

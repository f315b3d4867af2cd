#!/usr/bin/env python3
"""Draws picture.png without a screen: the snare has closed round the grapple shaft, and the carriage pulls.

MUJOCO_GL=egl python3 mechanisms/end_effector/picture.py        with the plugin as for mechanisms/run.py
"""

import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import capture  # noqa: E402
from dimensions import Snare  # noqa: E402
from kit import picture  # noqa: E402


def main():
    case = capture.Case(snare=Snare())
    made, sequencer = capture.machine(case), capture.Sequencer(case.snare)
    made.run(20.0, sequencer, watch=lambda m: sequencer.phase == "retract")
    made.run(0.4, sequencer)
    picture.take(made, HERE / "picture.png", lookat=(0.0, 0.0, 0.03), distance=0.62, azimuth=150, elevation=-38)


if __name__ == "__main__":
    main()

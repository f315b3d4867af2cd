#!/usr/bin/env python3
"""Draws pictures without a screen. picture.png: the snare has closed round the grapple shaft, and the carriage pulls.
seating.png: the cams of the payload go between the rollers, and the teeth are about to meet.

MUJOCO_GL=egl python3 mechanisms/end_effector/picture.py        with the plugin as for mechanisms/run.py
"""

import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import capture  # noqa: E402
from dimensions import SEAT, Snare, training  # noqa: E402
from kit import picture  # noqa: E402
from scene import Case  # noqa: E402


def snared():
    case = Case(snare=training(Snare()))
    made, sequencer = capture.machine(case), capture.sequencer_of(case)
    made.run(20.0, sequencer, watch=lambda m: sequencer.phase == "retract")
    made.run(0.4, sequencer)
    picture.take(made, HERE / "picture.png", lookat=(0.0, 0.0, 0.03), distance=0.62, azimuth=150, elevation=-38)


def seating():
    case = Case(snare=training(Snare()), roll_deg=5.0)
    made, sequencer = capture.machine(case), capture.sequencer_of(case)
    made.run(20.0, sequencer, watch=lambda m: capture.in_shell(m)[2] < SEAT + 0.014)
    picture.take(made, HERE / "seating.png", lookat=(0.0, 0.0, 0.02), distance=0.52, azimuth=200, elevation=12)


def main():
    snared()
    seating()


if __name__ == "__main__":
    main()

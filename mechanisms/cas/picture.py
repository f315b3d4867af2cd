#!/usr/bin/env python3
"""Draws picture.png without a screen: the payload in its vanes, pulled by the claw.

MUJOCO_GL=egl python3 mechanisms/cas/picture.py        with the plugin as for mechanisms/run.py
"""

import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import seat  # noqa: E402
from dimensions import TRAINING  # noqa: E402
from kit import picture  # noqa: E402


def main():
    made = seat.Capture(TRAINING.step).run().machine
    made.model.stat.meansize = 0.07  # small contact marks
    picture.take(made, HERE / "picture.png", (0, 0, 0.06), distance=1.6, azimuth=-62, elevation=-22, force_scale=4e-5)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Draws picture.png without a screen: a pallet that a push at its corner has jammed in its rails.

MUJOCO_GL=egl python3 mechanisms/pallet/picture.py        with the plugin as for mechanisms/run.py
"""

import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import drawer  # noqa: E402
from dimensions import TRAINING  # noqa: E402
from kit import picture  # noqa: E402


def main():
    made, _, _ = drawer.jammed(1.6, drawer.SHORT, 1000.0, TRAINING)
    picture.take(made, HERE / "picture.png", (1.4, 0.0, 0.0), distance=5.2, azimuth=120, elevation=-48)


if __name__ == "__main__":
    main()

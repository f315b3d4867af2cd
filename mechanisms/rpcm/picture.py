#!/usr/bin/env python3
"""Draws picture.png without a screen: a box that is turned between its rails and jams.

MUJOCO_GL=egl python3 mechanisms/rpcm/picture.py        with the plugin as for mechanisms/run.py
"""

import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import jam  # noqa: E402
from kit import picture  # noqa: E402


def main():
    made, _, _, _ = jam.pushed(jam.OFFSET)
    made.model.vis.scale.contactwidth = 0.1
    made.model.vis.scale.contactheight = 0.03
    made.model.vis.scale.forcewidth = 0.02
    picture.take(
        made, HERE / "picture.png", (0.05, 0.0, 0.0), distance=0.55, azimuth=60, elevation=-50, force_scale=1e-3
    )


if __name__ == "__main__":
    main()

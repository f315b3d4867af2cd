#!/usr/bin/env python3
"""Draws picture.png without a screen: the hexapod walks over the terrain.

MUJOCO_GL=egl python3 mechanisms/hexapod/picture.py        with the plugin as for mechanisms/run.py
"""

import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import dimensions as d  # noqa: E402
import scenes  # noqa: E402

from kit import picture  # noqa: E402


def main():
    walk = scenes.Walk(d.TRAINING.step, 1)
    walk.go(7.0)
    walk.go(0.2, walk.hexapod.advance)
    model = walk.hexapod.model
    model.vis.scale.contactwidth, model.vis.scale.forcewidth = 0.15, 0.06
    place = walk.hexapod.place("body")
    picture.take(walk.hexapod, HERE / "picture.png", place - (0, 0, 0.06), 1.3, 65.0, -24.0, force_scale=8e-3)


if __name__ == "__main__":
    main()

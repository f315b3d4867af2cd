#!/usr/bin/env python3
"""Draws picture.png without a screen: the arm has set the tripod down on a slope.

MUJOCO_GL=egl python3 mechanisms/tripod/picture.py        with the plugin as for mechanisms/run.py
"""

import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import outcome  # noqa: E402
import rig  # noqa: E402

from kit import picture  # noqa: E402


def main():
    made, arm, normal = rig.held(outcome.HOLDING)
    outcome.press(arm, normal)
    made.run(24.0, arm.control)
    made.model.vis.scale.contactwidth, made.model.vis.scale.forcewidth = 0.025, 0.015
    picture.take(made, HERE / "picture.png", made.place("tripod"), 2.8, 110.0, -12.0, force_scale=3e-3)


if __name__ == "__main__":
    main()

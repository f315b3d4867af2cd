#!/usr/bin/env python3
"""Draws picture.png: the arm presses its ball onto the pad. Needs what run.py needs, and OpenGL without a screen."""

import os
import pathlib
import sys

os.environ.setdefault("MUJOCO_GL", "egl")
HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]
import contact  # noqa: E402
import rig  # noqa: E402

from kit import picture  # noqa: E402


def main():
    made, arm, normal = rig.machine()
    contact.commanded(arm, normal, contact.PUSH)
    made.run(6.0, arm.control)
    made.model.vis.scale.contactwidth, made.model.vis.scale.forcewidth = 0.08, 0.08
    middle = 0.5 * (made.place("base") + made.place("tip"))
    picture.take(made, HERE / "picture.png", middle, 13.0, 90.0, -15.0, force_scale=5e-3)


if __name__ == "__main__":
    main()

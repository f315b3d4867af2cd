#!/usr/bin/env python3
"""Draws picture.png without a screen: the middle wheels are coming up a step.

MUJOCO_GL=egl python3 mechanisms/rover/picture.py        with the plugin as for mechanisms/run.py
"""

import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import dimensions as d  # noqa: E402
import rig  # noqa: E402
import scenes  # noqa: E402
from kit import picture  # noqa: E402

HEIGHT = 0.190


def main():
    made = rig.machine(d.RIGID, x=-0.5, more_ground=HEIGHT, height=HEIGHT + 0.005)
    made.run(1.2, scenes.crawl(0.0, d.RIGID))
    told = scenes.crawl(0.3, d.RIGID)
    made.run(5.0, told, lambda m: m.place("wheel_middle_left")[2] > HEIGHT / 2 + d.model.WHEEL_RADIUS)
    picture.take(
        made, HERE / "picture.png", (0.0, 0.0, 0.4), distance=4.6, azimuth=125, elevation=-14, force_scale=1e-3
    )


if __name__ == "__main__":
    main()

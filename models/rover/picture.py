#!/usr/bin/env python3
"""Takes picture.png: the rover in its traverse. Runs as models/pictures.py says."""

import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]
import pictures  # noqa: E402

if __name__ == "__main__":
    pictures.main(
        HERE,
        "scene_traverse.ron",
        at_s=4.5,
        eye=(6.4, -4.0, 2.3),
        target=(2.9, 0.2, 0.15),
        lens_mm=45.0,
        size=(640, 340),
        arrow_m=0.7,
        alpha=1.0,
    )

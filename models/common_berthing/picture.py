#!/usr/bin/env python3
"""Takes picture.png: the module at the hand-over, two fins held by their guides, latches over the fittings."""

import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]
import pictures  # noqa: E402

if __name__ == "__main__":
    pictures.main(HERE, "scene_berthing.ron", 30.0, (2.6, -2.4, 1.7), (0.0, 0.0, 0.0), lens_mm=60.0, arrow_m=0.4)

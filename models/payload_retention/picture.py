#!/usr/bin/env python3
"""Takes picture.png: a pin on the flare of its latch, a moment before it falls into the socket."""

import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]
import pictures  # noqa: E402
from dimensions import LATCHES, SILL_Y  # noqa: E402

LATCH = (LATCHES["primary_port"][0], -SILL_Y, 0.10)

if __name__ == "__main__":
    eye = (LATCH[0] - 0.70, LATCH[1] - 1.3, LATCH[2] + 0.9)
    pictures.main(HERE, "scene_berthing.ron", 21.8, eye, LATCH, arrow_m=2.0)

#!/usr/bin/env python3
"""Takes the picture of the docking: petals meet, off by 0.1 m and 4 degrees.

    bash c_examples/run docking --fast --case fast,x+,roll+,pitch- --seconds 5 --log LOG
    python picture.py LOG [-o PNG]

with Blender as a Python module.
"""

import argparse
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import pictures  # noqa: E402

AT_S = 2.1
EYE, TARGET = (2.2, -2.9, 1.75), (0.02, 0.0, 0.03)

if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="Takes a picture of the docking with Blender.")
    parser.add_argument("log", help="folder that the docking wrote")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=HERE / "picture.png")
    given = parser.parse_args()
    pictures.take(given.log, given.output, AT_S, EYE, TARGET, lens_mm=68.0, arrow_m=0.8, alpha=0.96)
    pictures.leave()

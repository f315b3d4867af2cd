# SPDX-License-Identifier: GPL-3.0-or-later
"""Durations of playback. No test: run it on a quiet machine.

    PYTHONPATH=blender python blender/tests/viz/timing.py LOG [PICTURES]

Prints the seconds to make the scene, then for each engine and size the first picture (which compiles shaders) and the least
and middle of those after it.
"""

import os
import sys
import tempfile
import time
from pathlib import Path

import bpy
import numpy as np
from pong_viz.log import Log
from pong_viz.render import Picture, prepare, still
from pong_viz.scene import Options, show


def timed(function, *arguments):
    """Wall-clock seconds, and processor seconds of all threads."""
    passed, spent = time.perf_counter(), time.process_time()
    function(*arguments)
    return time.perf_counter() - passed, time.process_time() - spent


def main():
    log, count = Log(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 10
    scene = bpy.context.scene
    made = min(timed(show, log, Options(fps=60)) for _ in range(3))
    print(f"{scene.frame_end} pictures, {len(scene.objects)} objects: scene made in {made[0]:.2f} s", flush=True)
    numbers = np.unique(np.linspace(1, scene.frame_end, count + 1).astype(int))
    with tempfile.TemporaryDirectory() as folder:
        for engine in ("workbench", "eevee"):
            for width, height in ((640, 360), (1280, 720)):
                prepare(scene, Picture(width, height, engine, 8))
                first, *others = [timed(still, scene, Path(folder) / "a.png", int(number)) for number in numbers]
                least, middle = np.min(others, axis=0), np.median(others, axis=0)
                print(f"{engine} {width}x{height}: first {first[0]:.2f} s, then least {least[0]:.2f} s, middle {middle[0]:.2f} s "
                      f"(processors {least[1]:.2f} s)", flush=True)
    os._exit(0)


main()

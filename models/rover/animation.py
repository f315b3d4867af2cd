#!/usr/bin/env python3
"""Makes docs/figures/rover.webp: the rover in its traverse. Runs as models/pictures.py says; needs Pillow as well."""

import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]
import pictures  # noqa: E402

if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as log:
        subprocess.run([sys.argv[1], "run", "--quiet", "--log", log, str(HERE / "scene_traverse.ron")], check=True)
        pictures.animate(
            log,
            HERE.parents[1] / "docs" / "figures" / "rover.webp",
            start_s=2.875,
            end_s=5.875,
            eye=(5.24, -4.0, 2.3),
            travel=(2.2, 0.0, 0.0),
            target=(1.74, 0.2, 0.15),
            lens_mm=45.0,
            size=(720, 384),
            fps=16,
            speed=1.0,
            arrow_m=0.7,
        )
    pictures.leave()

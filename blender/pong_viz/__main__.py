# SPDX-License-Identifier: GPL-3.0-or-later
"""python -m pong_viz LOG -o film.mp4: a response log as film, pictures or .blend, without a window."""

import os
import sys

from .cli import main

if __name__ == "__main__":
    code = main()
    sys.stdout.flush()
    sys.stderr.flush()
    # Skips Blender's own exit: as a module it sometimes crashes or hangs after all work is done.
    os._exit(code)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the tests of a folder in this process, and ends it without Blender's own exit.

    python run.py FOLDER

Blender as a module sometimes crashes (4.2) or waits for ever (4.5) when Python has gone and it frees what it has.
"""

import os
import sys
import unittest
from pathlib import Path


def main():
    folder = Path(sys.argv[1]).resolve()
    suite = unittest.defaultTestLoader.discover(str(folder), top_level_dir=str(folder.parents[1]))
    result = unittest.TextTestRunner().run(suite)
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(0 if result.wasSuccessful() and result.testsRun else 1)


main()

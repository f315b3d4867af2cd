# SPDX-License-Identifier: GPL-3.0-or-later
"""`python -m pong_pmtk`: the command line over Blender as a Python module."""

import os
import sys

from . import cli, register


def run():
    arguments = sys.argv[1:]
    try:
        cli.parser("python -m pong_pmtk").parse_args(arguments)  # usage is told without waiting for Blender
    except SystemExit as stop:
        return stop.code or cli.DONE
    try:
        import bpy  # noqa: F401
    except ImportError as error:
        print(f"this needs Blender as a Python module: pip install bpy ({error})", file=sys.stderr)
        return cli.NO_FILE
    register()
    return cli.main(arguments, "python -m pong_pmtk")


code = run()
sys.stdout.flush()
sys.stderr.flush()
os._exit(code)  # Blender 4.2 crashes when it frees what is registered after Python has gone

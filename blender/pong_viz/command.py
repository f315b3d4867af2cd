# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line as a command of Blender's: `blender -c pong_viz LOG -o film.mp4`."""

import bpy

from . import cli

NAME = "pong_viz"
_registered = []


def _run(arguments):
    return cli.main(arguments, f"blender -c {NAME}")


def register():
    _registered.append(bpy.utils.register_cli_command(NAME, _run))


def unregister():
    while _registered:
        bpy.utils.unregister_cli_command(_registered.pop())

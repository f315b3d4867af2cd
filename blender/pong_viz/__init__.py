# SPDX-License-Identifier: GPL-3.0-or-later
"""Pong response playback: response logs as animated Blender scenes.

Inside Blender this is an extension; `python -m pong_viz` does the same without a window. The modules log, shapes,
timeline and marks need numpy only.
"""


def register():
    from . import command, ui

    ui.register()
    command.register()


def unregister():
    from . import command, ui

    command.unregister()
    ui.unregister()

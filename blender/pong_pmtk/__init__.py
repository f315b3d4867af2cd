# SPDX-License-Identifier: GPL-3.0-or-later
"""Pong's model toolkit: an extension for Blender, and a command line over Blender as a Python module.

`core` needs numpy only and can be imported without Blender.
"""


def register():
    import bpy

    from . import command, operators, ui
    from .store import marks, state

    marks.register()
    state.register()
    for cls in (*operators.CLASSES, *ui.CLASSES):
        bpy.utils.register_class(cls)
    for part in (*ui.PARTS, command):
        part.register()


def unregister():
    import bpy

    from . import command, operators, ui
    from .store import marks, state

    for part in (command, *reversed(ui.PARTS)):
        part.unregister()
    for cls in reversed((*operators.CLASSES, *ui.CLASSES)):
        bpy.utils.unregister_class(cls)
    state.unregister()
    marks.unregister()

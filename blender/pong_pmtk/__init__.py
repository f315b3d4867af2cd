# SPDX-License-Identifier: GPL-3.0-or-later
"""Pong's model toolkit: an extension for Blender, and a command line over Blender as a Python module.

`core` needs numpy only and can be imported without Blender.
"""

# Read by versions of Blender that know no extensions: they say what they are too old for. Others take the manifest.
bl_info = {"name": "Pong Model Toolkit", "version": (0, 1, 0), "blender": (4, 2, 0), "category": "Import-Export"}


def register():
    refuse_old_blender()
    import bpy

    from . import command, operators, ui
    from .store import marks, state

    marks.register()
    state.register()
    for cls in (*operators.CLASSES, *ui.CLASSES):
        bpy.utils.register_class(cls)
    for part in (*ui.PARTS, command):
        part.register()


def refuse_old_blender():
    """Raises `RuntimeError` in a version that does not install extensions, and so not the wheel `pong` in this one."""
    import bpy

    if bpy.app.version < bl_info["blender"]:
        wanted, found = (".".join(map(str, version)) for version in (bl_info["blender"], bpy.app.version))
        raise RuntimeError(f"{bl_info['name']} needs Blender {wanted}, and this is {found}: install a newer Blender (blender/README.md)")


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

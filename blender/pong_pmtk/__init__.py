# SPDX-License-Identifier: GPL-3.0-or-later
"""Pong's model toolkit: an extension for Blender, and a command line over Blender as a Python module.

`core` needs numpy only and can be imported without Blender.
"""

# Read by versions of Blender that know no extensions, and removed by the others, which take the manifest.
bl_info = {"name": "Pong Model Toolkit", "version": (0, 1, 0), "blender": (4, 2, 0), "category": "Import-Export"}

OLDEST_BLENDER = (4, 2, 0)


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

    if bpy.app.version < OLDEST_BLENDER:
        wanted, found = (".".join(map(str, version)) for version in (OLDEST_BLENDER, bpy.app.version))
        raise RuntimeError(f"Pong Model Toolkit needs Blender {wanted}, and this is {found}: install a newer Blender (blender/README.md)")


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

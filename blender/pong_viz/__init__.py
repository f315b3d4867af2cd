# SPDX-License-Identifier: GPL-3.0-or-later
"""Pong response playback: response logs as animated Blender scenes.

Inside Blender this is an extension; `python -m pong_viz` does the same without a window. The modules log, shapes,
timeline and marks need numpy only.
"""

# Read by versions of Blender that know no extensions: they say what they are too old for. Others take the manifest.
bl_info = {"name": "Pong response playback", "version": (0, 1, 0), "blender": (4, 2, 0), "category": "Import-Export"}


def register():
    refuse_old_blender()
    from . import command, ui

    ui.register()
    command.register()


def refuse_old_blender():
    """Raises `RuntimeError` in a version that does not install extensions, and so not the wheel `pong` in this one."""
    import bpy

    if bpy.app.version < bl_info["blender"]:
        wanted, found = (".".join(map(str, version)) for version in (bl_info["blender"], bpy.app.version))
        raise RuntimeError(f"{bl_info['name']} needs Blender {wanted}, and this is {found}: install a newer Blender (blender/README.md)")


def unregister():
    from . import command, ui

    command.unregister()
    ui.unregister()

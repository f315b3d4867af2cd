# SPDX-License-Identifier: GPL-3.0-or-later
"""Pong response playback: response logs as animated Blender scenes.

Inside Blender this is an extension; `python -m pong_viz` does the same without a window. The modules log, shapes,
timeline and marks need numpy only.
"""

# Read by versions of Blender that know no extensions, and removed by the others, which take the manifest.
bl_info = {"name": "Pong response playback", "version": (0, 1, 0), "blender": (4, 2, 0), "category": "Import-Export"}

OLDEST_BLENDER = (4, 2, 0)


def register():
    refuse_old_blender()
    from . import command, ui

    ui.register()
    command.register()


def refuse_old_blender():
    """Raises `RuntimeError` in a version that does not install extensions, and so not the wheel `pong` in this one."""
    import bpy

    if bpy.app.version < OLDEST_BLENDER:
        wanted, found = (".".join(map(str, version)) for version in (OLDEST_BLENDER, bpy.app.version))
        raise RuntimeError(f"Pong response playback needs Blender {wanted}, and this is {found}: install a newer Blender (blender/README.md)")


def unregister():
    from . import command, ui

    command.unregister()
    ui.unregister()

# SPDX-License-Identifier: GPL-3.0-or-later
"""Who wants to know of changes to marks and settings: Blender itself tells of transforms and meshes only."""

import bpy

listeners = []  # functions without arguments


def changed(_holder=None, _context=None):
    """A mark or a setting is another one now; also the `update` of properties."""
    for listener in listeners:
        listener()


OVERRIDABLE = {"LIBRARY_OVERRIDABLE"}  # without it Blender forgets on save what was changed on a library override
INSERTABLE = OVERRIDABLE | {"USE_INSERTION"}


def watched(cls):
    """Lets every property of a class tell of its changes, but for those that only remember a place in a list.

    All of them may be changed on library overrides, and are saved there.
    """
    silent = (bpy.props.CollectionProperty, bpy.props.PointerProperty)
    for name, definition in cls.__annotations__.items():
        is_list = definition.function is bpy.props.CollectionProperty
        definition.keywords.setdefault("override", INSERTABLE if is_list else OVERRIDABLE)
        if definition.function not in silent and not name.startswith("active_"):
            definition.keywords.setdefault("update", changed)
    return cls

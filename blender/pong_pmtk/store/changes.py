# SPDX-License-Identifier: GPL-3.0-or-later
"""Listeners for changes of marks and settings: Blender itself reports only transforms and meshes."""

import bpy

listeners = []  # functions without arguments


def changed(_holder=None, _context=None):
    """Reports a changed mark or setting; also the `update` of properties."""
    for listener in listeners:
        listener()


OVERRIDABLE = {"LIBRARY_OVERRIDABLE"}  # without it Blender forgets on save what was changed on a library override
INSERTABLE = OVERRIDABLE | {"USE_INSERTION"}


def watched(cls):
    """Makes every property of a class report its changes, except for those that only store a list index.

    All of them may be changed on library overrides, and are saved there.
    """
    silent = (bpy.props.CollectionProperty, bpy.props.PointerProperty)
    for name, definition in cls.__annotations__.items():
        is_list = definition.function is bpy.props.CollectionProperty
        definition.keywords.setdefault("override", INSERTABLE if is_list else OVERRIDABLE)
        if definition.function not in silent and not name.startswith("active_"):
            definition.keywords.setdefault("update", changed)
    return cls

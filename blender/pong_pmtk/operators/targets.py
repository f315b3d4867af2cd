# SPDX-License-Identifier: GPL-3.0-or-later
"""Targets of operators."""


def selected(context):
    """Selected editable objects; in Edit Mode those being edited."""
    edited = getattr(context, "objects_in_mode", None)
    if context.mode == "EDIT_MESH" and edited:
        return [obj for obj in edited if not obj.library]
    return [obj for obj in context.view_layer.objects if obj.select_get() and not obj.library]


def active_mesh(context):
    obj = context.view_layer.objects.active
    return obj if obj is not None and obj.type == "MESH" and not obj.library else None


class Selection:
    """Operators on selected objects."""

    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if not selected(context):
            cls.poll_message_set("Select an object that is not linked from another file")
            return False
        return True


class OnPart:
    """Operators on the active part of the active object."""

    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        obj = active_mesh(context)
        if obj is None or not len(obj.pong.parts):
            cls.poll_message_set("The active object must be a mesh with parts")
            return False
        return True

    def part(self, context):
        obj = active_mesh(context)
        index = min(obj.pong.active_part, len(obj.pong.parts) - 1)
        return obj, obj.pong.parts[index]


class Edited:
    """Operators on selected elements, in Edit Mode."""

    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if context.mode != "EDIT_MESH":
            cls.poll_message_set("Select vertices, edges or faces in Edit Mode")
            return False
        return True


def edited_meshes(context):
    return [obj for obj in selected(context) if obj.type == "MESH" and obj.data.is_editmode]

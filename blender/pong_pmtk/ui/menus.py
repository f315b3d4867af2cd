# SPDX-License-Identifier: GPL-3.0-or-later
"""Entries in Blender's own menus."""

import bpy


class PONG_MT_mark(bpy.types.Menu):
    """Pong's entries of the context menus"""

    bl_idname = "PONG_MT_mark"
    bl_label = "Pong"

    def draw(self, context):
        layout = self.layout
        if context.mode == "EDIT_MESH":
            layout.operator_menu_enum("pong.mark_elements", "kind")
            layout.operator("pong.mark_inactive").active = False
        else:
            layout.operator_menu_enum("pong.mark", "kind")
            layout.operator("pong.group_new")
            layout.operator("pong.group_move")
            layout.operator("pong.unmark")
        layout.operator("pong.surface_assign")
        layout.operator("pong.check")


class PONG_FH_ron(bpy.types.FileHandler):
    """Model files dropped into the 3D view are imported"""

    bl_idname = "PONG_FH_ron"
    bl_label = "Pong model"
    bl_import_operator = "pong.import_ron"
    bl_file_extensions = ".ron"

    @classmethod
    def poll_drop(cls, context):
        return context.area is not None and context.area.type == "VIEW_3D"


def draw_export(self, _context):
    self.layout.operator("pong.export_ron", text="Pong Model (.ron)")


def draw_import(self, _context):
    self.layout.operator("pong.import_ron", text="Pong Model (.ron)")


def draw_mark(self, _context):
    self.layout.separator()
    self.layout.menu("PONG_MT_mark")


ENTRIES = {
    "TOPBAR_MT_file_export": draw_export,
    "TOPBAR_MT_file_import": draw_import,
    "VIEW3D_MT_object_context_menu": draw_mark,
    "VIEW3D_MT_edit_mesh_context_menu": draw_mark,
}
CLASSES = (PONG_MT_mark, PONG_FH_ron)


def register():
    for name, draw in ENTRIES.items():
        getattr(bpy.types, name).append(draw)


def unregister():
    for name, draw in ENTRIES.items():
        getattr(bpy.types, name).remove(draw)

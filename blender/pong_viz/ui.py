# SPDX-License-Identifier: GPL-3.0-or-later
"""File > Import > Pong response log, and its panel."""

from pathlib import Path

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty
from bpy_extras.io_utils import ImportHelper

from .log import Log, LogError


class PONG_OT_import_response(bpy.types.Operator, ImportHelper):
    """Show a response log: bodies in motion, contacts marked, forces as arrows"""

    bl_idname = "pong.import_response"
    bl_label = "Pong response log"
    bl_options = {"REGISTER", "UNDO"}

    filename_ext = ".json"
    filter_glob: StringProperty(default="run.json", options={"HIDDEN"})
    fps: IntProperty(name="Pictures per second", default=30, min=1)
    speed: FloatProperty(name="Speed", description="0.1: ten times slower than life", default=1.0, min=1e-6)
    relative_to: StringProperty(name="Hold still", description="Body that the view follows; empty for the common frame")
    shapes: EnumProperty(name="Shapes", default="missing", items=(
        ("missing", "Where there are no graphics", "Draw the primitives of bodies without an object of their own"),
        ("all", "All", "Draw the primitives of every body"),
        ("none", "None", "Draw no primitives"),
    ))
    arrow_length: FloatProperty(name="Arrow", description="Length for the largest force, m; 0 chooses", default=0.0, min=0.0)
    most_contacts: IntProperty(name="Contacts", description="Shown at once", default=64, min=1)
    alpha: FloatProperty(name="Opacity", default=0.55, min=0.0, max=1.0)
    camera: BoolProperty(name="Camera and lights", default=True)

    def execute(self, context):
        from .render import Picture, prepare
        from .scene import Options, show

        given = Path(self.filepath)
        options = Options(
            fps=self.fps, speed=self.speed, relative_to=self.relative_to, shapes=self.shapes,
            arrow_length=self.arrow_length, most_contacts=self.most_contacts, alpha=self.alpha, camera=self.camera,
        )
        try:
            log = Log(given.parent if given.name == "run.json" else given)
            made = show(log, options, context.scene)
        except (LogError, ValueError, OSError) as fault:
            self.report({"ERROR"}, str(fault))
            return {"CANCELLED"}
        if context.scene.render.engine == "BLENDER_WORKBENCH":
            prepare(context.scene, Picture(context.scene.render.resolution_x, context.scene.render.resolution_y))
        for note in made.notes:
            self.report({"WARNING"}, note)
        self.report({"INFO"}, f"{len(made.film.times)} pictures; 1 m of arrow is {_newtons(made):.4g} N")
        return {"FINISHED"}


def _newtons(made) -> float:
    return 1.0 / made.metres_per_newton if made.metres_per_newton else 0.0


class PONG_PT_response(bpy.types.Panel):
    bl_label = "Response"
    bl_space_type, bl_region_type, bl_category = "VIEW_3D", "UI", "Pong"

    def draw(self, context):
        column = self.layout.column()
        column.operator(PONG_OT_import_response.bl_idname, icon="IMPORT")
        moved = context.object
        if moved is not None:
            column.label(text="Body that moves this object:")
            if "pong_body" in moved:
                column.prop(moved, '["pong_body"]', text="")
            else:
                column.operator(PONG_OT_bind_body.bl_idname)


class PONG_OT_bind_body(bpy.types.Operator):
    """Let a body of the response move this object: its name is that in the log"""

    bl_idname = "pong.bind_body"
    bl_label = "Bind to a body"
    bl_options = {"REGISTER", "UNDO"}

    body: StringProperty(name="Body", description="`object`, or `object/path of the group`; empty takes the object's name")

    @classmethod
    def poll(cls, context):
        return context.object is not None

    def execute(self, context):
        context.object["pong_body"] = self.body or context.object.name
        return {"FINISHED"}


def _menu(self, _context):
    self.layout.operator(PONG_OT_import_response.bl_idname, text="Pong response log (run.json)")


_CLASSES = (PONG_OT_import_response, PONG_OT_bind_body, PONG_PT_response)


def register():
    for item in _CLASSES:
        bpy.utils.register_class(item)
    bpy.types.TOPBAR_MT_file_import.append(_menu)


def unregister():
    bpy.types.TOPBAR_MT_file_import.remove(_menu)
    for item in reversed(_CLASSES):
        bpy.utils.unregister_class(item)

# SPDX-License-Identifier: GPL-3.0-or-later
"""File > Import > Pong response log, its panel, and pictures and films from there."""

import json
from pathlib import Path

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty
from bpy_extras.io_utils import ImportHelper

from . import before, captions, render
from .core.engine import WheelMissing
from .graphics import PROPERTY
from .log import Log, LogError
from .scene import Options, show


_SECONDS = {"subtype": "TIME_ABSOLUTE", "unit": "TIME_ABSOLUTE", "precision": 4}


class PONG_OT_import_response(bpy.types.Operator, ImportHelper):
    """Show a response log: bodies in motion, contacts marked, forces as arrows"""

    bl_idname = "pong.import_response"
    bl_label = "Pong response log"
    bl_options = {"REGISTER", "UNDO"}

    filename_ext = ".json"
    filter_glob: StringProperty(default="run.json", options={"HIDDEN"})
    fps: IntProperty(name="Frame rate", description="Pictures per second", default=30, min=1)
    speed: FloatProperty(name="Speed", description="0.1: ten times slower than life", default=1.0, min=1e-6)
    part: BoolProperty(name="A part of the run", description="Only from one instant to another", default=False)
    start: FloatProperty(name="From", description="Time in the log", default=0.0, **_SECONDS)
    end: FloatProperty(name="To", description="Time in the log", default=1.0, **_SECONDS)
    relative_to: StringProperty(name="Hold still", description="Body that the view follows; empty for the common frame")
    shapes: EnumProperty(name="Shapes", default="missing", items=(
        ("missing", "If no graphics", "Draw the primitives of bodies without an object of their own"),
        ("touched", "And touched", "As before and, over graphics, each primitive while it touches"),
        ("all", "All", "Draw the primitives of every body"),
        ("none", "None", "Draw no primitives"),
    ))
    arrow_length: FloatProperty(name="Arrow, m", description="Length for the largest force; 0 chooses", default=0.0, min=0.0,
                                precision=4)
    mark_radius: FloatProperty(name="Mark, m", description="Radius of the disc at a contact; 0 chooses", default=0.0, min=0.0,
                               precision=4)
    most_contacts: IntProperty(name="Contacts", description="Shown at once", default=64, min=1)
    alpha: FloatProperty(name="Opacity", default=0.55, min=0.0, max=1.0)
    camera: BoolProperty(name="Camera and lights", description="Add a camera that has all in view, and two suns", default=True)
    look: BoolProperty(name="Set look", description="Render with Workbench and let 3D views show the "
                       "objects' own colors, so that bodies and arrows are told apart; else the scene's own settings stay",
                       default=True)

    def execute(self, context):
        scene = context.scene
        before.note(scene)
        if self.look:
            render.prepare(scene, render.Picture(scene.render.resolution_x, scene.render.resolution_y))
            render.show_colors()
        try:
            made = show(Log(self.filepath), self._options(), scene)
        except (LogError, WheelMissing, ValueError, OSError) as fault:
            self.report({"ERROR"}, str(fault))
            return {"CANCELLED"}
        scene.pong_response_log = self.filepath
        for note in made.notes:
            self.report({"WARNING"}, note)
        scale = f"; 1 m of arrow is {1.0 / made.metres_per_newton:.4g} N" if made.metres_per_newton else "; nothing touches"
        if made.pressure_scale:
            scale += f"; patches of solids: 0 (violet) to {captions.pressure(made.pressure_scale)} (yellow)"
        self.report({"INFO"}, f"{len(made.film.times)} pictures{scale}")
        return {"FINISHED"}

    def _options(self) -> Options:
        return Options(
            fps=self.fps, speed=self.speed, start=self.start if self.part else None, end=self.end if self.part else None,
            relative_to=self.relative_to, shapes=self.shapes, arrow_length=self.arrow_length,
            mark_radius=self.mark_radius, most_contacts=self.most_contacts, alpha=self.alpha, camera=self.camera,
        )


class PONG_OT_remove_response(bpy.types.Operator):
    """Take all responses out of this scene; objects and settings are again as they were before"""

    bl_idname = "pong.remove_response"
    bl_label = "Remove Response"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        cls.poll_message_set("The scene shows no response")
        return before.is_shown(context.scene)

    def execute(self, context):
        free = before.remove(context.scene)
        self.report({"INFO"}, f"The response is gone; {free} object{'s' * (free != 1)} of this file moved with it")
        return {"FINISHED"}


class PONG_OT_render_response(bpy.types.Operator):
    """Render the scene: a film, every picture, or the current picture"""

    bl_idname = "pong.render_response"
    bl_label = "Render response"

    filepath: StringProperty(subtype="FILE_PATH")
    check_existing: BoolProperty(default=True, options={"HIDDEN"})
    form: EnumProperty(name="As", items=(
        ("FILM", "Film", "One .mp4"),
        ("FRAMES", "Pictures", "A folder with a .png of each picture"),
        ("STILL", "Still", "One .png of the current picture"),
    ))
    caption: BoolProperty(name="Caption", default=True,
                          description="Write time, largest force and scale of the arrows into the pictures")

    @classmethod
    def poll(cls, context):
        cls.poll_message_set("The scene has no camera: import a response, or add one")
        return context.scene.camera is not None

    def invoke(self, context, _event):
        name = {"FILM": "response.mp4", "FRAMES": "response_frames", "STILL": "response.png"}[self.form]
        folder = Path(bpy.data.filepath).parent if bpy.data.filepath else Path.home()
        self.filepath = str(folder / name)
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context):
        scene, path = context.scene, Path(bpy.path.abspath(self.filepath))
        settings = render.kept(scene)
        try:
            if self.form == "FILM":
                render.movie(scene, path, self.caption)
            elif self.form == "FRAMES":
                render.frames(scene, path, self.caption)
            else:
                render.still(scene, path, scene.frame_current, self.caption)
        except (render.RenderFault, OSError) as fault:
            self.report({"ERROR"}, str(fault))
            return {"CANCELLED"}
        finally:
            render.restore(scene, settings)
        self.report({"INFO"}, f"{path} written")
        return {"FINISHED"}


class PONG_PT_response(bpy.types.Panel):
    bl_label = "Response"
    bl_space_type, bl_region_type, bl_category = "VIEW_3D", "UI", "Pong"

    def draw(self, context):
        column = self.layout.column()
        column.operator(PONG_OT_import_response.bl_idname, icon="IMPORT")
        row = column.row(align=True)
        for form, label in (("FILM", "Film"), ("FRAMES", "Pictures"), ("STILL", "Still")):
            row.operator(PONG_OT_render_response.bl_idname, text=label).form = form
        column.operator(PONG_OT_remove_response.bl_idname, icon="X")
        moved = context.object
        if moved is not None:
            column.label(text="Body that moves this object:")
            if PROPERTY in moved:
                column.prop(moved, f'["{PROPERTY}"]', text="")
                column.operator(PONG_OT_free_object.bl_idname)
            else:
                column.operator(PONG_OT_bind_body.bl_idname)


class _OfObject:
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        cls.poll_message_set("No object is active: choose one")
        return context.object is not None


def bodies_of(path: str) -> list[str]:
    """Names of the bodies of a log; empty if it cannot be read."""
    if not path:
        return []
    path = Path(bpy.path.abspath(path))
    try:
        run = json.loads((path / "run.json" if path.is_dir() else path).read_text(encoding="utf-8"))
        return [str(body["name"]) for body in run["bodies"]]
    except (OSError, ValueError, KeyError, TypeError):
        return []


def _search_body(_self, context, words):
    """Bodies of the log whose names contain the typed text, with the objects they move."""
    moves = {item[PROPERTY]: item.name for item in context.scene.objects if PROPERTY in item}
    found = [name for name in bodies_of(context.scene.pong_response_log) if words.lower() in name.lower()]
    return [(name, f"moves {moves[name]}" if name in moves else "moves no object yet") for name in found]


class PONG_OT_bind_body(_OfObject, bpy.types.Operator):
    """Let a body of the response move this object: its name is that in the log"""

    bl_idname = "pong.bind_body"
    bl_label = "Bind to a body"

    body: StringProperty(name="Body", description="`object`, or `object/path of the group`; empty takes the object's name",
                         search=_search_body, search_options={"SUGGESTION"})

    def invoke(self, context, _event):
        return context.window_manager.invoke_props_dialog(self)

    def draw(self, context):
        column = self.layout.column()
        column.prop(context.scene, "pong_response_log")
        column.prop(self, "body")
        path = context.scene.pong_response_log
        if path and not bodies_of(path):
            column.label(text="That log cannot be read: type the body's name", icon="ERROR")
        elif not path:
            column.label(text="With a log, its bodies are listed", icon="INFO")

    def execute(self, context):
        context.object[PROPERTY] = self.body or context.object.name
        return {"FINISHED"}


class PONG_OT_free_object(_OfObject, bpy.types.Operator):
    """No body of the response is to move this object any more; what it was given stays until the log is shown again"""

    bl_idname = "pong.free_object"
    bl_label = "Free from the body"

    def execute(self, context):
        if PROPERTY in context.object:
            del context.object[PROPERTY]
        return {"FINISHED"}


def _menu(self, _context):
    self.layout.operator(PONG_OT_import_response.bl_idname, text="Pong response log (run.json)")


_CLASSES = (PONG_OT_import_response, PONG_OT_remove_response, PONG_OT_render_response, PONG_OT_bind_body, PONG_OT_free_object, PONG_PT_response)


def register():
    for item in _CLASSES:
        bpy.utils.register_class(item)
    bpy.types.Scene.pong_response_log = StringProperty(
        name="Log", subtype="FILE_PATH", description="run.json of the response log, whose bodies are listed")
    bpy.types.TOPBAR_MT_file_import.append(_menu)


def unregister():
    bpy.types.TOPBAR_MT_file_import.remove(_menu)
    del bpy.types.Scene.pong_response_log
    for item in reversed(_CLASSES):
        bpy.utils.unregister_class(item)

# SPDX-License-Identifier: GPL-3.0-or-later
"""File > Export and File > Import."""

from pathlib import Path

import bpy
from bpy_extras.io_utils import ExportHelper, ImportHelper

from ..scene import session
from ..store.references import current_root, select_only
from ..store.state import keep_findings

REPORTED = 10


class PONG_OT_export_ron(ExportHelper, bpy.types.Operator):
    """Write the current model to a Pong model file; nothing is written if anything is wrong with it"""

    bl_idname = "pong.export_ron"
    bl_label = "Export Pong Model"

    filename_ext = ".ron"
    filter_glob: bpy.props.StringProperty(default="*.ron", options={"HIDDEN"})
    root: bpy.props.StringProperty(name="Root", description="Object. Empty: that of the active object, or the only one")

    def invoke(self, context, event):
        root = current_root(context)
        if root is not None and not self.filepath:
            folder = Path(bpy.data.filepath).parent if bpy.data.filepath else Path.home()
            self.filepath = str(folder / f"{root.pong_model.label or root.name}.ron")
        return super().invoke(context, event)

    def execute(self, context):
        root = current_root(context)
        name = self.root or (root.name if root else "")
        try:
            result = session.export(context, bpy.path.abspath(self.filepath), name)
        except session.Refused as refused:
            keep_findings(context, refused.result.findings, refused.result.name)
            lines = str(refused).splitlines()
            more = [f"… and {len(lines) - REPORTED} more: see the list of findings"] if len(lines) > REPORTED else []
            self.report({"ERROR"}, "\n".join(["Nothing was written:", *lines[:REPORTED], *more]))
            return {"CANCELLED"}
        except OSError as error:
            self.report({"ERROR"}, f"{self.filepath}: nothing was written: {error.strerror}")
            return {"CANCELLED"}
        keep_findings(context, result.findings, result.name, session.touches(result))
        self.report({"INFO"}, f"{self.filepath} written. {result.summary()}")
        return {"FINISHED"}


class PONG_OT_import_ron(ImportHelper, bpy.types.Operator):
    """Open a Pong model file as marked objects"""

    bl_idname = "pong.import_ron"
    bl_label = "Import Pong Model"
    bl_options = {"REGISTER", "UNDO"}

    filename_ext = ".ron"
    filter_glob: bpy.props.StringProperty(default="*.ron", options={"HIDDEN"})

    def invoke(self, context, event):
        if self.filepath:  # dropped into the view
            return self.execute(context)
        return super().invoke(context, event)

    def execute(self, context):
        if context.mode != "OBJECT":
            bpy.ops.object.mode_set(mode="OBJECT")
        try:
            root = session.load(context, bpy.path.abspath(self.filepath))
        except session.LOAD_FAULTS as faults:
            self.report({"ERROR"}, str(faults))
            return {"CANCELLED"}
        except OSError as error:
            self.report({"ERROR"}, f"{self.filepath}: {error.strerror}")
            return {"CANCELLED"}
        select_only(context, [root], root)
        self.report({"INFO"}, f"{root.name}: {len(root.children_recursive)} objects")
        return {"FINISHED"}


CLASSES = (PONG_OT_export_ron, PONG_OT_import_ron)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Marking objects and elements as primitives."""

import bpy

from ..core.marks import VERSION, Part
from ..scene import proposal
from ..store import elements, marks
from ..store.marks import KIND_ITEMS
from ..store.references import siblings, unique_name
from .targets import Edited, OnPart, Selection, active_mesh, edited_meshes, selected

PROPOSE = ("PROPOSE", "As Proposed", "What the geometry suggests")


class PONG_OT_mark(Selection, bpy.types.Operator):
    """Make the selected objects primitives of a kind; the geometry suggests one"""

    bl_idname = "pong.mark"
    bl_label = "Mark as Primitive"

    kind: bpy.props.EnumProperty(name="Kind", items=[PROPOSE] + KIND_ITEMS[1:])
    surface: bpy.props.StringProperty(name="Surface", description="Empty: leave as it is")

    def execute(self, context):
        told = []
        for obj in selected(context):
            proposed = proposal.of_object(context, obj)
            kind = proposed.kind if self.kind == "PROPOSE" else self.kind
            if not kind:
                self.report({"WARNING"}, f"{obj.name}: {proposed.reason}; choose a kind")
                continue
            _mark(context, obj, kind)
            if self.surface:
                obj.pong.surface = self.surface
            why = proposal.fault(context, obj, kind)
            if why:
                self.report({"WARNING"}, f"{obj.name}: {why}; choose another kind, or give the numbers of its mark by hand")
            told.append(f"{obj.name}: {kind}" + (f" ({proposed.reason})" if self.kind == "PROPOSE" else ""))
        if not told:
            return {"CANCELLED"}
        self.report({"INFO"}, ", ".join(told[:5]) + (", …" if len(told) > 5 else ""))
        return {"FINISHED"}


def _mark(context, obj, kind):
    obj.pong.role, obj.pong.kind, obj.pong.version = "primitive", kind, VERSION
    given = marks.read_numbers(obj)
    marks.write_numbers(obj, {name: value for name, value in proposal.sizes(context, obj, kind).items() if name not in given})


class PONG_OT_unmark(Selection, bpy.types.Operator):
    """Take the marks of the selected objects away"""

    bl_idname = "pong.unmark"
    bl_label = "Unmark"

    def execute(self, context):
        for obj in selected(context):
            marks.clear_mark(obj)
        return {"FINISHED"}


class PONG_OT_mark_elements(Edited, bpy.types.Operator):
    """Make the selected vertices, edges or faces primitives of a kind: a new part of the object"""

    bl_idname = "pong.mark_elements"
    bl_label = "Mark Elements"

    kind: bpy.props.EnumProperty(name="Kind", items=[PROPOSE] + KIND_ITEMS[1:])
    name: bpy.props.StringProperty(name="Name", description="Empty: after the kind")
    surface: bpy.props.StringProperty(name="Surface", description="Empty: that of the object")

    def execute(self, context):
        made = [part for part in (self._part(context, obj) for obj in edited_meshes(context)) if part]
        if not made:
            self.report({"ERROR"}, "Nothing of the needed sort is selected: vertices for points, edges for segments "
                                   "and rays, faces for the rest")
            return {"CANCELLED"}
        return {"FINISHED"}

    def _part(self, context, obj):
        kind = proposal.of_elements(context.tool_settings.mesh_select_mode) if self.kind == "PROPOSE" else self.kind
        sort = elements.domain_of(kind)
        chosen = elements.selected(obj.data, sort)
        if not chosen:
            return None
        taken = {part.name for sibling in siblings(obj, context.scene) for part in sibling.pong.parts}
        part = Part(name=unique_name(self.name or kind.lower(), taken), kind=kind, surface=self.surface)
        setattr(part, sort, chosen)
        if obj.pong.role == "none":
            obj.pong.role, obj.pong.version = "primitive", VERSION
        return marks.add_part(obj, part)


class PONG_OT_part_assign(OnPart, bpy.types.Operator):
    """Add the selected elements to the active part, or take them out of it"""

    bl_idname = "pong.part_assign"
    bl_label = "Assign to Part"

    take_out: bpy.props.BoolProperty(name="Take Out")

    def execute(self, context):
        obj, part = self.part(context)
        sort = elements.domain_of(part.kind)
        elements.mark(obj.data, part.attribute, sort, elements.selected(obj.data, sort), 0 if self.take_out else 1)
        return {"FINISHED"}


class PONG_OT_part_select(OnPart, bpy.types.Operator):
    """Select the elements of the active part, in Edit Mode"""

    bl_idname = "pong.part_select"
    bl_label = "Select Part"

    def execute(self, context):
        obj, part = self.part(context)
        if not obj.data.is_editmode:
            bpy.ops.object.mode_set(mode="EDIT")
        chosen = {sort: elements.indices(obj.data, part.attribute, sort) for sort in elements.DOMAINS}
        elements.select(obj.data, chosen)
        return {"FINISHED"}


class PONG_OT_part_remove(OnPart, bpy.types.Operator):
    """Remove the active part; the mesh stays as it is"""

    bl_idname = "pong.part_remove"
    bl_label = "Remove Part"

    def execute(self, context):
        obj = active_mesh(context)
        marks.remove_part(obj, min(obj.pong.active_part, len(obj.pong.parts) - 1))
        return {"FINISHED"}


class PONG_OT_mark_inactive(Edited, bpy.types.Operator):
    """Make the selected faces of a polyhedron inactive, so that they never push, or active again"""

    bl_idname = "pong.mark_inactive"
    bl_label = "Inactive Faces"

    active: bpy.props.BoolProperty(name="Active Again")

    def execute(self, context):
        for obj in edited_meshes(context):
            if not obj.pong.inactive:
                obj.pong.inactive = elements.new_attribute(elements.INACTIVE)
            chosen = elements.selected(obj.data, "faces")
            elements.mark(obj.data, obj.pong.inactive, "faces", chosen, 0 if self.active else 1)
        return {"FINISHED"}


CLASSES = (
    PONG_OT_mark, PONG_OT_unmark, PONG_OT_mark_elements, PONG_OT_part_assign, PONG_OT_part_select,
    PONG_OT_part_remove, PONG_OT_mark_inactive,
)

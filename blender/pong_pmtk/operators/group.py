# SPDX-License-Identifier: GPL-3.0-or-later
"""The tree of groups."""

import bpy
from mathutils import Matrix, Vector

from ..core.marks import VERSION
from ..scene.tree import common_parent, hang, new_empty, parents, topmost
from ..store.marks import BOUND_ITEMS, CONTACT_ITEMS
from ..store.references import select_only
from .targets import Selection, selected


def _place(context, obj, origin, members):
    context.view_layer.update()
    places = {
        "MEDIAN": lambda: sum((member.matrix_world.translation for member in members), Vector()) / max(len(members), 1),
        "ACTIVE": lambda: (context.view_layer.objects.active or obj).matrix_world.translation,
        "CURSOR": lambda: context.scene.cursor.location,
        "PARENT": lambda: obj.parent.matrix_world.translation if obj.parent else Vector(),
    }
    obj.matrix_world = Matrix.Translation(places[origin]())
    context.view_layer.update()


class PONG_OT_root_new(bpy.types.Operator):
    """Make a root: a new empty at the origin, with the selected objects below it"""

    bl_idname = "pong.root_new"
    bl_label = "New Root"
    bl_options = {"REGISTER", "UNDO"}

    name: bpy.props.StringProperty(name="Name", default="model")

    def execute(self, context):
        members = topmost(selected(context))
        root = new_empty(context, self.name, members, "PLAIN_AXES")
        root.pong.role, root.pong.version, root.pong.contact = "root", VERSION, "Automatic"
        context.view_layer.update()
        for member in members:
            hang(member, root)
        select_only(context, [root], root)
        return {"FINISHED"}


class PONG_OT_group_new(bpy.types.Operator):
    """Make a group around the selected objects: a new empty between them and what they hang below"""

    bl_idname = "pong.group_new"
    bl_label = "Group Selection"
    bl_options = {"REGISTER", "UNDO"}

    name: bpy.props.StringProperty(name="Name", default="group")
    movable: bpy.props.BoolProperty(name="Movable", description="A rigid body of its own")
    bound: bpy.props.EnumProperty(name="Bound", items=BOUND_ITEMS, default="Default")
    origin: bpy.props.EnumProperty(name="Origin", default="PARENT", items=[
        ("PARENT", "Of the Parent", "Identity pose"), ("MEDIAN", "Median", "Middle of the selected origins"),
        ("ACTIVE", "Active Object", "Origin of the active object"), ("CURSOR", "3D Cursor", "The 3D cursor")])

    @classmethod
    def poll(cls, context):
        if context.mode != "OBJECT" or not selected(context):
            cls.poll_message_set("Select objects in Object Mode")
            return False
        return True

    def execute(self, context):
        members = topmost(selected(context))
        if any(member.pong.role == "root" for member in members):
            self.report({"ERROR"}, "A root cannot hang below a group: select what is below it")
            return {"CANCELLED"}
        group = new_empty(context, self.name, members, "ARROWS")
        group.pong.role, group.pong.version = "group", VERSION
        group.pong.movable, group.pong.bound = self.movable, self.bound
        group.parent = common_parent(members)
        _place(context, group, self.origin, members)
        for member in members:
            hang(member, group)
        select_only(context, [group], group)
        return {"FINISHED"}


class PONG_OT_group_set(Selection, bpy.types.Operator):
    """Make the selected objects groups, or change the groups that are selected"""

    bl_idname = "pong.group_set"
    bl_label = "Set Groups"

    role: bpy.props.EnumProperty(name="Role", items=[
        ("group", "Group", "Holds groups or primitives"), ("root", "Root", "The whole model")])
    movable: bpy.props.BoolProperty(name="Movable", description="A rigid body of its own")
    bound: bpy.props.EnumProperty(name="Bound", items=BOUND_ITEMS, default="Default")
    contact: bpy.props.EnumProperty(name="Contact", items=CONTACT_ITEMS, default="Default")

    def execute(self, context):
        given = self.properties.is_property_set
        for obj in selected(context):
            mark = obj.pong
            if given("role") or mark.role not in ("group", "root"):
                if self.role == "root" and mark.role != "root" and mark.contact == "Default":
                    mark.contact = "Automatic"
                mark.role, mark.version = self.role, VERSION
            if given("movable"):
                mark.movable = self.movable and mark.role == "group"
            if given("bound"):
                mark.bound = self.bound
            if given("contact"):
                mark.contact = self.contact
        return {"FINISHED"}


class PONG_OT_group_move(Selection, bpy.types.Operator):
    """Hang the selected objects below the active group; they stay where they are"""

    bl_idname = "pong.group_move"
    bl_label = "Move to Active Group"

    def execute(self, context):
        target = context.view_layer.objects.active
        if target is None or target.pong.role not in ("group", "root"):
            self.report({"ERROR"}, "The active object must be a group: select it last")
            return {"CANCELLED"}
        members = [obj for obj in topmost(selected(context)) if obj != target]
        if any(obj in members for obj in parents(target)):
            self.report({"ERROR"}, f"{target.name} hangs below one of the selected objects")
            return {"CANCELLED"}
        context.view_layer.update()
        for member in members:
            hang(member, target)
        return {"FINISHED"}


class PONG_OT_select_tree(bpy.types.Operator):
    """Select an object, or all that hangs below it"""

    bl_idname = "pong.select_tree"
    bl_label = "Select"
    bl_options = {"REGISTER", "UNDO"}

    name: bpy.props.StringProperty(name="Object")
    below: bpy.props.BoolProperty(name="And All Below")

    def execute(self, context):
        obj = context.scene.objects.get(self.name)
        if obj is None:
            self.report({"ERROR"}, f'There is no object "{self.name}" in this scene')
            return {"CANCELLED"}
        select_only(context, [obj, *obj.children_recursive] if self.below else [obj], obj)
        return {"FINISHED"}


CLASSES = (
    PONG_OT_root_new, PONG_OT_group_new, PONG_OT_group_set, PONG_OT_group_move, PONG_OT_select_tree,
)

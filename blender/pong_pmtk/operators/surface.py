# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators on surfaces of a model, their assignment, and presets."""

import bpy

from ..store import presets, spec
from ..store.changes import changed
from ..store.references import current_root, tree, unique_name
from ..store.surfaces import FIRST_FRICTION, add_filter, add_pair, add_surface
from .targets import OnPart, Selection, selected


class OnModel:
    """Operators on the current model."""

    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if current_root(context) is None:
            cls.poll_message_set("Make a root first, or select an object of the model you mean")
            return False
        return True


class PONG_OT_surface_add(OnModel, bpy.types.Operator):
    """Add a surface to the model"""

    bl_idname = "pong.surface_add"
    bl_label = "Add Surface"

    name: bpy.props.StringProperty(name="Name", default="surface")
    stiffness: bpy.props.FloatProperty(name="Stiffness, N/m", default=1e6, min=0.0, precision=1)

    def execute(self, context):
        settings = current_root(context).pong_model
        name = unique_name(self.name, settings.surfaces.keys())
        add_surface(settings, name, {"stiffness": self.stiffness, "friction": FIRST_FRICTION})
        settings.active_surface = len(settings.surfaces) - 1
        return {"FINISHED"}


class PONG_OT_surface_remove(OnModel, bpy.types.Operator):
    """Remove the active surface; refused while something uses it"""

    bl_idname = "pong.surface_remove"
    bl_label = "Remove Surface"

    def execute(self, context):
        root = current_root(context)
        settings = root.pong_model
        if not len(settings.surfaces):
            return {"CANCELLED"}
        index = min(settings.active_surface, len(settings.surfaces) - 1)
        name = settings.surfaces[index].name
        users = [obj.name for obj in tree(root) for holder in (obj.pong, *obj.pong.parts) if holder.surface == name]
        if users:
            self.report({"ERROR"}, f'Surface "{name}" is used by {", ".join(users[:5])}: give them another one first')
            return {"CANCELLED"}
        settings.surfaces.remove(index)
        settings.active_surface = max(0, index - 1)
        changed()
        return {"FINISHED"}


class PONG_OT_surface_assign(Selection, bpy.types.Operator):
    """Give the selected objects a surface; groups hand it on to all below that have none of their own"""

    bl_idname = "pong.surface_assign"
    bl_label = "Assign Surface"

    surface: bpy.props.StringProperty(name="Surface", description="Empty: that of the group above")
    below: bpy.props.BoolProperty(name="And All Below", description="Also everything below the selected objects")

    def invoke(self, context, _event):
        root = current_root(context)
        if not self.properties.is_property_set("surface") and root and len(root.pong_model.surfaces):
            settings = root.pong_model
            self.surface = settings.surfaces[min(settings.active_surface, len(settings.surfaces) - 1)].name
        return self.execute(context)

    def execute(self, context):
        root = current_root(context)
        if self.surface and (root is None or self.surface not in root.pong_model.surfaces):
            self.report({"ERROR"}, f'There is no surface "{self.surface}" in this model: add it first')
            return {"CANCELLED"}
        for obj in selected(context):
            for target in tree(obj) if self.below else [obj]:
                target.pong.surface = self.surface
        return {"FINISHED"}


class PONG_OT_part_surface(OnPart, bpy.types.Operator):
    """Give the active part a surface"""

    bl_idname = "pong.part_surface"
    bl_label = "Assign Surface to Part"

    surface: bpy.props.StringProperty(name="Surface", description="Empty: that of the object")

    def execute(self, context):
        _obj, part = self.part(context)
        part.surface = self.surface
        return {"FINISHED"}


class PONG_OT_pair_add(OnModel, bpy.types.Operator):
    """Add values for two surfaces when they touch each other"""

    bl_idname = "pong.pair_add"
    bl_label = "Add Pair"

    first: bpy.props.StringProperty(name="Surface")
    second: bpy.props.StringProperty(name="Surface")

    def execute(self, context):
        settings = current_root(context).pong_model
        names = settings.surfaces.keys()
        first = self.first or (names[min(settings.active_surface, len(names) - 1)] if names else "")
        add_pair(settings, {"surfaces": (first, self.second or first)})
        settings.active_pair = len(settings.pairs) - 1
        return {"FINISHED"}


class PONG_OT_pair_remove(OnModel, bpy.types.Operator):
    """Remove the active pair"""

    bl_idname = "pong.pair_remove"
    bl_label = "Remove Pair"

    def execute(self, context):
        settings = current_root(context).pong_model
        if not len(settings.pairs):
            return {"CANCELLED"}
        settings.pairs.remove(min(settings.active_pair, len(settings.pairs) - 1))
        settings.active_pair = max(0, settings.active_pair - 1)
        changed()
        return {"FINISHED"}


class PONG_OT_filter_add(OnModel, bpy.types.Operator):
    """Keep two groups of the model apart"""

    bl_idname = "pong.filter_add"
    bl_label = "Add Filter"

    def execute(self, context):
        settings = current_root(context).pong_model
        add_filter(settings, "", "")
        settings.active_filter = len(settings.filters) - 1
        return {"FINISHED"}


class PONG_OT_filter_remove(OnModel, bpy.types.Operator):
    """Remove the active filter"""

    bl_idname = "pong.filter_remove"
    bl_label = "Remove Filter"

    def execute(self, context):
        settings = current_root(context).pong_model
        if not len(settings.filters):
            return {"CANCELLED"}
        settings.filters.remove(min(settings.active_filter, len(settings.filters) - 1))
        settings.active_filter = max(0, settings.active_filter - 1)
        changed()
        return {"FINISHED"}


_shown = []  # Blender keeps no reference to the texts of a dynamic list; somebody must


def _preset_items(_self, _context):
    _shown[:] = [(name, name, source, index) for index, (name, source) in enumerate(presets.listing())]
    return _shown or [("", "None", "")]


class PONG_OT_preset_load(OnModel, bpy.types.Operator):
    """Add a preset to the model's surfaces, or renew the surface of that name"""

    bl_idname = "pong.preset_load"
    bl_label = "Load Preset"
    bl_property = "preset"

    preset: bpy.props.EnumProperty(name="Preset", items=_preset_items)
    name: bpy.props.StringProperty(name="Name", description="Of the surface. Empty: that of the preset")

    def execute(self, context):
        settings = current_root(context).pong_model
        name = self.name or self.preset
        fields = presets.fields_of(self.preset)
        if name in settings.surfaces:
            spec.write(settings.surfaces[name], fields)
        else:
            spec.write(add_surface(settings, name, {}), fields)
        settings.active_surface = settings.surfaces.find(name)
        self.report({"INFO"}, f"{name}: {presets.source_of(self.preset)}")
        return {"FINISHED"}


class PONG_OT_preset_save(OnModel, bpy.types.Operator):
    """Keep the active surface as a preset of this .blend file, for all its scenes"""

    bl_idname = "pong.preset_save"
    bl_label = "Save as Preset"

    name: bpy.props.StringProperty(name="Name", description="Of the preset. Empty: that of the surface")
    source: bpy.props.StringProperty(name="Source", description="Where the numbers are from")

    def execute(self, context):
        settings = current_root(context).pong_model
        if not len(settings.surfaces):
            self.report({"ERROR"}, "The model has no surface to keep")
            return {"CANCELLED"}
        surface = settings.surfaces[min(settings.active_surface, len(settings.surfaces) - 1)]
        try:
            presets.save(self.name or surface.name, spec.read(surface), self.source)
        except ValueError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


class PONG_OT_preset_remove(bpy.types.Operator):
    """Remove a preset of this .blend file"""

    bl_idname = "pong.preset_remove"
    bl_label = "Remove Preset"
    bl_options = {"REGISTER", "UNDO"}

    preset: bpy.props.EnumProperty(name="Preset", items=_preset_items)

    def execute(self, _context):
        if not presets.remove(self.preset):
            self.report({"ERROR"}, f'"{self.preset}" comes with the toolkit and stays')
            return {"CANCELLED"}
        return {"FINISHED"}


CLASSES = (
    PONG_OT_surface_add, PONG_OT_surface_remove, PONG_OT_surface_assign, PONG_OT_part_surface, PONG_OT_pair_add,
    PONG_OT_pair_remove, PONG_OT_filter_add, PONG_OT_filter_remove, PONG_OT_preset_load, PONG_OT_preset_save,
    PONG_OT_preset_remove,
)

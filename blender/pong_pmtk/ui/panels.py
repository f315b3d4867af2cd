# SPDX-License-Identifier: GPL-3.0-or-later
"""The panels of the "Pong" tab."""

import bpy

from ..store.references import current_root
from ..store.state import state
from ..store.surfaces import RESTITUTIONS, shares_friction
from . import overlay

SIZES = {
    "Sphere": ("radius",), "Ellipsoid": ("semi_axes",), "Ray": ("length",),
    "Capsule": ("length", "radius"), "Cylinder": ("length", "radius"),
    "Cone": ("length", "radii"), "Bore": ("length", "radii"),
}
BUTTONS_OF_PARTS = (("ADD", "pong.mark_elements", {}), ("REMOVE", "pong.part_remove", {}))


class Panel:
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Pong"


def split(layout):
    """Layout with names before their fields, without keyframe dots, which nothing here has."""
    layout.use_property_split, layout.use_property_decorate = True, False


class PONG_PT_model(Panel, bpy.types.Panel):
    bl_label = "Model"

    def draw(self, context):
        layout, root = self.layout, current_root(context)
        if root is None:
            layout.label(text="No model: select an object of one,", icon="INFO")
            layout.label(text="or make a root around the selection")
            layout.operator("pong.root_new", icon="ADD")
            layout.operator("pong.import_ron", icon="IMPORT")
            return
        split(layout)
        layout.prop(root.pong_model, "label", text="Name", placeholder=root.name)
        layout.prop(root.pong_model, "entry_memory")
        row = layout.row(align=True)
        row.operator("pong.check", icon="CHECKMARK")
        row.operator("pong.export_ron", text="Export", icon="EXPORT")
        layout.operator("pong.root_new", icon="ADD")  # for another model in the same file


class PONG_PT_tree(Panel, bpy.types.Panel):
    bl_label = "Groups"

    @classmethod
    def poll(cls, context):
        return current_root(context) is not None

    def draw(self, context):
        layout = self.layout
        layout.template_list("PONG_UL_tree", "", context.scene, "objects", state(context), "active_object", rows=5)
        row = layout.row(align=True)
        row.operator("pong.group_new", text="Group", icon="ADD")
        row.operator("pong.group_move", text="Move to Active", icon="OUTLINER")


class PONG_PT_object(Panel, bpy.types.Panel):
    bl_label = "Object"

    @classmethod
    def poll(cls, context):
        return context.object is not None

    def draw(self, context):
        layout, obj = self.layout, context.object
        split(layout)
        mark = obj.pong
        layout.label(text=obj.name, icon="OBJECT_DATA")
        layout.prop(mark, "role")
        if mark.role != "none":
            layout.prop(mark, "label", placeholder=obj.name)
            draw_surface_choice(layout, context, mark)
        if mark.role in ("group", "primitive"):
            layout.prop(mark, "order")
        if mark.role in ("root", "group"):
            self._group(layout, mark)
        elif mark.role == "primitive":
            self._primitive(layout, mark)
        layout.operator_menu_enum("pong.mark", "kind", text="Mark Selected as", icon="MESH_CUBE")

    def _group(self, layout, mark):
        if mark.role == "group":
            layout.prop(mark, "movable")
        layout.prop(mark, "contact")
        layout.prop(mark, "bound")
        layout.prop(mark, "custom_bound")
        layout.prop(mark, "leaf_size")

    def _primitive(self, layout, mark):
        layout.prop(mark, "kind", text="Whole Object" if len(mark.parts) else "Kind")
        if len(mark.parts):
            layout.label(text=f"Besides: {len(mark.parts)} part{'s' * (len(mark.parts) != 1)}, see below", icon="INFO")
        for name in SIZES.get(mark.kind, ()):
            layout.prop(mark, name)
        if mark.kind == "Ray":
            draw_optional(layout, mark, "reach")
            layout.prop(mark, "response")
        if mark.kind == "Bore":
            draw_optional(layout, mark, "thickness")
            layout.prop(mark, "mouths")
        if mark.kind in ("Triangle", "TriangleMesh"):
            draw_optional(layout, mark, "thickness")
            layout.prop(mark, "two_sided")
        if mark.kind in ("TriangleMesh", "Polyhedron"):
            layout.prop(mark, "file")
            if mark.file:
                layout.prop(mark, "file_scale")
        if mark.kind == "Custom":
            layout.prop(mark, "custom_kind")
            layout.prop(mark, "parameters")


def draw_optional(layout, holder, name, field="", unset="default"):
    """An optional number with its switch; `field`: the property that shows it, if another one; `unset`: source of the
    number if it is not given."""
    row = layout.row(heading=holder.bl_rna.properties[name].name)
    row.prop(holder, f"use_{name}", text="")
    if getattr(holder, f"use_{name}"):
        row.prop(holder, field or name, text="")
    else:
        row.label(text=unset)


def draw_surface_choice(layout, context, holder, name="surface"):
    root = current_root(context)
    if root is not None:
        layout.prop_search(holder, name, root.pong_model, "surfaces", icon="MATERIAL")
    else:
        layout.prop(holder, name)


class PONG_PT_parts(Panel, bpy.types.Panel):
    bl_label = "Parts"
    bl_parent_id = "PONG_PT_object"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type == "MESH"

    def draw(self, context):
        layout, mark = self.layout, context.object.pong
        row = layout.row()
        row.template_list("PONG_UL_parts", "", mark, "parts", mark, "active_part", rows=3)
        column = row.column(align=True)
        for icon, operator, _options in BUTTONS_OF_PARTS:
            column.operator(operator, text="", icon=icon)
        if len(mark.parts):
            part = mark.parts[min(mark.active_part, len(mark.parts) - 1)]
            column = layout.column()
            split(column)
            draw_surface_choice(column, context, part)
            row = layout.row(align=True)
            row.operator("pong.part_assign", text="Assign").take_out = False
            row.operator("pong.part_assign", text="Take Out").take_out = True
            row.operator("pong.part_select", text="Select")
        row = layout.row(align=True)
        row.operator("pong.mark_inactive", text="Faces Inactive").active = False
        row.operator("pong.mark_inactive", text="Active").active = True


class PONG_PT_surfaces(Panel, bpy.types.Panel):
    bl_label = "Surfaces"

    @classmethod
    def poll(cls, context):
        return current_root(context) is not None

    def draw(self, context):
        layout, settings = self.layout, current_root(context).pong_model
        row = layout.row()
        row.template_list("PONG_UL_surfaces", "", settings, "surfaces", settings, "active_surface", rows=3)
        column = row.column(align=True)
        column.operator("pong.surface_add", text="", icon="ADD")
        column.operator("pong.surface_remove", text="", icon="REMOVE")
        if len(settings.surfaces):
            layout.operator("pong.surface_assign", text="Assign to Selected", icon="CHECKMARK")
            surface = settings.surfaces[min(settings.active_surface, len(settings.surfaces) - 1)]
            split(layout)
            layout.prop(surface, "rigid")
            if not surface.rigid:
                draw_quantity(layout, surface, "stiffness")
                draw_per_area(layout, surface)
            draw_laws(layout, surface)
            if shares_friction(surface):
                layout.label(text="Mixes with the friction of what it meets", icon="INFO")
        row = layout.row(align=True)
        row.operator_menu_enum("pong.preset_load", "preset", text="Load Preset", icon="PRESET")
        row.operator("pong.preset_save", text="Save as Preset", icon="PRESET_NEW")


def draw_per_area(layout, surface):
    """Stiffness of solids per area, which only a linear spring has."""
    if surface.normal == "Custom" or surface.normal in ("HuntCrossley", "PowerLaw") and surface.exponent == "HERTZ":
        if surface.use_foundation or surface.use_area:
            layout.label(text="Solids need the exponent 1: remove the foundation", icon="ERROR")
        else:
            return
    unset = "from the stiffness"
    draw_optional(layout, surface, "foundation", "foundation_text", "stiffness over area" if surface.use_area else unset)
    draw_optional(layout, surface, "area", "area_text", "not needed" if surface.use_foundation else "a sixth of each solid's")


def draw_laws(layout, laws):
    layout.prop(laws, "normal")
    if laws.normal in RESTITUTIONS:
        layout.prop(laws, "use_restitution")
        replaced, impact = RESTITUTIONS[laws.normal]
        if laws.use_restitution:
            draw_quantity(layout, laws, "restitution")
            for name in impact:
                draw_quantity(layout, laws, name)
        else:
            draw_quantity(layout, laws, replaced)
        if laws.normal == "Linear":
            draw_optional(layout, laws, "ramp", "ramp_text")
        else:
            layout.prop(laws, "exponent")
        if laws.normal == "PowerLaw":
            draw_quantity(layout, laws, "damping_exponent")
    elif laws.normal == "Custom":
        layout.prop(laws, "normal_name")
        layout.prop(laws, "normal_parameters")
    layout.prop(laws, "friction")
    if laws.friction in ("Bristle", "Coulomb"):
        draw_quantity(layout, laws, "mu")
    if laws.friction == "Bristle":
        for name in ("static_excess", "bristle_stiffness"):
            draw_optional(layout, laws, name, f"{name}_text")
        draw_bristle_damping(layout, laws)
        for name in ("rolling", "spinning"):
            draw_optional(layout, laws, name, f"{name}_text", "none")
    elif laws.friction == "Coulomb":
        draw_quantity(layout, laws, "slip_speed")
    elif laws.friction == "Custom":
        layout.prop(laws, "friction_name")
        layout.prop(laws, "friction_parameters")


def draw_bristle_damping(layout, laws):
    """Damping, or a mass for it, and their source without both."""
    if laws.use_bristle_mass:
        unset = "from the bristle's mass"
    elif laws.use_restitution and "mass" in RESTITUTIONS[laws.normal][1]:
        unset = "from the mass of the restitution"
    elif laws.normal == "Linear":
        unset = "from the normal law"
    else:
        unset = "from the two surfaces" if hasattr(laws, "first") and laws.normal == "DEFAULT" else "undamped"
    draw_optional(layout, laws, "bristle_damping", "bristle_damping_text", unset)
    draw_optional(layout, laws, "bristle_mass", "bristle_mass_text", "none")


def draw_quantity(layout, holder, name):
    """A number with its unit."""
    layout.prop(holder, f"{name}_text")


class PONG_PT_pairs(Panel, bpy.types.Panel):
    bl_label = "Pairs of Surfaces"
    bl_parent_id = "PONG_PT_surfaces"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return current_root(context) is not None

    def draw(self, context):
        layout, settings = self.layout, current_root(context).pong_model
        row = layout.row()
        row.template_list("PONG_UL_pairs", "", settings, "pairs", settings, "active_pair", rows=2)
        column = row.column(align=True)
        column.operator("pong.pair_add", text="", icon="ADD")
        column.operator("pong.pair_remove", text="", icon="REMOVE")
        if len(settings.pairs):
            pair = settings.pairs[min(settings.active_pair, len(settings.pairs) - 1)]
            split(layout)
            layout.prop_search(pair, "first", settings, "surfaces")
            layout.prop(pair, "second")
            draw_optional(layout, pair, "stiffness", "stiffness_text")
            draw_laws(layout, pair)


class PONG_PT_touch(Panel, bpy.types.Panel):
    bl_label = "What Touches"
    bl_parent_id = "PONG_PT_model"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return current_root(context) is not None

    def draw(self, context):
        told = state(context).touches
        for text in told.splitlines() if told else ("Known after a check without errors",):
            for line in wrapped(text, context.region.width):
                self.layout.label(text=line)


class PONG_PT_filters(Panel, bpy.types.Panel):
    bl_label = "Groups That Never Touch"
    bl_parent_id = "PONG_PT_model"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return current_root(context) is not None

    def draw(self, context):
        layout, settings = self.layout, current_root(context).pong_model
        row = layout.row()
        row.template_list("PONG_UL_filters", "", settings, "filters", settings, "active_filter", rows=2)
        column = row.column(align=True)
        column.operator("pong.filter_add", text="", icon="ADD")
        column.operator("pong.filter_remove", text="", icon="REMOVE")
        if len(settings.filters):
            groups = settings.filters[min(settings.active_filter, len(settings.filters) - 1)]
            layout.prop(groups, "first")
            layout.prop(groups, "second")


class PONG_PT_findings(Panel, bpy.types.Panel):
    bl_label = "Findings"

    def draw(self, context):
        layout, found = self.layout, state(context)
        row = layout.row(align=True)
        row.operator("pong.check", icon="CHECKMARK")
        row.operator("pong.findings_copy", text="", icon="COPYDOWN")
        layout.template_list("PONG_UL_findings", "", found, "findings", found, "active_finding", rows=5)
        if len(found.findings):
            item = found.findings[min(found.active_finding, len(found.findings) - 1)]
            box = layout.box().column(align=True)
            for text in (item.path, f"[{item.rule}] {item.cause}", item.cure):
                for line in wrapped(text, context.region.width):
                    box.label(text=line)
            if item.fix:
                layout.operator("pong.finding_fix", text=f"Fix: {titled(item.fix)}", icon="TOOL_SETTINGS").index = -1
                alike = sum(other.rule == item.rule and bool(other.fix) for other in found.findings)
                if alike > 1:
                    layout.operator("pong.findings_fix", text=f"Fix All {alike} of This Kind").rule = item.rule
            offered = sum(bool(other.fix) for other in found.findings)
            if offered > 1:
                layout.operator("pong.findings_fix", text=f"Fix All {offered}").rule = ""


def titled(fix):
    """Name of a repair on its button."""
    return fix.replace("-", " ").title()


def wrapped(text, width_px):
    """Wraps a label at about seven pixels a letter, which Blender does not."""
    lines, line = [], ""
    for word in text.split():
        if line and len(line) + len(word) >= max(width_px // 7, 20):
            lines.append(line)
            line = ""
        line = f"{line} {word}".strip()
    return [*lines, line] if line else lines


class PONG_PT_overlays(Panel, bpy.types.Panel):
    bl_label = "Overlays"

    def draw(self, context):
        shown = state(context)
        grid = self.layout.grid_flow(columns=2, align=True)
        for name in ("show_bounds", "show_normals", "show_rays", "show_round", "show_groups"):
            grid.prop(shown, name, toggle=True)
        if shown.show_normals:
            self.layout.prop(shown, "normal_length")
        text = overlay.message(context)
        if text:
            self.layout.label(text=text, icon="INFO")


CLASSES = (
    PONG_PT_model, PONG_PT_tree, PONG_PT_object, PONG_PT_parts, PONG_PT_surfaces, PONG_PT_pairs, PONG_PT_touch, PONG_PT_filters, PONG_PT_findings,
    PONG_PT_overlays,
)

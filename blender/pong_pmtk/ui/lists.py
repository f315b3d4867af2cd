# SPDX-License-Identifier: GPL-3.0-or-later
"""The lists of the panels."""

import bpy

from ..store.references import current_root, parents_first

ROLE_ICONS = {"root": "OUTLINER_OB_EMPTY", "group": "EMPTY_ARROWS", "primitive": "MESH_CUBE", "none": "DOT"}
INDENT = 1.5  # in widths of a separator, for each level
WITH_MU = ("Bristle", "Coulomb")
SEVERITY_ICONS = {"error": "CANCEL", "warning": "ERROR", "hint": "INFO"}


class PONG_UL_tree(bpy.types.UIList):
    """Groups and primitives of the current model, as a tree."""

    def draw_item(self, _context, layout, _data, item, _icon, _active_data, _active_property, _index):
        row = layout.row(align=True)
        if depth(item):
            row.separator(factor=INDENT * depth(item))
        op = row.operator("pong.select_tree", text="", icon=ROLE_ICONS[item.pong.role], emboss=False)
        op.name, op.below = item.name, True
        row.label(text=item.pong.label or item.name)
        row = row.row(align=True)
        row.alignment = "RIGHT"
        if item.pong.role == "primitive":
            row.label(text=contents(item.pong))
        elif item.pong.role == "group":
            icon = "UNLOCKED" if item.pong.movable else "LOCKED"
            row.prop(item.pong, "movable", text="", icon=icon, emboss=False)
        if item.pong.surface:
            row.label(text=item.pong.surface, icon="MATERIAL")

    def filter_items(self, context, data, property_name):
        objects = getattr(data, property_name)
        root = current_root(context)
        order = parents_first(root, objects) if root else []
        rank = {obj.name: number for number, (obj, _depth) in enumerate(order)}
        words = self.filter_name.lower()
        flags, places, last = [], [], len(rank)
        for obj in objects:
            shown = obj.name in rank and words in obj.name.lower()
            flags.append(self.bitflag_filter_item if shown else 0)
            places.append(rank.get(obj.name, last))
            last += obj.name not in rank
        return flags, places


def depth(obj):
    """Depth of an object in the tree below its root.

    Worked out where it is drawn: Blender makes a list anew for every item, so nothing can be kept with it.
    """
    count = 0
    while obj.pong.role != "root" and obj.parent is not None:
        obj = obj.parent
        count += obj.pong.role != "none"
    return count


def contents(mark):
    """Text of an object's kind, the number of its parts, or both."""
    count = len(mark.parts)
    told = [mark.kind] if mark.kind != "NONE" or not count else []
    return " + ".join([*told, f"{count} part{'s' * (count != 1)}"] if count else told)


class PONG_UL_surfaces(bpy.types.UIList):
    def draw_item(self, _context, layout, _data, item, _icon, _active_data, _active_property, _index):
        row = layout.row(align=True)
        row.prop(item, "name", text="", emboss=False, icon="MATERIAL")
        values = row.row(align=True)
        values.alignment = "RIGHT"
        values.label(text="rigid" if item.rigid else item.stiffness_text)
        if item.friction in WITH_MU:
            values.label(text=f"μ {item.mu_text}")


class PONG_UL_pairs(bpy.types.UIList):
    def draw_item(self, _context, layout, _data, item, _icon, _active_data, _active_property, _index):
        layout.label(text=f"{item.first} – {item.second}", icon="ARROW_LEFTRIGHT")


class PONG_UL_filters(bpy.types.UIList):
    def draw_item(self, _context, layout, _data, item, _icon, _active_data, _active_property, _index):
        layout.label(text=f"{item.first} – {item.second}", icon="UNLINKED")


class PONG_UL_parts(bpy.types.UIList):
    def draw_item(self, _context, layout, _data, item, _icon, _active_data, _active_property, _index):
        row = layout.row(align=True)
        row.prop(item, "name", text="", emboss=False)
        values = row.row(align=True)
        values.alignment = "RIGHT"
        values.label(text=item.kind)
        if item.surface:
            values.label(text=item.surface)


class PONG_UL_findings(bpy.types.UIList):
    def draw_item(self, _context, layout, _data, item, _icon, _active_data, _active_property, index):
        row = layout.row(align=True)
        op = row.operator("pong.finding_select", text="", icon=SEVERITY_ICONS.get(item.severity, "DOT"), emboss=False)
        op.index = index
        row.label(text=f"{item.object or 'scene'}: {item.rule}")  # never cut; the whole text stands below the list
        if item.fix:
            row.operator("pong.finding_fix", text="", icon="TOOL_SETTINGS").index = index


CLASSES = (PONG_UL_tree, PONG_UL_surfaces, PONG_UL_pairs, PONG_UL_filters, PONG_UL_parts, PONG_UL_findings)

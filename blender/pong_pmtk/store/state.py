# SPDX-License-Identifier: GPL-3.0-or-later
"""State of the panels while Blender runs: findings, and the active overlays."""

import json

import bpy

from .references import select_only


class PONG_PG_finding(bpy.types.PropertyGroup):
    """One finding of the last check, with the fields of core/finding.py."""

    severity: bpy.props.StringProperty()
    rule: bpy.props.StringProperty()
    object: bpy.props.StringProperty()
    path: bpy.props.StringProperty()
    cause: bpy.props.StringProperty()
    cure: bpy.props.StringProperty()
    fix: bpy.props.StringProperty()
    elements: bpy.props.StringProperty()  # JSON: {"vertices": [...], "edges": [...], "faces": [...]}


listeners = []  # functions without arguments, called after a change of a toggle


def _redraw(_self, _context):
    for listener in listeners:
        listener()


def _active_object(_self):
    context = bpy.context
    active = context.view_layer.objects.active if context.view_layer else None
    return context.scene.objects.find(active.name) if active is not None else -1


def _select_object(_self, index):
    """Selects the object clicked in the tree; Blender's list only stores the index."""
    context = bpy.context
    if not 0 <= index < len(context.scene.objects) or index == _active_object(None):
        return
    if context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    obj = context.scene.objects[index]
    select_only(context, [obj], obj)


def _toggle(name, tip):
    return bpy.props.BoolProperty(name=name, description=tip, update=_redraw)


class PONG_PG_state(bpy.types.PropertyGroup):
    """State in the window manager, so it is neither saved nor undone."""

    findings: bpy.props.CollectionProperty(type=PONG_PG_finding)
    active_finding: bpy.props.IntProperty()
    checked: bpy.props.StringProperty()  # what the last check was of
    touches: bpy.props.StringProperty()  # what touches what in the model, in lines; "" after a check with errors
    active_object: bpy.props.IntProperty(get=_active_object, set=_select_object)  # of the scene's objects
    show_bounds: _toggle("Bounds", "Bounding volumes of the groups")
    show_normals: _toggle("Normals", "Outward normals of faces and planes")
    show_rays: _toggle("Rays", "Rays with their reach, and segments")
    show_round: _toggle("Round Parts", "Capsules, cylinders, cones and bores")
    show_groups: _toggle("Groups", "What hangs below what; movable groups stand out")
    normal_length: bpy.props.FloatProperty(name="Length", default=0.05, min=0.001, update=_redraw,
                                           description="Of the normals, as a share of the model's size")


def state(context):
    return context.window_manager.pong


def keep_findings(context, findings, checked, touches=()):
    """Lists findings, and what touches what, in the panel."""
    kept = state(context)
    kept.findings.clear()
    kept.active_finding = 0
    kept.checked = checked
    kept.touches = "\n".join(touches)
    for finding in findings:
        item = kept.findings.add()
        for field in ("severity", "rule", "object", "path", "cause", "cure", "fix"):
            setattr(item, field, getattr(finding, field))
        if not finding.evaluated:
            chosen = {sort: getattr(finding, sort) for sort in ("vertices", "edges", "faces")}
            item.elements = json.dumps({sort: numbers for sort, numbers in chosen.items() if numbers})


CLASSES = (PONG_PG_finding, PONG_PG_state)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.WindowManager.pong = bpy.props.PointerProperty(type=PONG_PG_state, name="Pong")


def unregister():
    del bpy.types.WindowManager.pong
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)

# SPDX-License-Identifier: GPL-3.0-or-later
"""A snapshot as objects of a Blender scene, marked and editable."""

import bpy
from mathutils import Matrix

from ..core.round_shape import ROUND_KINDS
from ..store import exact, marks
from . import meshes

MARK_NUMBERS = (*marks.NUMBERS, *marks.LISTS)  # a mark keeps these in full precision itself
EMPTY_SHAPES = {"root": "PLAIN_AXES", "group": "ARROWS", "primitive": "SPHERE"}
EMPTY_SHAPES_BY_KIND = {
    "Point": "PLAIN_AXES", "Ray": "SINGLE_ARROW", "Plane": "CIRCLE", **dict.fromkeys(ROUND_KINDS, "SINGLE_ARROW"),
}


def insert(snapshot, scene):
    """Creates the objects of a snapshot in a new collection. Returns them by their names in the snapshot."""
    roots = [facts for facts in snapshot.objects if facts.mark.role == "root"]
    collection = bpy.data.collections.new(roots[0].name if roots else "Pong")
    scene.collection.children.link(collection)
    made = {facts.name: _object(facts, collection) for facts in snapshot.objects}
    for facts in snapshot.objects:
        _place(made[facts.name], facts, made)
    return made


def _object(facts, collection):
    mesh = None
    if facts.mesh is not None:
        mesh = bpy.data.meshes.new(facts.name)
        meshes.fill(mesh, facts.mesh)
    obj = bpy.data.objects.new(facts.name, mesh)
    collection.objects.link(obj)
    marks.write_mark(obj, facts.mark)
    marks.write_numbers(obj, {name: facts.exact[name] for name in MARK_NUMBERS if name in facts.exact})
    if obj.name != facts.name and not facts.mark.name:
        obj.pong.label = facts.name  # Blender had to give it another name
    if facts.settings is not None:
        marks.write_settings(obj, facts.settings)
    if mesh is None:
        _shape(obj, facts.mark)
    return obj


def _shape(obj, mark):
    obj.empty_display_type = EMPTY_SHAPES_BY_KIND.get(mark.kind, EMPTY_SHAPES.get(mark.role, "PLAIN_AXES"))
    obj.empty_display_size = 0.1
    marks.show_size(obj)


def _place(obj, facts, made):
    transform = facts.transform
    if facts.parent is not None:
        obj.parent = made[facts.parent]
        if transform.parent_inverse is not None:
            obj.matrix_parent_inverse = Matrix(transform.parent_inverse.tolist())
    obj.rotation_mode = transform.rotation_mode
    obj.location = transform.location
    obj.scale = transform.scale
    obj.delta_location, obj.delta_scale = transform.delta_location, transform.delta_scale
    if transform.rotation_mode == "QUATERNION":
        obj.rotation_quaternion, obj.delta_rotation_quaternion = transform.rotation, transform.delta_rotation
    elif transform.rotation_mode == "AXIS_ANGLE":
        obj.rotation_axis_angle = transform.rotation
    else:
        obj.rotation_euler = transform.rotation
        if len(transform.delta_rotation) == 3:
            obj.delta_rotation_euler = transform.delta_rotation
    exact.write(obj, {name: values for name, values in facts.exact.items() if name not in MARK_NUMBERS})

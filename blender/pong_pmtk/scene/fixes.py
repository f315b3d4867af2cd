# SPDX-License-Identifier: GPL-3.0-or-later
"""Repairs offered by findings (core/finding.py, FIXES), as functions of an object.

They work on the stored mesh, in Edit Mode on the edited one, and give an object its own copy of a shared mesh before
they change it. What they move is moved in float64, and the full numbers are kept. A repair that does not apply raises
`FixFault` with the reason and changes nothing.
"""

import bmesh
import bpy
import numpy as np
from mathutils import Matrix

from ..core.exact import meant, meant_rows
from ..core.marks import VERSION
from ..core.round_shape import ROUND_KINDS, find
from ..core.transforms import SCALE_TOLERANCE, frame_of, local_transform, matrix_quaternion, quaternion_matrix
from ..core.unbuild import turn_of_z
from ..store import exact, marks
from ..store.references import select_only, siblings, unique_name
from . import extract, meshes, proposal
from .tree import hang, new_empty

MERGE_SHARE = 1e-6  # of the mesh's diameter: as far as the engine takes places to be the same


class FixFault(ValueError):
    """A repair could not be made."""


def run(context, name, obj):
    """Makes a repair by name."""
    if obj.library or (obj.data is not None and obj.data.library):
        raise FixFault(f"{obj.name} is linked from another file: make it local, or mend it there")
    REPAIRS[name](context, obj)


def _own_mesh(obj):
    if obj.type != "MESH":
        raise FixFault(f"{obj.name} is no mesh")
    if obj.data.users > 1 and not obj.data.is_editmode:
        obj.data = obj.data.copy()
    return obj.data


def _edit(obj, change):
    """Runs `change(bmesh)` on the mesh of an object, in the mode it is in."""
    mesh = _own_mesh(obj)
    if mesh.is_editmode:
        change(bmesh.from_edit_mesh(mesh))
        bmesh.update_edit_mesh(mesh)
        return
    edited = bmesh.new()
    edited.from_mesh(mesh)
    change(edited)
    edited.to_mesh(mesh)
    edited.free()
    mesh.update()


def _diameter(edited):
    places = np.array([vertex.co for vertex in edited.verts]).reshape(-1, 3)
    return float(np.linalg.norm(np.ptp(places, axis=0))) if len(places) else 0.0


def delete_loose(_context, obj):
    def change(edited):
        edges = [edge for edge in edited.edges if not edge.link_faces]
        bmesh.ops.delete(edited, geom=edges, context="EDGES")
        bmesh.ops.delete(edited, geom=[v for v in edited.verts if not v.link_faces], context="VERTS")

    _edit(obj, change)


def dissolve_degenerate(_context, obj):
    _edit(obj, lambda edited: bmesh.ops.dissolve_degenerate(
        edited, dist=MERGE_SHARE * _diameter(edited), edges=list(edited.edges)))


def merge_by_distance(_context, obj):
    _edit(obj, lambda edited: bmesh.ops.remove_doubles(
        edited, verts=list(edited.verts), dist=MERGE_SHARE * _diameter(edited)))


def recalculate_normals(_context, obj):
    _edit(obj, lambda edited: bmesh.ops.recalc_face_normals(edited, faces=list(edited.faces)))


def flip_normals(_context, obj):
    _edit(obj, lambda edited: bmesh.ops.reverse_faces(edited, faces=list(edited.faces)))


def triangulate(_context, obj):
    _edit(obj, lambda edited: bmesh.ops.triangulate(edited, faces=list(edited.faces)))


def _facts(context, obj):
    """Facts that the core needs to compute the object's transform."""
    reader = extract.Reader(context.evaluated_depsgraph_get(), context.view_layer)
    return reader.object(obj)


def _move_vertices(obj, linear, offset):
    """Maps the vertices of an object by x -> linear · x + offset."""
    mesh = _own_mesh(obj)
    if mesh.is_editmode:
        raise FixFault(f"leave Edit Mode of {obj.name} first")
    if mesh.shape_keys:
        raise FixFault(f"{obj.name} has shape keys: apply them first")
    places = meant_rows(meshes.read(mesh).vertices, exact.read(obj).get("vertices"))
    moved = sum(places[:, i : i + 1] * linear[:, i] for i in range(3)) + offset
    mesh.vertices.foreach_set("co", moved.astype(np.float32).ravel())
    exact.write(obj, {"vertices": moved})
    if np.linalg.det(linear) < 0.0:
        flip_normals(None, obj)
    mesh.update()


def _keep_children(obj, linear, offset):
    """Keeps children in place when x of the object becomes linear · x + offset."""
    matrix = Matrix(np.block([[linear, offset.reshape(3, 1)], [np.zeros((1, 3)), np.ones((1, 1))]]).tolist())
    for child in obj.children:
        child.matrix_parent_inverse = matrix @ child.matrix_parent_inverse


def apply_scale(context, obj):
    """Applies the scale to the mesh, or to the children of an empty, and to the sizes of the mark."""
    scale = local_transform(_facts(context, obj)).scale
    sizes = _scaled_sizes(obj, np.diag(scale))
    _apply(obj, np.diag(scale))
    _resize(obj, sizes)
    obj.scale, obj.delta_scale = (1.0, 1.0, 1.0), (1.0, 1.0, 1.0)
    _forget(obj, "scale")


def apply_transform(context, obj):
    """Applies rotation and scale to the mesh, or to the children of an empty, and to the sizes of the mark."""
    local = local_transform(_facts(context, obj))
    sizes = _scaled_sizes(obj, local.rotation * local.scale)
    _apply(obj, local.rotation * local.scale)
    _resize(obj, sizes)
    obj.scale, obj.delta_scale = (1.0, 1.0, 1.0), (1.0, 1.0, 1.0)
    _set_quaternion(obj, (1.0, 0.0, 0.0, 0.0))
    _forget(obj, "scale", "rotation")


def _scaled_sizes(obj, linear):
    """(kind, numbers) of a mark after its object's transform is applied; raises `FixFault` if no mark can represent it."""
    kind = obj.pong.kind if obj.pong.role == "primitive" else ""
    on_empty = obj.type == "EMPTY"
    if kind not in ("Sphere", "Ellipsoid", *ROUND_KINDS) and not (on_empty and kind in ("Ray", "Plane")):
        return None
    numbers, lengths = marks.read_numbers(obj), np.sqrt((linear * linear).sum(axis=0))
    if kind in ROUND_KINDS:
        return kind, _scaled_round(obj, kind, linear, numbers)
    even = np.ptp(lengths) <= SCALE_TOLERANCE * lengths.max()
    if kind == "Sphere" and even:
        return kind, {"radius": numbers.get("radius", 0.0) * float(lengths[0])}
    turned = np.abs(linear - np.diag(np.diag(linear))).max() > SCALE_TOLERANCE * lengths.max()
    if turned or on_empty and kind in ("Ray", "Plane") and linear[2, 2] < 0.0:
        raise FixFault(f"the {kind.lower()} of {obj.name} lies along its axes: turning or mirroring it cannot be applied")
    if kind == "Ray":
        return kind, {"length": numbers.get("length", 0.0) * float(lengths[2])}
    if kind == "Plane":
        return None
    axes = (numbers.get("radius", 0.0),) * 3 if kind == "Sphere" else numbers.get("semi_axes", (0.0,) * 3)
    return "Ellipsoid", {"semi_axes": tuple(float(axis) for axis in axes * lengths)}


def _scaled_round(obj, kind, linear, numbers):
    """Numbers of a round part after its object's scale is applied; the z direction is preserved."""
    size = np.abs(linear).max()
    even = np.abs(np.diff(np.diag(linear)[: 3 if kind == "Capsule" else 2])).max() <= SCALE_TOLERANCE * size
    if np.abs(linear - np.diag(np.diag(linear))).max() > SCALE_TOLERANCE * size or linear[2, 2] < 0.0 or not even:
        raise FixFault(f"the {kind.lower()} of {obj.name} lies around its z axis: only a scale that is the same around it "
                       "can be applied")
    across, along = abs(float(linear[0, 0])), float(linear[2, 2])
    scaled = {"length": numbers.get("length", 0.0) * along}
    scaled |= {"radius": numbers["radius"] * across} if "radius" in numbers else {}
    return scaled | ({"radii": tuple(r * across for r in numbers["radii"])} if "radii" in numbers else {})


def _resize(obj, sizes):
    if sizes is not None:
        obj.pong.kind, values = sizes
        marks.write_numbers(obj, values)


def _apply(obj, linear):
    if obj.type == "MESH":
        _move_vertices(obj, linear, np.zeros(3))
    elif obj.type != "EMPTY":
        raise FixFault(f"{obj.name} is a {obj.type.lower()}: convert it to a mesh first")
    _keep_children(obj, linear, np.zeros(3))


def _set_quaternion(obj, quaternion):
    obj.rotation_mode = "QUATERNION"
    obj.rotation_quaternion = quaternion
    obj.delta_rotation_quaternion = (1.0, 0.0, 0.0, 0.0)


def _forget(obj, *names):
    """Removes exact numbers that have become invalid."""
    if exact.KEY in obj:
        for name in names:
            if name in obj[exact.KEY]:
                del obj[exact.KEY][name]


def clear_parent_inverse(context, obj):
    """Keeps the object's pose, by its own transform alone."""
    local = local_transform(_facts(context, obj))
    frame = frame_of(local.matrix.linear, np.sign(local.scale))
    if frame is None:
        raise FixFault(f"{obj.name} is sheared by its parent: apply the parent's scale first")
    quaternion = matrix_quaternion(frame.rotation)
    obj.matrix_parent_inverse = Matrix()
    obj.delta_location, obj.delta_scale = (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)
    obj.location, obj.scale = local.matrix.offset, np.diag(frame.rest)
    _set_quaternion(obj, quaternion)
    exact.write(obj, {"location": local.matrix.offset, "rotation": np.array(quaternion), "scale": np.diag(frame.rest)})


def set_origin(context, obj):
    """Moves the origin to the middle of the vertices; everything stays in place."""
    facts = _facts(context, obj)
    if facts.mesh is None or not len(facts.mesh.vertices):
        raise FixFault(f"{obj.name} has no vertices")
    local = local_transform(facts)
    places = facts.mesh.vertices
    middle = (places.min(axis=0) + places.max(axis=0)) / 2
    _move_vertices(obj, np.eye(3), -middle)
    _keep_children(obj, np.eye(3), -middle)
    location = meant(facts.transform.location, facts.exact.get("location"))
    moved = location + (local.rotation * local.scale) @ middle
    obj.location = moved
    exact.write(obj, {**{k: v for k, v in facts.exact.items() if k != "vertices"}, "location": moved})


def fit(kind):
    """Makes it a sphere, ellipsoid or ray of the displayed size."""

    def repair(context, obj):
        sizes = proposal.sizes(context, obj, kind)
        if not sizes:
            raise FixFault(f"{obj.name} has no vertices to fit a {kind.lower()} to, or is hidden")
        obj.pong.kind = kind
        marks.write_numbers(obj, sizes)

    return repair


def fit_round(context, obj):
    """Adopts the displayed size: that of the mesh, or the length of an empty."""
    kind = obj.pong.kind
    sizes = proposal.sizes(context, obj, kind) if kind in ROUND_KINDS else {}
    why = proposal.fault(context, obj, kind)
    if why:
        raise FixFault(f"{obj.name}: {why}; choose another kind, or give the numbers of its mark by hand")
    if not sizes:
        raise FixFault(f"{obj.name} shows no round part: choose its kind, and show its mesh")
    if obj.type == "EMPTY":
        given = marks.read_numbers(obj)
        sizes = {name: value for name, value in sizes.items() if name == "length" or name not in given}
    marks.write_numbers(obj, sizes)


def align_axis(context, obj):
    """Rotates the object so that its z axis is that of the part shown by its mesh; everything stays in place."""
    facts = _facts(context, obj)
    shown = find(facts.mesh.vertices, obj.pong.kind) if facts.mesh is not None and obj.pong.kind in ROUND_KINDS else None
    if shown is None:
        raise FixFault(f"{obj.name} shows no round part: choose its kind, and show its mesh")
    if facts.modifiers:
        raise FixFault(f"{obj.name} has modifiers, which work along its axes: apply them first")
    local = local_transform(facts)
    if np.ptp(np.abs(local.scale)) > SCALE_TOLERANCE * np.abs(local.scale).max() or local.scale.min() < 0.0:
        raise FixFault(f"the scale of {obj.name} is uneven: apply it first")
    turn = quaternion_matrix(turn_of_z(shown.axis))
    location = meant(facts.transform.location, facts.exact.get("location"))
    location = location + (local.rotation * local.scale) @ shown.center
    quaternion = matrix_quaternion(local.rotation @ turn)
    _move_vertices(obj, turn.T, -turn.T @ shown.center)
    _keep_children(obj, turn.T, -turn.T @ shown.center)
    _set_quaternion(obj, quaternion)
    obj.location = location
    kept = {name: values for name, values in facts.exact.items() if name not in ("vertices", "ends")}
    exact.write(obj, {**kept, "location": location, "rotation": np.array(quaternion)})


def group_primitives(context, obj):
    """Moves the primitives of a group that also holds groups into a new group at the same pose."""
    below = _of_primitives(obj)
    if not below:
        raise FixFault(f"{obj.name} holds no primitives")
    name = unique_name("parts", {child.pong.label or child.name for child in obj.children})
    group = new_empty(context, name, below, "ARROWS")
    group.pong.role, group.pong.version = "group", VERSION
    group.parent = obj
    context.view_layer.update()
    for child in below:
        if child.parent == obj:
            child.parent = group  # it stands exactly where the old one does
        else:
            hang(child, group)


def _of_primitives(obj):
    """Topmost objects that carry primitives and no groups, down to the next groups."""
    found = []
    for child in obj.children:
        roles = {other.pong.role for other in (child, *child.children_recursive)}
        if child.pong.role == "primitive" or "primitive" in roles and not roles & {"group", "root"}:
            found.append(child)
        elif child.pong.role == "none":
            found += _of_primitives(child)
    return found


def unmark_copy(_context, obj):
    """Unmarks the copy, which stays as a visible object."""
    marks.clear_mark(obj)


def adopt_parts(context, obj):
    """Makes parts of the attributes left by joined objects."""
    if obj.pong.role == "none":
        obj.pong.role, obj.pong.version = "primitive", VERSION
    marks.adopt(obj, {part.name for sibling in siblings(obj, context.scene) for part in sibling.pong.parts})


def rename(_context, obj):
    """A unique name among its siblings, and one for each of its parts."""
    others = [other for other in siblings(obj, bpy.context.scene) if other != obj]
    taken = {part.name for other in others for part in other.pong.parts}
    for part in obj.pong.parts:
        part.name = unique_name(part.name, taken)
        taken.add(part.name)
    taken = {other.pong.label or other.name for other in others}
    wanted = (obj.pong.label or obj.name).replace("/", "_") or obj.pong.role
    obj.pong.label = unique_name(wanted, taken)


def unhide(context, obj):
    obj.hide_viewport = False
    if obj.name in context.view_layer.objects:
        obj.hide_set(False)
    _show_layers(context.view_layer.layer_collection, obj)
    context.view_layer.update()


def _show_layers(layer, obj):
    """Shows every layer collection on the path to an object; returns whether the object is below."""
    below = [_show_layers(child, obj) for child in layer.children]
    holds = any(below) or obj.name in layer.collection.objects
    if holds:
        layer.exclude = layer.hide_viewport = False
        layer.collection.hide_viewport = False
    return holds


def leave_edit_mode(_context, _obj):
    if bpy.context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")


def _operate(context, obj, operate):
    """Runs an operator of Blender's on one object, and restores the selection."""
    leave_edit_mode(context, obj)
    chosen = [other for other in context.view_layer.objects if other.select_get()]
    active = context.view_layer.objects.active
    select_only(context, [obj], obj)
    if not obj.select_get():
        raise FixFault(f"{obj.name} cannot be selected: show it and take away its lock")
    before = set(context.scene.objects)
    operate()
    made = [other for other in context.scene.objects if other not in before]
    select_only(context, chosen, active)
    return made


def convert_to_mesh(context, obj):
    _operate(context, obj, lambda: bpy.ops.object.convert(target="MESH"))


def make_instances_real(context, obj):
    _operate(context, obj, lambda: bpy.ops.object.duplicates_make_real(use_base_parent=True, use_hierarchy=True))


def separate_loose(context, obj):
    """Makes each connected piece an object with the same mark."""
    _own_mesh(obj)

    def separate():
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.separate(type="LOOSE")
        bpy.ops.object.mode_set(mode="OBJECT")

    for piece in _operate(context, obj, separate):
        piece.pong.label = ""


REPAIRS = {
    "adopt-parts": adopt_parts,
    "align-axis": align_axis,
    "apply-scale": apply_scale,
    "apply-transform": apply_transform,
    "clear-parent-inverse": clear_parent_inverse,
    "convert-to-mesh": convert_to_mesh,
    "delete-loose": delete_loose,
    "dissolve-degenerate": dissolve_degenerate,
    "fit-ellipsoid": fit("Ellipsoid"),
    "fit-length": fit("Ray"),
    "fit-round": fit_round,
    "fit-sphere": fit("Sphere"),
    "flip-normals": flip_normals,
    "group-primitives": group_primitives,
    "leave-edit-mode": leave_edit_mode,
    "make-instances-real": make_instances_real,
    "merge-by-distance": merge_by_distance,
    "recalculate-normals": recalculate_normals,
    "rename": rename,
    "separate-loose": separate_loose,
    "set-origin": set_origin,
    "triangulate": triangulate,
    "unmark-copy": unmark_copy,
    "unhide": unhide,
}

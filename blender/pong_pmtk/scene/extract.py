# SPDX-License-Identifier: GPL-3.0-or-later
"""A Blender scene as a snapshot: facts only, checked by the core.

Transforms are read as they are stored and composed by the core in float64; world matrices would carry the rounding of
every parent, and Blender does not even work them out for hidden objects. Meshes are read after their modifiers, and
as stored where modifiers or shape keys change anything. A mesh that is being edited is read as it is in Edit Mode,
which stays as it is.
"""

import contextlib

import bpy
import numpy as np

from ..core.marks import Mark
from ..core.naming import RESPONSE
from ..core.snapshot import Snapshot, SnapshotObject, Transform
from ..store import exact, marks
from . import instances, meshes

GEOMETRY = ("MESH", "CURVE", "SURFACE", "META", "FONT")


def snapshot(context):
    """The scene of a context at its current frame."""
    _flush_edited(context.scene)
    with _playback_paused(context):
        return _read(context)


@contextlib.contextmanager
def _playback_paused(context):
    """A displayed response moves objects by constraints, which are no part of the model."""
    led = [each for obj in context.scene.objects for each in obj.constraints if _is_playback(each) and not each.mute]
    for constraint in led:
        constraint.mute = True
    context.view_layer.update()
    try:
        yield
    finally:
        for constraint in led:
            constraint.mute = False
        if led:
            context.view_layer.update()


def _read(context):
    scene, view_layer = context.scene, context.view_layer
    shown, elsewhere = instances.shown_collections(scene), instances.shown_elsewhere(scene)
    members = instances.memberships(shown)
    everything = [*scene.objects, *instances.beyond(scene, shown)]
    reader = Reader(context.evaluated_depsgraph_get(), view_layer, everything)
    objects = []
    for obj in everything:
        facts = reader.object(obj)
        if obj in elsewhere:
            facts.mark = Mark()  # only its instances are there
        facts.collections = members.get(obj, [])
        objects.append(facts)
    objects += instances.scattered(reader)
    return Snapshot(
        objects=objects,
        unit_scale=_shortest(scene.unit_settings.scale_length),
        frame=scene.frame_current,
        source=bpy.data.filepath,
        edit_mode=_edited_with_modifiers(scene),
        instance_offsets={name: tuple(collection.instance_offset) for name, collection in shown.items()},
    )


def _shortest(value):
    return float(str(np.float32(value)))


def _flush_edited(scene):
    for obj in scene.objects:
        if obj.mode == "EDIT":
            obj.update_from_editmode()


def _edited_with_modifiers(scene):
    """An object whose modifiers are unreliable, because Edit Mode shows only some of them."""
    edited = [obj.name for obj in scene.objects if obj.mode == "EDIT" and modifiers(obj)]
    return edited[0] if edited else ""


class Reader:
    """Reads objects of one scene at one frame."""

    def __init__(self, depsgraph, view_layer, objects=()):
        self.depsgraph = depsgraph
        self.view_layer = view_layer
        self.included = set(view_layer.objects)  # one by one they are searched for from the first on
        self.names = instances.unique_names(objects)

    def name(self, obj):
        """Name of an object in the snapshot."""
        return self.names.get(obj, obj.name)

    def object(self, obj):
        """Facts of one object."""
        parented = obj.parent is not None
        excluded = obj not in self.included
        hidden = not excluded and not obj.visible_get(view_layer=self.view_layer)
        mesh, stored = self.meshes(obj)
        return SnapshotObject(
            name=self.name(obj),
            called=obj.name if self.name(obj) != obj.name else "",
            type=obj.type,
            parent=self.name(obj.parent) if parented else None,
            parent_type=obj.parent_type if parented else "OBJECT",
            transform=transform(obj),
            mark=marks.read_mark(obj),
            settings=marks.read_settings(obj) if obj.pong.role == "root" else None,
            mesh=mesh,
            stored_mesh=stored,
            modifiers=modifiers(obj),
            left_over=[part for _, part in marks.left_over(obj)] if obj.type == "MESH" else [],
            display_size=obj.empty_display_size if obj.type == "EMPTY" else None,
            shape_keys=_shape_keys(obj),
            constraints=[constraint.name for constraint in obj.constraints if _acts(constraint)],
            animated=any(_animated(data) for data in _animatable(obj)),
            drivers=any(data.animation_data.drivers for data in _animatable(obj)),
            hidden=hidden,
            excluded=excluded,
            instance_of=_collection_shown(obj),
            linked_from=obj.library.filepath if obj.library else "",
            exact={**exact.read(obj), **{name: np.array(value) for name, value in marks.read_numbers(obj).items()}},
        )

    def meshes(self, obj):
        """Mesh after modifiers and, if they change anything, before. Hidden objects are not evaluated."""
        if obj.type not in GEOMETRY:
            return None, None
        stored = meshes.read(obj.data) if obj.type == "MESH" else None
        shown = obj.evaluated_get(self.depsgraph)
        if stored is not None and not (shown.is_evaluated and (modifiers(obj) or _shape_keys(obj))):
            return stored, None
        return (self._evaluated(shown) if shown.is_evaluated else None), stored

    def _evaluated(self, shown):
        mesh = shown.to_mesh(preserve_all_data_layers=False, depsgraph=self.depsgraph)
        if mesh is None:
            return None
        try:
            return meshes.read(mesh)
        finally:
            shown.to_mesh_clear()


def transform(obj):
    """An object's transform as stored."""
    mode = obj.rotation_mode
    if mode == "QUATERNION":
        rotation, delta = obj.rotation_quaternion, obj.delta_rotation_quaternion
    elif mode == "AXIS_ANGLE":
        rotation, delta = obj.rotation_axis_angle, (1.0, 0.0, 0.0, 0.0)
    else:
        rotation, delta = obj.rotation_euler, obj.delta_rotation_euler
    inverse = np.array(obj.matrix_parent_inverse, float) if obj.parent is not None else np.eye(4)
    return Transform(
        location=tuple(obj.location),
        rotation_mode=mode,
        rotation=tuple(rotation),
        scale=tuple(obj.scale),
        delta_location=tuple(obj.delta_location),
        delta_rotation=tuple(delta),
        delta_scale=tuple(obj.delta_scale),
        parent_inverse=None if np.array_equal(inverse, np.eye(4)) else inverse,
    )


def modifiers(obj):
    return [modifier.name for modifier in obj.modifiers if modifier.show_viewport]


def _shape_keys(obj):
    keys = getattr(obj.data, "shape_keys", None)
    return len(keys.key_blocks) if keys else 0


def _is_playback(constraint):
    return constraint.name.startswith(RESPONSE)


def _acts(constraint):
    return not _is_playback(constraint) and not constraint.mute and constraint.influence > 0.0


def _collection_shown(obj):
    shows = obj.instance_type == "COLLECTION" and obj.instance_collection is not None
    return instances.key_of(obj.instance_collection) if shows else ""


def _animatable(obj):
    """An object and its data, if they have animation data."""
    candidates = (obj, obj.data, getattr(obj.data, "shape_keys", None))
    return [data for data in candidates if data is not None and getattr(data, "animation_data", None)]


def _animated(data):
    animation = data.animation_data
    return animation.action is not None or any(not track.mute for track in animation.nla_tracks)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Bulk keyframes, in the two forms that Blender versions require."""

import bpy
import numpy as np


_OURS = "pong_response"


def is_ours(action) -> bool:
    """True if an action comes from playback."""
    return action is not None and bool(action.get(_OURS))


def action_curves(owner, name: str):
    """Curves of a new action of an object, as an object with `new(data_path, index=i)`."""
    old = owner.animation_data.action if owner.animation_data else None
    owner.animation_data_clear()
    if is_ours(old) and old.users == 0:
        bpy.data.actions.remove(old)
    action = bpy.data.actions.new(name)
    action[_OURS] = True
    data = owner.animation_data_create()
    data.action = action
    if not hasattr(action, "slots"):  # before 4.4
        return action.fcurves
    slot = action.slots.new(id_type="OBJECT", name=owner.name)
    data.action_slot = slot
    strip = action.layers.new("response").strips.new(type="KEYFRAME")
    return strip.channelbag(slot, ensure=True).fcurves


def key(curves, path: str, values: np.ndarray, first_frame: int = 1, constant: bool = False) -> None:
    """One key per picture and component. `values` has axes (picture, component), or (picture,) for a single value.

    Of a constant curve only the changes are kept.
    """
    values = np.asarray(values, dtype=np.float64)
    columns = values[:, None] if values.ndim == 1 else values
    for index in range(columns.shape[1]):
        _curve(curves.new(path, index=index), columns[:, index], first_frame, constant)


def _curve(curve, column: np.ndarray, first_frame: int, constant: bool) -> None:
    pictures = np.arange(len(column))
    if constant:
        pictures = pictures[np.concatenate([[True], column[1:] != column[:-1]])]
    points = np.empty((len(pictures), 2), dtype=np.float32)
    points[:, 0], points[:, 1] = pictures + first_frame, column[pictures]
    curve.keyframe_points.add(len(pictures))
    curve.keyframe_points.foreach_set("co", points.ravel())
    # The numbers of the enumeration differ from version to version.
    mode = "CONSTANT" if constant else "LINEAR"
    number = bpy.types.Keyframe.bl_rna.properties["interpolation"].enum_items[mode].value
    curve.keyframe_points.foreach_set("interpolation", np.full(len(pictures), number, dtype=np.int32))
    curve.update()

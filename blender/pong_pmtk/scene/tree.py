# SPDX-License-Identifier: GPL-3.0-or-later
"""Parenting of objects, and new empties as parents."""

import bpy
from mathutils import Matrix

DISPLAY_SHARE = 0.5  # of the largest object: so long are the axes of a new root or group


def topmost(objects):
    """Objects without an ancestor among the others."""
    chosen = set(objects)
    return [obj for obj in objects if not any(parent in chosen for parent in parents(obj))]


def parents(obj):
    while obj.parent is not None:
        obj = obj.parent
        yield obj


def common_parent(objects):
    """Lowest common ancestor of these objects, or None."""
    first, *others = [list(parents(obj)) for obj in objects]
    return next((obj for obj in first if all(obj in other for other in others)), None)


def hang(obj, parent):
    """Parents an object and keeps its pose, to the last bit if the new parent has the pose of the old one."""
    if parent is not None and parent.parent == obj.parent and parent.matrix_local == Matrix():
        obj.parent = parent
        return
    world, is_free = obj.matrix_world.copy(), obj.parent is None and not obj.constraints
    obj.parent = parent
    obj.parent_type = "OBJECT"
    obj.matrix_parent_inverse = parent.matrix_world.inverted() if parent is not None else Matrix()
    if not is_free:  # else its own numbers are those of the world: worked out anew they would be rounded
        obj.matrix_world = world


def new_empty(context, name, members, shape):
    """An empty in the collection of the first of some objects, sized to suit them."""
    obj = bpy.data.objects.new(name, None)
    obj.empty_display_type = shape
    context.view_layer.update()
    below = [each for member in members for each in (member, *member.children_recursive)]
    obj.empty_display_size = DISPLAY_SHARE * max((max(each.dimensions) for each in below), default=0.0) or 1.0
    like = members[0] if members else None
    _collection(context, like).objects.link(obj)
    return obj


def _collection(context, like):
    """Collection of a new object: that of another object, or the active one. Collections of other files are excluded."""
    wanted = [*(like.users_collection if like is not None else ()), context.collection]
    own = [each for each in wanted if not each.library and not each.override_library]
    return own[0] if own else context.scene.collection

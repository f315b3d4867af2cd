# SPDX-License-Identifier: GPL-3.0-or-later
"""Membership and references in a model."""

from ..core.naming import natural

def root_of(obj):
    """Root above an object, including itself; None outside of any model."""
    while obj is not None:
        if obj.pong.role == "root":
            return obj
        obj = obj.parent
    return None


def roots(scene):
    """All roots of a scene, by name."""
    return sorted((obj for obj in scene.objects if obj.pong.role == "root"), key=lambda obj: obj.name)


def current_root(context):
    """Model of the panels: that of the active object, else the only one of the scene."""
    active = context.view_layer.objects.active if context.view_layer else None
    root = root_of(active)
    if root is not None:
        return root
    all_roots = roots(context.scene)
    return all_roots[0] if len(all_roots) == 1 else None


def tree(root):
    """A root and everything below it."""
    return [root, *root.children_recursive]


def siblings(obj, scene):
    """Objects with the same parent, including itself: names in the model are unique among these."""
    return list(obj.parent.children) if obj.parent else [other for other in scene.objects if other.parent is None]


def rename_surface(root, old, new):
    """Replaces the name of a surface everywhere in a model."""
    for obj in tree(root):
        for holder in (obj.pong, *obj.pong.parts):
            if holder.surface == old:
                holder.surface = new
    for pair in root.pong_model.pairs:
        if pair.first == old:
            pair.first = new
        if pair.second == old:
            pair.second = new


def select_only(context, objects, active=None):
    """Selects objects and nothing else, as far as possible."""
    context.view_layer.update()  # what was just made cannot be selected before
    for obj in context.view_layer.objects:
        obj.select_set(False)
    for obj in objects:
        if obj.name in context.view_layer.objects:
            obj.select_set(True)
    if active is not None and active.name in context.view_layer.objects:
        context.view_layer.objects.active = active


def unique_name(wanted, taken):
    """`wanted`, with a number appended if it is taken."""
    if wanted not in taken:
        return wanted
    number = 2
    while f"{wanted}_{number}" in taken:
        number += 1
    return f"{wanted}_{number}"


def parents_first(root, objects):
    """(object, depth) of a root and its descendants with a role, in the order of the tree."""
    below = {}
    for obj in objects:
        if obj.parent is not None:
            below.setdefault(obj.parent.name, []).append(obj)
    listed, open_ = [], [(root, 0)]
    while open_:
        obj, depth = open_.pop()
        marked = obj.pong.role != "none"
        if marked:
            listed.append((obj, depth))
        children = sorted(below.get(obj.name, ()), key=lambda child: natural(child.name), reverse=True)
        open_ += [(child, depth + marked) for child in children]
    return listed

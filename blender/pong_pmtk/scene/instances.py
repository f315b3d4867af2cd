# SPDX-License-Identifier: GPL-3.0-or-later
"""Instances: facts for a snapshot about those made by the core, and those that only Blender can make.

What an empty shows of a collection is composed by the core from stored transforms, like everything else, so nothing is
rounded twice. Instances on vertices and faces, and those of geometry nodes, exist only as matrices of the dependency
graph and are taken from there, as objects with names made from the instancer's.
"""

from dataclasses import replace

from pathlib import Path

import numpy as np

from ..core.snapshot import Transform

SEPARATOR = "."  # between the name of an instancer and that of what it shows
LIBRARY = " [{}]"  # behind the name of an object or a collection of another file, where names alone are not unique
NO_ID = 2**31 - 1  # fills the unused places of a persistent id


def key_of(data):
    """A name unique among data of all files."""
    return data.name + (LIBRARY.format(Path(data.library.filepath).name) if data.library else "")


def unique_names(objects):
    """Object -> name. An object of another file keeps its name unless an object of this one has it."""
    local = {obj.name for obj in objects if not obj.library}
    names, taken = {}, set(local)
    for obj in objects:
        name = obj.name
        if obj.library and name in taken:
            name = key_of(obj)
            while name in taken:  # files of the same name in two folders
                name += "'"
        taken.add(name)
        names[obj] = name
    return names


def shown_collections(scene):
    """Name -> collection: those shown by empties of a scene, and those shown by their objects in turn."""
    found, open_ = {}, list(scene.objects)
    while open_:
        obj = open_.pop()
        collection = obj.instance_collection
        if obj.instance_type == "COLLECTION" and collection is not None and key_of(collection) not in found:
            found[key_of(collection)] = collection
            open_ += collection.all_objects
    return found


def beyond(scene, shown):
    """Objects of shown collections that are not in the scene itself, each once."""
    own = set(scene.objects)
    members = {obj: None for collection in shown.values() for obj in collection.all_objects if obj not in own}
    return list(members)


def memberships(shown):
    """Object -> names of the shown collections that show it. Hidden objects have no instances."""
    found = {}
    for name, collection in sorted(shown.items()):
        for obj in collection.all_objects:
            if not obj.hide_viewport:
                found.setdefault(obj, []).append(name)
    return found


def shown_elsewhere(scene):
    """Objects that Blender shows on their parents' vertices or faces instead of their own location."""
    instancers = [obj for obj in scene.objects if obj.instance_type in ("VERTS", "FACES")]
    return {child for obj in instancers for child in obj.children}


def scattered(reader):
    """Marked instances that are not of a collection shown by an empty."""
    made = []
    for instance in reader.depsgraph.object_instances:
        if not instance.is_instance or instance.parent is None:
            continue
        parent, shown = instance.parent.original, instance.instance_object.original
        if parent.instance_type != "COLLECTION" and shown != parent and shown.pong.role != "none":
            made.append(_one(reader, instance, parent, shown))
    return made


def _one(reader, instance, parent, shown):
    number = "_".join(str(number) for number in reversed(instance.persistent_id) if number != NO_ID)
    facts = reader.object(shown)
    facts.name, facts.called = f"{reader.name(parent)}{SEPARATOR}{reader.name(shown)}_{number}", ""
    facts.mark = replace(facts.mark, name=f"{facts.mark.name or shown.name}_{number}")
    matrix = np.linalg.inv(np.array(parent.matrix_world, float)) @ np.array(instance.matrix_world, float)
    facts.parent, facts.parent_type = reader.name(parent), "OBJECT"
    facts.transform = Transform(parent_inverse=matrix)
    facts.exact.pop("location", None)
    facts.hidden = facts.excluded = False
    facts.collections = []
    return facts

# SPDX-License-Identifier: GPL-3.0-or-later
"""State of a file before a response was added, and removal of the response.

A response adds a collection with everything it makes. The author's objects keep parents, animation and numbers: a
constraint of theirs (`RESPONSE`) follows what the response moves. Settings of the scene are noted before they change.
"""

from __future__ import annotations

import json

import bpy

from .animate import is_ours
from .captions import KEY as CAPTIONS
from .core.naming import RESPONSE

NOTED = "pong_before"  # of a scene: its settings, as JSON
OURS = "pong_response"  # of a collection that a response made
SETTINGS = (
    "render.fps", "render.fps_base", "frame_start", "frame_end", "frame_current", "render.engine", "render.resolution_x",
    "render.resolution_y", "render.resolution_percentage", "view_settings.view_transform", "view_settings.look",
    "view_settings.exposure", "display.shading.light", "display.shading.color_type", "display.shading.show_shadows",
    "display.shading.show_cavity", "display.render_aa", "eevee.taa_render_samples", "cycles.device", "cycles.samples",
    "cycles.use_denoising",
)
MATERIALS = ("Pong response", "Pong marks")
WORLD = "Pong world"


def note(scene) -> None:
    """Records the settings of a scene once, before the first response."""
    if NOTED in scene:
        return
    settings = {path: value for path in SETTINGS if (value := _value(scene, path)) is not None}
    scene[NOTED] = json.dumps({
        "settings": settings, "views": [space.shading.color_type for space in _views()],
        "camera": scene.camera.name if scene.camera else "", "has_world": scene.world is not None,
    })


def _owner(scene, path: str):
    owner, *names = scene, *path.split(".")
    for name in names[:-1]:
        owner = getattr(owner, name, None)
    return owner, names[-1]


def _value(scene, path: str):
    owner, name = _owner(scene, path)
    return getattr(owner, name, None)


def _views() -> list:
    return [space for screen in bpy.data.screens for area in screen.areas for space in area.spaces if space.type == "VIEW_3D"]


def led() -> list:
    """(object, constraint) of everything moved by a response."""
    return [(item, each) for item in bpy.data.objects for each in item.constraints if each.name.startswith(RESPONSE)]


def responses(scene) -> list:
    return [each for each in scene.collection.children_recursive if each.get(OURS)]


def is_shown(scene) -> bool:
    return NOTED in scene or bool(responses(scene))


def remove(scene) -> int:
    """Removes all responses from a scene and restores its settings; returns the number of freed author's objects."""
    free = led()
    for collection in responses(scene):
        clear(collection)
    for item in [item for item in scene.objects if item.animation_data and is_ours(item.animation_data.action)]:
        action = item.animation_data.action  # of a version that animated the author's objects themselves
        item.animation_data_clear()
        bpy.data.actions.remove(action)
    bpy.data.batch_remove([each for name in MATERIALS if (each := bpy.data.materials.get(name)) and not each.users])
    if CAPTIONS in scene:
        del scene[CAPTIONS]
    if NOTED in scene:
        _put_back(scene, json.loads(scene[NOTED]))
        del scene[NOTED]
    return len(free)


def clear(collection) -> None:
    """Removes one response, and returns its objects to their former pose."""
    own = set(collection.objects)
    for item, constraint in led():
        if constraint.target is None or constraint.target in own:
            item.constraints.remove(constraint)
    actions = [item.animation_data.action for item in own if item.animation_data and is_ours(item.animation_data.action)]
    data = {item.data for item in own if item.data is not None}
    bpy.data.batch_remove([*own, *data, *actions, collection])


def _put_back(scene, noted: dict) -> None:
    for path, value in noted["settings"].items():
        owner, name = _owner(scene, path)
        if owner is not None and name != "frame_current" and getattr(owner, name) != value:
            setattr(owner, name, value)
    scene.camera = bpy.data.objects.get(noted["camera"]) if noted["camera"] else None
    if not noted["has_world"] and scene.world is not None and scene.world.name.startswith(WORLD):
        bpy.data.worlds.remove(scene.world)
    views = _views()
    if len(views) == len(noted["views"]):
        for space, color_type in zip(views, noted["views"]):
            space.shading.color_type = color_type
    scene.frame_set(noted["settings"]["frame_current"])

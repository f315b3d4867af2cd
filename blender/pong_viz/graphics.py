# SPDX-License-Identifier: GPL-3.0-or-later
"""The author's own objects: which of them a body moves."""

from __future__ import annotations

from .animate import is_ours

PROPERTY = "pong_body"  # of an object: name of the body that moves it


def graphics_of(scene, names: list[str], wanted: dict[str, str]) -> dict:
    """Body -> object of the scene: named by the user, else marked with the property, else of the body's name."""
    unknown = [body for body in wanted if body not in names]
    if unknown:
        raise ValueError(f"there is no body `{unknown[0]}` in the log; it has {', '.join(names)}")
    found = {body: item for body in names if (item := _object_of(scene, body, wanted.get(body))) is not None}
    bodies: dict = {}
    for body, item in found.items():
        if item in bodies:
            raise ValueError(f"bodies `{bodies[item]}` and `{body}` are both to move `{item.name}`; give each an object of its own")
        bodies[item] = body
    return found


def _object_of(scene, body: str, wanted: str | None):
    if wanted is not None:
        item = scene.objects.get(wanted)
        if item is None:
            raise ValueError(f"body `{body}` is to move `{wanted}`, but the scene `{scene.name}` has no such object; "
                             "name one that it has")
        return item
    marked = [item for item in scene.objects if item.get(PROPERTY) == body]
    if len(marked) > 1:
        raise ValueError(f"body `{body}` is to move {', '.join(f'`{item.name}`' for item in marked)}; parent them to one "
                         "object (an empty at the origin of the group's frame) and mark only that")
    return marked[0] if marked else scene.objects.get(body)


def strays(scene, names: list[str]) -> list[str]:
    """What is wrong with marks of the scene though it can be shown."""
    marks = [(item.name, item.get(PROPERTY)) for item in scene.objects if item.get(PROPERTY)]
    return [f"object `{item}` is marked for body `{body}`, which is not in the log ({', '.join(names)}); it does not move"
            for item, body in marks if body not in names]


def release(item, notes: list[str]) -> None:
    """Frees an object from all that would move it besides the response; its size stays."""
    if item.parent is not None:
        item.scale = item.matrix_world.to_scale()
        item.parent = None
        notes.append(f"object `{item.name}` is moved by the response now, no more by its parent")
    for constraint in item.constraints:
        if not constraint.mute:
            constraint.mute = True
            notes.append(f"object `{item.name}`: constraint `{constraint.name}` is switched off, the response moves the object")
    if item.animation_data is not None and not is_ours(item.animation_data.action):
        notes.append(f"object `{item.name}`: its own animation is replaced by the response")
    item.delta_location = (0.0, 0.0, 0.0)
    item.delta_rotation_quaternion = (1.0, 0.0, 0.0, 0.0)

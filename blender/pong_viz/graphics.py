# SPDX-License-Identifier: GPL-3.0-or-later
"""The author's own objects that are moved by bodies."""

from __future__ import annotations

from .core.naming import RESPONSE

PROPERTY = "pong_body"  # of an object: name of the body that moves it


def graphics_of(scene, names: list[str], wanted: dict[str, str]) -> dict:
    """Body -> object of the scene: named by the user, else marked with the property, else with the body's name."""
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
    """Faults of marks in the scene that do not prevent the display."""
    marks = [(item.name, item.get(PROPERTY)) for item in scene.objects if item.get(PROPERTY)]
    return [f"object `{item}` is marked for body `{body}`, which is not in the log ({', '.join(names)}); it does not move"
            for item, body in marks if body not in names]


def lead(item, driver, notes: list[str] | None) -> None:
    """Makes an object follow a driver. Its parent, animation, numbers and other constraints stay as the author made them.

    `notes` takes what moves the object no more while it follows; `None` for an object that followed before.
    """
    if item.library:
        raise ValueError(f"`{item.name}` is linked from another file and cannot be moved: make a library override of it")
    driver.scale = item.matrix_world.to_scale()
    constraint = item.constraints.new("COPY_TRANSFORMS")
    constraint.name, constraint.target = RESPONSE, driver
    others = [f"constraint `{each.name}`" for each in item.constraints if each != constraint and not each.mute]
    parent = [f"its parent `{item.parent.name}`"] if item.parent is not None else []
    own = ["its own animation"] if item.animation_data is not None and item.animation_data.action is not None else []
    if notes is not None:
        notes += [f"object `{item.name}` follows the response, not {other}; Remove Response gives it back"
                  for other in (*parent, *others, *own)]

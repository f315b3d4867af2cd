# SPDX-License-Identifier: GPL-3.0-or-later
"""Overlays in the 3D view. The core computes the lines (core/overlay.py); this stores them and passes them to the GPU.

Overlays show the model as it would be exported, so they are worked out by a whole check: after changes of the scene,
in a pause of the author's work and never while Blender draws, and only while they are switched on. A model that has
errors is not shown; the panel says so.
"""

import time

import bpy
import numpy as np
from bpy.app.handlers import persistent

from ..core import overlay
from ..scene import session
from ..store import changes, state as toggles
from ..store.references import current_root
from ..store.state import state

COLOURS = {
    "show_bounds": (0.95, 0.75, 0.2, 0.8),
    "show_normals": (0.3, 0.8, 1.0, 0.8),
    "show_rays": (1.0, 0.35, 0.3, 1.0),
    "show_round": (0.85, 0.55, 1.0, 1.0),
    "show_groups": (0.5, 1.0, 0.4, 1.0),
}
LINE_WIDTH_PX = 1.5
AXES_SHARE = 0.1  # of the model's size: the axes of groups

PAUSE_S = 0.2  # after the last change, and as long again as the last check took

_shown = {}  # by name of the scene: {toggle: ends of lines}
_messages = {}  # by name of the scene: why there is nothing to see
_took = [0.0]  # the last check, s
_handle = []


def wanted(shown):
    """The toggles that are on."""
    return [name for name in COLOURS if getattr(shown, name)]


def message(context):
    return _messages.get(context.scene.name, "")


def refresh(context):
    """Recomputes the lines of a scene."""
    name, root, shown = context.scene.name, current_root(context), state(context)
    _shown.pop(name, None)
    _messages.pop(name, None)
    if root is None or not wanted(shown):
        return
    started = time.monotonic()
    result = session.check(context, root.name)
    if result.model is None:
        _messages[name] = f"Not shown: {result.summary()}"
    else:
        _shown[name] = lines(context, root, result)
    _took[0] = time.monotonic() - started


def lines(context, root, result):
    """Ends of lines in the coordinates of the scene, by toggle."""
    model, shown = result.model, state(context)
    bounds = overlay.bounds_lines(model, result.loaded)
    size = size_of(bounds)
    tables = {
        "show_bounds": lambda: bounds,
        "show_normals": lambda: overlay.normals_lines(model, shown.normal_length * size),
        "show_rays": lambda: overlay.rays_lines(model),
        "show_round": lambda: overlay.round_lines(model),
        "show_groups": lambda: overlay.groups_lines(model, AXES_SHARE * size),
    }
    return {name: in_scene(context, root, tables[name]()) for name in wanted(shown)}


def size_of(bounds):
    """The diagonal of all bounding volumes, m."""
    found = list(bounds.values())
    return float(np.linalg.norm(np.ptp(np.concatenate(found), axis=0))) if found else 1.0


def in_scene(context, root, table):
    """Lines of the core, in metres in the root's frame, as points of the scene."""
    if not table:
        return np.empty((0, 3))
    points = np.concatenate(list(table.values())) / context.scene.unit_settings.scale_length
    # The model's numbers include the root's scale.
    location, rotation, _scale = root.matrix_world.decompose()
    return points @ np.array(rotation.to_matrix()).T + np.array(location)


def draw():
    """Called by Blender for every redraw of a 3D view."""
    import gpu
    from gpu_extras.batch import batch_for_shader

    found = _shown.get(bpy.context.scene.name)
    if not found:
        return
    shader = gpu.shader.from_builtin("POLYLINE_UNIFORM_COLOR")
    gpu.state.blend_set("ALPHA")
    shader.bind()
    shader.uniform_float("lineWidth", LINE_WIDTH_PX)
    shader.uniform_float("viewportSize", gpu.state.viewport_get()[2:])
    for name, points in found.items():
        if len(points):
            shader.uniform_float("color", COLOURS[name])
            batch_for_shader(shader, "LINES", {"pos": points.astype(np.float32)}).draw(shader)
    gpu.state.blend_set("NONE")


@persistent
def later(*_arguments):
    """Schedules a refresh after a change, in the next pause."""
    if bpy.app.timers.is_registered(in_pause):
        bpy.app.timers.unregister(in_pause)
    if wanted(bpy.context.window_manager.pong) or _shown:
        bpy.app.timers.register(in_pause, first_interval=PAUSE_S + _took[0])


def in_pause():
    """Refreshes the display of every window. Blender calls timers without a window in the context."""
    listen_no_more()  # a check updates the scene, which is no change of the author's
    try:
        for window in bpy.context.window_manager.windows:
            with bpy.context.temp_override(window=window):
                refresh(bpy.context)
            for area in window.screen.areas:
                if area.type == "VIEW_3D":
                    area.tag_redraw()
    finally:
        listen()


def lists_of_handlers():
    handlers = bpy.app.handlers
    return handlers.depsgraph_update_post, handlers.frame_change_post, handlers.load_post, handlers.undo_post


def listen():
    for listeners in (changes.listeners, toggles.listeners):
        listeners.append(later)
    for handlers in lists_of_handlers():
        handlers.append(later)


def listen_no_more():
    for listeners in (changes.listeners, toggles.listeners):
        if later in listeners:
            listeners.remove(later)
    for handlers in lists_of_handlers():
        if later in handlers:
            handlers.remove(later)


def register():
    listen()
    if not bpy.app.background:
        _handle.append(bpy.types.SpaceView3D.draw_handler_add(draw, (), "WINDOW", "POST_VIEW"))


def unregister():
    listen_no_more()
    if bpy.app.timers.is_registered(in_pause):
        bpy.app.timers.unregister(in_pause)
    while _handle:
        bpy.types.SpaceView3D.draw_handler_remove(_handle.pop(), "WINDOW")
    _shown.clear()
    _messages.clear()

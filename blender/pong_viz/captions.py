# SPDX-License-Identifier: GPL-3.0-or-later
"""Captions of pictures: log time, forces, and the arrow length of a newton."""

from __future__ import annotations

import contextlib

import bpy
import numpy as np

from .log import Log
from .marks import contact_forces
from .patches import merged
from .timeline import Film

KEY = "pong_response"  # of a scene: what its captions are made of
LINE_SHARE = 1 / 36  # height of a line, as a share of the picture's
SMALLEST_PX = 8
STAMPS = (
    "use_stamp_date", "use_stamp_time", "use_stamp_render_time", "use_stamp_frame", "use_stamp_frame_range",
    "use_stamp_memory", "use_stamp_hostname", "use_stamp_camera", "use_stamp_lens", "use_stamp_scene",
    "use_stamp_marker", "use_stamp_filename", "use_stamp_sequencer_strip", "use_stamp_note",
)
LOOK = {
    "use_stamp": True, "use_stamp_labels": False, "stamp_foreground": (1.0, 1.0, 1.0, 1.0),
    "stamp_background": (0.0, 0.0, 0.0, 0.75),
}
KEPT = (*STAMPS, *LOOK, "stamp_font_size", "stamp_note_text")


def keep(scene, log: Log, film: Film, metres_per_newton: float, pressure_scale: float = 0.0) -> None:
    """Stores the data of its captions with a scene; pictures begin at frame 1."""
    forces = [np.linalg.norm(contact_forces(merged(log.contacts_of(int(row)))), axis=1) for row in film.rows]
    scene[KEY] = {
        "times": np.asarray(film.times, float),
        "contacts": np.array([len(each) for each in forces], float),
        "largest": np.array([each.max(initial=0.0) for each in forces]),
        "pressure_scale": pressure_scale,
        "newtons_per_metre": 1.0 / metres_per_newton if metres_per_newton else 0.0,
    }


def text(scene, frame: int) -> str:
    """Caption of the picture; "" for a scene that shows no response."""
    known = scene.get(KEY)
    if not known or not len(known["times"]):
        return ""
    picture = min(max(frame - 1, 0), len(known["times"]) - 1)
    count = int(known["contacts"][picture])
    told = [f"t = {known['times'][picture]:.4f} s"]
    if count:
        told.append(f"{count} contact{'s' * (count != 1)}, largest force {known['largest'][picture]:.4g} N")
    else:
        told.append("no contact")
    if known["newtons_per_metre"]:
        told.append(f"1 m of arrow: {known['newtons_per_metre']:.4g} N")
    if known.get("pressure_scale"):
        told.append(f"yellow: {pressure(known['pressure_scale'])}")
    return f" {'   '.join(told)} "


def pressure(value: float) -> str:
    """A pressure with a prefix: `12.3 kPa`."""
    factor, unit = next((f, u) for f, u in ((1e9, "GPa"), (1e6, "MPa"), (1e3, "kPa"), (0.0, "Pa")) if value >= f)
    return f"{value / (factor or 1.0):.3g} {unit}"


@contextlib.contextmanager
def shown(scene, wanted: bool = True):
    """Context in which Blender writes the caption of each picture into it."""
    if not wanted or not text(scene, 1):
        yield
        return
    render = scene.render
    before = {name: _value(render, name) for name in KEPT if hasattr(render, name)}
    for name in STAMPS:
        if hasattr(render, name):
            setattr(render, name, name == "use_stamp_note")
    for name, value in LOOK.items():
        setattr(render, name, value)
    height = render.resolution_y * render.resolution_percentage // 100
    render.stamp_font_size = max(int(height * LINE_SHARE), SMALLEST_PX)

    def write(rendered, *_arguments):
        if rendered.name == scene.name:
            render.stamp_note_text = text(scene, rendered.frame_current)

    bpy.app.handlers.render_pre.append(write)
    try:
        yield
    finally:
        bpy.app.handlers.render_pre.remove(write)
        for name, value in before.items():
            setattr(render, name, value)


def _value(render, name: str):
    value = getattr(render, name)
    return tuple(value) if hasattr(value, "__len__") and not isinstance(value, str) else value

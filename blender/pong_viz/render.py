# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures and films of a scene."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import bpy

BACKGROUND = (0.50, 0.53, 0.58)


@dataclass
class Picture:
    """How to render."""

    width: int = 1280
    height: int = 720
    engine: str = "workbench"
    samples: int = 8


def prepare(scene, picture: Picture) -> None:
    """Sets size and engine."""
    scene.render.resolution_x, scene.render.resolution_y = picture.width, picture.height
    scene.render.resolution_percentage = 100
    scene.render.engine = _engine(picture.engine)
    if scene.world is None:
        scene.world = bpy.data.worlds.new("Pong world")
        scene.world.color = BACKGROUND
    if picture.engine == "workbench":
        shading = scene.display.shading
        shading.light, shading.color_type = "STUDIO", "OBJECT"
        shading.show_shadows, shading.show_cavity = True, True
        scene.display.render_aa = "8"
        scene.view_settings.view_transform, scene.view_settings.exposure = "Standard", 0.7
    elif picture.engine == "cycles":
        scene.cycles.device, scene.cycles.samples, scene.cycles.use_denoising = "CPU", picture.samples, False
    else:
        scene.eevee.taa_render_samples = picture.samples


def _engine(name: str) -> str:
    if name == "workbench":
        return "BLENDER_WORKBENCH"
    if name == "cycles":
        return "CYCLES"
    known = {item.identifier for item in bpy.types.RenderSettings.bl_rna.properties["engine"].enum_items}
    # Its name changed with 4.2 and back with 5.0; the list of a module without a window may lack it.
    return "BLENDER_EEVEE_NEXT" if "BLENDER_EEVEE_NEXT" in known or bpy.app.version < (5, 0, 0) else "BLENDER_EEVEE"


def still(scene, path: Path, frame: int) -> Path:
    """One picture as PNG."""
    scene.frame_set(frame)
    _as_png(scene)
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True, scene=scene.name)
    return path


def frames(scene, folder: Path) -> None:
    """Every picture of the scene as `frame_0001.png` ... in a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    _as_png(scene)
    scene.render.filepath = str(folder / "frame_")
    bpy.ops.render.render(animation=True, scene=scene.name)


def movie(scene, path: Path) -> Path:
    """The whole scene as an mp4 film (H.264)."""
    settings = scene.render.image_settings
    if hasattr(settings, "media_type"):  # from 5.0 on it decides which formats there are
        settings.media_type = "VIDEO"
    settings.file_format = "FFMPEG"
    scene.render.ffmpeg.format, scene.render.ffmpeg.codec = "MPEG4", "H264"
    scene.render.ffmpeg.constant_rate_factor = "HIGH"
    scene.render.use_file_extension = False
    scene.render.filepath = str(path)
    bpy.ops.render.render(animation=True, scene=scene.name)
    return path


def _as_png(scene) -> None:
    settings = scene.render.image_settings
    if hasattr(settings, "media_type"):
        settings.media_type = "IMAGE"
    settings.file_format, settings.color_mode = "PNG", "RGB"
    scene.render.use_file_extension = True

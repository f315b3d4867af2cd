# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures and films of a scene."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import bpy

from . import captions

BACKGROUND = (0.50, 0.53, 0.58)
# Workbench's studio light is dim. The two suns of camera.py and the background give 1.6 times the light of a white
# surface; the exposure compensates for that, so that colours are true.
KEY_PICTURE_SECONDS = 4  # of film from one whole picture to the next: most of the bytes of a film are in these
EXPOSURE = {"workbench": 0.7, "lit": -0.7}


@dataclass
class Picture:
    """Render options; the engine `scene` leaves all settings of the scene as they are."""

    width: int = 1280
    height: int = 720
    engine: str = "workbench"
    samples: int = 8
    quick: bool = False  # Workbench without shadows and with one sample
    smooth: bool = True  # Workbench: edges without steps


def prepare(scene, picture: Picture) -> None:
    """Sets size, engine and, where there is none, a background."""
    if picture.engine == "scene":
        return
    scene.render.resolution_x, scene.render.resolution_y = picture.width, picture.height
    scene.render.resolution_percentage = 100
    scene.render.engine = _engine(picture.engine)
    if scene.world is None:
        scene.world = bpy.data.worlds.new("Pong world")
        scene.world.color = BACKGROUND
        scene.world.use_nodes = True
        for node in scene.world.node_tree.nodes:
            if node.type == "BACKGROUND":  # what EEVEE and Cycles see
                node.inputs["Color"].default_value = (*BACKGROUND, 1.0)
    # Blender's own choice (AgX) fades colours, which here distinguish sticking from slipping, and bodies from each
    # other.
    scene.view_settings.view_transform, scene.view_settings.look = "Standard", "None"
    scene.view_settings.exposure = EXPOSURE["workbench" if picture.engine == "workbench" else "lit"]
    if picture.engine == "workbench":
        shading = scene.display.shading
        shading.light, shading.color_type = "STUDIO", "OBJECT"
        shading.show_shadows, shading.show_cavity = not picture.quick, True
        scene.display.render_aa = ("FXAA" if picture.quick else "8") if picture.smooth else "OFF"
    elif picture.engine == "cycles":
        scene.cycles.device, scene.cycles.samples, scene.cycles.use_denoising = "CPU", picture.samples, False
    else:
        scene.eevee.taa_render_samples = picture.samples


def show_colors() -> None:
    """Makes solid 3D views show each object's own colour, where bodies, marks and arrows have theirs.

    Blender's own choice is the material's, and all of them share one grey material.
    """
    for screen in bpy.data.screens:
        for area in screen.areas:
            for space in area.spaces:
                if space.type == "VIEW_3D":
                    space.shading.color_type = "OBJECT"


def _engine(name: str) -> str:
    if name == "workbench":
        return "BLENDER_WORKBENCH"
    if name == "cycles":
        return "CYCLES"
    known = {item.identifier for item in bpy.types.RenderSettings.bl_rna.properties["engine"].enum_items}
    # Its name changed with 4.2 and back with 5.0; a module without a window may not list it.
    return "BLENDER_EEVEE_NEXT" if "BLENDER_EEVEE_NEXT" in known or bpy.app.version < (5, 0, 0) else "BLENDER_EEVEE"


class RenderFault(Exception):
    """A picture or film that cannot be rendered; the text names the file, the cause and the cure."""


def still(scene, path: Path, frame: int, caption: bool = True) -> Path:
    """Renders one picture as PNG."""
    _check(path, ".png")
    scene.frame_set(frame)
    _as_png(scene)
    scene.render.filepath = str(path)
    with captions.shown(scene, caption):
        return _rendered(path, write_still=True, scene=scene.name)


def frames(scene, folder: Path, caption: bool = True) -> Path:
    """Renders every picture of the scene as `frame_0001.png` ... in a folder. Pictures of an earlier, longer film are
    removed."""
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("frame_[0-9][0-9][0-9][0-9]*.png"):
        old.unlink()
    _as_png(scene)
    scene.render.filepath = str(folder / "frame_")
    with captions.shown(scene, caption):
        _rendered(folder / f"frame_{scene.frame_end:04}.png", animation=True, scene=scene.name)
    return folder


def movie(scene, path: Path, caption: bool = True) -> Path:
    """Renders the whole scene as an mp4 film (H.264)."""
    _check(path, ".mp4")
    as_film(scene, path)
    with captions.shown(scene, caption):
        return _rendered(path, animation=True, scene=scene.name)


def as_film(scene, path: Path) -> None:
    """Settings for an mp4 film; its sides are made even, as H.264 requires."""
    settings = scene.render.image_settings
    if hasattr(settings, "media_type"):  # from 5.0 on it decides which formats there are
        settings.media_type = "VIDEO"
    settings.file_format = "FFMPEG"
    scene.render.ffmpeg.format, scene.render.ffmpeg.codec = "MPEG4", "H264"
    scene.render.ffmpeg.constant_rate_factor = "HIGH"
    scene.render.ffmpeg.gopsize = KEY_PICTURE_SECONDS * scene.render.fps
    scene.render.resolution_x += scene.render.resolution_x % 2
    scene.render.resolution_y += scene.render.resolution_y % 2
    scene.render.use_file_extension = False
    scene.render.filepath = str(path)


KEPT = ("filepath", "use_file_extension", "resolution_x", "resolution_y")


def kept(scene) -> dict:
    """Render settings of the scene, which rendering a response changes temporarily."""
    settings = scene.render.image_settings
    form = {name: getattr(settings, name) for name in ("media_type", "file_format", "color_mode") if hasattr(settings, name)}
    return {"render": {name: getattr(scene.render, name) for name in KEPT}, "form": form, "frame": scene.frame_current}


def restore(scene, before: dict) -> None:
    for name, value in before["form"].items():
        setattr(scene.render.image_settings, name, value)
    for name, value in before["render"].items():
        setattr(scene.render, name, value)
    scene.frame_set(before["frame"])


def _check(path: Path, ending: str) -> None:
    if path.suffix.lower() != ending:
        raise RenderFault(f"{path}: the name must end in {ending}")
    if not path.parent.is_dir():
        raise RenderFault(f"{path}: there is no folder {path.parent}; make it first")


def _rendered(path: Path, **what) -> Path:
    """Renders; raises errors for files that Blender silently fails to write."""
    path.unlink(missing_ok=True)
    try:
        bpy.ops.render.render(**what)
    except RuntimeError as reason:
        raise RenderFault(f"{path}: not written; Blender says: {str(reason).strip()}") from None
    if not path.is_file() or path.stat().st_size == 0:
        raise RenderFault(f"{path}: not written; see what Blender printed, and whether the disk has room")
    return path


def _as_png(scene) -> None:
    settings = scene.render.image_settings
    if hasattr(settings, "media_type"):
        settings.media_type = "IMAGE"
    settings.file_format, settings.color_mode = "PNG", "RGB"
    scene.render.use_file_extension = True

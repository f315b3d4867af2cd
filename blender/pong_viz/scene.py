# SPDX-License-Identifier: GPL-3.0-or-later
"""A response log as an animated Blender scene."""

from __future__ import annotations

from dataclasses import dataclass, field

import bpy
import numpy as np

from . import before, captions, shapes
from .bodies import show_bodies
from .camera import DIRECTION, frame_camera
from .contacts import show_contacts
from .log import Log
from .timeline import Film, View, film, travel, view


@dataclass
class Options:
    """Display options of a run."""

    fps: int = 30
    speed: float = 1.0  # 0.1: ten times slower than life
    start: float | None = None  # s
    end: float | None = None  # s
    relative_to: str = ""  # a body that is held still; "" for the common frame
    arrow_length: float = 0.0  # m for the largest force of the run; 0 for half the extent
    mark_radius: float = 0.0  # m of the disc at a contact; 0 for a share of the extent
    most_contacts: int = 64  # shown at once
    alpha: float = 0.55  # of bodies, so that arrows inside them are seen
    shapes: str = "missing"  # draw the models' primitives: one of SHAPES
    graphics: dict[str, str] = field(default_factory=dict)  # body -> object of the scene that moves with it
    camera: bool = True
    look_from: tuple[float, float, float] = DIRECTION  # from what is looked at to the camera
    look_at: tuple[float, float, float, float] | None = None  # a ball that fills the picture: centre, radius; else the run


# Colours: of all bodies; of those without graphics; likewise, and of primitives of the others while in contact; of
# none.
SHAPES = ("all", "missing", "touched", "none")


@dataclass
class Shown:
    """Created objects."""

    film: Film
    seen: View
    objects: dict[str, bpy.types.Object]  # body -> the object that moves
    arrows: list
    marks: list
    metres_per_newton: float
    pressure_scale: float  # of the last colour of patches, Pa; 0 without solids
    notes: list[str]  # what the user should know


@dataclass
class Stage:
    """Shared data of the makers of a scene's parts."""

    log: Log
    options: Options
    scene: bpy.types.Scene
    collection: bpy.types.Collection
    models: list
    anchors: np.ndarray  # (bodies, 3): shapes.anchor_of
    extent: float  # of what is looked at, m
    sizes: shapes.Sizes
    unit: float  # m of one unit of the scene
    led: set  # objects of the author's that an earlier response of this log moved


def show(log: Log, options: Options, scene=None) -> Shown:
    """Adds an animated response to a scene: bodies, contact marks, arrows, a camera."""
    scene = scene or bpy.context.scene
    pictures = film(log, options.fps, options.speed, options.start, options.end)
    held = _index_of_body(log, options.relative_to)
    models = [shapes.load(path) for path in log.models]
    boxes = [shapes.boxes_of(model) for model in models]
    anchors = np.array([shapes.anchor_of(boxes[body.model].get(body.path)) for body in log.bodies]).reshape(-1, 3)
    whole = _extent(log, [shapes.extent_of(model) for model in models])
    extent = 2.0 * options.look_at[3] if options.look_at else whole  # arrows and marks are as large as suits the picture
    seen = view(log, pictures, held, whole, anchors)
    sizes = shapes.sizes_for(extent, whole + travel(log, pictures, seen, anchors))
    shown = Shown(pictures, seen, {}, [], [], 0.0, 0.0, list(log.notes))
    name = f"Response of {log.run.get('name') or log.folder.name}"
    before.note(scene)
    led = {item for item, _ in before.led()}
    if name in bpy.data.collections:  # what an earlier call made of the same log
        before.clear(bpy.data.collections[name])
    stage = Stage(log, options, scene, bpy.data.collections.new(name), models, anchors, extent, sizes,
                  scene.unit_settings.scale_length or 1.0, led)
    stage.collection[before.OURS] = True
    scene.collection.children.link(stage.collection)
    bpy.context.view_layer.update()
    _tell_what_is_followed(stage, shown)
    show_bodies(stage, shown)
    slots = show_contacts(stage, shown)
    scene.render.fps, scene.render.fps_base = options.fps, 1.0
    scene.frame_start, scene.frame_end = 1, len(pictures.times)
    captions.keep(scene, log, pictures, shown.metres_per_newton, shown.pressure_scale)
    scene.frame_set(1)
    if options.camera:
        points = np.concatenate([slots.points[slots.shown], slots.tips(shown.metres_per_newton)])
        frame_camera(scene, stage.collection, list(shown.objects.values()), points / stage.unit, whole / stage.unit,
                     options.look_from, options.look_at and np.array(options.look_at) / stage.unit)
    return shown


def _extent(log: Log, extents: list[float]) -> float:
    """Size of the subject, m: of the smaller partner in the largest touching pair; a rover, not its terrain."""
    objects = log.run["objects"]
    partners = [[extents[objects[number]["model"]] for number in pair] for pair in log.pairs_that_touch()]
    found = [min(size for size in sizes if size > 0.0) for sizes in partners if max(sizes) > 0.0]
    return max(found, default=0.0) or max(extents, default=0.0) or 1.0


def _index_of_body(log: Log, name: str) -> int | None:
    if not name:
        return None
    names = [body.name for body in log.bodies]
    if name not in names:
        raise ValueError(f"there is no body `{name}` in the log; it has {', '.join(names)}")
    return names.index(name)


def _tell_what_is_followed(stage: Stage, shown: Shown) -> None:
    if shown.seen.followed is not None:
        name = stage.log.bodies[shown.seen.followed].name
        shown.notes.append(f"all bodies move far together: the view goes along with `{name}`; "
                           "hold a body of your choice still with --relative-to (Hold still)")

# SPDX-License-Identifier: GPL-3.0-or-later
"""A response log as an animated Blender scene."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import bpy
import numpy as np

from . import marks, shapes
from .animate import action_curves, key
from .camera import frame_camera
from .log import Log
from .timeline import Film, View, film, track, travel, view

FORCE = (0.75, 0.02, 0.02, 1.0)
BODY_COLORS = (
    (0.55, 0.62, 0.72), (0.80, 0.74, 0.62), (0.50, 0.66, 0.58), (0.70, 0.58, 0.68), (0.62, 0.62, 0.62),
)


@dataclass
class Options:
    """How a run is shown."""

    fps: int = 30
    speed: float = 1.0  # 0.1: ten times slower than life
    start: float | None = None  # s
    end: float | None = None  # s
    relative_to: str = ""  # a body that is held still; "" for the common frame
    arrow_length: float = 0.0  # m for the largest force of the run; 0 for half the extent
    most_contacts: int = 64  # shown at once
    alpha: float = 0.55  # of bodies, so that arrows inside them are seen
    shapes: str = "missing"  # draw the models' primitives: "all", "missing" (bodies without graphics), "none"
    graphics: dict[str, str] = field(default_factory=dict)  # body -> object of the scene that moves with it
    camera: bool = True


@dataclass
class Shown:
    """What was made."""

    film: Film
    seen: View
    objects: dict[str, bpy.types.Object]  # body -> the object that moves
    arrows: list
    marks: list
    metres_per_newton: float
    notes: list[str]  # what the user should know


def show(log: Log, options: Options, scene=None) -> Shown:
    """Adds an animated response to a scene: bodies, contact marks, arrows, a camera."""
    scene = scene or bpy.context.scene
    unit = scene.unit_settings.scale_length or 1.0
    pictures = film(log, options.fps, options.speed, options.start, options.end)
    seen = view(log, pictures, _index_of_body(log, options.relative_to))
    models = [shapes.load(path) for path in log.models]
    extent = max([shapes.extent_of(model) for model in models] + [1e-3])
    shown = Shown(pictures, seen, {}, [], [], 0.0, [])
    collection = _fresh_collection(scene, f"Response of {log.run.get('name', log.folder.name)}")
    sizes = shapes.sizes_for(extent, travel(log, pictures, seen))
    _show_bodies(log, options, shown, models, sizes, collection, unit)
    _show_contacts(log, options, shown, extent, collection, unit)
    scene.render.fps, scene.render.fps_base = options.fps, 1.0
    scene.frame_start, scene.frame_end = 1, len(pictures.times)
    scene.frame_set(1)
    if options.camera:
        frame_camera(scene, collection, list(shown.objects.values()))
    return shown


def _index_of_body(log: Log, name: str) -> int | None:
    if not name:
        return None
    names = [body.name for body in log.bodies]
    if name not in names:
        raise ValueError(f"there is no body `{name}` in the log; it has {', '.join(names)}")
    return names.index(name)


def _fresh_collection(scene, name: str):
    old = bpy.data.collections.get(name)
    if old is not None:  # shown before: replace it
        for item in list(old.objects):
            bpy.data.objects.remove(item)
        bpy.data.collections.remove(old)
    collection = bpy.data.collections.new(name)
    scene.collection.children.link(collection)
    return collection


# --- bodies -------------------------------------------------------------------------------------------------------


def _show_bodies(log, options, shown, models, sizes, collection, unit) -> None:
    touching = log.touching()
    parts = [shapes.bodies_of(model) for model in models]
    index = {(p.body, p.path): i for i, p in enumerate(log.primitives)}
    for number, body in enumerate(log.bodies):
        moved = _graphics_of(body.name, options, shown)
        draw = options.shapes == "all" or (options.shapes == "missing" and moved is None)
        if moved is None:
            moved = bpy.data.objects.new(body.name, None)
            moved.empty_display_type, moved.empty_display_size = "ARROWS", 10.0 * sizes.point / unit
            collection.objects.link(moved)
        _key_motion(moved, track(log, shown.film, number, shown.seen), unit, body.name)
        shown.objects[body.name] = moved
        if draw:
            color = BODY_COLORS[log.run["bodies"][number]["object"] % len(BODY_COLORS)]
            listed = [(index.get((number, path)), shapes.shape(path, primitive, turn, place, sizes))
                      for path, primitive, turn, place in parts[body.model].get(body.path, [])]
            _draw_body(log, shown, moved, listed, touching, (*color, options.alpha), collection, unit)


def _graphics_of(body: str, options: Options, shown: Shown):
    """The author's own object for a body: named by the user, marked `pong_body`, or of the body's name."""
    wanted = options.graphics.get(body)
    if wanted is not None:
        found = bpy.data.objects.get(wanted)
        if found is None:
            raise ValueError(f"body `{body}` is to move `{wanted}`, but the scene has no such object; name one that it has")
        return found
    marked = [item for item in bpy.data.objects if item.get("pong_body") == body]
    return marked[0] if marked else None


def _key_motion(moved, way, unit, name) -> None:
    moved.parent = None
    moved.rotation_mode = "QUATERNION"
    moved.delta_location = (0.0, 0.0, 0.0)
    moved.delta_rotation_quaternion = (1.0, 0.0, 0.0, 0.0)
    curves = action_curves(moved, f"{name} response")
    key(curves, "location", way.positions / unit)
    key(curves, "rotation_quaternion", way.orientations)


def _draw_body(log, shown, moved, listed, touching, color, collection, unit) -> None:
    """Primitives that never touch become one mesh; each of the others is an object, so that it can light up."""
    quiet = [shape for number, shape in listed if number not in touching and shape.kind != "Plane"]
    if quiet:
        _child(moved, f"{moved.name} shape", *_joined(quiet), color, collection, unit)
    for number, shape in listed:
        if number not in touching and shape.kind != "Plane":
            continue
        child = _child(moved, shape.path, shape.vertices, shape.faces, color, collection, unit)
        child["pong_kind"] = shape.kind
        if shape.kind in ("Point", "Sphere", "Ellipsoid"):
            child.data.shade_smooth()
        if number in touching:
            lit = marks.touched(log, shown.film, number)
            colors = np.where(lit[:, None], (*marks.TOUCHED, max(color[3], 0.8)), color)
            key(action_curves(child, f"{shape.path} touch"), "color", colors, constant=True)


def _joined(listed) -> tuple[np.ndarray, list]:
    vertices, faces, first = [], [], 0
    for shape in listed:
        vertices.append(shape.vertices)
        faces += [tuple(int(i) + first for i in face) for face in shape.faces]
        first += len(shape.vertices)
    return np.concatenate(vertices), faces


def _child(parent, name, vertices, faces, color, collection, unit):
    child = _mesh_object(name, np.asarray(vertices) / unit, faces, color, collection)
    child.parent = parent
    return child


def _mesh_object(name, vertices, faces, color, collection, mesh=None):
    if mesh is None:
        mesh = bpy.data.meshes.new(name)
        mesh.from_pydata(np.asarray(vertices).tolist(), [], [tuple(int(i) for i in face) for face in faces])
        mesh.materials.append(_material())
    made = bpy.data.objects.new(name, mesh)
    made.color = color
    collection.objects.link(made)
    return made


def _material():
    """One material for all: the colour is the object's."""
    name = "Pong response"
    material = bpy.data.materials.get(name)
    if material is not None:
        return material
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    info = nodes.new("ShaderNodeObjectInfo")
    surface = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    surface.inputs["Roughness"].default_value = 0.6
    links.new(info.outputs["Color"], surface.inputs["Base Color"])
    links.new(info.outputs["Alpha"], surface.inputs["Alpha"])
    return material


# --- contacts -----------------------------------------------------------------------------------------------------


def _show_contacts(log, options, shown, extent, collection, unit) -> None:
    largest = marks.largest_force(log)
    length = options.arrow_length or 0.5 * extent
    shown.metres_per_newton = length / largest if largest > 0.0 else 0.0
    made = marks.slots(log, shown.film, shown.seen, options.most_contacts)
    if made.left_out:
        shown.notes.append(f"{made.left_out} contacts are not shown, those with the largest forces are; "
                           f"show more than {options.most_contacts} at once with --most-contacts")
    arrow_mesh = mark_mesh = None
    for slot in range(made.shown.shape[1]):
        arrow = _mesh_object(f"force {slot}", *marks.arrow(), FORCE, collection, arrow_mesh)
        mark = _mesh_object(f"contact {slot}", *shapes.ball(12, 6), marks.STICK, collection, mark_mesh)
        arrow_mesh, mark_mesh = arrow.data, mark.data
        # Forces point into the bodies they act on.
        arrow.show_in_front = mark.show_in_front = True
        _key_contact(arrow, mark, made, slot, shown.metres_per_newton, 0.018 * extent, unit)
        shown.arrows.append(arrow)
        shown.marks.append(mark)


def _key_contact(arrow, mark, made, slot, metres_per_newton, radius, unit) -> None:
    points, hidden = made.points[:, slot] / unit, ~made.shown[:, slot]
    arrow.rotation_mode = "QUATERNION"
    lengths = made.forces[:, slot] * metres_per_newton / unit
    # Thickness follows length only in part: small forces stay visible.
    widths = np.sqrt(lengths * lengths.max(initial=0.0))
    for item in (arrow, mark):
        curves = action_curves(item, f"{item.name} response")
        key(curves, "location", points, constant=True)
        key(curves, "hide_render", hidden, constant=True)
        key(curves, "hide_viewport", hidden, constant=True)
        if item is arrow:
            key(curves, "rotation_quaternion", made.turns[:, slot], constant=True)
            key(curves, "scale", np.stack([widths, widths, lengths], axis=1), constant=True)
        else:
            key(curves, "color", np.where(made.sticks[:, slot, None], marks.STICK, marks.SLIP), constant=True)
            item.scale = (radius / unit,) * 3

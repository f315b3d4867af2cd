# SPDX-License-Identifier: GPL-3.0-or-later
"""Moving bodies, and primitives highlighted while in contact."""

from __future__ import annotations

import bpy
import numpy as np

from . import graphics, marks, shapes
from .animate import action_curves, key
from .timeline import is_known, track

COLORS = (
    (0.55, 0.62, 0.72), (0.80, 0.74, 0.62), (0.50, 0.66, 0.58), (0.70, 0.58, 0.68), (0.62, 0.62, 0.62),
)
LIT_ALPHA = 0.75  # a primitive that touches is at least that opaque


def show_bodies(stage, shown) -> None:
    """Adds or adopts an object for each body and keys its motion."""
    log, names = stage.log, [body.name for body in stage.log.bodies]
    own = graphics.graphics_of(stage.scene, names, stage.options.graphics)
    shown.notes += graphics.strays(stage.scene, names)
    lit = marks.touched(log, shown.film)
    parts = [shapes.bodies_of(model) for model in stage.models]
    numbers = {(p.body, p.path): i for i, p in enumerate(log.primitives)}
    for number, body in enumerate(log.bodies):
        if not is_known(log, number):
            shown.notes.append(f"body `{body.name}` has no state in the log: it is not shown")
            continue
        item = own.get(body.name)
        shown.objects[body.name] = _moved(stage, shown, number, item)
        listed = [(lit.get(numbers.get((number, part[0]))), part) for part in parts[body.model].get(body.path, [])]
        drawn = [(touches, shapes.shape(*part, stage.sizes)) for touches, part in listed
                 if _is_drawn(stage.options.shapes, item is not None, touches is not None)]
        if drawn:
            _draw(stage, shown, number, item, drawn)


def _is_drawn(choice: str, has_graphics: bool, touches: bool) -> bool:
    if not has_graphics:
        return choice != "none"
    return choice == "all" or (choice == "touched" and touches)


def _moved(stage, shown, number, item):
    """The author's object, or an empty, in motion."""
    body = stage.log.bodies[number]
    if item is None:
        return _key_motion(stage, shown, number, _empty(stage, body.name), stage.anchors[number])
    driver = _key_motion(stage, shown, number, _empty(stage, f"{item.name} response"), np.zeros(3))
    graphics.lead(item, driver, None if item in stage.led else shown.notes)
    return item


def _empty(stage, name):
    empty = bpy.data.objects.new(name, None)
    empty.empty_display_type, empty.empty_display_size = "ARROWS", 5.0 * stage.sizes.point / stage.unit
    stage.collection.objects.link(empty)
    return empty


def _key_motion(stage, shown, number, item, anchor):
    way = track(stage.log, shown.film, number, shown.seen, anchor)
    item.rotation_mode = "QUATERNION"
    curves = action_curves(item, f"{stage.log.bodies[number].name} response")
    key(curves, "location", way.positions / stage.unit)
    key(curves, "rotation_quaternion", way.orientations)
    return item


def _draw(stage, shown, number, item, listed) -> None:
    """Merges primitives that never touch to one mesh; each of the others is an object, so that it can be highlighted."""
    frame, anchor = shown.objects[stage.log.bodies[number].name], stage.anchors[number]
    if item is not None:  # it may be scaled: shapes hang on an empty beside it
        frame = _key_motion(stage, shown, number, _empty(stage, f"{item.name} shapes"), anchor)
    color = (*COLORS[stage.log.run["bodies"][number]["object"] % len(COLORS)], stage.options.alpha)
    quiet = [shape for touches, shape in listed if touches is None and shape.kind != "Plane"]
    if quiet:
        _child(stage, frame, f"{frame.name} shape", *_joined(quiet), anchor, color)
    for touches, shape in listed:
        if touches is None and shape.kind != "Plane":
            continue
        child = _child(stage, frame, shape.path, shape.vertices, shape.faces, anchor, color)
        child["pong_kind"] = shape.kind
        if shape.kind in ("Point", "Sphere", "Ellipsoid", "Capsule"):
            child.data.shade_smooth()
        if touches is not None:
            _light_up(child, touches, color, only_then=item is not None and stage.options.shapes == "touched")


def _light_up(child, touches, color, only_then: bool) -> None:
    curves = action_curves(child, f"{child.name} touch")
    lit = (*marks.TOUCHED, max(color[3], LIT_ALPHA))
    key(curves, "color", np.where(touches[:, None], lit, color), constant=True)
    if only_then:
        key(curves, "hide_render", ~touches, constant=True)
        key(curves, "hide_viewport", ~touches, constant=True)
        child.show_in_front = True  # it lies in the skin of the graphics


def _joined(listed) -> tuple[np.ndarray, list]:
    vertices, faces, first = [], [], 0
    for shape in listed:
        vertices.append(shape.vertices)
        faces += [tuple(int(i) + first for i in face) for face in shape.faces]
        first += len(shape.vertices)
    return np.concatenate(vertices), faces


def _child(stage, parent, name, vertices, faces, anchor, color):
    child = mesh_object(stage, name, (np.asarray(vertices) - anchor) / stage.unit, faces, color)
    child.parent = parent
    return child


def mesh_object(stage, name, vertices, faces, color, mesh=None, see_through=True):
    """An object of a colour; of an existing or of a new mesh."""
    if mesh is None:
        mesh = bpy.data.meshes.new(name)
        mesh.from_pydata(np.asarray(vertices).tolist(), [], [tuple(int(i) for i in face) for face in faces])
        mesh.materials.append(_material("Pong response" if see_through else "Pong marks", see_through))
    made = bpy.data.objects.new(name, mesh)
    made.color = color
    stage.collection.objects.link(made)
    return made


def _material(name: str, see_through: bool):
    """One material for all bodies and one for all marks: the colour is the object's."""
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
    if see_through:
        links.new(info.outputs["Alpha"], surface.inputs["Alpha"])
        material.surface_render_method = "BLENDED"  # of EEVEE; the other one is grainy and hides arrows
        material.use_transparency_overlap = False
    return material

# SPDX-License-Identifier: GPL-3.0-or-later
"""Vertices, edges and faces of a part, stored as integer attributes of the mesh.

Attributes follow their elements when a mesh is edited, in and out of Edit Mode; indices would not. The names of the
attributes are kept with the object, because objects may share a mesh. Whole numbers, because Blender 4.2 gives no
access to truth values in Edit Mode.
"""

import re
import uuid

import bmesh
import numpy as np

PREFIX = "pong_"
NAME = re.compile(PREFIX + r"(\w+)_([0-9a-f]+)_([vef])")  # as new_attribute makes them, with the elements behind
INACTIVE = "inactive"  # stem of what marks inactive faces; other stems are kinds of parts
DOMAINS = {"vertices": "POINT", "edges": "EDGE", "faces": "FACE"}


def domain_of(kind):
    """Element domain of a kind."""
    return {"Point": "vertices", "LineSegment": "edges", "Ray": "edges"}.get(kind, "faces")


def new_attribute(stem):
    """An attribute name unique among the meshes of all files: joined meshes merge attributes of one name."""
    return f"{PREFIX}{stem}_{uuid.uuid4().hex[:12]}"


def attributes(mesh):
    """(name, elements, stem) of every attribute of the toolkit that a mesh has."""
    if mesh.is_editmode:
        edited = bmesh.from_edit_mesh(mesh)
        names = [name for sort in DOMAINS for name in _sequence(edited, sort).layers.int.keys()]
    else:
        names = mesh.attributes.keys()
    sorts = {sort[0]: sort for sort in DOMAINS}
    found = [(name, NAME.fullmatch(name)) for name in names]
    return [(f"{PREFIX}{is_ours[1]}_{is_ours[2]}", sorts[is_ours[3]], is_ours[1]) for _, is_ours in found if is_ours]


def _full_name(name, elements):
    """Unique names of attributes within a mesh, in all domains."""
    return f"{name}_{elements[0]}"


def indices(mesh, name, elements):
    """Indices of the marked elements of an attribute, as the mesh is stored (or being edited)."""
    full = _full_name(name, elements)
    if mesh.is_editmode:
        sequence = _sequence(bmesh.from_edit_mesh(mesh), elements)
        layer = sequence.layers.int.get(full)
        return [] if layer is None else [index for index, element in enumerate(sequence) if element[layer]]
    attribute = mesh.attributes.get(full)
    if attribute is None or attribute.domain != DOMAINS[elements] or not len(attribute.data):
        return []
    values = np.empty(len(attribute.data), np.int32)
    attribute.data.foreach_get("value", values)
    return np.flatnonzero(values).tolist()


def mark(mesh, name, elements, chosen, value=1):
    """Sets an attribute of the elements with these indices; the others keep theirs."""
    full = _full_name(name, elements)
    if mesh.is_editmode:
        _mark_edited(mesh, full, elements, chosen, value)
        return
    attribute = mesh.attributes.get(full) or mesh.attributes.new(full, "INT", DOMAINS[elements])
    values = np.zeros(len(attribute.data), np.int32)
    attribute.data.foreach_get("value", values)
    values[list(chosen)] = value
    attribute.data.foreach_set("value", values)


def _mark_edited(mesh, full, elements, chosen, value):
    edited = bmesh.from_edit_mesh(mesh)
    sequence = _sequence(edited, elements)
    layer = sequence.layers.int.get(full) or sequence.layers.int.new(full)
    sequence.ensure_lookup_table()
    for index in chosen:
        sequence[index][layer] = value
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)


def forget(mesh, name):
    """Removes the attributes of a part."""
    for elements in DOMAINS:
        full = _full_name(name, elements)
        if mesh.is_editmode:
            sequence = _sequence(bmesh.from_edit_mesh(mesh), elements)
            layer = sequence.layers.int.get(full)
            if layer is not None:
                sequence.layers.int.remove(layer)
        elif full in mesh.attributes:
            mesh.attributes.remove(mesh.attributes[full])


def _sequence(edited, elements):
    return {"vertices": edited.verts, "edges": edited.edges, "faces": edited.faces}[elements]


def selected(mesh, elements):
    """Indices of the selected elements, in and out of Edit Mode."""
    if mesh.is_editmode:
        sequence = _sequence(bmesh.from_edit_mesh(mesh), elements)
        return [index for index, element in enumerate(sequence) if element.select and not element.hide]
    sequence = {"vertices": mesh.vertices, "edges": mesh.edges, "faces": mesh.polygons}[elements]
    values = np.empty(len(sequence), bool)
    sequence.foreach_get("select", values)
    return np.flatnonzero(values).tolist()


def select(mesh, chosen):
    """Selects elements of an edited mesh and nothing else; `chosen`: {"vertices": indices, ...}."""
    edited = bmesh.from_edit_mesh(mesh)
    for sequence in (edited.faces, edited.edges, edited.verts):
        sequence.ensure_lookup_table()
        for element in sequence:
            element.select = False
    for elements, numbers in chosen.items():
        sequence = _sequence(edited, elements)
        for index in numbers:
            if index < len(sequence):
                sequence[index].select_set(True)
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)

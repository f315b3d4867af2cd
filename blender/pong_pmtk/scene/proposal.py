# SPDX-License-Identifier: GPL-3.0-or-later
"""Proposed kind and size of a primitive for an object or a selection. The author decides."""

from ..core.engine import WheelMissing
from ..core.marks import Mark
from ..core.propose import Proposal, fit_ellipsoid, fit_sphere, propose
from ..core.round_pieces import bodies_shown
from ..core.round_shape import ROUND_KINDS, fault_of, fitted_numbers, numbers_of, shown_number
from ..core.snapshot import SnapshotObject
from ..store import exact
from . import extract, meshes

OF_EMPTIES = {"SPHERE": "Sphere", "SINGLE_ARROW": "Ray", "CIRCLE": "Plane"}


def of_object(context, obj):
    """Proposed kind of an object; "" with the reason if there is none."""
    if obj.type == "EMPTY" and obj.empty_display_type in OF_EMPTIES:
        return Proposal(OF_EMPTIES[obj.empty_display_type], "an empty that is shown like this")
    mesh = _shown_mesh(context, obj)
    try:
        found = propose(SnapshotObject(obj.name, obj.type, mark=Mark(), mesh=mesh, exact=exact.read(obj)))
    except WheelMissing as missing:
        return Proposal("", str(missing))
    if found:
        return found[0]
    if obj.type != "MESH":
        return Proposal("", f"it is a {obj.type.lower()}: convert it to a mesh first")
    return Proposal("", "it has no vertices" if mesh else "it is hidden, so its modifiers are not worked out: show it")


def _shown_mesh(context, obj):
    """The mesh that would be exported: after its modifiers. None if none is visible."""
    if obj.type != "MESH":
        return None
    if obj.mode == "EDIT":
        obj.update_from_editmode()
    depsgraph = context.evaluated_depsgraph_get()
    if extract.modifiers(obj) and not obj.evaluated_get(depsgraph).is_evaluated:
        return None
    return extract.Reader(depsgraph, context.view_layer).meshes(obj)[0]


def shown_vertices(context, obj, kind):
    """Vertices of the displayed body: of the first one where the mesh shows several. None for hidden objects."""
    mesh = _shown_mesh(context, obj)
    if mesh is None:
        return None
    facts = SnapshotObject(obj.name, obj.type, mesh=mesh, stored_mesh=meshes.read(obj.data))
    pieces = bodies_shown(facts, kind)
    return mesh.vertices[pieces[0]] if pieces else mesh.vertices


def fault(context, obj, kind):
    """Reason why the mesh of an object gives a round part no size; "" if it does."""
    vertices = shown_vertices(context, obj, kind) if obj.type == "MESH" and kind in ROUND_KINDS else None
    return fault_of(vertices, kind) if vertices is not None else ""


def of_elements(select_mode):
    """Kind that suits the selection in Edit Mode: vertices, edges or faces."""
    vertices, edges, _faces = select_mode
    return "Point" if vertices else "LineSegment" if edges else "TriangleMesh"


def sizes(context, obj, kind):
    """Numbers of a mark of some kind from the object's appearance, in its own coordinates."""
    if kind in ROUND_KINDS:
        return _round_sizes(context, obj, kind)
    if kind not in ("Sphere", "Ellipsoid", "Ray"):
        return {}
    if obj.type == "MESH" and kind != "Ray":
        vertices = shown_vertices(context, obj, kind)
        return _fitted(vertices, kind) if vertices is not None else {}
    size = float(f"{obj.empty_display_size:.7g}") if obj.type == "EMPTY" else 1.0
    return {"Sphere": {"radius": size}, "Ellipsoid": {"semi_axes": (size,) * 3}, "Ray": {"length": size}}[kind]


def _round_sizes(context, obj, kind):
    """Sizes of its mesh; an empty is shown with half its length, and starts half as thick as it is long."""
    if obj.type == "MESH":
        vertices = shown_vertices(context, obj, kind)
        return fitted_numbers(vertices, kind) if vertices is not None else {}
    size = float(f"{obj.empty_display_size:.7g}") if obj.type == "EMPTY" else 1.0
    return numbers_of(kind, 2.0 * size, (size / 2.0,) * 2)


def _fitted(vertices, kind):
    if not len(vertices):
        return {}
    if kind == "Sphere":
        return {"radius": fit_sphere(vertices)}
    fitted = fit_ellipsoid(vertices)
    axes = fitted[1] if fitted is not None else abs(vertices).max(axis=0)
    return {"semi_axes": tuple(map(shown_number, axes.tolist()))}

# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts: some vertices, edges or faces of a mesh as primitives of one kind, with or without the rest."""

from __future__ import annotations

import numpy as np

from .marks import Part
from .shape import Place, Shape, ready
from .snapshot import Mesh

# Elements that each kind takes from a part.
ELEMENTS = {
    "Point": "vertices",
    "LineSegment": "edges",
    "Ray": "edges",
    "Plane": "faces",
    "Triangle": "faces",
    "TriangleMesh": "faces",
    "Polyhedron": "faces",
}


def part_shapes(place: Place, mesh: Mesh | None, evaluated: bool, surface: str | None) -> list[Shape]:
    """One shape for each valid part of an object."""
    mark = place.thing.mark
    if mesh is None:
        place.findings.error("needs-mesh", place.where, "an empty has no parts", "mark a mesh")
        return []
    if evaluated:
        cause = f"its parts name elements that its modifiers change: {', '.join(place.thing.modifiers)}"
        place.findings.error("parts-and-modifiers", place.where, cause, "apply the modifiers, then mark the parts anew")
        return []
    shapes = [_shape(place, mesh, part, surface) for part in mark.parts]
    return [shape for shape in shapes if shape is not None]


def _shape(place: Place, mesh: Mesh, part: Part, surface: str | None) -> Shape | None:
    shape = Shape(place, part.name, part.kind, part.surface or surface, mesh, False, part=part)
    elements = ELEMENTS.get(part.kind)
    if elements is None:
        cause = f'a part cannot be of the kind "{part.kind}"'
        shape.error("part-kind", cause, f"choose from: {', '.join(ELEMENTS)}")
        return None
    chosen = getattr(part, elements)
    if not chosen:
        cause = f"a part of the kind {part.kind} without {elements}"
        shape.error("empty-part", cause, f"select {elements} and assign them to it")
        return None
    others = [name for name in ("vertices", "edges", "faces") if name != elements and getattr(part, name)]
    if others:
        cause = f"a part of the kind {part.kind} takes {elements} alone, not {others[0]}"
        shape.error("part-elements", cause, f"assign {elements} only")
        return None
    count = {"vertices": len(mesh.vertices), "edges": len(mesh.edges), "faces": len(mesh.face_starts) - 1}[elements]
    if min(chosen) < 0 or max(chosen) >= count:
        cause = f"it names {elements} that the mesh no longer has: there are {count}"
        shape.error("part-out-of-range", cause, f"select its {elements} and assign them again")
        return None
    if len(np.unique(chosen)) != len(chosen):
        shape.error("part-repeats", f"it names some of its {elements} twice", f"assign its {elements} again")
        return None
    return shape if ready(shape) else None

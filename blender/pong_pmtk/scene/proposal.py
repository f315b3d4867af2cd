# SPDX-License-Identifier: GPL-3.0-or-later
"""What kind of primitive an object or a selection looks like, and of what size. The author decides."""

from dataclasses import dataclass

import numpy as np

from ..core.build import build
from ..core.marks import Mark, ModelSettings
from ..core.snapshot import Snapshot, SnapshotObject
from . import meshes

OF_EMPTIES = {"SPHERE": "Sphere", "SINGLE_ARROW": "Ray", "CIRCLE": "Plane", "CUBE": "Ellipsoid"}
ROUND = 1e-3  # vertices as far from the middle as this share count as on one ball
ROUND_VERTICES = 20  # a cube's corners are on a ball too
TRIED = 100_000  # faces; larger meshes are terrain, and trying them takes long


@dataclass
class Proposal:
    kind: str  # "" for none
    reason: str


def of_object(obj):
    """The kind an object looks like."""
    if obj.type == "EMPTY":
        return Proposal(OF_EMPTIES.get(obj.empty_display_type, "Point"), "an empty that is shown like this")
    if obj.type != "MESH":
        return Proposal("", f"it is a {obj.type.lower()}: convert it to a mesh first")
    mesh = meshes.read(obj.data)
    if not len(mesh.vertices):
        return Proposal("", "it has no vertices")
    if len(mesh.face_starts) == 1:
        if len(mesh.edges):
            return Proposal("LineSegment", "it has edges and no faces")
        return Proposal("Point", "it has vertices alone")
    if _is_ball(mesh.vertices):
        return Proposal("Sphere", "all vertices are as far from the origin")
    if len(mesh.face_starts) <= TRIED and _builds(mesh, "Polyhedron"):
        return Proposal("Polyhedron", "it is closed and convex")
    return Proposal("TriangleMesh", "it has faces and is no convex solid")


def _is_ball(vertices):
    distance = np.linalg.norm(vertices, axis=1)
    return len(vertices) >= ROUND_VERTICES and np.ptp(distance) <= ROUND * distance.max()


def _builds(mesh, kind):
    """Whether a mesh is a primitive of a kind without error: the core itself is asked."""
    settings = ModelSettings(surfaces={"any": {"stiffness": 1.0}})
    root = SnapshotObject("root", "EMPTY", mark=Mark("root", surface="any"), settings=settings)
    thing = SnapshotObject("thing", "MESH", "root", mark=Mark("primitive", kind=kind), mesh=mesh)
    return build(Snapshot([root, thing])).model is not None


def of_elements(select_mode):
    """The kind that suits what Edit Mode selects: vertices, edges or faces."""
    vertices, edges, _faces = select_mode
    return "Point" if vertices else "LineSegment" if edges else "TriangleMesh"


def sizes(obj, kind):
    """The numbers of a mark of some kind that follow from how the object looks, in its own coordinates."""
    if kind not in ("Sphere", "Ellipsoid", "Ray"):
        return {}
    if obj.type == "MESH" and kind != "Ray":
        vertices = meshes.read(obj.data).vertices
        if not len(vertices):
            return {}
        if kind == "Sphere":
            return {"radius": float(f"{np.linalg.norm(vertices, axis=1).max():.7g}")}
        return {"semi_axes": tuple(float(f"{reach:.7g}") for reach in np.abs(vertices).max(axis=0))}
    size = float(f"{obj.empty_display_size:.7g}") if obj.type == "EMPTY" else 1.0
    return {"Sphere": {"radius": size}, "Ellipsoid": {"semi_axes": (size,) * 3}, "Ray": {"length": size}}[kind]

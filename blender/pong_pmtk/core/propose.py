# SPDX-License-Identifier: GPL-3.0-or-later
"""Proposes kinds for a mesh, from its shape. The author decides: nothing here is applied automatically."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .engine import PLANE_TOLERANCE, polyhedron_faults
from .exact import meant_rows
from .pieces import is_closed, pieces_of
from .polygon import off_plane
from .round_shape import FIT_TOLERANCE, ROUND_KINDS, fit, fitted_numbers, off, radii_of, shown_number, widest_gap
from .snapshot import Mesh, SnapshotObject

ROUND_VERTICES = 26  # fewer are a solid with corners: an icosahedron has 12
ROUND_SIDES = 12  # fewer are a prism or a pyramid that is meant so
ROUND_DEPTH = 0.9  # the middle of every face of a round mesh lies this near to the surface
CENTER_TOLERANCE = 1e-4  # of the size
CHECKED_FACES = 5000  # larger meshes are surfaces: nobody wants them as one convex solid


@dataclass
class Proposal:
    """A kind, its fields of the mark, and the reason."""

    kind: str
    reason: str
    fields: dict = field(default_factory=dict)
    fix: str = ""  # what must be done first: see finding.FIXES


def propose(thing: SnapshotObject) -> list[Proposal]:
    """Possible kinds of an object, the likeliest first; empty for what cannot be a primitive."""
    if thing.mesh is None:
        return [Proposal("Point", "an empty: its origin")] if thing.type == "EMPTY" else []
    vertices = meant_rows(thing.mesh.vertices, thing.exact.get("vertices"))
    return propose_mesh(vertices, thing.mesh)


def propose_mesh(vertices: np.ndarray, mesh: Mesh) -> list[Proposal]:
    count = len(mesh.face_starts) - 1
    if not len(vertices):
        return []
    if count <= 0:
        return _without_faces(vertices, mesh)
    faces = np.split(np.asarray(mesh.loops), np.asarray(mesh.face_starts)[1:-1])
    if count == 1:
        return _one_face(vertices, faces[0])
    found = []
    if count <= CHECKED_FACES and is_closed(faces):
        found = [*_round(vertices, faces), *_solid(vertices, faces)]
        found += _round_parts(vertices, faces) if found else []
    return [*found, _surface(faces, bool(found))]


def _without_faces(vertices: np.ndarray, mesh: Mesh) -> list[Proposal]:
    if len(mesh.edges):
        reason = f"{len(mesh.edges)} edges and no faces"
        return [Proposal("LineSegment", reason), Proposal("Ray", reason + ": each from its first vertex to its second")]
    if len(vertices) == 1:
        return [Proposal("Point", "a single vertex")]
    return [Proposal("Point", f"{len(vertices)} vertices without edges")]


def _one_face(vertices: np.ndarray, face: np.ndarray) -> list[Proposal]:
    corners = vertices[face]
    if len(face) == 3:
        return [Proposal("Triangle", "a single triangle"), Proposal("TriangleMesh", "a surface of one triangle")]
    sheet = Proposal("TriangleMesh", f"a single face of {len(face)} corners: a sheet that ends at its rim")
    if off_plane(corners) > PLANE_TOLERANCE * float(np.ptp(corners, axis=0).max()):
        return [sheet]
    return [Proposal("Plane", "a single planar face: all behind it is solid, without end"), sheet]


def _round(vertices: np.ndarray, faces: list[np.ndarray]) -> list[Proposal]:
    """Spheres and ellipsoids with axes along those of the object."""
    middles = np.array([vertices[face].mean(axis=0) for face in faces])
    fitted = round_fit(vertices, middles, ROUND_DEPTH) if len(vertices) >= ROUND_VERTICES else None
    if fitted is None:
        return []
    center, axes, _ = fitted
    size = float(axes.max())
    away = bool(np.sqrt(center @ center) > CENTER_TOLERANCE * size)
    note = "; its origin is not its centre and must be set there first" if away else ""
    fix = "set-origin" if away else ""
    if np.ptp(axes) <= FIT_TOLERANCE * size:
        radius = fit_sphere(vertices)
        reason = f"its vertices lie on a sphere of radius {radius:.6g}{note}"
        return [Proposal("Sphere", reason, {"radius": radius}, fix)]
    shown = ", ".join(f"{a:.6g}" for a in axes)
    semi_axes = tuple(map(shown_number, axes.tolist()))
    reason = f"its vertices lie on an ellipsoid of semi-axes {shown}{note}"
    return [Proposal("Ellipsoid", reason, {"semi_axes": semi_axes}, fix)]


def _round_parts(vertices: np.ndarray, faces: list[np.ndarray]) -> list[Proposal]:
    """The simplest round part around the z axis of the object that matches a closed mesh."""
    for kind in ROUND_KINDS[:3]:
        numbers, found = fitted_numbers(vertices, kind), fit(vertices, kind)
        if "length" not in numbers or found is None or not _is_round(vertices, faces, kind, numbers):
            continue
        middle = abs(found[2]) > CENTER_TOLERANCE * numbers["length"]
        note = "; its origin is not its middle and must be set there first" if middle else ""
        radii = radii_of(kind, numbers)
        shown = f"radius {radii[0]:.6g}" if "radius" in numbers else f"radii {radii[0]:.6g} and {radii[1]:.6g}"
        reason = f"its vertices lie on a {kind} of {shown}, {numbers['length']:.6g} long{note}"
        return [Proposal(kind, reason, numbers, "set-origin" if middle else "")]
    return []


def _is_round(vertices: np.ndarray, faces: list[np.ndarray], kind: str, numbers: dict) -> bool:
    """True if the vertices lie on the part, with enough of them around it that its corners are an approximation."""
    length, radii = numbers["length"], radii_of(kind, numbers)
    size = max(length, 2.0 * max(radii))
    centered = vertices - np.array([0.0, 0.0, fit(vertices, kind)[2]])
    tapered = np.ptp(fit(vertices, kind)[1]) > FIT_TOLERANCE * size and kind != "Cone"
    if tapered or off(centered, kind, length, radii) > FIT_TOLERANCE * size:
        return False
    return around_axis(centered, radii)


def around_axis(own: np.ndarray, radii: tuple[float, float]) -> bool:
    """True if vertices surround the z axis, at the wider end of a part, as densely as those of a round mesh."""
    return widest_gap(own, radii) <= 2.0 * np.pi / (ROUND_SIDES - 0.5)


def fit_ellipsoid(points: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
    """Centre and semi-axes, along the coordinate axes, of the best-fit ellipsoid; `None` if there is none."""
    low, high = points.min(axis=0), points.max(axis=0)
    size = float((high - low).max())
    if not size > 0.0 or len(points) < 6:
        return None
    middle = (low + high) / 2.0
    p = (points - middle) / size
    solution, _, rank, _ = np.linalg.lstsq(np.hstack([p * p, p]), np.ones(len(p)), rcond=None)
    squares, slopes = solution[:3], solution[3:]
    if rank < 6 or not (squares > 0.0).all():
        return None
    center = -slopes / (2.0 * squares)
    level = 1.0 + (squares * center * center).sum()
    return middle + size * center, size * np.sqrt(level / squares)


def round_fit(points: np.ndarray, middles: np.ndarray, depth: float) -> tuple[np.ndarray, np.ndarray, float] | None:
    """Centre, semi-axes, and largest relative error of any point; `None` for a shape that is not round.

    The middles of faces must come as near to the surface as `depth`: the corners of a prism lie on an ellipsoid too.
    """
    fitted = fit_ellipsoid(points)
    if fitted is None:
        return None
    center, axes = fitted
    off = float(np.abs(np.sqrt((((points - center) / axes) ** 2).sum(axis=1)) - 1.0).max())
    deepest = np.sqrt((((middles - center) / axes) ** 2).sum(axis=1)).min() if len(middles) else 1.0
    return (center, axes, off) if off <= FIT_TOLERANCE and deepest >= depth else None


def fit_sphere(points: np.ndarray) -> float:
    """Radius of the best-fit sphere to seven digits, the accuracy of 32 bits."""
    center = (points.min(axis=0) + points.max(axis=0)) / 2.0
    fitted = fit_ellipsoid(points)
    if fitted is not None:
        center = fitted[0]
    return shown_number(float(np.sqrt(((points - center) ** 2).sum(axis=1)).mean()))


def _solid(vertices: np.ndarray, faces: list[np.ndarray]) -> list[Proposal]:
    pieces = pieces_of(vertices, faces)
    for piece in pieces:
        own = [faces[i] for i in piece]
        problems = polyhedron_faults(vertices, own)
        if problems and problems[0]["rule"] == "inside-out":
            return [
                Proposal("Polyhedron", "closed and convex, but its normals point inward", fix="recalculate-normals")
            ]
        if problems:
            return []
    if len(pieces) == 1:
        return [Proposal("Polyhedron", f"closed and convex, {len(faces)} faces")]
    return [Proposal("Polyhedron", f"{len(pieces)} pieces, each closed and convex")]


def _surface(faces: list[np.ndarray], convex: bool) -> Proposal:
    if convex:
        return Proposal("TriangleMesh", "a surface, if only its outside matters")
    if is_closed(faces):
        return Proposal("TriangleMesh", "closed but not convex: a surface, or cut it into convex pieces")
    return Proposal("TriangleMesh", "an open surface")

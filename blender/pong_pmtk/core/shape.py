# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects where they are placed, and their meshes as shapes of a kind, in metres in the frame of their group."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .exact import meant, meant_rows, without_rounding
from .marks import Mark, Part
from .model import Primitive
from .scene import Scene
from .snapshot import Mesh, SnapshotObject
from .transforms import Affine, Local

SHAPES_OF_MESH = ("LineSegment", "Triangle", "TriangleMesh", "Polyhedron")


@dataclass
class Origin:
    """Source of a primitive: its object, and for each triangle the face of the mesh."""

    object: str
    path: str
    evaluated: bool = False
    faces: np.ndarray | None = None


@dataclass
class Place:
    """Placement of an object in the frame of its group."""

    scene: Scene
    thing: SnapshotObject
    affine: Affine
    local: Local | None  # its own transform, where that is all there is
    scaled_parent: str

    @property
    def where(self) -> tuple[str, str]:
        return self.scene.where(self.thing)

    @property
    def findings(self):
        return self.scene.findings

    @property
    def mirrored(self) -> bool:
        return bool(np.linalg.det(self.affine.linear) < 0.0)

    def points(self, points) -> np.ndarray:
        return np.asarray(self.scene.metres(carried(self.affine, points)))

    def origin(self) -> tuple[float, ...]:
        return tuple(np.asarray(self.scene.metres(origin_of(self.affine, self.local))).tolist())

    def number(self, name: str):
        """A number of the mark in full precision and metres; `None` stays."""
        value = getattr(self.thing.mark, name)
        return None if value is None else self.scene.metres(meant(value, self.thing.exact.get(name)))

    def unmoved(self, name: str):
        """An exact number that depends on the object's placement, if the object is unmoved otherwise."""
        plain = self.local is not None and self.local.fresh and (self.local.scale == 1.0).all()
        return self.thing.exact.get(name) if plain and self.scene.metres_per_unit == 1.0 else None


def carried(affine: Affine, points) -> np.ndarray:
    """Points under a transform, without rounding of sums where decimals were typed."""
    made = affine.points(points)
    if affine.is_identity() or not made.size:
        return made
    size = np.abs(affine.linear).max() * np.abs(points).max() + np.abs(affine.offset).max()
    return without_rounding(made, float(size))


def origin_of(affine: Affine, local: Local | None) -> np.ndarray:
    """Position of an object: the typed number, if only its own transform contributes."""
    return affine.offset if local is not None else without_rounding(affine.offset, float(np.abs(affine.offset).max()))


@dataclass
class Shape:
    """Mesh of a placement, or its part in use: vertices in metres in the group's frame."""

    place: Place
    name: str
    kind: str
    surface: str | None
    mesh: Mesh | None
    evaluated: bool  # the mesh is not the stored one: its indices cannot be selected
    vertices: np.ndarray = field(default_factory=lambda: np.zeros((0, 3)))
    noise: float = 0.0  # of 32-bit rounding, m
    part: Part | None = None

    @property
    def mark(self) -> Mark:
        return self.place.thing.mark

    @property
    def findings(self):
        return self.place.findings

    def error(self, rule: str, cause: str, cure: str, **more) -> None:
        self.findings.error(rule, self.where, cause, cure, evaluated=self.evaluated, **more)

    def warn(self, rule: str, cause: str, cure: str, **more) -> None:
        self.findings.warn(rule, self.where, cause, cure, evaluated=self.evaluated, **more)

    @property
    def where(self) -> tuple[str, str]:
        name, path = self.place.where
        return (name, f"{path}/{self.part.name}") if self.part else (name, path)

    def origin(self, faces=None) -> Origin:
        return Origin(self.place.thing.name, self.where[1], self.evaluated, faces)

    def numbered(self, kind: str, each: list[dict], faces=None) -> list[tuple[Primitive, Origin]]:
        """One primitive for each set of fields, numbered if there are several."""
        made = []
        for index, fields in enumerate(each):
            name = self.name if len(each) == 1 else f"{self.name}_{index}"
            face = None if faces is None else np.asarray(faces[index]).reshape(-1)
            made.append((Primitive(kind, name, fields, self.surface), self.origin(face)))
        return made


def ready(shape: Shape) -> bool:
    """Checks the mesh as data and transforms its vertices to the frame of the group."""
    mesh = shape.mesh
    if mesh is None:
        if shape.kind in SHAPES_OF_MESH:
            cause = f"a {shape.kind} needs a mesh, and this is an empty"
            shape.error("needs-mesh", cause, "mark a mesh, or choose another kind")
            return False
        return True
    stored = np.asarray(mesh.vertices, dtype=np.float64).reshape(-1, 3)
    bad = np.flatnonzero(~np.isfinite(stored).all(axis=1))
    if len(bad):
        shape.error("not-finite", f"{len(bad)} vertices are not finite", "delete them", vertices=bad)
        return False
    if not _indices_hold(shape, mesh, len(stored)):
        return False
    exact = shape.place.thing.exact.get("vertices")
    full = meant_rows(stored, exact)
    shape.vertices = shape.place.points(full)
    singles = exact is None and len(stored)
    shape.noise = float(4 * 2.0**-23 * np.abs(shape.vertices).max()) if singles else 0.0
    return True


def _indices_hold(shape: Shape, mesh: Mesh, count: int) -> bool:
    starts, loops = np.asarray(mesh.face_starts), np.asarray(mesh.loops)
    whole = len(starts) > 0 and starts[0] == 0 and starts[-1] == len(loops) and (np.diff(starts) >= 0).all()
    for indices in (loops, np.asarray(mesh.edges).ravel()):
        whole = whole and (len(indices) == 0 or (indices.min() >= 0 and indices.max() < count))
    if not whole:
        shape.error(
            "index-out-of-range", "its mesh names vertices that it has not", "validate the mesh, or make it anew"
        )
        return False
    widths = np.diff(starts)
    few = np.flatnonzero(widths < 3)
    face = np.repeat(np.arange(len(widths)), widths)
    pairs = np.unique(face * np.int64(count + 1) + loops) if len(loops) else loops
    if len(few):
        shape.error("too-few-vertices", "a face of fewer than three vertices", "delete it", faces=few)
    elif len(pairs) != len(loops):
        doubled = np.flatnonzero(np.bincount((pairs // (count + 1)).astype(int), minlength=len(widths)) != widths)
        cure = "clean the mesh up (Mesh > Clean Up > Degenerate Dissolve)"
        shape.error("repeated-index", "a face names a vertex twice", cure, faces=doubled, fix="dissolve-degenerate")
    return not len(few) and len(pairs) == len(loops)


def thickness_of(shape: Shape) -> dict:
    """The thickness of a mark, if it is given."""
    options = {}
    thickness = shape.place.number("thickness")
    if thickness is not None:
        options["thickness"] = float(thickness)
        if not (np.isfinite(options["thickness"]) and options["thickness"] > 0.0):
            cause = f"its thickness is {options['thickness']}"
            shape.error("thickness", cause, "it is above zero; leave it out for the default")
    return options

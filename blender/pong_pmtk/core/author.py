# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes written in Python, without Blender: build scripts and tests.

    scene = Scene("tripod", surfaces={"foot": {"stiffness": 1e5}}, surface="foot")
    leg = scene.group("leg", location=(0.0, 0.0, 0.3))
    scene.primitive("tip", "Point", above=leg, location=(0.5, 0.0, -0.3))
    scene.mesh("block", "Polyhedron", box((0.1, 0.2, 0.3)), above=leg)
    built = build(scene.snapshot())

Keyword arguments are fields of `Mark`, `Transform` or `SnapshotObject`, by name.
"""

from __future__ import annotations

import dataclasses
import math

import numpy as np

from .canonical import flattened
from .marks import Mark, ModelSettings
from .snapshot import Mesh, Snapshot, SnapshotObject, Transform
from .unbuild import edges_of

_MARK = {field.name for field in dataclasses.fields(Mark)} - {"name"}
_TRANSFORM = {field.name for field in dataclasses.fields(Transform)}
_OBJECT = {field.name for field in dataclasses.fields(SnapshotObject)}


class Scene:
    """A scene under construction; `root` is its root."""

    def __init__(self, name: str, surfaces: dict | None = None, pairs: list | None = None, **more):
        self.objects: list[SnapshotObject] = []
        self.root = self.empty(name, "root", above=None, **more)
        self.root.settings = ModelSettings(surfaces=surfaces or {}, pairs=pairs or [])

    def snapshot(self, **more) -> Snapshot:
        return Snapshot(self.objects, **more)

    def empty(self, name: str, role: str, above: SnapshotObject | None, **more) -> SnapshotObject:
        thing = SnapshotObject(name, "EMPTY", above.name if above else None, mark=Mark(role))
        self.objects.append(thing)
        return changed(thing, **more)

    def group(self, name: str, above: SnapshotObject | None = None, **more) -> SnapshotObject:
        return self.empty(name, "group", above or self.root, **more)

    def primitive(self, name: str, kind: str, above: SnapshotObject | None = None, **more) -> SnapshotObject:
        """A primitive that is an empty."""
        return self.empty(name, "primitive", above or self.root, kind=kind, **more)

    def mesh(self, name: str, kind: str, mesh: Mesh, above: SnapshotObject | None = None, **more) -> SnapshotObject:
        return self.empty(name, "primitive", above or self.root, kind=kind, mesh=mesh, type="MESH", **more)


def changed(thing: SnapshotObject, **more) -> SnapshotObject:
    """Sets fields of an object, of its mark or of its transform; returns the object."""
    for name, value in more.items():
        owner = thing.mark if name in _MARK else thing.transform if name in _TRANSFORM else thing
        if name not in _MARK | _TRANSFORM | _OBJECT:
            raise TypeError(f"neither an object nor its mark nor its transform has a field `{name}`")
        setattr(owner, name, value)
    return thing


# --- meshes --------------------------------------------------------------------------------------------------------


def mesh(vertices, faces=(), edges=None) -> Mesh:
    """A mesh from lists; edges are those of the faces unless they are given."""
    loops, widths = flattened(list(map(np.asarray, faces)))
    starts = np.concatenate([[0], np.cumsum(widths)]).astype(np.int64)
    own = edges_of(loops, starts) if edges is None else np.asarray(edges, dtype=np.int64).reshape(-1, 2)
    return Mesh(np.asarray(vertices, dtype=np.float64).reshape(-1, 3), own, loops, starts)


def box(size, center=(0.0, 0.0, 0.0)) -> Mesh:
    """A box of edge lengths `size`."""
    signs = np.array([[x, y, z] for z in (-0.5, 0.5) for y in (-0.5, 0.5) for x in (-0.5, 0.5)])
    faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
    return mesh(signs * np.asarray(size) + np.asarray(center), faces)


def prism(outline, low: float, high: float) -> Mesh:
    """The solid over a convex outline (x, y), counter-clockwise, from z = low to high."""
    flat = [tuple(map(float, p)) for p in outline]
    count = len(flat)
    vertices = [(x, y, low) for x, y in flat] + [(x, y, high) for x, y in flat]
    sides = [[i, (i + 1) % count, count + (i + 1) % count, count + i] for i in range(count)]
    return mesh(vertices, [list(range(count))[::-1], list(range(count, 2 * count)), *sides])


def cylinder(radius: float, low: float, high: float, sides: int) -> Mesh:
    """A prism over a regular polygon whose corners lie on the circle, the first one on the x axis."""
    turn = [2.0 * math.pi * i / sides for i in range(sides)]
    return prism([(round(radius * math.cos(a), 12), round(radius * math.sin(a), 12)) for a in turn], low, high)


def grid(x, y, height) -> Mesh:
    """A surface of quads over the points x × y (rising), its front up; `height(x, y)` gives z."""
    x, y = np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64)
    vertices = [(a, b, height(a, b)) for b in y.tolist() for a in x.tolist()]
    n = len(x)
    faces = [
        [j * n + i, j * n + i + 1, (j + 1) * n + i + 1, (j + 1) * n + i]
        for j in range(len(y) - 1)
        for i in range(n - 1)
    ]
    return mesh(vertices, faces)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Model -> Snapshot: the scene whose export gives the model again, byte for byte.

Every group is an empty, every primitive an object of its own: points, rays, spheres, ellipsoids, planes, round parts
and custom primitives are empties, the others meshes. What single precision cannot hold is kept beside it (`exact`).
"""

from __future__ import annotations

import math

import numpy as np

from . import mesh_file, transforms
from .canonical import canonical, flattened
from .exact import needed
from .marks import Mark, ModelSettings
from .model import Group, Model, Primitive
from .naming import UniqueNames, natural
from .snapshot import Mesh, Snapshot, SnapshotObject, Transform


def unbuild(model: Model, folder=None, reserved: set[str] = frozenset()) -> Snapshot:
    """Scene of a model. `folder`: location of its mesh files; `reserved`: names of existing objects.

    Raises `mesh_file.MeshFileError` if a mesh file is of no use.
    """
    model = canonical(model)
    scene = _Scene(folder, reserved)
    root = scene.group(model.root, None, 0, "root")
    root.settings = ModelSettings(
        model.name if model.name != model.root.name else "",
        model.entry_memory,
        model.surfaces,
        model.pairs,
        model.filters,
    )
    return Snapshot(scene.objects)


class _Scene:
    def __init__(self, folder, reserved):
        self.folder, self.names, self.objects = folder, UniqueNames(), []
        self.names.taken |= set(reserved)

    def add(self, name: str, kind: str, parent: str | None, mark: Mark) -> SnapshotObject:
        own = self.names.take(name)
        mark.name = name if own != name else ""
        thing = SnapshotObject(own, kind, parent, mark=mark)
        self.objects.append(thing)
        return thing

    def group(self, group: Group, parent: str | None, order: int, role: str) -> SnapshotObject:
        mark = Mark(role, surface=group.surface or "", order=order, movable=group.movable)
        if group.bound and group.bound.startswith("Custom:"):
            mark.custom_bound = group.bound[7:]
        elif group.bound:
            mark.bound = group.bound
        mark.leaf_size, mark.contact = group.leaf_size or 0, group.contact or "Default"
        thing = self.add(group.name, "EMPTY", parent, mark)
        _place(thing, group.position, group.orientation)
        for place, below in ordered(group.groups):
            self.group(below, thing.name, place, "group")
        for place, below in ordered(group.primitives):
            self.primitive(below, thing.name, place)
        return thing

    def primitive(self, primitive: Primitive, parent: str, order: int) -> None:
        mark = Mark("primitive", surface=primitive.surface or "", order=order, kind=primitive.kind)
        kind = "MESH" if primitive.kind in _MESHES else "EMPTY"
        thing = self.add(primitive.name, kind, parent, mark)
        if kind == "MESH":
            _MESHES[primitive.kind](self, thing, primitive.fields)
        else:
            _EMPTIES[primitive.kind](thing, primitive.fields)


def ordered(siblings: list) -> list[tuple[int, object]]:
    """Siblings with their order numbers, which are 0 if the natural order of names suffices."""
    keys = [natural(sibling.name) for sibling in siblings]
    natural_already = all(a < b for a, b in zip(keys, keys[1:]))
    return [(0 if natural_already else index + 1, sibling) for index, sibling in enumerate(siblings)]


def _place(thing: SnapshotObject, position=None, orientation=None) -> None:
    thing.transform = Transform(
        location=tuple(position) if position is not None else (0.0, 0.0, 0.0),
        rotation=tuple(orientation) if orientation is not None else (1.0, 0.0, 0.0, 0.0),
    )
    _keep(thing, "location", position)
    _keep(thing, "rotation", orientation)


def _keep(thing: SnapshotObject, name: str, values) -> None:
    if values is not None and needed(values):
        thing.exact[name] = np.asarray(values, dtype=np.float64)


def _number(thing: SnapshotObject, name: str, value) -> None:
    """A number of the mark."""
    setattr(thing.mark, name, value)
    _keep(thing, name, value)


# --- empties -------------------------------------------------------------------------------------------------------


def _point(thing: SnapshotObject, fields: dict) -> None:
    _place(thing, fields["position"])


def _sphere(thing: SnapshotObject, fields: dict) -> None:
    _place(thing, fields["center"])
    _number(thing, "radius", fields["radius"])


def _ellipsoid(thing: SnapshotObject, fields: dict) -> None:
    _place(thing, fields["center"], fields.get("orientation"))
    _number(thing, "semi_axes", tuple(fields["semi_axes"]))


def _ray(thing: SnapshotObject, fields: dict) -> None:
    _place(thing, fields["origin"], turn_of_z(fields["direction"]))
    thing.exact["direction"] = np.asarray(fields["direction"])
    _number(thing, "length", fields["length"])
    if "reach" in fields:
        _number(thing, "reach", fields["reach"])
    thing.mark.response = fields.get("response", "Normal")


def _plane(thing: SnapshotObject, fields: dict) -> None:
    normal = np.asarray(fields["normal"], dtype=np.float64)
    scaled = normal / np.abs(normal).max()
    unit = scaled / np.sqrt(scaled @ scaled)
    place = tuple((unit * fields["offset"] + 0.0).tolist())
    _place(thing, place, turn_of_z(unit))
    thing.exact["normal"], thing.exact["offset"] = normal, np.asarray(float(fields["offset"]))


def _round(thing: SnapshotObject, fields: dict) -> None:
    low, high = np.asarray(fields["ends"], dtype=np.float64)
    axis = high - low
    _place(thing, tuple((low / 2.0 + high / 2.0 + 0.0).tolist()), turn_of_z(axis))
    thing.exact["ends"] = np.array([low, high])
    _number(thing, "length", float(np.sqrt((axis**2).sum())))
    for name in ("radius", "radii", "thickness"):
        if name in fields:
            value = fields[name]
            _number(thing, name, tuple(map(float, value)) if name == "radii" else float(value))
    thing.mark.mouths = tuple(map(bool, fields.get("mouths", (True, True))))


def _custom(thing: SnapshotObject, fields: dict) -> None:
    thing.mark.custom_kind = fields["kind"]
    thing.mark.parameters = list(fields.get("parameters", ()))


def turn_of_z(direction) -> tuple[float, ...]:
    """A quaternion that takes z to a direction: by the shortest rotation, with a fixed axis if that is ambiguous."""
    d = np.asarray(direction, dtype=np.float64)
    d = d / np.abs(d).max()
    d = d / math.sqrt(d @ d)
    x, y, z = d.tolist()
    if z > -0.5:
        return tuple(c + 0.0 for c in transforms.unit_quaternion((1.0 + z, -y, x, 0.0)))
    side = np.array([1.0, 0.0, 0.0]) - x * d if abs(x) < 0.8 else np.array([0.0, 1.0, 0.0]) - y * d
    side = side / math.sqrt(side @ side)
    return transforms.matrix_quaternion(transforms.cleaned(np.stack([side, np.cross(d, side), d], axis=1)))


_EMPTIES = {
    "Point": _point,
    "Sphere": _sphere,
    "Ellipsoid": _ellipsoid,
    "Ray": _ray,
    "Plane": _plane,
    "Capsule": _round,
    "Cylinder": _round,
    "Cone": _round,
    "Bore": _round,
    "Custom": _custom,
}


# --- meshes --------------------------------------------------------------------------------------------------------


def _segment(_scene: _Scene, thing: SnapshotObject, fields: dict) -> None:
    _mesh(thing, np.asarray(fields["ends"], dtype=np.float64), [], np.array([[0, 1]]))


def _triangle(_scene: _Scene, thing: SnapshotObject, fields: dict) -> None:
    _mesh(thing, np.asarray(fields["vertices"], dtype=np.float64), np.array([[0, 1, 2]]))
    _sheet(thing, fields)


def _sheet(thing: SnapshotObject, fields: dict) -> None:
    if "thickness" in fields:
        _number(thing, "thickness", fields["thickness"])
    thing.mark.two_sided = bool(fields.get("two_sided", False))


def _triangle_mesh(scene: _Scene, thing: SnapshotObject, fields: dict) -> None:
    _mesh(thing, *_shape(scene, thing, fields, "triangles"))
    _sheet(thing, fields)


def _polyhedron(scene: _Scene, thing: SnapshotObject, fields: dict) -> None:
    _mesh(thing, *_shape(scene, thing, fields, "faces"))
    thing.mark.inactive_faces = list(fields.get("inactive_faces", ()))


def _shape(scene: _Scene, thing: SnapshotObject, fields: dict, faces: str):
    if "file" not in fields:
        return fields["vertices"], fields[faces]
    thing.mark.file = fields["file"]
    _number(thing, "file_scale", fields.get("scale", 1.0))
    return mesh_file.read(scene.folder or ".", fields["file"], fields.get("scale", 1.0))


_MESHES = {
    "LineSegment": _segment,
    "Triangle": _triangle,
    "TriangleMesh": _triangle_mesh,
    "Polyhedron": _polyhedron,
}


def _mesh(thing: SnapshotObject, vertices: np.ndarray, faces, edges=None) -> None:
    loops, widths = flattened(faces)
    starts = np.concatenate([[0], np.cumsum(widths)]).astype(np.int64)
    vertices = np.asarray(vertices, dtype=np.float64)
    thing.mesh = Mesh(vertices, edges_of(loops, starts) if edges is None else edges, loops, starts)
    _keep(thing, "vertices", vertices)


def edges_of(loops: np.ndarray, starts: np.ndarray) -> np.ndarray:
    """All edges of faces, each once, in the order of their first use."""
    if not len(loops):
        return np.zeros((0, 2), dtype=np.int64)
    following = np.arange(1, len(loops) + 1)
    following[starts[1:] - 1] = starts[:-1]
    pairs = np.stack([loops, loops[following]], axis=1)
    count = int(loops.max()) + 1
    _, first = np.unique(pairs.min(axis=1) * count + pairs.max(axis=1), return_index=True)
    return pairs[np.sort(first)]

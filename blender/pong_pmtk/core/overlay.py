# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines to draw over a scene: bounds, normals, rays and groups of a model, as arrays of positions.

Every function gives a table from paths to (2n, 3) arrays: the ends of n lines, in metres in the root's frame.
"""

from __future__ import annotations

import numpy as np

from .bounds import Volume, volumes
from .canonical import flattened
from .model import Group, Model, Primitive
from .polygon import area_vector, unit
from .transforms import Affine, identity
from .triangle_check import pose_of

CIRCLE = 48  # lines of a circle
_SIGNS = np.array([[x, y, z] for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)], dtype=np.float64)
_BOX_EDGES = [0, 1, 2, 3, 4, 5, 6, 7, 0, 2, 1, 3, 4, 6, 5, 7, 0, 4, 1, 5, 2, 6, 3, 7]

Lines = dict[str, np.ndarray]


def bounds_lines(model: Model, loaded) -> Lines:
    """The bounding volume of every group; those without end are left out. `loaded`: the model as the engine has it."""
    places = {path: body for path, _, _, body in _walk(model.root, model.root.name, identity(), identity())}
    return {path: places[path].points(volume_lines(volume)) for path, volume in volumes(loaded).items()}


def volume_lines(volume: Volume) -> np.ndarray:
    """The edges of a box, or three circles of a ball."""
    if volume.kind != "Sphere":
        return volume.center + (_SIGNS * volume.half)[_BOX_EDGES] @ volume.axes.T
    turn = np.linspace(0.0, 2.0 * np.pi, CIRCLE + 1)
    circle = np.stack([np.cos(turn), np.sin(turn), np.zeros(CIRCLE + 1)], axis=1) * volume.half[0]
    steps = np.repeat(circle, 2, axis=0)[1:-1]
    return volume.center + np.concatenate([np.roll(steps, axis, axis=1) for axis in range(3)])


def normals_lines(model: Model, length: float) -> Lines:
    """From the middle of every face outward, of planes from the point nearest to the origin; not of inactive faces."""
    return _of_primitives(model, lambda primitive: _normals(primitive, length))


def _normals(primitive: Primitive, length: float) -> np.ndarray | None:
    f = primitive.fields
    if primitive.kind == "Plane":
        normal = unit(np.asarray(f["normal"], dtype=np.float64))
        return np.array([normal * f["offset"], normal * (f["offset"] + length)])
    if primitive.kind == "Triangle":
        return _face_normals(np.asarray(f["vertices"], dtype=np.float64), np.array([[0, 1, 2]]), length)
    if primitive.kind == "TriangleMesh" and "vertices" in f:
        return _face_normals(f["vertices"], f["triangles"], length)
    if primitive.kind == "Polyhedron" and "vertices" in f:
        walls = set(f.get("inactive_faces", ()))
        active = [face for index, face in enumerate(f["faces"]) if index not in walls]
        return _face_normals(f["vertices"], active, length)
    return None


def _face_normals(vertices: np.ndarray, faces, length: float) -> np.ndarray:
    _, widths = flattened(faces)
    if len(widths) and (widths == 3).all():
        corners = np.asarray(vertices)[np.asarray(faces)]
        middle = corners.mean(axis=1)
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        size = np.sqrt((normal**2).sum(axis=1, keepdims=True))
        normal = normal / np.where(size > 0.0, size, 1.0)
    else:
        middle = np.array([vertices[face].mean(axis=0) for face in faces]).reshape(-1, 3)
        normal = np.array([unit(area_vector(vertices[face])) for face in faces]).reshape(-1, 3)
    return np.stack([middle, middle + length * normal], axis=1).reshape(-1, 3)


def rays_lines(model: Model) -> Lines:
    """Every ray from its origin to its tip, and the reach behind its origin."""
    return _of_primitives(model, _ray)


def _ray(primitive: Primitive) -> np.ndarray | None:
    if primitive.kind != "Ray":
        return None
    f = primitive.fields
    origin, direction = np.asarray(f["origin"], dtype=np.float64), unit(np.asarray(f["direction"], dtype=np.float64))
    lines = [origin, origin + direction * f["length"]]
    if f.get("reach"):
        lines += [origin - direction * f["reach"], origin]
    return np.array(lines)


def groups_lines(model: Model, length: float) -> Lines:
    """The axes of every group (x, y, z: three lines), then a line to the group above, but for the root."""
    found, origins = {}, {}
    for path, _, place, _ in _walk(model.root, model.root.name, identity(), identity()):
        axes = np.stack([np.zeros((3, 3)), length * np.eye(3)], axis=1).reshape(-1, 3)
        lines, origins[path] = place.points(axes), place.offset
        above = origins.get(path.rpartition("/")[0])
        found[path] = lines if above is None else np.concatenate([lines, [above, place.offset]])
    return found


def _of_primitives(model: Model, lines) -> Lines:
    found = {}
    for path, group, place, _ in _walk(model.root, model.root.name, identity(), identity()):
        for primitive in group.primitives:
            own = lines(primitive)
            if own is not None:
                found[f"{path}/{primitive.name}"] = place.points(own)
    return found


def _walk(group: Group, path: str, place: Affine, body: Affine):
    """Every group with its path, its place and that of its movable group, both in the root's frame."""
    yield path, group, place, body
    for below in group.groups:
        here = place @ pose_of(below)
        yield from _walk(below, f"{path}/{below.name}", here, here if below.movable else body)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines to draw over a scene: bounds, normals, rays, round parts and groups of a model, as arrays of positions.

Every function gives a table from paths to (2n, 3) arrays: the ends of n lines, in metres in the root's frame.
"""

from __future__ import annotations

import numpy as np

from .bounds import Volume, volumes
from .canonical import flattened
from .model import Group, Model, Primitive
from .polygon import area_vector, unit
from .round_shape import ROUND_KINDS, radii_of
from .transforms import Affine, identity
from .triangle_check import pose_of

CIRCLE = 48  # lines of a circle
_SIGNS = np.array([[x, y, z] for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)], dtype=np.float64)
_BOX_EDGES = [0, 1, 2, 3, 4, 5, 6, 7, 0, 2, 1, 3, 4, 6, 5, 7, 0, 4, 1, 5, 2, 6, 3, 7]

Lines = dict[str, np.ndarray]


def bounds_lines(model: Model, loaded) -> Lines:
    """Bounding volume of every group; unbounded ones are left out. `loaded`: the model as loaded by the engine."""
    places = {path: body for path, _, _, body in _walk(model.root, model.root.name, identity(), identity())}
    return {path: places[path].points(volume_lines(volume)) for path, volume in volumes(loaded).items()}


def volume_lines(volume: Volume) -> np.ndarray:
    """Edges of a box, or three circles of a sphere."""
    if volume.kind != "Sphere":
        return volume.center + (_SIGNS * volume.half)[_BOX_EDGES] @ volume.axes.T
    turn = np.linspace(0.0, 2.0 * np.pi, CIRCLE + 1)
    circle = np.stack([np.cos(turn), np.sin(turn), np.zeros(CIRCLE + 1)], axis=1) * volume.half[0]
    steps = np.repeat(circle, 2, axis=0)[1:-1]
    return volume.center + np.concatenate([np.roll(steps, axis, axis=1) for axis in range(3)])


def normals_lines(model: Model, length: float) -> Lines:
    """Normals from the middle of every active face, and of planes from the point nearest to the origin."""
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


def round_lines(model: Model) -> Lines:
    """Lines of every capsule, cylinder, cone and bore: a circle at each end and in the middle, four lines along the
    wall, and the half circles over the ends of a capsule."""
    return _of_primitives(model, _round)


def _round(primitive: Primitive) -> np.ndarray | None:
    if primitive.kind not in ROUND_KINDS:
        return None
    low, high = np.asarray(primitive.fields["ends"], dtype=np.float64)
    radii = radii_of(primitive.kind, primitive.fields)
    z = unit(high - low)
    x = unit(np.cross(np.eye(3)[np.abs(z).argmin()], z))
    y = np.cross(z, x)
    turn = np.linspace(0.0, 2.0 * np.pi, CIRCLE + 1)
    around = np.cos(turn)[:, None] * x + np.sin(turn)[:, None] * y
    middle = (low + high) / 2.0, (radii[0] + radii[1]) / 2.0
    rings = [center + radius * around for center, radius in ((low, radii[0]), middle, (high, radii[1])) if radius > 0.0]
    lines = [_joined(ring) for ring in rings]
    lines += [np.array([low + radii[0] * side, high + radii[1] * side]) for side in (x, y, -x, -y)]
    if primitive.kind == "Capsule":
        half = np.linspace(0.0, np.pi, CIRCLE // 2 + 1)
        for end, outward in ((low, -z), (high, z)):
            arcs = [np.cos(half)[:, None] * side + np.sin(half)[:, None] * outward for side in (x, y)]
            lines += [_joined(end + radii[0] * arc) for arc in arcs]
    return np.concatenate(lines)


def _joined(places: np.ndarray) -> np.ndarray:
    """Lines from each point to the next one."""
    return np.repeat(places, 2, axis=0)[1:-1]


def groups_lines(model: Model, length: float) -> Lines:
    """Axes of every group (x, y, z: three lines), then a line to its parent, except for the root."""
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
    """Every group with its path, its pose and that of its movable group, both in the root's frame."""
    yield path, group, place, body
    for below in group.groups:
        here = place @ pose_of(below)
        yield from _walk(below, f"{path}/{below.name}", here, here if below.movable else body)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Primitives as display meshes, in the frame of their movable group. Numpy only."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .core import mesh_file
from .core.model import Group, Model, Primitive
from .core.read import read_file


@dataclass
class Shape:
    """Display shape of one primitive."""

    path: str
    kind: str
    vertices: np.ndarray  # (n, 3), m
    faces: list  # vertex indices of each face, or an (n, 3) array


@dataclass(frozen=True)
class Sizes:
    """Display sizes of primitives without a size, m."""

    point: float  # radius of a point
    line: float  # radius of a segment or ray
    plane: float  # half the side of a plane


def sizes_for(extent: float, way: float) -> Sizes:
    """Display sizes for the size of the subject (m), and the reach of models with their travel (m)."""
    return Sizes(point=0.012 * extent, line=0.006 * extent, plane=way)


def load(path: Path) -> Model:
    """A model file with its mesh files inserted."""
    try:
        model = read_file(path)
    except OSError as reason:
        raise OSError(f"{path}: the model cannot be read ({reason.strerror}); copy the whole folder of the log") from None
    _fill_meshes(model.root, path.parent)
    return model


def _fill_meshes(group: Group, folder: Path) -> None:
    for primitive in group.primitives:
        if "file" in primitive.fields:
            vertices, faces = mesh_file.read(folder, primitive.fields["file"], primitive.fields.get("scale") or 1.0)
            primitive.fields["vertices"] = vertices
            primitive.fields["triangles" if primitive.kind == "TriangleMesh" else "faces"] = faces
    for child in group.groups:
        _fill_meshes(child, folder)


def bodies_of(model: Model) -> dict[str, list[tuple[str, Primitive, np.ndarray, np.ndarray]]]:
    """Path of each movable group -> its primitives: path, primitive, rotation (3, 3), position (3,) in its frame."""
    bodies: dict[str, list] = {}

    def walk(group: Group, path: str, body: str, rotation: np.ndarray, position: np.ndarray) -> None:
        if body == path:
            bodies[body] = []
        for primitive in group.primitives:
            if primitive.kind not in _DRAWN:
                continue  # kinds of the user's own: nobody here knows their shape
            bodies[body].append((f"{path}/{primitive.name}", primitive, rotation, position))
        for child in group.groups:
            below = f"{path}/{child.name}"
            if child.movable:
                walk(child, below, below, np.eye(3), np.zeros(3))
                continue
            turn = rotation @ rotation_of(child.orientation or (1.0, 0.0, 0.0, 0.0))
            place = position + rotation @ np.asarray(child.position or (0.0, 0.0, 0.0))
            walk(child, below, body, turn, place)

    walk(model.root, model.root.name, model.root.name, np.eye(3), np.zeros(3))
    return bodies


def rotation_of(q) -> np.ndarray:
    """Matrix of a quaternion (w, x, y, z), normalised."""
    w, x, y, z = np.asarray(q, dtype=float) / np.linalg.norm(q)
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ])


def shape(path: str, primitive: Primitive, rotation: np.ndarray, position: np.ndarray, sizes: Sizes) -> Shape:
    """The mesh of one primitive."""
    vertices, faces = _DRAWN[primitive.kind](primitive.fields, sizes)
    return Shape(path, primitive.kind, np.asarray(vertices) @ rotation.T + position, faces)


def boxes_of(model: Model) -> dict[str, np.ndarray]:
    """Path of each movable group -> low and high corner (2, 3) of its primitives in its frame, m.

    Planes have no end: of them only the place nearest to the origin counts, and only where there is nothing else.
    """
    none = Sizes(0.0, 0.0, 0.0)
    boxes = {}
    for path, primitives in bodies_of(model).items():
        solid = [listed for listed in primitives if listed[1].kind != "Plane"] or primitives
        points = [shape(*listed, none).vertices for listed in solid]
        if points:
            joined = np.concatenate(points)
            boxes[path] = np.array([joined.min(axis=0), joined.max(axis=0)])
    return boxes


def extent_of(model: Model) -> float:
    """Longest side of the largest of a model's bodies, m; 0 for planes and single points."""
    return max((float((high - low).max()) for low, high in boxes_of(model).values()), default=0.0)


ROUND = 32  # sides that a round part is drawn with
FAR = 1000.0  # m; beyond, single precision leaves less than 0.1 mm


def anchor_of(box: np.ndarray | None) -> np.ndarray:
    """Reference point of a body's displayed shapes, in its frame: its origin unless the shapes are far from it."""
    if box is None or np.linalg.norm(box.mean(axis=0)) < FAR:
        return np.zeros(3)
    return np.round(box.mean(axis=0))


# --- one function for each kind -----------------------------------------------------------------------------------


def _point(fields, sizes):
    vertices, faces = ball(8, 4)
    return vertices * sizes.point + fields["position"], faces


def _segment(fields, sizes):
    return _rod(*fields["ends"], sizes.line)


def _ray(fields, sizes):
    direction = np.asarray(fields["direction"], dtype=float)
    origin = np.asarray(fields["origin"], dtype=float)
    return _rod(origin, origin + direction / np.linalg.norm(direction) * fields["length"], sizes.line)


def _sphere(fields, _):
    vertices, faces = ball(32, 16)
    return vertices * fields["radius"] + fields["center"], faces


def _ellipsoid(fields, _):
    vertices, faces = ball(32, 16)
    turn = rotation_of(fields.get("orientation") or (1.0, 0.0, 0.0, 0.0))
    return (vertices * fields["semi_axes"]) @ turn.T + fields["center"], faces


def _plane(fields, sizes):
    normal = np.asarray(fields["normal"], dtype=float)
    length = np.linalg.norm(normal)
    normal = normal / length
    across, along = frame_of(normal)
    center = normal * fields["offset"] / length
    corners = [center + sizes.plane * (a * across + b * along) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return np.array(corners), [(0, 1, 2, 3)]


def _triangle(fields, _):
    return np.asarray(fields["vertices"], dtype=float), [(0, 1, 2)]


def _mesh(faces_name):
    def drawn(fields, _):
        return np.asarray(fields["vertices"], dtype=float), fields[faces_name]

    return drawn


def _capsule(fields, _):
    """A sphere with its halves pulled apart."""
    low, high = np.asarray(fields["ends"], dtype=float)
    along, (vertices, faces) = (high - low) / np.linalg.norm(high - low), ball(32, 16)
    across, other = frame_of(along)
    turned = vertices @ np.array([across, other, along]) * fields["radius"]
    return turned + np.where(vertices[:, 2:] > 0.0, high, low), faces


def _frustum(fields, _):
    radii = fields.get("radii") or (fields["radius"],) * 2
    vertices, sides = _wall(fields["ends"], radii)
    return vertices, [*sides, tuple(range(ROUND - 1, -1, -1)), tuple(range(ROUND, 2 * ROUND))]


def _bore(fields, _):
    """Wall of a bore, seen from inside the hole."""
    vertices, sides = _wall(fields["ends"], fields["radii"])
    return vertices, [side[::-1] for side in sides]


def _wall(ends, radii):
    low, high = np.asarray(ends, dtype=float)
    across, other = frame_of((high - low) / np.linalg.norm(high - low))
    angles = np.linspace(0.0, 2.0 * np.pi, ROUND, endpoint=False)
    ring = np.cos(angles)[:, None] * across + np.sin(angles)[:, None] * other
    sides = [(i, (i + 1) % ROUND, ROUND + (i + 1) % ROUND, ROUND + i) for i in range(ROUND)]
    return np.concatenate([low + radii[0] * ring, high + radii[1] * ring]), sides


def _rod(start, end, radius):
    """A closed cylinder with twelve sides."""
    start, end = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
    across, along = frame_of((end - start) / np.linalg.norm(end - start))
    angles = np.linspace(0.0, 2.0 * np.pi, 12, endpoint=False)
    ring = radius * (np.cos(angles)[:, None] * across + np.sin(angles)[:, None] * along)
    sides = [(i, (i + 1) % 12, 12 + (i + 1) % 12, 12 + i) for i in range(12)]
    return np.concatenate([start + ring, end + ring]), sides + [tuple(range(11, -1, -1)), tuple(range(12, 24))]


def frame_of(direction: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Two unit vectors that form a right-handed frame with a unit direction as the third."""
    helper = np.eye(3)[np.argmin(np.abs(direction))]
    across = np.cross(helper, direction)
    across /= np.linalg.norm(across)
    return across, np.cross(direction, across)


def ball(around: int, upwards: int) -> tuple[np.ndarray, list]:
    """The unit sphere in rings."""
    theta = np.pi * np.arange(1, upwards) / upwards
    phi = 2.0 * np.pi * np.arange(around) / around
    rings = np.stack([
        np.outer(np.sin(theta), np.cos(phi)),
        np.outer(np.sin(theta), np.sin(phi)),
        np.repeat(np.cos(theta)[:, None], around, axis=1),
    ], axis=-1).reshape(-1, 3)
    top, bottom = len(rings), len(rings) + 1
    faces = []
    for j in range(around):
        k = (j + 1) % around
        faces.append((top, j, k))
        last = (upwards - 2) * around
        faces.append((bottom, last + k, last + j))
        faces += [(i * around + j, (i + 1) * around + j, (i + 1) * around + k, i * around + k) for i in range(upwards - 2)]
    return np.concatenate([rings, [(0.0, 0.0, 1.0), (0.0, 0.0, -1.0)]]), faces


_DRAWN = {
    "Point": _point,
    "LineSegment": _segment,
    "Ray": _ray,
    "Sphere": _sphere,
    "Ellipsoid": _ellipsoid,
    "Plane": _plane,
    "Triangle": _triangle,
    "TriangleMesh": _mesh("triangles"),
    "Polyhedron": _mesh("faces"),
    "Capsule": _capsule,
    "Cylinder": _frustum,
    "Cone": _frustum,
    "Bore": _bore,
}

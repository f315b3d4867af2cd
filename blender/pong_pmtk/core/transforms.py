# SPDX-License-Identifier: GPL-3.0-or-later
"""Transforms in double precision, by Blender's own rules.

World of an object = world of its parent · parent inverse · local; local = translation(location + delta) · rotation ·
diag(scale · delta). Rotation matrices are cleaned of rounding: entries within a few units of the last place of 0 or ±1
are made so, that a quarter turn does not smear zeros into 6e-17.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .exact import is_fresh, meant, typed_angle
from .snapshot import SnapshotObject, Transform

EULER_ORDERS = ("XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX")
ROTATION_MODES = ("QUATERNION", "AXIS_ANGLE", *EULER_ORDERS)
CLEAN = 1e-15
# Columns count as orthogonal (no shear) within this cosine, the accuracy of 32-bit numbers.
SHEAR_TOLERANCE = 1e-6
# Scales count as equal, and as 1, within this share.
SCALE_TOLERANCE = 1e-6
QUATERNION_NORM_TOLERANCE = 1e-3


class TransformFault(ValueError):
    """An unusable transform: rule, cause and cure."""

    def __init__(self, rule: str, cause: str, cure: str):
        super().__init__(cause)
        self.rule, self.cause, self.cure = rule, cause, cure


@dataclass
class Affine:
    """x -> linear · x + offset."""

    linear: np.ndarray
    offset: np.ndarray

    def __matmul__(self, other: Affine) -> Affine:
        return Affine(product(self.linear, other.linear), apply(self.linear, other.offset) + self.offset)

    def points(self, points) -> np.ndarray:
        return apply(self.linear, points) + self.offset

    def is_identity(self) -> bool:
        return is_identity(self.linear) and not self.offset.any()


def identity() -> Affine:
    return Affine(np.eye(3), np.zeros(3))


def is_identity(linear: np.ndarray) -> bool:
    return np.array_equal(linear, np.eye(3))


def product(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Product a · b, without rounding if one is the identity."""
    if is_identity(a):
        return b
    return a if is_identity(b) else a @ b


def apply(linear: np.ndarray, points) -> np.ndarray:
    """linear · p for one or many points. The order of sums is fixed, independent of the machine's mathematics library."""
    points = np.asarray(points, dtype=np.float64)
    if is_identity(linear):
        return points.copy()
    x, y, z = points[..., 0:1], points[..., 1:2], points[..., 2:3]
    return x * linear[:, 0] + y * linear[:, 1] + z * linear[:, 2]


def cleaned(matrix: np.ndarray) -> np.ndarray:
    """A rotation matrix without rounding errors near 0 and ±1."""
    whole = np.rint(matrix)
    return np.where(np.abs(matrix - whole) <= CLEAN, whole + 0.0, matrix)


def quaternion_matrix(quaternion) -> np.ndarray:
    """The rotation of a quaternion (w, x, y, z) of any length but zero."""
    w, x, y, z = unit_quaternion(quaternion)
    return cleaned(
        np.array(
            [
                [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
            ]
        )
    )


def unit_quaternion(quaternion) -> tuple[float, ...]:
    norm = math.sqrt(sum(c * c for c in quaternion))
    if norm == 0.0:
        raise TransformFault("zero-rotation", "its quaternion is zero", "give it a rotation: Alt R clears it")
    return tuple(float(c) / norm for c in quaternion)


def matrix_quaternion(matrix: np.ndarray) -> tuple[float, float, float, float]:
    """The unit quaternion (w ≥ 0 first) of a rotation matrix, from its largest component."""
    m = matrix
    squares = np.array([
        1 + m[0, 0] + m[1, 1] + m[2, 2], 1 + m[0, 0] - m[1, 1] - m[2, 2],
        1 - m[0, 0] + m[1, 1] - m[2, 2], 1 - m[0, 0] - m[1, 1] + m[2, 2],
    ])  # fmt: skip
    first = int(np.argmax(squares))
    big = math.sqrt(squares[first]) / 2
    off = 4 * big
    a, b, c = (m[2, 1] - m[1, 2]) / off, (m[0, 2] - m[2, 0]) / off, (m[1, 0] - m[0, 1]) / off
    d, e, f = (m[1, 0] + m[0, 1]) / off, (m[0, 2] + m[2, 0]) / off, (m[2, 1] + m[1, 2]) / off
    q = [(big, a, b, c), (a, big, d, e), (b, d, big, f), (c, e, f, big)][first]
    sign = next((math.copysign(1.0, x) for x in q if x), 1.0)
    return tuple(float(sign * x) + 0.0 for x in unit_quaternion(q))


def euler_matrix(order: str, angles) -> np.ndarray:
    """Rotation by Euler angles; the first letter's rotation comes first: "XYZ" is Rz · Ry · Rx."""
    matrix = np.eye(3)
    for axis in order:
        index = "XYZ".index(axis)
        matrix = product(axis_turn(index, angles[index]), matrix)
    return cleaned(matrix)


def axis_turn(axis: int, angle: float) -> np.ndarray:
    i, j = (axis + 1) % 3, (axis + 2) % 3
    matrix = np.eye(3)
    matrix[i, i] = matrix[j, j] = math.cos(angle)
    matrix[j, i] = math.sin(angle)
    matrix[i, j] = -matrix[j, i]
    return cleaned(matrix)


def axis_angle_quaternion(rotation) -> tuple[float, ...]:
    """Rotation by (angle, x, y, z); a zero axis gives the identity, as in Blender."""
    angle, *axis = rotation
    norm = math.sqrt(sum(c * c for c in axis))
    if norm == 0.0:
        return (1.0, 0.0, 0.0, 0.0)
    sine = math.sin(angle / 2) / norm
    return (math.cos(angle / 2), *(sine * c for c in axis))


def rotation_matrix(mode: str, rotation) -> np.ndarray:
    if mode == "QUATERNION":
        return quaternion_matrix(rotation)
    if mode == "AXIS_ANGLE":
        return quaternion_matrix(axis_angle_quaternion(rotation))
    if mode in EULER_ORDERS:
        return euler_matrix(mode, rotation)
    cure = f"choose one of {', '.join(ROTATION_MODES)}"
    raise TransformFault("unknown-rotation-mode", f'its rotation mode is "{mode}"', cure)


@dataclass
class Local:
    """An object's transform to its parent's frame, and whether it consists of its own plain fields."""

    matrix: Affine
    location: tuple[float, ...]  # with the delta
    quaternion: tuple[float, ...] | None  # exactly as authored, if rotation is a quaternion without a delta
    rotation: np.ndarray
    scale: np.ndarray
    has_parent_inverse: bool
    fresh: bool  # the exact numbers that hang on the object's place still hold


def local_transform(thing: SnapshotObject) -> Local:
    """Transform of an object as composed by Blender; raises `TransformFault`."""
    t, exact = thing.transform, thing.exact
    _check(t)
    location = meant(t.location, exact.get("location"))
    scale = meant(t.scale, exact.get("scale")) * meant(t.delta_scale)
    offset = location + meant(t.delta_location)
    rotation, quaternion = _rotation(t, exact.get("rotation"))
    linear = rotation if (scale == 1.0).all() else rotation * scale
    matrix = Affine(linear, offset)
    inverse = parent_inverse(t)
    if inverse is not None:
        matrix = inverse @ matrix
    fresh = inverse is None and _keeps(t.location, exact.get("location")) and _keeps(t.rotation, exact.get("rotation"))
    return Local(matrix, tuple(offset.tolist()), quaternion, rotation, scale, inverse is not None, fresh)


def _keeps(stored, exact) -> bool:
    """Unused exact numbers do not make the result inexact."""
    return exact is None or is_fresh(np.asarray(stored, dtype=np.float64), exact)


def parent_inverse(t: Transform) -> Affine | None:
    if t.parent_inverse is None or np.array_equal(t.parent_inverse, np.eye(4)):
        return None
    matrix = meant(t.parent_inverse)
    return Affine(cleaned(matrix[:3, :3]), matrix[:3, 3].copy())


def _rotation(t: Transform, exact) -> tuple[np.ndarray, tuple[float, ...] | None]:
    mode = t.rotation_mode
    delta = _angles(mode, t.delta_rotation) if mode != "AXIS_ANGLE" else (1.0, 0.0, 0.0, 0.0)
    delta_mode = "QUATERNION" if mode == "AXIS_ANGLE" else mode
    has_delta = any(delta) if mode in EULER_ORDERS and len(delta) == 3 else tuple(delta[1:]) != (0.0, 0.0, 0.0)
    rotation = _angles(mode, t.rotation, exact)
    matrix = rotation_matrix(mode, rotation)
    if has_delta:
        return cleaned(product(rotation_matrix(delta_mode, delta), matrix)), None
    return matrix, _as_authored(rotation, t.rotation, exact) if mode == "QUATERNION" else None


def _angles(mode: str, stored, exact=None) -> tuple[float, ...]:
    values = meant(stored, exact).tolist()
    if exact is not None and is_fresh(np.asarray(stored, dtype=np.float64), exact):
        return tuple(values)
    if mode in EULER_ORDERS and len(values) == 3:
        return tuple(typed_angle(x) for x in stored)
    if mode == "AXIS_ANGLE":
        return (typed_angle(stored[0]), *values[1:])
    return tuple(values)


def _as_authored(rotation, stored, exact) -> tuple[float, ...]:
    """The quaternion itself if given in full precision, else normalised."""
    full = _keeps(stored, exact) and exact is not None or not (meant(stored) != np.asarray(stored)).any()
    norm = math.sqrt(sum(c * c for c in rotation))
    if full and abs(norm - 1.0) <= QUATERNION_NORM_TOLERANCE:
        return tuple(rotation)
    return unit_quaternion(rotation)


def _check(t: Transform) -> None:
    numbers = [t.location, t.rotation, t.scale, t.delta_location, t.delta_rotation, t.delta_scale]
    inverse = [] if t.parent_inverse is None else [np.ravel(t.parent_inverse)]
    if not all(np.isfinite(np.asarray(part, dtype=np.float64)).all() for part in numbers + inverse):
        raise TransformFault(
            "transform-not-finite", "its transform is not finite", "clear location, rotation and scale"
        )
    if not np.all(np.asarray(t.scale) * np.asarray(t.delta_scale)):
        raise TransformFault("zero-scale", f"its scale is {tuple(t.scale)}", "give it a scale, or remove the object")
    if inverse and np.linalg.det(np.asarray(t.parent_inverse)[:3, :3]) == 0.0:
        cause = "its parent's inverse matrix flattens it"
        raise TransformFault("zero-scale", cause, "clear the parent and set it again")


@dataclass
class Frame:
    """Factors of a linear map, a rotation after the rest: `linear` = `rotation` · `rest`."""

    rotation: np.ndarray
    rest: np.ndarray


def column_lengths(linear: np.ndarray) -> np.ndarray:
    return np.sqrt((linear * linear).sum(axis=0))


def shear(linear: np.ndarray) -> float:
    """The largest cosine between two columns; 0 for rotation and scale alone."""
    unit = linear / column_lengths(linear)
    gram = unit.T @ unit
    return float(np.abs(gram[[0, 0, 1], [1, 2, 2]]).max())


def frame_of(linear: np.ndarray, signs) -> Frame | None:
    """Rotation of a frame that is rotated and scaled but not sheared; `None` if it is sheared.

    `signs` are those of the scale: a frame that is mirrored keeps its rotation and leaves the mirror to the rest.
    """
    if shear(linear) > SHEAR_TOLERANCE:
        return None
    lengths = column_lengths(linear) * np.where(np.asarray(signs) < 0, -1.0, 1.0)
    rotation = linear / lengths
    if np.linalg.det(rotation) < 0.0:
        lengths = lengths * np.array([-1.0, 1.0, 1.0])
        rotation = linear / lengths
    rotation = cleaned(orthonormal(rotation))
    return Frame(rotation, np.diag(lengths))


def orthonormal(matrix: np.ndarray) -> np.ndarray:
    """The rotation nearest to a slightly inexact one."""
    for _ in range(3):
        matrix = 0.5 * (matrix + np.linalg.inv(matrix).T)
    return matrix

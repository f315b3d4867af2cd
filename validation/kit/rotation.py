"""Quaternions w, x, y, z as arrays: the last axis has the four numbers, all other axes are free."""

import numpy as np


def product(a, b):
    """Product of two rotations: that of `b` first, then that of `a`."""
    aw, ax, ay, az = np.moveaxis(a, -1, 0)
    bw, bx, by, bz = np.moveaxis(b, -1, 0)
    return np.stack(
        [
            aw * bw - ax * bx - ay * by - az * bz,
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw,
        ],
        axis=-1,
    )


def inverse(q):
    """Inverse rotation of unit quaternions."""
    return q * np.array([1.0, -1.0, -1.0, -1.0])


def rotation_vector(q):
    """Axis times angle of unit quaternions, angle from 0 to π, rad."""
    q = np.where(q[..., :1] < 0.0, -q, q)
    length = np.linalg.norm(q[..., 1:], axis=-1, keepdims=True)
    angle = 2.0 * np.arctan2(length, q[..., :1])
    # The ratio of angle to sine tends to 2 where the rotation vanishes.
    return q[..., 1:] * np.where(length > 1e-12, angle / np.maximum(length, 1e-12), 2.0)


def of_rotation_vector(vector):
    """Unit quaternions of axis times angle, rad."""
    angle = np.linalg.norm(vector, axis=-1, keepdims=True)
    return np.concatenate([np.cos(angle / 2), vector * np.sinc(angle / (2 * np.pi)) / 2], axis=-1)


def turned(q, vector):
    """Components of the vectors in the outer frame, from those in the frame that `q` turns."""
    w, axis = q[..., :1], q[..., 1:]
    across = 2.0 * np.cross(axis, vector)
    return vector + w * across + np.cross(axis, across)


def angle_between(a, b):
    """Angle of the rotation that takes `a` to `b`, from 0 to π, rad."""
    return np.linalg.norm(rotation_vector(product(b, inverse(a))), axis=-1)


def matrix(q):
    """Rotation matrices whose columns are the turned axes."""
    return np.moveaxis(np.stack([turned(q, np.broadcast_to(axis, q.shape[:-1] + (3,))) for axis in np.eye(3)]), 0, -1)

"""Rotations, and an Object displaced as one rigid body."""

import numpy as np


def turned(rotation, vectors):
    """Vectors rotated by a rotation vector (Rodrigues)."""
    angle = np.linalg.norm(rotation)
    if angle == 0.0:
        return vectors
    axis = rotation / angle
    parallel = np.outer(vectors @ axis, axis).reshape(vectors.shape)
    return parallel + np.cos(angle) * (vectors - parallel) + np.sin(angle) * np.cross(axis, vectors)


def product(p, q):
    """Product of two quaternions (w, x, y, z)."""
    vector = p[0] * q[1:] + q[0] * p[1:] + np.cross(p[1:], q[1:])
    return np.concatenate([[p[0] * q[0] - p[1:] @ q[1:]], vector])


def in_frame_of(state, vector):
    """A vector of the common frame along the axes of a body."""
    w, v = state[3], -state[4:7]
    return vector + 2 * np.cross(v, np.cross(v, vector) + w * vector)


def in_common(state, vector):
    """A vector of a body along the common axes."""
    w, v = state[3], state[4:7]
    return vector + 2 * np.cross(v, np.cross(v, vector) + w * vector)


def displaced(states, pivot, change):
    """States of the bodies of one Object (its root first), displaced as one rigid body: rotated about the pivot,
    translated, and given additional linear and angular velocity."""
    out = states.copy()
    root = states[0]
    at = root[:3] + in_common(root, pivot)
    angle = np.linalg.norm(change["rotation"])
    axis = change["rotation"] / angle if angle else np.zeros(3)
    turn = np.concatenate([[np.cos(angle / 2)], np.sin(angle / 2) * axis])
    for row in out:
        arm = turned(change["rotation"], row[:3] - at)
        row[:3] = at + arm + change["position"]
        row[3:7] = product(turn, row[3:7])
        row[3:7] /= np.linalg.norm(row[3:7])
        # Velocities are those of the approach: they keep their direction, whatever the rotation of the vehicle.
        row[7:10] += change["velocity"] + np.cross(change["angular_velocity"], arm)
        row[10:] += change["angular_velocity"]
    return out

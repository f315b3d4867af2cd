"""Kinematics of the arm as products of rotations, without an engine, so the controller can run anywhere."""

import numpy as np

from .dimensions import LINKS, TIP


def rotation(axis, angle):
    """Rotation about a unit axis, by Rodrigues' formula."""
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * cross @ cross


def forward(angles, place=np.zeros(3), attitude=np.eye(3)):
    """Origins and axes of the joints, and pose of the tip, for a pose of the base."""
    origins, axes = [], []
    for link, angle in zip(LINKS, angles):
        place = place + attitude @ link.offset
        origins.append(place)
        axes.append(attitude @ link.axis)
        attitude = attitude @ rotation(link.axis, angle)
    return np.array(origins), np.array(axes), place + attitude @ TIP, attitude


def jacobian(angles, place=np.zeros(3), attitude=np.eye(3)):
    """Linear and angular rate of the tip for each joint's rate, 6×7, along the axes of the world."""
    origins, axes, tip, _ = forward(angles, place, attitude)
    return np.vstack([np.cross(axes, tip - origins).T, axes.T])


def resolve(matrix, rates, damping):
    """Joint rates for rates of the tip by damped least squares: (JᵀJ + λ²)⁻¹Jᵀ·v, in the form with a 6×6 inverse."""
    return matrix.T @ np.linalg.solve(matrix @ matrix.T + damping**2 * np.eye(6), rates)


def reach(start, place, attitude, base=(np.zeros(3), np.eye(3)), damping=0.05, rounds=200):
    """Joint angles for a pose of the tip, from `start` by damped least squares; None without convergence."""
    angles = np.array(start, float)
    for _ in range(rounds):
        _, _, tip, turned = forward(angles, *base)
        off = np.concatenate([place - tip, turn_between(turned, attitude)])
        if np.abs(off).max() < 1e-12:
            break
        # The damping vanishes with the residual, so the last steps are Newton's.
        angles = angles + resolve(jacobian(angles, *base), off, damping * min(1.0, float(np.linalg.norm(off))))
    return angles if np.abs(off).max() < 1e-9 else None


def turn_between(first, second):
    """World rotation vector from one attitude to another (less than half a turn)."""
    turn = second @ first.T
    vector = 0.5 * np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
    sine, cosine = np.linalg.norm(vector), 0.5 * (np.trace(turn) - 1.0)
    return vector * (np.arctan2(sine, cosine) / sine if sine > 1e-9 else 1.0)


def quaternion(attitude):
    """Quaternion of a rotation matrix whose angle is below half a turn."""
    w = 0.5 * np.sqrt(1.0 + np.trace(attitude))
    vector = [attitude[2, 1] - attitude[1, 2], attitude[0, 2] - attitude[2, 0], attitude[1, 0] - attitude[0, 1]]
    return np.array([w, *(np.array(vector) / (4.0 * w))])

"""Impact of rigid bodies after Routh: Coulomb friction along the normal impulse, Poisson's restitution. Impulses per mass."""

import numpy as np

from validation.planar_impacts.data import METRIC

# Slip, its end, the end of the approach and the end of the impact, in any order, are fewer.
PHASES = 8


def contact_matrix(impacts):
    """Inverse effective mass of the contacts times the mass, n × 2 × 2: tangential, normal."""
    h, l, k = impacts.tangent, impacts.normal, METRIC[2]
    return np.moveaxis(np.array([[1 + h * h / k, h * l / k], [h * l / k, 1 + l * l / k]]), -1, 0)


def after(impacts, restitution, friction):
    """Velocities after the impacts. The friction slips until it has stopped the contact, and then holds it, or slips back."""
    out = np.empty_like(impacts.before)
    for number, matrix in enumerate(contact_matrix(impacts)):
        h, l = impacts.tangent[number], impacts.normal[number]
        x, y, turning = impacts.before[number]
        impulse = _impulse(matrix, x + h * turning, y + l * turning, restitution, friction)
        out[number] = (x + impulse[0], y + impulse[1], turning + (h * impulse[0] + l * impulse[1]) / METRIC[2])
    return out


def _impulse(matrix, slip, approach, restitution, friction):
    """Impulse per mass (tangential, normal) of one impact, phase by phase along the normal impulse."""
    if approach >= 0.0:
        return np.zeros(2)
    velocity, impulse, end = np.array([slip, approach]), np.zeros(2), np.inf
    for _ in range(PHASES):
        direction = _direction(matrix, velocity[0], friction)
        rate = matrix @ direction
        # Normal impulses until the contact stops slipping, until it stops approaching, and until the impact ends.
        stops = -velocity[0] / rate[0] if velocity[0] * rate[0] < 0.0 else np.inf
        turns = -velocity[1] / rate[1] if end == np.inf and rate[1] > 0.0 else np.inf
        step = max(min(stops, turns, end - impulse[1]), 0.0)
        if step == np.inf:
            break
        impulse, velocity = impulse + step * direction, velocity + step * rate
        if step == stops:
            velocity[0] = 0.0
        if step == turns:
            velocity[1] = 0.0
            end = (1.0 + restitution) * impulse[1]
        elif impulse[1] >= end * (1.0 - 1e-12):
            break
    return impulse


def _direction(matrix, slip, friction):
    """Impulse per normal impulse: against the slip, or what holds a contact that does not slip, if friction suffices."""
    if slip != 0.0:
        return np.array([-friction * np.sign(slip), 1.0])
    holds = -matrix[0, 1] / matrix[0, 0]
    return np.array([float(np.clip(holds, -friction, friction)), 1.0])

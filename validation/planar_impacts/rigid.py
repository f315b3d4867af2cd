"""Impact of rigid bodies after Routh: Coulomb friction along the normal impulse, Poisson's restitution. Impulses per mass."""

import numpy as np

from validation.planar_impacts.data import METRIC


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
    velocity, impulse, until = np.array([slip, approach]), np.zeros(2), np.inf
    for _ in range(8):
        direction = _direction(matrix, velocity[0], friction)
        rate = matrix @ direction
        ends = []
        if velocity[0] * rate[0] < 0.0:
            ends.append(-velocity[0] / rate[0])
        if until == np.inf and rate[1] > 0.0 and velocity[1] < 0.0:
            ends.append(-velocity[1] / rate[1])
        if until < np.inf:
            ends.append(until - impulse[1])
        if not ends:
            break
        step = max(min(ends), 0.0)
        impulse, velocity = impulse + step * direction, velocity + step * rate
        if step == ends[0] and abs(velocity[0]) < 1e-12 * (1.0 + abs(slip)):
            velocity[0] = 0.0
        if until == np.inf and velocity[1] >= -1e-12:
            until = (1.0 + restitution) * impulse[1]
        if impulse[1] >= until * (1.0 - 1e-12):
            break
    return impulse


def _direction(matrix, slip, friction):
    """Impulse per normal impulse: against the slip, or what holds a contact that does not slip, if friction suffices."""
    if slip != 0.0:
        return np.array([-friction * np.sign(slip), 1.0])
    holds = -matrix[0, 1] / matrix[0, 0]
    return np.array([float(np.clip(holds, -friction, friction)), 1.0])

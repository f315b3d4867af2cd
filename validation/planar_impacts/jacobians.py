"""The sign of the published Jacobians: what the measured velocities say of it, without any model of impact.

An impulse (tangential, normal) changes the velocity by M⁻¹·Jᵀ·P, with the rows of J: tangential (1, 0, h), normal (0, 1, l).
So the change of the turning is (h·Δv_x + l·Δv_y)/k², k the radius of gyration, whatever the impulse is.
"""

from dataclasses import dataclass, replace

import numpy as np

from validation.kit.statistics import interval
from validation.planar_impacts.data import GYRATION, METRIC


@dataclass(frozen=True)
class Signs:
    """Coefficients of Δω = a·h·Δv_x + b·l·Δv_y, 1/m²."""

    tangential: object  # Interval of a
    normal: object  # Interval of b
    expected: float  # of both
    explained: float  # share of the variance, R²


def signs(impacts):
    """Regression of the measured changes of velocity."""
    change = impacts.after - impacts.before
    rows = np.column_stack([impacts.tangent * change[:, 0], impacts.normal * change[:, 1], change[:, 2]])

    def solved(number):
        def of(sample, axis=None):
            matrix, right = sample[..., :2], sample[..., 2:]
            transposed = np.swapaxes(matrix, -1, -2)
            return np.linalg.solve(transposed @ matrix, transposed @ right)[..., number, 0]

        return of

    both = [interval(rows, solved(number)) for number in (0, 1)]
    rest = rows[:, 2] - rows[:, :2] @ [one.value for one in both]
    return Signs(*both, GYRATION**-2, float(1.0 - np.var(rest) / np.var(rows[:, 2])))


def corrected(impacts):
    """The impacts with the other sign of the tangential Jacobian."""
    return replace(impacts, tangent=-impacts.tangent)


def best_impulse(impacts):
    """Velocities after the impact by the impulse that fits each impact best: no model of contact does better."""
    rows = np.zeros((len(impacts), 2, 3))
    rows[:, 0, 0], rows[:, 0, 2] = 1.0, impacts.tangent
    rows[:, 1, 1], rows[:, 1, 2] = 1.0, impacts.normal
    # Least squares in the norm of the kinetic energy: the effective mass of the contact times the wanted change of its velocity.
    spread = rows / METRIC
    impulse = np.linalg.solve(rows @ np.swapaxes(spread, 1, 2), rows @ (impacts.after - impacts.before)[:, :, None])
    return impacts.before + (np.swapaxes(spread, 1, 2) @ impulse)[:, :, 0]

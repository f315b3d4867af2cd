"""Statics of a pull at a latched truss: torque of each joint for a displacement of the tip.

A joint is a spring: gear and servo in series. The tip does not move, so its six forces take back what the motors have
turned: τ = Jᵀλ with J·K⁻¹·Jᵀ·λ = J·Δ, with Δ the angles to which the servos lead. Their damping acts on the rate that a
motor is told less the rate that it has, and a motor before a gear that yields turns with the share k/(k + g) of what it
is told (k servo, g gear): the servo leads by c/k·g/(k + g) seconds. Angles are small.
"""

import math

import numpy as np
import pull
from kit.arm import kinematics
from kit.arm.dimensions import GEAR_STIFFNESS, READY, SERVO_DAMPING, SERVO_STIFFNESS

GEARS = np.array(GEAR_STIFFNESS)
STIFFNESS = 1.0 / (1.0 / GEARS + 1.0 / SERVO_STIFFNESS)  # N·m/rad
LEAD = SERVO_DAMPING / SERVO_STIFFNESS * GEARS / (GEARS + SERVO_STIFFNESS)  # s


def rate(way):
    """Rate of the tip, which rises linearly, after a commanded displacement."""
    risen = pull.RATE[0] * pull.RISE / 2
    return pull.RATE[0] * min(1.0, math.sqrt(way / risen))


def torques(direction, way):
    """Torques of the joints, N·m, after a commanded displacement of the tip along a direction."""
    moves = kinematics.jacobian(READY)
    led = kinematics.resolve(moves, np.array((*direction, 0.0, 0.0, 0.0)), 0.05) * (way + LEAD * rate(way))
    return moves.T @ np.linalg.solve(moves / STIFFNESS @ moves.T, moves @ led)


def stalls_at(direction, limits, most=1.0):
    """Displacement of the tip at which the first joint needs its motor's limit, m."""
    low, high = 0.0, most
    for _ in range(40):
        middle = 0.5 * (low + high)
        stalls = (np.abs(torques(direction, middle)) >= limits).any()
        low, high = (low, middle) if stalls else (middle, high)
    return high

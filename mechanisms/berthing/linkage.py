"""The four-bar linkage of a latch in closed form, in the plane (radius, z); angles in rad above the outward direction."""

import math
from dataclasses import dataclass

from dimensions import COUPLER, CRANK, CRANK_PIVOT, FOLLOWER, FOLLOWER_PIVOT, ROLLER_AT


@dataclass(frozen=True)
class Pose:
    """Angles of the links and their rates per rad/s of the crank; position of the roller and its rate likewise."""

    crank: float
    coupler: float
    follower: float
    coupler_rate: float
    follower_rate: float
    roller: tuple
    roller_rate: tuple


def _toward(angle, length):
    return (length * math.cos(angle), length * math.sin(angle))


def _add(*vectors):
    return tuple(map(sum, zip(*vectors)))


def pose(crank):
    """Pose of the other links for a crank angle: triangle of crank pin, joint and follower pivot."""
    pin = _add(CRANK_PIVOT, _toward(crank, CRANK))
    across = (FOLLOWER_PIVOT[0] - pin[0], FOLLOWER_PIVOT[1] - pin[1])
    distance = math.hypot(*across)
    opening = math.acos((COUPLER**2 + distance**2 - FOLLOWER**2) / (2 * COUPLER * distance))
    coupler = math.atan2(across[1], across[0]) + opening
    joint = _add(pin, _toward(coupler, COUPLER))
    follower = math.atan2(joint[1] - FOLLOWER_PIVOT[1], joint[0] - FOLLOWER_PIVOT[0])
    # Rates from the closed loop: crank + coupler − follower turns without moving the pivots.
    coupler_rate = CRANK * math.sin(follower - crank) / (COUPLER * math.sin(coupler - follower))
    follower_rate = CRANK * math.sin(coupler - crank) / (FOLLOWER * math.sin(coupler - follower))
    arm = _add(_toward(coupler, ROLLER_AT[0]), _toward(coupler + math.pi / 2, ROLLER_AT[1]))
    swept = (-CRANK * math.sin(crank) - coupler_rate * arm[1], CRANK * math.cos(crank) + coupler_rate * arm[0])
    return Pose(crank, coupler, follower, coupler_rate, follower_rate, _add(pin, arm), swept)


def freudenstein(crank, follower):
    """Residual of Freudenstein's equation K1·cos φ − K2·cos θ + K3 = cos(θ − φ); angles from the fixed link."""
    fixed = (FOLLOWER_PIVOT[0] - CRANK_PIVOT[0], FOLLOWER_PIVOT[1] - CRANK_PIVOT[1])
    length, turned = math.hypot(*fixed), math.atan2(fixed[1], fixed[0])
    theta, phi = crank - turned, follower - turned
    first, second = length / CRANK, length / FOLLOWER
    third = (CRANK**2 - COUPLER**2 + FOLLOWER**2 + length**2) / (2 * CRANK * FOLLOWER)
    return first * math.cos(phi) - second * math.cos(theta) + third - math.cos(theta - phi)


def crank_at(z, low, high):
    """Angle of the crank for a height of the roller, which descends between the two given angles."""
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if pose(middle).roller[1] > z else (low, middle)
    return 0.5 * (low + high)

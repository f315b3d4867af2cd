"""Highest step that a rocker-bogie rover can begin to climb: planar balance of one side, with limits of friction.

Three wheels bear N and pull with T, |T| ≤ μ·N and |T| ≤ τ/r. The whole must be in balance (three equations), and each
bogie about its pivot (one). A wheel can lift off the ground where there is any such balance with the wheel at the edge.
"""

import itertools
import math

import dimensions as d
import numpy as np
from dimensions import model

NAMES = ("front", "middle", "rear")
SLACK = 1e-9  # of a weight


def at_edge(axle, height):
    """Position, normal and tangent (ahead and up) of a wheel at the edge of a step; at a wall if it is higher than the
    axle."""
    radius = model.WHEEL_RADIUS
    angle = math.acos(max(0.0, 1.0 - height / radius))
    normal = np.array((-math.sin(angle), math.cos(angle)))
    return axle - radius * normal, normal, np.array((math.cos(angle), math.sin(angle)))


def on_ground(axle):
    return axle - (0.0, model.WHEEL_RADIUS), np.array((0.0, 1.0)), np.array((1.0, 0.0))


def cross(a, b):
    return a[0] * b[1] - a[1] * b[0]


def contacts(climbs, height, ahead=0.0):
    """Contacts of the three wheels with `climbs` at the edge and those ahead on the step; pivot and centre of mass.

    `ahead`: by how much the mass centre of the chassis is ahead of its middle, m.
    """
    up = {name: height if NAMES.index(name) < NAMES.index(climbs) else 0.0 for name in NAMES}
    axles = {name: np.array((d.AXLE_X[name], model.WHEEL_RADIUS + up[name])) for name in NAMES}
    bogie = 0.5 * (axles["middle"] + axles["rear"])
    along = axles["front"] - bogie
    pitch = math.atan2(along[1], along[0])
    turn = np.array(((math.cos(pitch), -math.sin(pitch)), (math.sin(pitch), math.cos(pitch))))
    center = bogie + turn @ (np.array(mass_center(ahead)) - (d.BOGIE_X, 0.0))
    made = [at_edge(axles[n], height) if n == climbs else on_ground(axles[n]) for n in NAMES]
    return made, bogie, center


def mass_center(ahead=0.0):
    """Centre of mass of the rover on level ground, x and z from the axles."""
    parts = [
        (d.CHASSIS_MASS, ahead, d.CHASSIS_Z),
        (2 * d.ROCKER_MASS, 0.0, d.ROCKER_Z),
        (2 * d.BOGIE_MASS, d.BOGIE_X, d.BOGIE_Z),
    ]
    parts += [(2 * (d.STEER_MASS + model.WHEEL_MASS), x, 0.0) for x in d.AXLE_X.values()]
    mass = sum(part[0] for part in parts)
    return tuple(sum(m * place[i] for m, *place in parts) / mass for i in (0, 1))


def can_climb(climbs, height, torque, friction=model.FRICTION, ahead=0.0):
    """Existence of a balance, and torque of each motor, N·m. Forces in weights of one side of the rover."""
    made, bogie, center = contacts(climbs, height, ahead)
    pull = torque / model.WHEEL_RADIUS / (d.GROSS_MASS * model.GRAVITY / 2)
    columns, limits, room = [], [], []
    for i, (place, normal, tangent) in enumerate(made):
        for direction in (normal, tangent):
            about = cross(place - bogie, direction)
            columns.append((*direction, about, about if i else 0.0))
        bear, draw = np.zeros(6), np.zeros(6)
        bear[2 * i], draw[2 * i + 1] = 1.0, 1.0
        limits += [-bear, draw - friction * bear, -draw - friction * bear, draw, -draw]
        room += [0.0, 0.0, 0.0, pull, pull]
    balance = np.array(columns).T
    loads = np.array((0.0, 1.0, center[0] - bogie[0], 0.0))
    return feasible(balance, loads, np.array(limits), np.array(room))


def feasible(balance, loads, limits, room):
    """True if balance·x = loads with limits·x ≤ room has a solution: tries the vertices of pairs of limits."""
    some = np.linalg.lstsq(balance, loads, rcond=None)[0]
    free = np.linalg.svd(balance)[2][4:].T
    across, left = limits @ free, room - limits @ some
    for pair in itertools.combinations(range(len(room)), 2):
        corner = across[list(pair)]
        if abs(np.linalg.det(corner)) > 1e-12:
            at = np.linalg.solve(corner, left[list(pair)])
            if (across @ at <= left + SLACK).all():
                return True
    return False


def highest(torque, climbs=NAMES, most=1.0):
    """Highest step that each of the wheels can begin to climb, m."""
    low, high = 0.0, most
    for _ in range(40):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if all(can_climb(n, middle, torque) for n in climbs) else (low, middle)
    return low


def needed(name, height, friction=model.FRICTION, ahead=0.0, most=500.0, halvings=40):
    """Least torque of each motor with which a wheel can leave the ground, N·m; `most` if none suffices."""
    low, high = 0.0, most
    for _ in range(halvings):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if can_climb(name, height, middle, friction, ahead) else (middle, high)
    return high

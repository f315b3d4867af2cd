"""Insertion of a peg on a compliant support: force of the feed against depth, in closed form.

After D. E. Whitney, Quasi-static assembly of compliantly supported rigid parts (1982): a support that is soft across
and about its centre of compliance, a peg that slides in slowly, and pushes with friction at the places that touch. All
is linear in these pushes, so each phase is a system of one or two equations. What the contact springs give is in it.

The hole's axis is z, and z = 0 where the chamfer ends. Places are (x, z) in the plane of offset and tilt.
"""

from dataclasses import dataclass

import numpy as np
from dimensions import ACROSS, FRICTION, HOLE, OFFSET, RADIUS, SLOPE, STIFFNESS, TILT, TURN

SPRING = STIFFNESS / 2  # N/m of one end of the peg


@dataclass(frozen=True)
class Support:
    centre: float  # m from the tip up to the centre of compliance
    offset: float = OFFSET
    tilt: float = TILT


def moved(support, pushes, lean):
    """Position of the tip and tilt of the peg, for forces (x, z) at points (x and height from the tip).

    `lean` as last found: it says how far beside the tip the centre of compliance is.
    """
    across, turn = 0.0, 0.0
    for (x, height), (force, lift) in pushes:
        across += force / ACROSS
        # A rotation moves a point above the centre sideways, and one beside it down.
        turn += (force * (height - support.centre) - lift * (x - lean * support.centre)) / TURN
    new = support.tilt + turn
    return support.offset + support.tilt * support.centre + across - new * support.centre, new


def chamfer(z, lean):
    """Contact of the tip circle, on the side of the offset, with the chamfer: direction, position and depth of its force."""
    sine, cosine = np.sin(SLOPE), np.cos(SLOPE)
    direction = np.array([-cosine, sine]) + FRICTION * np.array([sine, cosine])
    rim = (RADIUS * np.cos(lean), -RADIUS * np.sin(lean))
    wall = HOLE + (z + rim[1]) * np.tan(SLOPE)
    return direction, rim, lambda tip, angle: (tip + rim[0] - wall) * cosine


def mouth(z, lean):
    """Contact of the peg's side with the edge of the hole; its force is normal to the side."""
    sine, cosine = np.sin(lean), np.cos(lean)
    place = (RADIUS - z * sine, -z)
    direction = np.array([-cosine, sine]) + FRICTION * np.array([sine, cosine])
    return direction, place, lambda tip, angle: tip - z * np.tan(angle) + RADIUS / np.cos(lean) - HOLE


def wall(z, lean):
    """Contact of the tip circle's other side with the wall."""
    place = (-RADIUS, RADIUS * np.sin(lean))
    return np.array([1.0, FRICTION]), place, lambda tip, angle: -HOLE - (tip - RADIUS * np.cos(lean))


def pushes(support, z, kinds):
    """Contact forces of these kinds in balance with the support and the contact springs, N."""
    lean = support.tilt
    for _ in range(20):  # how far the peg leans, in the sines and cosines
        places = [kind(z, lean) for kind in kinds]

        def gap(found, places=places, lean=lean):
            """Depth of each contact point less the deflection of its spring."""
            pushed = [(place, n * way) for n, (way, place, _) in zip(found, places)]
            tip, angle = moved(support, pushed, lean)
            return np.array([depth(tip, angle) - n / SPRING for n, (_, _, depth) in zip(found, places)])

        none, units = gap(np.zeros(len(kinds))), np.eye(len(kinds))
        found = np.linalg.solve(np.stack([none - gap(unit) for unit in units]).T, none)
        _, lean = moved(support, [(place, n * way) for n, (way, place, _) in zip(found, places)], lean)
    return found, lean, sum(n * way[1] for n, (way, _, _) in zip(found, places))


def insertion(support, z):
    """Phase, force of the feed and lean with the tip at the height z (below zero: in the hole)."""
    found, lean, force = pushes(support, z, [chamfer])
    if found[0] <= 0:
        return "free", 0.0, support.tilt
    if z - RADIUS * np.sin(lean) > 0:
        return "chamfer", force, lean
    found, lean, force = pushes(support, z, [mouth, wall])
    if (found > 0).all():
        return "two places", force, lean
    found, lean, force = pushes(support, z, [mouth])
    return "one place", force, lean


def second(support):
    """Depth from which two contacts exist (bisection)."""
    low, high = 0.003, 0.09
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if insertion(support, -middle)[0] == "two places" else (middle, high)
    return high


def jams(support, limit):
    """Depth at which a feed of that force stops, or None."""
    for depth in np.arange(0.002, 0.09, 1e-4):
        if insertion(support, -depth)[1] > limit:
            return float(depth)
    return None

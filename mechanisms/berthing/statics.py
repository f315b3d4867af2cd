"""Equilibrium of the module and its supports, from springs alone: an independent closed form of each part.

The module is rigid. Height z of the passive frame and small tilts about x and y are unknown; each part gives a force
along z at a place. Guides, friction and the arm are left out.
"""

import functools
import math

import numpy as np

import dimensions as d
import linkage
from dimensions import common

STOP = common.series(common.RING_STIFFNESS)
STANDOFF = common.series(common.STANDOFF_STIFFNESS)
TIP = common.series(d.TIP_STIFFNESS)
PLUNGER = common.series(d.PLUNGER_SPRING, TIP)
LATCH = common.series(common.LATCH_STIFFNESS)
EDGE = common.series(common.PADDLE_STIFFNESS)
SETTLED = 1e-15  # m and rad by which an equilibrium may still move
FULL = (1.0, 1.0, 1.0, 1.0)


def stop(z):
    return STOP * max(0.0, -z)


def standoff(z):
    return STANDOFF * max(0.0, common.STANDOFF_STROKE - z)


def plunger(z):
    return PLUNGER * max(0.0, common.PLUNGER_TIP_Z - common.FITTING_BOTTOM - z)


def paddle(z):
    """Force of a hinge spring whose edge, sunk in by F/k, touches the underside of the fitting, which pushes along z."""
    raised, force = math.radians(common.PADDLE_DEG), 0.0
    for _ in range(5):
        sine = (z + force / EDGE + common.FITTING_BOTTOM - common.HINGE[2]) / common.PADDLE_LENGTH
        if sine >= math.sin(raised):
            return 0.0
        force = common.PADDLE_SPRING * (raised - math.asin(sine)) / (common.PADDLE_LENGTH * math.sqrt(1.0 - sine**2))
    return force


def paddle_energy(z):
    sine = (z + common.FITTING_BOTTOM - common.HINGE[2]) / common.PADDLE_LENGTH
    return 0.5 * common.PADDLE_SPRING * max(0.0, math.radians(common.PADDLE_DEG) - math.asin(min(1.0, sine))) ** 2


def latch(z, share, friction=0.0):
    """Force of a stalled motor: τ = F·(−dz/dθ + μ·|dr/dθ|) at the height of the roller, which is sunk in by F/k.

    r is the way of the point where the roller touches: friction holds it back where it slid in to the last.
    """
    force = 0.0
    for _ in range(20):
        height = z + common.FITTING_TOP + d.ROLLER_RADIUS - force / LATCH
        pose = linkage.pose(linkage.crank_at(height, 0.0, d.CRANK_MOST))
        slid = pose.roller_rate[0] + d.ROLLER_RADIUS * pose.coupler_rate
        force = share * d.STALL_TORQUE / (-pose.roller_rate[1] + friction * abs(slid))
    return force


def roller_radius(z):
    return linkage.pose(linkage.crank_at(z + common.FITTING_TOP + d.ROLLER_RADIUS, 0.0, d.CRANK_MOST)).roller[0]


def forces(state, shares):
    """(x, y, upward force on the module) of every part at (z, tilt about x, tilt about y)."""
    z, about_x, about_y = state

    def height(place):
        return z + about_x * place[1] - about_y * place[0]

    for azimuth in common.STANDOFF_AZIMUTHS:
        for radius, law in ((common.STOP_RADIUS, stop), (common.STANDOFF_RADIUS, standoff)):
            place = common.radial(radius, azimuth)
            yield place[0], place[1], law(height(place))
    for azimuth, share in zip(common.LATCH_AZIMUTHS, shares):
        place = common.radial(common.PLUNGER_RADIUS, azimuth)
        yield place[0], place[1], plunger(height(place))
        edge = common.HINGE[0] + common.PADDLE_LENGTH
        yield from line(edge, azimuth, common.PADDLE_HALF_WIDTH, EDGE, paddle, height)
        if share > 0.0:
            law = functools.partial(pulled, share)
            yield from line(roller_radius(z), azimuth, d.ROLLER_HALF_WIDTH, LATCH, law, height)


def pulled(share, z):
    return -latch(z, share)


def line(radius, azimuth, half, stiffness, law, height):
    """A radial roller or edge: its two ends share the force by their depths."""
    middle, turned = common.radial(radius, azimuth), math.radians(azimuth)
    whole = law(height(middle))
    for side in (-half, half):
        place = (middle[0] - side * math.sin(turned), middle[1] + side * math.cos(turned))
        yield *place, 0.5 * whole - 0.5 * stiffness * (height(place) - height(middle)) * (whole != 0.0)


def residual(state, shares):
    rows = np.array(list(forces(state, shares)))
    return np.array([rows[:, 2].sum(), rows[:, 1] @ rows[:, 2], -rows[:, 0] @ rows[:, 2]])


def rest(shares=FULL, start=1e-3):
    """Equilibrium (z, tilt about x, tilt about y), by Newton's method; `shares`: of the stall torque, by latch."""
    state = np.array([start, 0.0, 0.0])
    for _ in range(60):
        now, step = residual(state, shares), 1e-9
        slope = np.array([(residual(state + step * axis, shares) - now) / step for axis in np.eye(3)]).T
        move = np.linalg.solve(slope, -now)
        farthest = np.abs(move).max()
        if farthest < SETTLED:
            break
        state = state + move * min(1.0, 2e-3 / farthest)
    return state


def stored(z):
    """Energy of standoffs, plungers and paddles pushed down to a height, J."""
    deep = (max(0.0, common.STANDOFF_STROKE - z), max(0.0, common.PLUNGER_TIP_Z - common.FITTING_BOTTOM - z))
    return 8 * 0.5 * STANDOFF * deep[0] ** 2 + 4 * 0.5 * PLUNGER * deep[1] ** 2 + 4 * paddle_energy(z)

"""Closed forms: vanes as three grooves of two flanks, the opening, friction, arms as springs in series."""

import dimensions as d
import numpy as np
import rig

SINE, COSINE = np.sin(d.FLANK), np.cos(d.FLANK)


def lateral(name):
    """Unit vector across the groove of a vane."""
    return np.cross((0.0, 0.0, 1.0), rig.radial(name))


def flanks(missing=None):
    """(vane, position of the ball, normal) of each contact."""
    for i, name in enumerate(rig.VANES, 1):
        if i != missing:
            for side in (1.0, -1.0):
                normal = np.array([0.0, 0.0, COSINE]) - side * SINE * lateral(name)
                yield name, d.RADIUS * rig.radial(name), normal


def wrenches():
    """Force and moment about the origin of one newton at each flank, as columns."""
    return np.array([np.r_[normal, np.cross(place, normal)] for _, place, normal in flanks()]).T


def loads(load):
    """Force of each vane on its pin under a wrench about the origin, without friction: six equations, six unknowns."""
    given = np.linalg.solve(wrenches(), -np.asarray(load))
    if given.min() <= 0.0:
        raise ValueError("this load lifts a ball off a flank")
    normals = np.array([normal for _, _, normal in flanks()])
    return (given[:, None] * normals).reshape(3, 2, 3).sum(axis=1)


def shares(pull, beside):
    """Vertical load of each vane under a pull towards the platform at (x, y) beside the middle, N."""
    return np.array([pull * (1 + 2 * rig.radial(name)[:2] @ beside / d.RADIUS) / 3 for name in rig.VANES])


def sunk(pull, friction=0.0):
    """Displacement of the payload, m, with friction that resists it (positive) or has reversed (negative)."""
    return pull / (6 * d.STIFFNESS * COSINE * (COSINE + friction * SINE))


def band():
    """Displacement from the seat that friction can hold per newton of pull: sideways m/N, about the axis of the pull rad/N.

    About the axis: both flanks of each vane slip. Sideways, an upper bound: all friction there is, against the flanks.
    """
    mu, k = d.FRICTION, d.STIFFNESS
    sideways = mu / (COSINE - mu * SINE) / (3 * k * SINE**2)
    turned = mu / (6 * k * SINE**2 * (1 + mu**2)) / d.RADIUS
    return sideways, turned


def slipped(pull, moment):
    """Rotation about the axis of a pull under a moment at which all flanks slip.

    Of a vane with the pull P and the side force L both flanks slip the same way; then N2 − N1 = (L − μP)/(sinβ·(1 + μ²)).
    """
    mu = d.FRICTION
    beside = moment / (3 * d.RADIUS) - mu * pull / 3
    return beside / (2 * d.STIFFNESS * SINE**2 * (1 + mu**2)) / d.RADIUS


def surely_in():
    """Share of the opening from which the edge of a crest pushes a ball inwards against friction."""
    return 1.0 - d.PIN * d.FRICTION / np.hypot(1.0, d.FRICTION) / d.OPENING


def out_of_line(offset, yaw):
    """Largest offset of a pin from its groove, relative to half of the opening."""
    turn = rig.rotation((0.0, 0.0, yaw))
    beside = [
        lateral(name) @ (turn @ (d.RADIUS * rig.radial(name)) + (*offset, 0.0)) / d.OPENING for name in rig.VANES
    ]
    return max(map(abs, beside))


def series(first, second, off):
    """Wrench of the second arm about the mass centre for a commanded displacement `off`: springs in series."""
    compliance = np.linalg.inv(about_center(first)) + np.linalg.inv(about_center(second))
    return np.linalg.solve(compliance, off)


def about_center(h):
    """Stiffness of an arm for motions of the mass centre."""
    moves = motion(np.array(h.fixture) - d.CENTER)
    return moves.T @ np.diag(h.stiffness) @ moves


def motion(arm):
    """Small motions of a point at `arm` from those of the mass centre."""
    moves = np.eye(6)
    moves[:3, 3:] = -np.cross(np.eye(3), arm)
    return moves


def released_speed(h, force):
    """Largest speed after the other arm lets go while this one has `force` along x: one damped spring, m/s."""
    k, c = h.stiffness[0], h.damping[0]
    rate = np.sqrt(k / d.MASS)
    ratio = c / (2 * d.MASS * rate)
    return force / k * rate * np.exp(-ratio * np.arccos(ratio) / np.sqrt(1 - ratio**2))


def tilt_on_two(h, pull, missing):
    """Payload on two vanes, held by an arm: rotation about the line of both pins, and the load of both along z.

    Two motions are free: that turn, and one about the axis along z that is 2·R from the middle, in which both balls
    slide along their grooves. The arm's stiffness balances the pull, and so does the claw's, as long as both ends of the
    bar touch it, each with half of a contact's spring. The bar is square to the line if the first pin is missing.
    """
    away = rig.radial(rig.VANES[missing - 1])
    axis, pivot = np.cross((0.0, 0.0, 1.0), away), -d.RADIUS / 2 * away
    about = [(axis, pivot), (np.array((0.0, 0.0, 1.0)), -2.0 * d.RADIUS * away)]
    moves = np.array([np.r_[np.cross(w, np.array(h.fixture) - at), w] for w, at in about]).T
    stiffness = moves.T @ (np.array(h.stiffness)[:, None] * moves)
    stiffness[0, 0] += d.STIFFNESS * d.BAR_HALF**2
    turns = np.linalg.solve(stiffness, (axis @ np.cross(-pivot, (0.0, 0.0, -pull)), 0.0))
    if abs(turns[0]) * d.BAR_HALF >= pull / d.STIFFNESS:
        raise ValueError("one end of the bar leaves the claw")
    return abs(turns[0]), pull + h.stiffness[2] * moves[2] @ turns

"""Closed-form statics: the box between its rails, the wedged box at the mouth, the cone in its jaws.

x is the way in, y to the left; moments are about z. A push on the box is along x.
"""

import math

import dimensions as d
import numpy as np

# --- the box between its rails: Whitney's parallelogram ------------------------------------------------------------------


def parallelogram(across, moment):
    """Load factor, 1 on the sides: `across` = Fy/Fx, `moment` = M/Fx in m, about the middle of the box.

    Loads on one side: |Fy|·μ < Fx. Loads on two opposite corners: N₁ + N₂ = (2/l)·|M + μ·(w/2)·Fy|, and μ·(N₁ + N₂) < Fx.
    """
    opposite = abs(moment + d.FRICTION * d.WIDTH / 2 * across) * 2 * d.FRICTION / d.BETWEEN
    return max(abs(across) * d.FRICTION, opposite)


def resistance(across, moment):
    """Load factor from balance: friction over Fx at the two corners that can balance the loads."""
    half_length, half_width = d.BETWEEN / 2, d.WIDTH / 2
    places = [(x, side) for side in (1, -1) for x in (half_length, -half_length)]
    found = []
    for pair in ((0, 1), (2, 3), (0, 3), (1, 2)):
        columns = [(side, side * (x - d.FRICTION * half_width)) for x, side in (places[i] for i in pair)]
        pushes = np.linalg.solve(np.array(columns).T, [across, moment])
        if (pushes >= -1e-12).all():
            found.append(d.FRICTION * pushes.sum())
    return min(found)


# --- the box at the mouth, turned to the left: its left front corner and the right mouth hold it ------------------------------


def second_touch(tilt):
    """Depth of the front corners at which a turned box makes its second contact: W·cos θ − l·sin θ = w."""
    return (d.GAP * math.cos(tilt) - d.WIDTH) / math.sin(tilt)


def tilt_at(depth, push=0.0):
    """Tilt for a depth of the second contact; under a push, the contact depths, on two springs each, widen the gap."""
    gap = d.GAP + push / d.STIFFNESS
    low, high = 0.0, 0.5 * math.atan2(gap, depth)
    for _ in range(60):
        middle = 0.5 * (low + high)
        open_still = gap * math.cos(middle) - depth * math.sin(middle) > d.WIDTH
        low, high = (middle, high) if open_still else (low, middle)
    return low


def wedge(depth, tilt, offset, friction=d.FRICTION):
    """(F/N, M/N) while the box slides: the push F at `offset` to the right of the middle of the rear, and the moment M of the
    wrist, over the force N at the mouth. With M/N below zero no push moves a box that nothing turns back: it jams.
    """
    sine, cosine = math.sin(tilt), math.cos(tilt)
    mouth_force = np.array((-sine - friction * cosine, cosine - friction * sine))
    push = friction * mouth_force[1] - mouth_force[0]
    corner = np.array((depth, d.GAP / 2))
    mouth = np.array((-d.ROUNDING * sine, -d.GAP / 2 - d.ROUNDING * (1 - cosine)))
    along, aside = -(d.LENGTH - d.ROUNDING), -(d.WIDTH / 2 - d.ROUNDING + offset)
    lever = -d.ROUNDING + sine * along + cosine * aside
    arm = mouth - corner
    return push, push * lever - (arm[0] * mouth_force[1] - arm[1] * mouth_force[0])


def jams_from(tilt, friction=d.FRICTION, turning=d.ARM_TURNING):
    """Offset from which a box held at this tilt jams at its second contact.

    A force N at the mouth sinks in and turns the box further by N·give; the wrist then turns it back with K·N·give (K: `turning`).
    So the limit is not at M/N = 0, but at M/N = −K·give.
    """
    depth = second_touch(tilt)
    give = math.cos(tilt) / (d.GAP * math.sin(tilt) + depth * math.cos(tilt)) / d.STIFFNESS
    (_, at_zero), (_, at_one) = (wedge(depth, tilt, offset, friction) for offset in (0.0, 1.0))
    return (at_zero + turning * give) / (at_zero - at_one)


def turning_back(depth, tilt):
    """Rate at which the mouth turns a box that enters at the speed of the arm, rad/s."""
    return -d.SPEED * math.sin(tilt) / (d.GAP * math.sin(tilt) + depth * math.cos(tilt))


def feed(depth, tilt_held, offset):
    """Push that slides the box with the wrist's spring and damper commanded to `tilt_held`, including the depths of
    both contacts."""
    mouth = 0.0
    for _ in range(100):
        tilt = tilt_at(depth, mouth)
        push, moment = wedge(depth, tilt, offset)
        wrist = d.ARM_TURNING * (tilt_held - tilt) - d.ARM_TURNING_DAMPING * turning_back(depth, tilt)
        mouth = 0.5 * (mouth + wrist / moment)
    return push * mouth


# --- the cone in its jaws -------------------------------------------------------------------------------------------------


def pull_out(slope):
    """Force that pulls the cone out of two jaws, each pushed by a stalled motor: 2·S·tan(ρ − α)."""
    return 2 * d.JAW_STALL * math.tan(math.atan(d.GRIP_FRICTION) - slope)


def push_in(slope):
    """Force that drives it in against the motors: 2·S·tan(ρ + α)."""
    return 2 * d.JAW_STALL * math.tan(math.atan(d.GRIP_FRICTION) + slope)


def spring():
    """Force of both contacts of the connector when the box is home."""
    return 2 * d.SPRING_STIFFNESS * d.SPRING_STROKE

"""Holder of the module: a six-axis spring and damper at the grapple point, toward a commanded pose.

Replaceable: whoever brings a real arm gives these three pieces of MJCF and a function with the meaning of `command`.
"""

import math

from dimensions import ARM_DAMPING, ARM_STIFFNESS, common
from kit import mjcf

GROUP = 1  # of its actuators: disabling this group makes the arm limp
AXES = ("x", "y", "z", "roll", "pitch", "yaw")


def in_world():
    """Site of the grapple point in the berthed module."""
    return f'<site name="arm" pos="{mjcf.numbers(common.GRAPPLE)}"/>'


def on_module():
    return f'<site name="grapple" pos="{mjcf.numbers(common.GRAPPLE)}"/>'


def actuators():
    """Controls are the commanded pose of the grapple point, m and rad, relative to its pose in the berthed module."""
    return "".join(
        f'<general name="arm_{name}" site="grapple" refsite="arm" group="{GROUP}" gear="{_axis(i)}" gaintype="fixed" '
        f'gainprm="{k:.12g}" biastype="affine" biasprm="0 {-k:.12g} {-c:.12g}"/>'
        for i, (name, k, c) in enumerate(zip(AXES, ARM_STIFFNESS, ARM_DAMPING))
    )


def _axis(i):
    return mjcf.numbers([float(i == k) for k in range(6)])


def command(offset, turn, gap):
    """The six controls that hold the passive frame at (x, y, gap), turned by a rotation vector."""
    moved = turned(turn, common.GRAPPLE)
    shift = [m - g for m, g in zip(moved, common.GRAPPLE)]
    return [offset[0] + shift[0], offset[1] + shift[1], gap + shift[2], *turn]


def quaternion(turn):
    angle = math.sqrt(sum(x * x for x in turn))
    share = 0.5 if angle == 0.0 else math.sin(angle / 2) / angle
    return (math.cos(angle / 2), *(share * x for x in turn))


def turned(turn, vector):
    """A vector turned by a rotation vector (Rodrigues)."""
    angle = math.sqrt(sum(x * x for x in turn))
    if angle == 0.0:
        return tuple(vector)
    k = [x / angle for x in turn]
    cross = (
        k[1] * vector[2] - k[2] * vector[1],
        k[2] * vector[0] - k[0] * vector[2],
        k[0] * vector[1] - k[1] * vector[0],
    )
    along = sum(a * b for a, b in zip(k, vector)) * (1.0 - math.cos(angle))
    return tuple(v * math.cos(angle) + c * math.sin(angle) + a * along for v, c, a in zip(vector, cross, k))

"""Kinematics of a leg in closed form: yaw of the coxa, elevations of femur and tibia, for a place of its foot."""

import math

import dimensions as d


def hip(i):
    """Position of a hip in the body."""
    return d.HIPS * math.cos(d.AZIMUTHS[i]), d.HIPS * math.sin(d.AZIMUTHS[i])


def neutral(i, height=d.HEIGHT):
    """Neutral position of a foot below the body."""
    return d.STANCE * math.cos(d.AZIMUTHS[i]), d.STANCE * math.sin(d.AZIMUTHS[i]), -height


def angles(i, place):
    """Joint angles that bring foot `i` to a position in the body, knee up; None out of reach.

    In the plane of femur and tibia the law of cosines gives the knee, and two arc tangents the femur.
    """
    x0, y0 = hip(i)
    cos, sin = math.cos(d.AZIMUTHS[i]), math.sin(d.AZIMUTHS[i])
    ahead, across = cos * (place[0] - x0) + sin * (place[1] - y0), cos * (place[1] - y0) - sin * (place[0] - x0)
    out, up = math.hypot(ahead, across) - d.COXA, place[2]
    cosine = (out * out + up * up - d.FEMUR**2 - d.TIBIA**2) / (2.0 * d.FEMUR * d.TIBIA)
    if abs(cosine) > 1.0:
        return None
    knee = -math.acos(cosine)
    femur = math.atan2(up, out) - math.atan2(d.TIBIA * math.sin(knee), d.FEMUR + d.TIBIA * math.cos(knee))
    return math.atan2(across, ahead), femur, knee


def all_angles(places):
    """All eighteen joint angles, leg by leg."""
    found = [angles(i, place) for i, place in enumerate(places)]
    if None in found:
        raise ValueError(f"leg {found.index(None)} does not reach {places[found.index(None)]}")
    return [angle for three in found for angle in three]

"""Vectors, planes and convex pieces for the build scripts of models; standard library only.

Convex pieces are given as half spaces n·x <= d, so that a piece says what it is (a wall, a slope, a rim) and its
vertices follow. All coordinates are rounded to a nanometre: the same script gives the same numbers everywhere, and
vertices that two pieces share are equal to the last bit, as the engine wants them.
"""

import itertools
import math

ROUNDING = 9  # decimal places of a metre
TOUCHES = 1e-9  # a vertex lies on a plane within this distance, m


# --- vectors -----------------------------------------------------------------------------------------------------

def add(a, b):
    return tuple(x + y for x, y in zip(a, b))


def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def scaled(a, s):
    return tuple(x * s for x in a)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    return scaled(a, 1.0 / math.sqrt(dot(a, a)))


def on_circle(radius, azimuth_deg, z=0.0):
    a = math.radians(azimuth_deg)
    return (radius * math.cos(a), radius * math.sin(a), z)


def quaternion_of_axes(x, y, z):
    """Quaternion (w, x, y, z) of the frame whose unit axes are given, largest component first for accuracy."""
    m = ((x[0], y[0], z[0]), (x[1], y[1], z[1]), (x[2], y[2], z[2]))
    squares = (
        1 + m[0][0] + m[1][1] + m[2][2],
        1 + m[0][0] - m[1][1] - m[2][2],
        1 - m[0][0] + m[1][1] - m[2][2],
        1 - m[0][0] - m[1][1] + m[2][2],
    )
    first = max(range(4), key=lambda i: squares[i])
    big = math.sqrt(squares[first]) / 2
    off = 4 * big
    q = {
        0: (big, (m[2][1] - m[1][2]) / off, (m[0][2] - m[2][0]) / off, (m[1][0] - m[0][1]) / off),
        1: ((m[2][1] - m[1][2]) / off, big, (m[1][0] + m[0][1]) / off, (m[0][2] + m[2][0]) / off),
        2: ((m[0][2] - m[2][0]) / off, (m[1][0] + m[0][1]) / off, big, (m[2][1] + m[1][2]) / off),
        3: ((m[1][0] - m[0][1]) / off, (m[0][2] + m[2][0]) / off, (m[2][1] + m[1][2]) / off, big),
    }[first]
    return q if q[0] >= 0 else scaled(q, -1.0)


# --- planes and convex pieces --------------------------------------------------------------------------------------

def plane(normal, through):
    """Half space behind the plane through a point; `normal` points out of the solid."""
    n = unit(normal)
    return (n, dot(n, through))


def plane_through(a, b, c, inside):
    """Half space bounded by three points that holds `inside`."""
    n = unit(cross(sub(b, a), sub(c, a)))
    if dot(n, sub(inside, a)) > 0:
        n = scaled(n, -1.0)
    return (n, dot(n, a))


def meet(p, q, r):
    """Intersection of three planes; None if it is not a single point."""
    c = cross(q[0], r[0])
    determinant = dot(p[0], c)
    if abs(determinant) < 1e-9:
        return None
    sum_ = add(add(scaled(c, p[1]), scaled(cross(r[0], p[0]), q[1])), scaled(cross(p[0], q[0]), r[1]))
    return scaled(sum_, 1.0 / determinant)


def rounded(a):
    return tuple(round(x, ROUNDING) + 0.0 for x in a)


def solid(half_spaces):
    """Vertices and faces (counter-clockwise seen from outside, in the order of the half spaces) of a convex piece."""
    vertices = []
    for three in itertools.combinations(half_spaces, 3):
        point = meet(*three)
        if point is None or any(dot(n, point) > d + TOUCHES for n, d in half_spaces):
            continue
        point = rounded(point)
        if all(max(abs(x) for x in sub(point, other)) > 2 * TOUCHES for other in vertices):
            vertices.append(point)
    vertices.sort()
    faces = [face_outline(vertices, n, d) for n, d in half_spaces]
    bad = [i for i, face in enumerate(faces) if len(face) < 3]
    if bad:
        raise ValueError(f"the half spaces {bad} bound nothing")
    return vertices, faces


def face_outline(vertices, normal, offset):
    corners = [i for i, v in enumerate(vertices) if abs(dot(normal, v) - offset) < 4 * TOUCHES]
    if len(corners) < 3:
        return corners
    middle = scaled(tuple(map(sum, zip(*(vertices[i] for i in corners)))), 1.0 / len(corners))
    east = unit(sub(vertices[corners[0]], middle))
    north = cross(normal, east)
    angle = {i: math.atan2(dot(north, sub(vertices[i], middle)), dot(east, sub(vertices[i], middle))) for i in corners}
    turn = sorted(corners, key=lambda i: angle[i])
    first = turn.index(min(turn))
    return turn[first:] + turn[:first]

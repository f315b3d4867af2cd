"""Closed meshes made by formulas, for checks without a network; standard library only."""

import math


def extruded(outline, height):
    """Prism over a star-shaped outline around the origin, counter-clockwise from above: a fan at each end."""
    count = len(outline)
    vertices = [(x, y, z) for z in (0.0, height) for x, y in outline] + [(0.0, 0.0, 0.0), (0.0, 0.0, height)]
    triangles = []
    for i in range(count):
        j = (i + 1) % count
        triangles += [(i, j, count + j), (i, count + j, count + i)]
        triangles += [(j, i, 2 * count), (count + i, count + j, 2 * count + 1)]
    return vertices, triangles


def star(points, outer, inner, height):
    radii = [outer if i % 2 == 0 else inner for i in range(2 * points)]
    angles = [math.pi * i / points for i in range(2 * points)]
    return extruded([(r * math.cos(a), r * math.sin(a)) for r, a in zip(radii, angles)], height)


def ell(size, thick, height):
    corner = thick / 2
    outline = [(-corner, -corner), (size, -corner), (size, corner), (corner, corner), (corner, size), (-corner, size)]
    return extruded(outline, height)


def grid(rows, columns, place, closed):
    """Triangles of a grid that is periodic in its columns and, if `closed`, in its rows."""
    vertices = [place(i, j) for i in range(rows) for j in range(columns)]
    triangles = []
    for i in range(rows if closed else rows - 1):
        for j in range(columns):
            a, b = i * columns + j, i * columns + (j + 1) % columns
            c, d = ((i + 1) % rows) * columns + j, ((i + 1) % rows) * columns + (j + 1) % columns
            triangles += [(a, b, d), (a, d, c)]
    return vertices, triangles


def torus(radius, tube, around, across):
    def place(i, j):
        a, b = 2 * math.pi * j / around, 2 * math.pi * i / across
        r = radius + tube * math.cos(b)
        return (r * math.cos(a), r * math.sin(a), tube * math.sin(b))

    return grid(across, around, place, True)


def dented(radius, rows, columns):
    """A sphere with a dent at its top."""
    def place(i, j):
        up, around = math.pi * ((i + 1) / (rows + 1) - 0.5), 2 * math.pi * j / columns
        r = radius * (1 - 0.5 * math.exp(-(((math.pi / 2 - up) / 0.5) ** 2)))
        return (r * math.cos(up) * math.cos(around), r * math.cos(up) * math.sin(around), r * math.sin(up))

    vertices, triangles = grid(rows, columns, place, False)
    low, high = len(vertices), len(vertices) + 1
    vertices += [(0.0, 0.0, -radius), (0.0, 0.0, 0.5 * radius)]
    for j in range(columns):
        k, last = (j + 1) % columns, (rows - 1) * columns
        triangles += [(k, j, low), (last + j, last + k, high)]
    return vertices, triangles


def meshes():
    """Name -> vertices in m and triangles."""
    return {
        "prism": star(4, 0.05, 0.05 * math.cos(math.pi / 4), 0.06),
        "star": star(5, 0.06, 0.025, 0.02),
        "ell": ell(0.06, 0.02, 0.03),
        "torus": torus(0.04, 0.012, 16, 8),
        "dented": dented(0.04, 9, 16),
    }

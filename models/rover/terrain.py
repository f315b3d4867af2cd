"""The ground: a smooth relief from seeded numbers, and rocks on it.

Made of whole-number mixing, sums, products, quotients and square roots only, which are the same on every machine.
"""

import math

from dimensions import *  # noqa: F403

SEED = 20
HEIGHT_ROUNDING = 4  # decimal places of a metre, of the mesh
PAD = (-1.0, 1.0)  # level up to the first x; all of the relief from the second on
SINKS = 0.3  # share of a rock's half height that is below the ground


def number(*keys):
    """A pseudo-random number from 0 to 1 that depends on integers only."""
    mixed = SEED
    for key in keys:
        mixed = (mixed ^ (key & 0xFFFFFFFF)) * 0x9E3779B1 & 0xFFFFFFFF
        mixed = (mixed ^ (mixed >> 15)) * 0x85EBCA6B & 0xFFFFFFFF
        mixed ^= mixed >> 13
    return mixed / 2**32


def eased(t):
    """Smooth step from 0 to 1 with zero slope at the ends, twice differentiable."""
    t = min(max(t, 0.0), 1.0)
    return t * t * t * (t * (t * 6 - 15) + 10)


def waves(x, y, octave):
    """Smooth noise from -1/2 to 1/2: random values at the corners of unit squares, interpolated between them."""
    i, j = math.floor(x), math.floor(y)
    a, b = eased(x - i), eased(y - j)
    near = number(octave, i, j) * (1 - a) + number(octave, i + 1, j) * a
    far = number(octave, i, j + 1) * (1 - a) + number(octave, i + 1, j + 1) * a
    return near * (1 - b) + far * b - 0.5


def height(x, y):
    """Height of the smooth relief, m."""
    relief = sum(tall * waves(x / long, y / long, k) for k, (long, tall) in enumerate(OCTAVES))
    return relief * eased((x - PAD[0]) / (PAD[1] - PAD[0]))


def mesh():
    """Vertices and triangles of the relief, in squares of CELL cut into two."""
    columns = round((TERRAIN_X[1] - TERRAIN_X[0]) / CELL) + 1
    rows = round((TERRAIN_Y[1] - TERRAIN_Y[0]) / CELL) + 1
    vertices = []
    for i in range(columns):
        for j in range(rows):
            x, y = TERRAIN_X[0] + i * CELL, TERRAIN_Y[0] + j * CELL
            vertices.append((x, y, round(height(x, y), HEIGHT_ROUNDING)))
    triangles = []
    for i in range(columns - 1):
        for j in range(rows - 1):
            corner = i * rows + j
            triangles.append((corner, corner + rows, corner + rows + 1))
            triangles.append((corner, corner + rows + 1, corner + 1))
    return vertices, triangles


# --- rocks -------------------------------------------------------------------------------------------------------------

def places(count, kind, reach, taken):
    """Seeded positions for rocks, with their sizes, at least the sum of both radii apart."""
    found, tried = [], 0
    while len(found) < count:
        tried += 1
        x = PAD[1] + 0.5 + number(kind, tried, 1) * (TERRAIN_X[1] - PAD[1] - 1.0)
        y = TERRAIN_Y[0] + 0.5 + number(kind, tried, 2) * (TERRAIN_Y[1] - TERRAIN_Y[0] - 1.0)
        u = number(kind, tried, 3)
        size = reach[0] + (reach[1] - reach[0]) * u * u * u  # many small, few large
        if abs(y) < LANE_HALF_WIDTH + size:
            size = min(size, LANE_ROCK)
        if all((x - p) ** 2 + (y - q) ** 2 > (1.5 * (size + s)) ** 2 for p, q, s, _ in taken + found):
            found.append((x, y, size, tried))
    return found


FACETS = [(s * (k == 0), s * (k == 1), s * (k == 2)) for k in range(3) for s in (-1, 1)]
CORNERS = [(a, b, c) for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)]


def rock(x, y, size, seed):
    """Half spaces of a rock of fourteen facets, an irregular cube with cut corners that stands `size` above the ground."""
    axes = [size * (1.0 + 0.5 * number(5, seed, k)) for k in range(2)] + [size / (1.0 - SINKS) / 1.05]
    middle = (x, y, height(x, y) - SINKS * axes[2])
    half_spaces = []
    for facet, (direction, far) in enumerate([(n, 1.0) for n in FACETS] + [(n, 1.3) for n in CORNERS]):
        crooked = [n + 0.24 * (number(6, seed, facet, k) - 0.5) for k, n in enumerate(direction)]
        length = math.sqrt(sum(n * n for n in crooked))
        offset = far * (0.95 + 0.1 * number(7, seed, facet))
        normal = [n / length / axis for n, axis in zip(crooked, axes)]
        length = math.sqrt(sum(n * n for n in normal))
        unit = tuple(n / length for n in normal)
        half_spaces.append((unit, offset / length + sum(n * m for n, m in zip(unit, middle))))
    return half_spaces


def boulder(x, y, size):
    """Middle and radius of a sphere that stands `size` above the ground."""
    radius = round(size / (1.0 - SINKS), HEIGHT_ROUNDING)
    middle = (x, y, height(x, y) + size - radius)
    return tuple(round(c, HEIGHT_ROUNDING) for c in middle), radius

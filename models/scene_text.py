"""Text of scene files (docs/scene_format.md), quaternions and smooth paths: for the scenes.py of models."""

import math

UPRIGHT = (1.0, 0.0, 0.0, 0.0)
DIGITS = 12  # decimal places


# --- numbers ----------------------------------------------------------------------------------------------------------

def numbers(values):
    return "(" + ", ".join(repr(round(float(x), DIGITS) + 0.0) for x in values) + ")"


def about_axis(axis, angle_deg):
    """Quaternion (w, x, y, z) of a turn about x (0), y (1) or z (2)."""
    half = math.radians(angle_deg) / 2
    return (math.cos(half), *(math.sin(half) * float(i == axis) for i in range(3)))


def product(p, q):
    """Product of two quaternions: the rotation q, then p."""
    return (
        p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
        p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
        p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
        p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0],
    )


def turned(q, v):
    """A vector from the axes of a body to the common ones."""
    inverse = (q[0], -q[1], -q[2], -q[3])
    return product(product(q, (0.0, *v)), inverse)[1:]


# --- paths: rows (time, position, orientation) of a prescribed motion -------------------------------------------------

def smooth(t):
    """Smooth step from 0 to 1 with no speed and no acceleration at either end."""
    return t**3 * (10 - 15 * t + 6 * t**2)


def glide(times, row, steps):
    """Rows between two times; `row` gives position and orientation from 0 to 1. The path rests for a second around
    them: the motion's curve takes its speed from the neighbours of a row, and would overshoot a long rest."""
    start, end = times
    rows = [(round(start + i / steps * (end - start), 9), *row(smooth(i / steps))) for i in range(steps + 1)]
    return [(start - 1.0, *row(0.0)), *rows, (end + 1.0, *row(1.0))]


def joined(*ways):
    """Paths in sequence; where one ends as the next begins, there is no rest."""
    rows = []
    for way in ways:
        rows = [row for row in rows if row[0] < way[1][0]] + (way if not rows or rows[-1][0] < way[0][0] else way[1:])
    return rows


def stroke(place, orientation, travel, speed):
    """Rows of a path of this length: at rest for a second, up to speed within two, steady, to rest within two. `place`
    gives the position at a length of it."""
    even = (travel - 4 * speed) / speed  # seconds of even motion behind t = 4
    stops = ((0.0, 0.0), (1.0, 0.0), (3.0, speed), (4.0, 2 * speed), (4.0 + even, travel - 2 * speed))
    stops += ((5.0 + even, travel - speed), (7.0 + even, travel), (8.0 + even, travel))
    return [(round(time, 9), place(way), orientation) for time, way in stops]


def table(rows):
    return ", ".join(f"(time: {time!r}, position: {numbers(p)}, orientation: {numbers(q)})" for time, p, q in rows)


# --- scenes ----------------------------------------------------------------------------------------------------------

def spring(first, second, stiffness, damping):
    return f"(first: {first}, second: {second}, stiffness: {numbers(stiffness)}, damping: {numbers(damping)}),"


def on(body, position=None, orientation=None):
    given = [f'body: "{body}"']
    given += [] if position is None else [f"position: {numbers(position)}"]
    given += [] if orientation is None else [f"orientation: {numbers(orientation)}"]
    return f"On({', '.join(given)})"


def scene(name, about, models, objects, pairs, duration, record_every, loads=(), springs=(), step="1e-3"):
    """`models` are names of files beside the scene, without their ending; `objects`, `loads`, `springs` are lines, `step` as
    it is to be written, s."""
    lines = [f"// {line}" for line in about]
    lines += ["(", '    format: "pong-scene",', "    version: 1,", f'    name: "{name}",']
    lines += ["    models: { " + ", ".join(f'"{model}": "{model}.ron"' for model in models) + " },"]
    lines += _block("objects", objects)
    lines += ["    pairs: [" + ", ".join(f'("{first}", "{second}")' for first, second in pairs) + "],"]
    lines += _block("loads", loads) + _block("springs", springs)
    lines += ["    integrator: RungeKutta4,", f"    step: {step},", f"    duration: {duration!r},"]
    lines += [f"    record_every: {record_every},", "    ledger: true,", ")"]
    return "\n".join(lines) + "\n"


def _block(name, lines):
    return [f"    {name}: ["] + ["        " + line for line in lines] + ["    ],"] if lines else []

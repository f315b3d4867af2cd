#!/usr/bin/env python3
"""Writes the retention latches of models/payload_retention as plain solids: bay.ron, payload.ron, arm.ron and the scenes.

    python3 make.py [FOLDER]

Standard library only. Dimensions, surfaces, guides, claws, jaws, plungers and scenes are those of the marked model;
this script only gives the bay `contact: Solid` and replaces the spheres and segments of the payload by convex pieces.
"""

import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
MARKED = HERE.parent / "payload_retention"
sys.path[:0] = [str(MARKED), str(HERE.parent)]
import geometry as g  # noqa: E402
import scenes  # noqa: E402
from dimensions import *  # noqa: E402, F403

SIDES = 8  # of a pin: flat below, above, at both sides and at 45°, where floor, claw, walls and flares touch it
PIN_HALF_WIDTH = 0.020  # along the pin's axis: the part that a spherical bearing would hold
# Area, m², over which a pin has the stiffness of the marked model. A flat goes in by CLAW_BITE/2; the sides at 45° beside it
# then add half of that depth each to its mean width.
FLAT = (2 * PIN_RADIUS * math.tan(math.pi / SIDES) + CLAW_BITE / 2) * 2 * PIN_HALF_WIDTH
SCUFF_THICKNESS = SCUFF_RADIUS - SCUFF_FLAT_RADIUS  # the flange at 45° ends where the plate does
KEEL_PIN_TOP = 0.060  # above the middle of the keel latch, as far as the round end is below it


# --- text --------------------------------------------------------------------------------------------------------------

def vector(v):
    return "(" + ", ".join(repr(round(x, 9) + 0.0) for x in v) + ")"


def polyhedron(name, half_spaces):
    vertices, faces = g.solid(half_spaces)
    outlines = ", ".join("[" + ", ".join(map(str, face)) + "]" for face in faces)
    return f'Polyhedron(name: "{name}", vertices: [{", ".join(map(vector, vertices))}], faces: [{outlines}])'


def ring(radius, across=(0.0, 0.0, 1.0), along=(1.0, 0.0, 0.0), lean=0.0, axis=(0.0, 1.0, 0.0)):
    """Half spaces of a regular prism around the origin with the distance `radius` from its axis to its sides. `lean` turns
    all normals towards `axis`, by an angle in rad: then the sides are those of a pyramid."""
    for index in range(SIDES):
        angle = 2 * math.pi * index / SIDES
        outward = g.add(g.scaled(across, math.cos(angle)), g.scaled(along, math.sin(angle)))
        yield (g.add(g.scaled(outward, math.cos(lean)), g.scaled(axis, math.sin(lean))), radius * math.cos(lean))


# --- payload -----------------------------------------------------------------------------------------------------------

def pin():
    ends = [((0.0, end, 0.0), PIN_HALF_WIDTH) for end in (-1.0, 1.0)]
    return polyhedron("barrel", [*ring(PIN_RADIUS), *ends])


def scuff_plate(side):
    """Plate with a flange at 45° around it; `side`: -1 port, 1 starboard. Its face looks outboard."""
    face = -side * PIN_LENGTH / 2
    outboard = (0.0, float(side), 0.0)
    sides = [(n, d + face * n[1]) for n, d in ring(SCUFF_FLAT_RADIUS, lean=math.pi / 4, axis=outboard)]
    ends = [(outboard, side * face), (g.scaled(outboard, -1.0), -side * face + SCUFF_THICKNESS)]
    return polyhedron("plate", [*sides, *ends])


def trunnion(name):
    x, side = LATCHES[name]
    plunger = (
        f'Ray(name: "plunger", surface: "plunger", origin: (0.0, 0.0, 0.0), direction: (0.0, 0.0, -1.0), '
        f"length: {round(PIN_RADIUS + PLUNGER_STROKE, 9)}, response: Axial)"
    )
    parts = (("pin", pin()), ("scuff_plate", scuff_plate(side)), ("ready_to_latch", plunger))
    lines = [f'(name: "trunnion_{name}", pose: (position: {vector((x, side * SILL_Y, 0.0))}), groups: [']
    lines += [f'    (name: "{part}", primitives: [{text}]),' for part, text in parts]
    return [*lines, "]),"]


def keel_pin():
    """Upright pin whose lower end is chamfered at 45°, as its round end guides it."""
    down, north, east = (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), (1.0, 0.0, 0.0)
    end = KEEL_PIN_END + KEEL_PIN_RADIUS
    sides = [*ring(KEEL_PIN_RADIUS, north, east)]
    # A tangent plane of the round end at 45° from the axis.
    chamfer = [
        (n, (KEEL_PIN_END * math.sqrt(0.5) + KEEL_PIN_RADIUS))
        for n, _ in ring(KEEL_PIN_RADIUS, north, east, lean=math.pi / 4, axis=down)
    ]
    middle = (0.0, 0.0, KEEL_Z)
    half_spaces = [*sides, *chamfer, (down, end), (g.scaled(down, -1.0), KEEL_PIN_TOP)]
    return polyhedron("shank", [(n, d + g.dot(n, middle)) for n, d in half_spaces])


def foundation():
    return f"foundation: {STEEL_STIFFNESS / FLAT:.6e}"


def payload():
    lines = [
        "// Payload with pins and scuff plates of plain solids. Written by make.py.",
        "(",
        '    format: "pong-model", version: 1, name: "payload",',
        "    surfaces: {",
        f'        "pin": (stiffness: {STEEL_STIFFNESS}, {foundation()},',
        f"            normal: Linear(damping: {PIN_DAMPING}, ramp: {DAMPING_RAMP}),",
        f"            friction: Bristle(mu: {FRICTION}, damping: {PIN_STICKING_DAMPING})),",
        f'        "plunger": (stiffness: {PLUNGER_STIFFNESS}, normal: Linear(damping: {PLUNGER_DAMPING}, ramp: {DAMPING_RAMP})),',
        "    },",
        '    root: (name: "payload", surface: "pin", contact: Solid, groups: [',
    ]
    lines += ["        " + line for name in LATCHES for line in trunnion(name)]
    lines += [f'        (name: "keel_pin", primitives: [{keel_pin()}]),', "    ]),", ")"]
    return "\n".join(lines) + "\n"


# --- bay ---------------------------------------------------------------------------------------------------------------

def replaced(text, old, new):
    if text.count(old) != 1:
        raise ValueError(f"the marked bay has {text.count(old)} times: {old}")
    return text.replace(old, new)


def bay():
    """The marked bay, whose parts are convex polyhedra already, with `contact: Solid` and a stiffness per area."""
    text = (MARKED / "bay.ron").read_text(encoding="utf-8")
    text = replaced(text, f"stiffness: {STEEL_STIFFNESS},", f"stiffness: {STEEL_STIFFNESS}, {foundation()},")
    text = replaced(text, 'surface: "latch",\n', 'surface: "latch",\n        contact: Solid,\n')
    return "// Latches of plain solids. Written by make.py.\n" + text


def texts():
    """Name -> text of each file."""
    files = {"bay.ron": bay(), "payload.ron": payload(), "arm.ron": (MARKED / "arm.ron").read_text(encoding="utf-8")}
    for name, text in scenes.texts().items():
        files[name] = replaced(text, "Written by build.py.", "Written by make.py.")
    return files


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else HERE
    for name, text in texts().items():
        (folder / name).write_text(text, encoding="utf-8", newline="\n")
        print(f"{folder / name}: written")

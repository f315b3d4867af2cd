"""Writes Pong model files (RON, docs/model_format.md) from Python, without Blender; standard library only.

For models as plain as those of a verification case; others are made through the modelling toolkit (authoring.py).
"""

from geometry import (  # noqa: F401 (the build scripts use them from here)
    ROUNDING,
    add,
    sub,
    scaled,
    dot,
    cross,
    unit,
    on_circle,
    quaternion_of_axes,
    plane,
    plane_through,
    meet,
    rounded,
    solid,
    face_outline,
)

# --- primitives and groups as RON ----------------------------------------------------------------------------------

def number(x):
    return repr(round(float(x), ROUNDING) + 0.0)


def triple(v):
    return "(" + ", ".join(number(x) for x in v) + ")"


def on_surface(surface):
    return f', surface: "{surface}"' if surface else ""


def point(name, position, surface=None):
    return f'Point(name: "{name}", position: {triple(position)}{on_surface(surface)})'


def segment(name, a, b, surface=None):
    return f'LineSegment(name: "{name}", ends: ({triple(a)}, {triple(b)}){on_surface(surface)})'


def flat_ground(name, normal, offset, surface=None):
    return f'Plane(name: "{name}", normal: {triple(normal)}, offset: {number(offset)}{on_surface(surface)})'


def polyhedron(name, half_spaces, inactive=(), surface=None):
    """`inactive`: indices of the half spaces that are internal faces."""
    vertices, faces = solid(half_spaces)
    vertex_text = ", ".join(triple(v) for v in vertices)
    face_text = ", ".join("[" + ", ".join(map(str, f)) + "]" for f in faces)
    walls = f", inactive_faces: [{', '.join(map(str, inactive))}]" if inactive else ""
    return (
        f'Polyhedron(name: "{name}", vertices: [{vertex_text}], faces: [{face_text}]{walls}{on_surface(surface)})'
    )


def group(name, groups=None, primitives=None, bound=None, surface=None, movable=False, position=None, orientation=None):
    """A group as a list of lines."""
    head = f'(name: "{name}"'
    if movable:
        head += ", movable: true"
    if position is not None or orientation is not None:
        parts = []
        if position is not None:
            parts.append(f"position: {triple(position)}")
        if orientation is not None:
            parts.append("orientation: (" + ", ".join(repr(round(c, 15) + 0.0) for c in orientation) + ")")
        head += f", pose: ({', '.join(parts)})"
    if bound:
        head += f", bound: {bound}"
    head += on_surface(surface)
    if groups is not None:
        lines = [head + ", groups: ["]
        for child in groups:
            lines += ["    " + line for line in child]
    else:
        lines = [head + ", primitives: ["]
        lines += ["    " + line + "," for line in primitives]
    return lines + ["]),"]


def model(name, surfaces, root, about):
    """The text of a model file. `surfaces`: name → RON text; `about`: lines of a comment."""
    lines = [f"// {line}".rstrip() for line in about]
    lines += ["(", '    format: "pong-model",', "    version: 1,", f'    name: "{name}",', "    surfaces: {"]
    lines += [f'        "{key}": {text},' for key, text in surfaces.items()]
    lines += ["    },"]
    lines += ["    root: " + root[0]] + ["    " + line for line in root[1:]] + [")"]
    return "\n".join(lines) + "\n"


def write(path, text):
    with open(path, "w", encoding="utf-8", newline="\n") as file:
        file.write(text)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Fields of a model file: their order in our layout, their types and their defaults (docs/model_format.md)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

REQUIRED = object()


@dataclass(frozen=True)
class Field:
    """A field: `kind` names the reader of its value, a field at `default` is not written."""

    name: str
    kind: str
    default: object = None


def _fields(*fields: tuple) -> tuple[Field, ...]:
    return tuple(Field(*field) for field in fields)


PRIMITIVES: dict[str, tuple[Field, ...]] = {
    "Point": _fields(("position", "vector", REQUIRED)),
    "LineSegment": _fields(("ends", "vectors2", REQUIRED)),
    "Ray": _fields(
        ("origin", "vector", REQUIRED),
        ("direction", "direction", REQUIRED),
        ("length", "positive", REQUIRED),
        ("reach", "not_negative"),
        ("response", "response", "Normal"),
    ),
    "Sphere": _fields(("center", "vector", REQUIRED), ("radius", "positive", REQUIRED)),
    "Ellipsoid": _fields(
        ("center", "vector", REQUIRED),
        ("semi_axes", "semi_axes", REQUIRED),
        ("orientation", "rotation", (1.0, 0.0, 0.0, 0.0)),
    ),
    "Plane": _fields(("normal", "direction", REQUIRED), ("offset", "number", REQUIRED)),
    "Triangle": _fields(("thickness", "positive"), ("two_sided", "boolean", False), ("vertices", "vectors3", REQUIRED)),
    # Of these, either `file` or the two lists must be present: see read_primitive.py.
    "TriangleMesh": _fields(
        ("file", "text_value"),
        ("scale", "positive", 1.0),
        ("thickness", "positive"),
        ("two_sided", "boolean", False),
        ("vertices", "vertices"),
        ("triangles", "triangles"),
    ),
    "Polyhedron": _fields(
        ("file", "text_value"),
        ("scale", "positive", 1.0),
        ("inactive_faces", "indices", ()),
        ("vertices", "vertices"),
        ("faces", "faces"),
    ),
    "Capsule": _fields(("ends", "vectors2", REQUIRED), ("radius", "positive", REQUIRED)),
    "Cylinder": _fields(("ends", "vectors2", REQUIRED), ("radius", "positive", REQUIRED)),
    "Cone": _fields(("ends", "vectors2", REQUIRED), ("radii", "radii", REQUIRED)),
    "Bore": _fields(
        ("ends", "vectors2", REQUIRED),
        ("radii", "radii", REQUIRED),
        ("thickness", "positive"),
        ("mouths", "booleans", (True, True)),
    ),
    "Custom": _fields(("kind", "text_value", REQUIRED), ("parameters", "numbers", ())),
}

NORMAL_LAWS: dict[str, tuple[Field, ...]] = {
    "Linear": _fields(("damping", "not_negative"), ("ramp", "not_negative"), ("restitution", "restitution_mass")),
    "HuntCrossley": _fields(
        ("dissipation", "not_negative"),
        ("exponent", "exponent", REQUIRED),
        ("restitution", "restitution_speed"),
    ),
    "PowerLaw": _fields(
        ("exponent", "exponent", REQUIRED),
        ("damping_exponent", "not_negative", REQUIRED),
        ("damping", "not_negative"),
        ("restitution", "restitution_impact"),
    ),
    "Custom": _fields(("name", "text_value", REQUIRED), ("parameters", "numbers", ())),
}

FRICTION_LAWS: dict[str, tuple[Field, ...]] = {
    "Bristle": _fields(
        ("mu", "not_negative", REQUIRED),
        ("static_excess", "not_negative"),
        ("stiffness", "finite_stiffness"),
        ("damping", "not_negative"),
        ("mass", "positive"),
    ),
    "Coulomb": _fields(("mu", "not_negative", REQUIRED), ("slip_speed", "positive", REQUIRED)),
    "Custom": _fields(("name", "text_value", REQUIRED), ("parameters", "numbers", ())),
}

RESPONSES = ("Normal", "Axial")


def tells_friction(surface: dict) -> bool:
    """True if a surface specifies its friction. A rigid surface without friction differs from one that leaves it to the
    partner; for other surfaces, both are the same."""
    if surface.get("friction") is not None:
        return True
    return "friction" in surface and surface["stiffness"] == float("inf")


def is_default(value, default) -> bool:
    """True if a value equals the default of its field."""
    if default is None or default is REQUIRED:
        return False
    if isinstance(default, tuple):
        return not isinstance(value, np.ndarray) and tuple(value) == default
    return not isinstance(value, np.ndarray) and value == default

# SPDX-License-Identifier: GPL-3.0-or-later
"""Fields of a model file: their order in our layout, their types and their defaults, from the wheel (`pong.model.schema`)."""

from __future__ import annotations

import ast
from dataclasses import dataclass
from functools import cache

import numpy as np

from .engine import wheel

REQUIRED = object()
SOLID_NUMBERS = ("foundation", "area")  # of a surface: its stiffness per area at solids
RESPONSES = ("Normal", "Axial")  # of a ray; also where there is no wheel


@dataclass(frozen=True)
class Field:
    """A field: `kind` names the type of its value, a field at `default` is not written."""

    name: str
    kind: str
    default: object = None


Table = dict[str, tuple[Field, ...]]


@cache
def primitives() -> Table:
    """Fields of each kind of primitive, without `name` and `surface`. Raises `WheelMissing`."""
    tables = wheel().model.schema()["primitives"]
    return {kind: tuple(Field(name, row["type"], _default(row)) for name, row in table.items()) for kind, table in tables.items()}


@cache
def normal_laws() -> Table:
    """Fields of each normal law; those at their defaults are written as well. Raises `WheelMissing`."""
    return _laws("normal_laws")


@cache
def friction_laws() -> Table:
    """Fields of each friction law; those at their defaults are written as well. Raises `WheelMissing`."""
    return _laws("friction_laws")


def _laws(name: str) -> Table:
    tables = wheel().model.schema()[name]
    default = {"numbers": ()}  # of types: an empty list of parameters is not written
    return {
        law: tuple(Field(name, row["type"], default.get(row["type"])) for name, row in table.items())
        for law, table in tables.items()
    }


def _default(row: dict) -> object:
    """Value of a default, from its text in a model file."""
    if row["required"]:
        return REQUIRED
    text = row.get("default")
    if text is None or text.isalpha() and text not in ("true", "false"):
        return text
    value = ast.literal_eval(text.replace("true", "True").replace("false", "False"))
    return tuple(value) if isinstance(value, list) else value


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

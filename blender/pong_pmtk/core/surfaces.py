# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of surfaces and pairs as Python data: written as RON, and read and judged as those of a model file."""

from __future__ import annotations

import re

from .engine import WheelMissing
from .model import Tagged
from .read import Fault, ModelFaults, read_text
from .ron_text import number, text


def checked(surfaces: dict, pairs: list, model: str = "model") -> tuple[dict, list, list[Fault]]:
    """The tables with laws as `Tagged` and without what says nothing, and all that is wrong with them.

    `model` is the name of the model, by which pairs may call its surfaces. Tables at fault, or without the wheel, come
    back with their names alone, so that what is made of a surface is not called nameless.
    """
    names = {str(name): {} for name in surfaces}
    try:
        read = read_text(_document(surfaces, pairs, model), "")
    except ModelFaults as refused:
        return names, [], refused.faults
    except WheelMissing:
        return names, [], []
    return {name: read.surfaces[name] for name in names}, read.pairs, []


def _document(surfaces: dict, pairs: list, model: str) -> str:
    """A model of these tables around a point, which has the first surface, or one of its own where there is none."""
    tables = {str(name): fields for name, fields in surfaces.items()} or {"-": {"stiffness": 1.0}}
    entries = ", ".join(f"{text(name)}: {_ron(fields)}" for name, fields in tables.items())
    point = f"Point(name: {text('-')}, surface: {text(next(iter(tables)))}, position: (0, 0, 0))"
    return (
        f'(format: "pong-model", version: 1, name: {text(model or "-")}, surfaces: {{{entries}}}, '
        f"pairs: [{', '.join(map(_pair, pairs))}], root: (name: {text('-')}, primitives: [{point}]))"
    )


def _pair(pair) -> str:
    if not isinstance(pair, dict):
        return _ron(pair)
    return "(" + ", ".join(f"{_name(key)}: {_names(key, value)}" for key, value in pair.items()) + ")"


def _names(key: str, value) -> str:
    if key == "surfaces" and isinstance(value, (list, tuple)):
        return "(" + ", ".join(map(_ron, value)) + ")"
    return _ron(value)


def _ron(value) -> str:
    """A value as RON, whatever it is; {"Linear": {…}} is a law."""
    if isinstance(value, Tagged):
        return _name(value.name) + _ron_fields(value.fields)
    if isinstance(value, dict):
        law = law_of(value)
        return _ron(law) if law else _ron_fields(value)
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(_ron, value)) + "]"
    if value is None or value == "None":
        return "None"
    if isinstance(value, str):
        return "inf" if value in ("inf", "Infinity") else text(value)
    if isinstance(value, bool):
        return "true" if value else "false"
    return number(value).replace("nan", "NaN")


def _ron_fields(fields: dict) -> str:
    return "(" + ", ".join(f"{_name(name)}: {_ron(value)}" for name, value in fields.items()) + ")"


def _name(name) -> str:
    """A name of a field; RON has a form for those that are no plain words."""
    return name if re.fullmatch(r"[A-Za-z_]\w*", str(name), re.ASCII) else f"r#{name}"


def law_of(value: dict) -> Tagged | None:
    if len(value) == 1:
        ((name, fields),) = value.items()
        if isinstance(name, str) and name[:1].isupper() and isinstance(fields, dict):
            return Tagged(name, fields)
    return None


def to_json(value):
    """Laws as {"Linear": {…}}, rigid as "inf": what JSON can hold."""
    if isinstance(value, Tagged):
        return {value.name: to_json(value.fields)}
    if isinstance(value, dict):
        return {name: to_json(inner) for name, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [to_json(item) for item in value]
    return "inf" if isinstance(value, float) and value == float("inf") else value

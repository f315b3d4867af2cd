# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of surfaces and pairs as Python data, read and checked as those of a model file."""

from __future__ import annotations

from .engine import WheelMissing, wheel
from .model import Tagged
from .read import Fault, ModelFaults, read_text


def checked(surfaces: dict, pairs: list, model: str = "model") -> tuple[dict, list, list[Fault]]:
    """The tables with laws as `Tagged` and without empty fields, and all of their faults.

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


def derived(fields: dict) -> dict:
    """The values of a surface as the engine has them, with the damping that follows from a restitution, a mass or the normal
    law (docs/python.md, `Model.surfaces`). Empty where that cannot be told: values at fault, or no wheel."""
    try:
        pong = wheel()
    except WheelMissing:
        return {}
    try:
        return pong.Model.parse(_document({"-": fields}, [], "-"), name="-").surfaces["-"]
    except pong.PongError:
        return {}


def _document(surfaces: dict, pairs: list, model: str) -> str:
    """A model of these tables around a point, with the first surface, or a new one if there is none."""
    tables = {str(name): _plain(fields) for name, fields in surfaces.items()} or {"-": {"stiffness": 1.0}}
    point = {"Point": {"name": "-", "surface": next(iter(tables)), "position": (0.0, 0.0, 0.0)}}
    data = {"name": model or "-", "surfaces": tables, "pairs": [_pair(pair) for pair in pairs]}
    return wheel().model.write(data | {"root": {"name": "-", "primitives": [point]}})


def _pair(pair):
    data = _plain(pair)
    if isinstance(data, dict) and isinstance(data.get("surfaces"), list):
        data["surfaces"] = tuple(data["surfaces"])
    return data


def _plain(value):
    """A value in the form of `pong.model`: JSON has no infinity, and the choice of no law is a word."""
    if isinstance(value, Tagged):
        return {value.name: _plain(value.fields)}
    if isinstance(value, dict):
        return {str(name): _plain(inner) for name, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    if value == "None":
        return None
    if value in ("inf", "Infinity"):
        return float("inf")
    return value if value is None or isinstance(value, (bool, str)) else float(value)


def law_of(value: dict) -> Tagged | None:
    if len(value) == 1:
        ((name, fields),) = value.items()
        if isinstance(name, str) and name[:1].isupper() and isinstance(fields, dict):
            return Tagged(name, fields)
    return None


def to_json(value):
    """Laws as {"Linear": {…}}, rigid as "inf", in the range of JSON."""
    if isinstance(value, Tagged):
        return {value.name: to_json(value.fields)}
    if isinstance(value, dict):
        return {name: to_json(inner) for name, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [to_json(item) for item in value]
    return "inf" if isinstance(value, float) and value == float("inf") else value

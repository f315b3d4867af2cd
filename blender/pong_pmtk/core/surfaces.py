# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of surfaces and pairs as Python data, checked by the same code (and rules) as those of a model file."""

from __future__ import annotations

from .model import Tagged
from .read import ModelReader
from .read_values import Fault
from .ron_tree import List, Map, Name, Node, Struct, Tuple


def checked(surfaces: dict, pairs: list) -> tuple[dict, list, list[Fault]]:
    """The tables with laws as `Tagged` and without what says nothing, and all that is wrong with them."""
    reader = ModelReader("", "")
    entries = [(Node(0, str(name)), node_of(fields)) for name, fields in surfaces.items()]
    good = reader.surfaces(Node(0, Map(entries)))
    return good, reader.pairs(Node(0, List([_pair(pair) for pair in pairs])), good), reader.faults


def _pair(pair) -> Node:
    node = node_of(pair)
    if isinstance(node.value, Struct):
        node.value.fields = [
            (name, at, _names(pair["surfaces"]) if name == "surfaces" else value)
            for name, at, value in node.value.fields
        ]
    return node


def _names(names) -> Node:
    return (
        Node(0, Tuple(None, [node_of(name) for name in names])) if isinstance(names, (list, tuple)) else node_of(names)
    )


def node_of(value) -> Node:
    """A value as the reader of RON would give it; {"Linear": {…}} is a law."""
    if isinstance(value, Tagged):
        return Node(0, Struct(value.name, _fields(value.fields)))
    if isinstance(value, dict):
        law = law_of(value)
        return node_of(law) if law else Node(0, Struct(None, _fields(value)))
    if isinstance(value, (list, tuple)):
        return Node(0, List([node_of(item) for item in value]))
    if value is None or value == "None":
        return Node(0, Name("None"))
    if isinstance(value, str) and value in ("inf", "Infinity"):
        return Node(0, float("inf"))
    return Node(0, value if isinstance(value, (bool, str)) else float(value))


def law_of(value: dict) -> Tagged | None:
    if len(value) == 1:
        ((name, fields),) = value.items()
        if isinstance(name, str) and name[:1].isupper() and isinstance(fields, dict):
            return Tagged(name, fields)
    return None


def _fields(fields: dict) -> list[tuple[str, int, Node]]:
    return [(str(name), 0, node_of(value)) for name, value in fields.items()]


def to_json(value):
    """Laws as {"Linear": {…}}, rigid as "inf": what JSON can hold."""
    if isinstance(value, Tagged):
        return {value.name: to_json(value.fields)}
    if isinstance(value, dict):
        return {name: to_json(inner) for name, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [to_json(item) for item in value]
    return "inf" if isinstance(value, float) and value == float("inf") else value

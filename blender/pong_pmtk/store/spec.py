# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces and pairs of surfaces as JSON text, with properties as views of it.

Which optional fields are given matters as much as their values, and all numbers are float64. Both are kept by storing
the fields of docs/model_format.md as they stand; a property of the panel reads and writes one of them. Laws are
`{"Linear": {"damping": 250.0}}`.
"""

import json

import bpy

from ..core.model import Tagged
from . import quantities
from .numbers import shortest

NO_FRICTION = "None"  # a law of pairs, which is not the same as none given
FIELDS = "*"  # in a path: the fields of the law, whatever its name


def to_plain(value):
    """Fields of the core -> JSON values."""
    if value is None:
        return {NO_FRICTION: {}}
    if isinstance(value, Tagged):
        return {value.name: to_plain(value.fields)}
    if isinstance(value, dict):
        return {key: to_plain(item) for key, item in value.items() if item is not None or key == "friction"}
    if isinstance(value, (list, tuple)):
        return [to_plain(item) for item in value]
    return value


def from_plain(fields):
    """JSON values -> fields of the core."""
    return {key: _law(value) if key in ("normal", "friction") else _field(value) for key, value in fields.items()}


def _law(value):
    if not isinstance(value, dict):
        return value
    (name, fields), = value.items()
    if name == NO_FRICTION:
        return None
    return Tagged(name, {key: _field(item) for key, item in fields.items()})


def _field(value):
    return tuple(value) if isinstance(value, list) else value


def read(group):
    """The fields of a surface or pair."""
    return json.loads(group.spec) if group.spec else {}


def write(group, fields):
    group.spec = json.dumps(fields)


def _holder(fields, path):
    """Dictionary that contains the last name of a path, or None."""
    for name in path[:-1]:
        if name == FIELDS:
            fields = next(iter(fields.values()), None) if isinstance(fields, dict) else None
        else:
            fields = fields.get(name)
        if not isinstance(fields, dict):
            return None
    return fields


def value_at(fields, path, default=None):
    holder = _holder(fields, path)
    return default if holder is None or path[-1] not in holder else holder[path[-1]]


def put(group, path, value):
    """Stores one value; None removes it. An invalid path changes nothing."""
    fields = read(group)
    holder = _holder(fields, path)
    if holder is None:
        return
    if value is None:
        holder.pop(path[-1], None)
    else:
        holder[path[-1]] = value
    write(group, fields)


def number(*path, default=0.0, **options):
    """A view of one number."""

    def get(self):
        return value_at(read(self), path, default)

    def set_(self, value):
        put(self, path, shortest(value))

    # Overrides store `spec` itself: this view has fewer digits.
    return bpy.props.FloatProperty(get=get, set=set_, override=set(), **options)


def quantity(unit, *path, default=0.0, least=0.0, most=None, **options):
    """A view of one number as text with its unit, for panels; in full precision."""
    return quantities.view(
        lambda self: value_at(read(self), path, default), lambda self, value: put(self, path, value),
        unit, least, most, **options)


def given(*path, default=0.0, **options):
    """A view of the presence of an optional field."""

    def get(self):
        return value_at(read(self), path) is not None

    def set_(self, value):
        if value != get(self):
            put(self, path, default if value else None)

    return bpy.props.BoolProperty(get=get, set=set_, **options)


def text(*path, **options):
    """A view of one name."""

    def get(self):
        return value_at(read(self), path, "")

    def set_(self, value):
        put(self, path, value)

    return bpy.props.StringProperty(get=get, set=set_, **options)


def numbers(*path, **options):
    """A view of a list of numbers as text with commas."""

    def get(self):
        return ", ".join(repr(number) for number in value_at(read(self), path, []))

    def set_(self, value):
        put(self, path, [float(word) for word in value.replace(",", " ").split()])

    return bpy.props.StringProperty(get=get, set=set_, **options)


def law(key, laws, of_rigid=None, **options):
    """A view of the chosen law: an EnumProperty. `laws`: (identifier, label, tip, initial fields).

    `of_rigid`: the same laws as a rigid surface calls them.
    """
    names = [entry[0] for entry in laws]

    def get(self):
        value = read(self).get(key)
        name = next(iter(value)) if isinstance(value, dict) else names[0]
        return names.index(name) if name in names else 0

    def set_(self, index):
        if index != get(self):
            start = laws[index][3]
            put(self, (key,), None if start is None else {names[index]: dict(start)})

    soft, rigid = _items(laws), _items(of_rigid or laws)
    # A function only if the names differ: Blender's documentation and scripts see the items of a list alone.
    items = (lambda self, _context: rigid if self.rigid else soft) if of_rigid else soft
    return bpy.props.EnumProperty(items=items, get=get, set=set_, **options)


def _items(laws):
    return [(name, label, tip, index) for index, (name, label, tip, _) in enumerate(laws)]

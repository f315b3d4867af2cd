# SPDX-License-Identifier: GPL-3.0-or-later
"""Lays values out as RON text: on one line if they fit into it, else one field a line and long lists filled."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

WIDTH = 120
INDENT = "    "


@dataclass
class Block:
    """Something in brackets: `items` are (label, value) with a value that is text, `Block` or `Filled`."""

    opening: str
    closing: str
    items: list[tuple[str, object]] = field(default_factory=list)
    broken: bool = False  # always one item a line


@dataclass
class Filled:
    """A long list of short tokens, as many on a line as fit."""

    tokens: list[str]


def number(value: float) -> str:
    """The shortest text that reads back as the same number."""
    return repr(float(value))


def text(value: str) -> str:
    escaped = value.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + "".join(c if c.isprintable() else _escape(c) for c in escaped) + '"'


def _escape(character: str) -> str:
    return {"\n": "\\n", "\r": "\\r", "\t": "\\t"}.get(character) or f"\\u{{{ord(character):x}}}"


def tuple_of(values) -> str:
    return "(" + ", ".join(map(number, values)) + ")"


def rows(array: np.ndarray) -> list[str]:
    """`(x, y, z)` for every row of an array."""
    items = list(map(repr, array.ravel().tolist()))
    columns = [items[i :: array.shape[1]] for i in range(array.shape[1])]
    return ["(" + ", ".join(row) + ")" for row in zip(*columns)]


def lay_out(label: str, value, indent: str, out: list[str]) -> None:
    """Appends the lines of `label` and value, each ending with a comma."""
    flat = _flat(value, WIDTH - len(indent) - len(label) - 1)
    if flat is not None:
        out.append(f"{indent}{label}{flat},")
    elif isinstance(value, Filled):
        out.append(f"{indent}{label}[")
        _fill(value.tokens, indent + INDENT, out)
        out.append(f"{indent}],")
    elif isinstance(value, Block):
        out.append(f"{indent}{label}{value.opening}")
        for inner_label, inner in value.items:
            lay_out(inner_label, inner, indent + INDENT, out)
        out.append(f"{indent}{value.closing},")
    else:
        out.append(f"{indent}{label}{value},")


def _flat(value, room: int) -> str | None:
    """The value on one line, or `None` if it is longer than the room."""
    if isinstance(value, str):
        return value if len(value) <= room else None
    if isinstance(value, Filled):
        if 3 * len(value.tokens) > room + 3:
            return None
        line = "[" + ", ".join(value.tokens) + "]"
    elif value.broken:
        return None
    else:
        parts = []
        for label, inner in value.items:
            flat = _flat(inner, room)
            if flat is None:
                return None
            parts.append(label + flat)
        line = value.opening + ", ".join(parts) + value.closing
    return line if len(line) <= room else None


def _fill(tokens: list[str], indent: str, out: list[str]) -> None:
    ends = np.cumsum([len(token) + 2 for token in tokens])  # with comma and space
    room = WIDTH - len(indent) + 1  # the last space is not written
    start, done = 0, 0
    while start < len(tokens):
        stop = max(int(np.searchsorted(ends, done + room, side="right")), start + 1)
        out.append(indent + ", ".join(tokens[start:stop]) + ",")
        start, done = stop, ends[stop - 1]

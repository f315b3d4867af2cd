"""Writer of model data as RON, in one layout: on one line if it fits, else one field per line, with long lists filled."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from numbers import Integral, Real
from typing import Any

import numpy as np

WIDTH = 120
INDENT = "    "
# Fields whose text is written as a name: `bound: Sphere`, not `bound: "Sphere"`.
NAMES = ("bound", "response")
# Fields for which `None` is a value; for all others it means that the field is left out.
SPEAKING_NONE = ("friction",)
# Lists with one item per line, however short.
BROKEN_LISTS = ("groups", "primitives", "pairs")


@dataclass
class _Block:
    """A bracketed list: `items` are (label, value) with a value that is text, `_Block` or `_Filled`."""

    opening: str
    closing: str
    items: list[tuple[str, Any]] = field(default_factory=list)
    broken: bool = False  # always one item a line


@dataclass
class _Filled:
    """A long list of short tokens, as many per line as fit."""

    tokens: list[str]


def write(data: dict[str, Any]) -> str:
    """Text of a model file; see `pong.model.write`."""
    document = {"format": "pong-model", "version": 1} | data
    items = [(f"{_name(key)}: ", _field(key, value)) for key, value in document.items() if _is_written(key, value)]
    out: list[str] = []
    _lay_out("", _Block("(", ")", items, broken=True), "", out)
    out[-1] = ")"
    return "\n".join(out) + "\n"


# --- values to blocks --------------------------------------------------------------------------------------------


def _is_written(key: str, value: Any) -> bool:
    return value is not None or key in SPEAKING_NONE


def _field(key: str, value: Any) -> Any:
    """Value of a field, whose name decides how lists and texts are written."""
    if key == "surfaces" and isinstance(value, dict):
        entries = [(f"{_text(str(name))}: ", _value(surface)) for name, surface in value.items()]
        return _Block("{", "}", entries, broken=bool(entries))
    if key == "root" and isinstance(value, dict):
        return _group(value)
    if key in BROKEN_LISTS and isinstance(value, list):
        each = _group if key == "groups" else _value
        return _Block("[", "]", [("", each(item)) for item in value], broken=True)
    if key in NAMES and isinstance(value, str):
        return _name(value)
    if key in ("vertices", "triangles", "faces") and isinstance(value, (list, np.ndarray)):
        return _Filled(_rows(value, "[]" if key == "faces" else "()"))
    return _value(value)


def _group(value: Any) -> Any:
    block = _value(value)
    if isinstance(block, _Block):
        block.broken = True
    return block


def _value(value: Any) -> Any:
    if value is None:
        return "None"
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, np.ndarray) and value.ndim == 0:
        return _value(value.item())
    if isinstance(value, (Integral, Real)):
        return _number(value)
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, dict):
        return _struct(value)
    if isinstance(value, tuple):
        return _Block("(", ")", [("", _value(item)) for item in value])
    if isinstance(value, (list, np.ndarray)):
        return _list(list(value))
    raise TypeError(f"a model file has no form for {value!r}, which is a {type(value).__name__}")


def _struct(value: dict[str, Any]) -> Any:
    """`(a: 1)`, or `Name(a: 1)` for {"Name": {"a": 1}}: names of fields begin with a small letter."""
    name = next(iter(value)) if len(value) == 1 else None
    if isinstance(name, str) and name[:1].isupper():
        inner = value[name]
        if isinstance(inner, dict):
            return _Block(f"{name}(", ")", _fields(inner))
        return _Block(f"{name}(", ")", [("", _value(item)) for item in (inner if isinstance(inner, tuple) else (inner,))])
    return _Block("(", ")", _fields(value))


def _fields(value: dict[str, Any]) -> list[tuple[str, Any]]:
    return [(f"{_name(key)}: ", _field(key, inner)) for key, inner in value.items() if _is_written(key, inner)]


def _list(value: list[Any]) -> Any:
    items = [_value(item) for item in value]
    if all(isinstance(item, str) for item in items):
        return _Filled(items)
    return _Block("[", "]", [("", item) for item in items])


def _rows(value: Iterable[Any], brackets: str) -> list[str]:
    """`(x, y, z)` of every row."""
    if isinstance(value, np.ndarray) and value.ndim == 2:
        items = list(map(repr, value.ravel().tolist()))
        columns = [items[i :: value.shape[1]] for i in range(value.shape[1])]
        rows = [", ".join(row) for row in zip(*columns)]
    else:
        rows = [", ".join(map(repr, np.asarray(row).tolist())) for row in value]
    return [brackets[0] + row + brackets[1] for row in rows]


def _number(value: Any) -> str:
    """Shortest text that reads back as the same number."""
    return str(int(value)) if isinstance(value, Integral) else repr(float(value)).replace("nan", "NaN")


def _name(name: Any) -> str:
    """Text of a name; RON has a raw form for names that are no plain words."""
    return str(name) if re.fullmatch(r"[A-Za-z_]\w*", str(name), re.ASCII) else f"r#{name}"


def _text(value: str) -> str:
    escaped = value.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + "".join(c if c.isprintable() else _escape(c) for c in escaped) + '"'


def _escape(character: str) -> str:
    return {"\n": "\\n", "\r": "\\r", "\t": "\\t"}.get(character) or f"\\u{{{ord(character):x}}}"


# --- blocks to lines ---------------------------------------------------------------------------------------------


def _lay_out(label: str, value: Any, indent: str, out: list[str]) -> None:
    """Appends the lines of `label` and value, each ending with a comma."""
    flat = _flat(value, WIDTH - len(indent) - len(label) - 1)
    if flat is not None:
        out.append(f"{indent}{label}{flat},")
    elif isinstance(value, _Filled):
        out.append(f"{indent}{label}[")
        _fill(value.tokens, indent + INDENT, out)
        out.append(f"{indent}],")
    elif isinstance(value, _Block):
        out.append(f"{indent}{label}{value.opening}")
        for inner_label, inner in value.items:
            _lay_out(inner_label, inner, indent + INDENT, out)
        out.append(f"{indent}{value.closing},")
    else:
        out.append(f"{indent}{label}{value},")


def _flat(value: Any, room: int) -> str | None:
    """The value on one line, or `None` if it is longer than the room."""
    if isinstance(value, str):
        return value if len(value) <= room else None
    if isinstance(value, _Filled):
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
        start, done = stop, int(ends[stop - 1])

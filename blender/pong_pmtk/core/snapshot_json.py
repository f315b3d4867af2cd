# SPDX-License-Identifier: GPL-3.0-or-later
"""Snapshots and marks as JSON: fields at their defaults are left out, numbers keep every bit."""

from __future__ import annotations

import dataclasses
import json
import typing

import numpy as np

from . import marks, snapshot
from .marks import Mark
from .snapshot import Snapshot
from .surfaces import law_of, to_json

FORMAT = "pong-snapshot"


def dumps(scene: Snapshot) -> str:
    """JSON text of a snapshot, with one object of the scene per line."""
    data = {"format": FORMAT, "version": marks.VERSION, **encoded(scene)}
    objects = data.pop("objects", [])
    head = json.dumps(data, ensure_ascii=False)[:-1]
    lines = ",\n".join("  " + json.dumps(item, ensure_ascii=False) for item in objects)
    return f'{head}, "objects": [\n{lines}\n]}}\n'


def loads(text: str) -> Snapshot:
    """Reads a snapshot; raises `ValueError` with the field that cannot be read."""
    data = json.loads(text)
    if data.pop("format", None) != FORMAT or data.pop("version", 0) > marks.VERSION:
        raise ValueError(f'this is no snapshot: it has no "format": "{FORMAT}" of a version up to {marks.VERSION}')
    return decoded(Snapshot, data, "snapshot")


def mark_to_json(mark: Mark) -> dict:
    """A mark as in glTF's `extras.pong`; the version is always included."""
    return {**encoded(mark), "version": mark.version}


def mark_from_json(data: dict) -> Mark:
    return decoded(Mark, data, "mark")


def encoded(value):
    """A dataclass, array or plain value as JSON data."""
    if dataclasses.is_dataclass(value):
        fields = {field.name: getattr(value, field.name) for field in dataclasses.fields(value)}
        return {name: encoded(inner) for name, inner in fields.items() if not _is_default(value, name, inner)}
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, dict):
        return {name: encoded(inner) for name, inner in to_json(value).items()}
    return [encoded(item) for item in value] if isinstance(value, (list, tuple)) else value


def _is_default(owner, name: str, value) -> bool:
    field = next(field for field in dataclasses.fields(owner) if field.name == name)
    if field.default is not dataclasses.MISSING:
        default = field.default
    elif field.default_factory is not dataclasses.MISSING:
        default = field.default_factory()
    else:
        return False
    if dataclasses.is_dataclass(value):
        return type(value) is type(default) and encoded(value) == {}
    return not isinstance(value, np.ndarray) and type(value) is type(default) and value == default


def decoded(kind: type, data: dict, path: str):
    """A dataclass from JSON data; unknown fields are refused, which reveals typing errors."""
    if not isinstance(data, dict):
        raise ValueError(f"{path}: expected named fields, found {data!r}")
    types = typing.get_type_hints(kind, vars(snapshot) | vars(marks))
    unknown = set(data) - set(types)
    if unknown:
        raise ValueError(f"{path}: there is no field {sorted(unknown)[0]!r}")
    values = {name: _value(types[name], name, value, f"{path}.{name}") for name, value in data.items()}
    try:
        return kind(**values)
    except TypeError as error:
        raise ValueError(f"{path}: {error}") from None


_INDICES = ("edges", "loops", "face_starts")


def _value(kind, name: str, value, path: str):
    text = str(kind)
    if value is None:
        return None
    for inner in _CLASSES:
        if inner.__name__ in text:
            if "list[" in text:
                return [decoded(inner, item, f"{path}[{index}]") for index, item in enumerate(value)]
            return decoded(inner, value, path)
    if name == "exact":
        return {key: np.asarray(item, dtype=np.float64) for key, item in value.items()}
    if "ndarray" in text:
        array = np.asarray(value, dtype=np.int64 if name in _INDICES else np.float64)
        return array.reshape(-1, 2 if name == "edges" else 3) if name in ("edges", "vertices") else array
    if name == "surfaces":
        return {surface: _with_laws(fields) for surface, fields in value.items()}
    if name == "pairs":
        return [_with_laws(fields) for fields in value]
    if name == "filters":
        return [tuple(groups) for groups in value]
    if text.startswith("tuple"):
        return tuple(map(bool if "bool" in text else float, value))
    return {key: tuple(item) for key, item in value.items()} if name == "instance_offsets" else value


_CLASSES = (snapshot.SnapshotObject, snapshot.Transform, snapshot.Mesh, marks.Part, marks.ModelSettings, marks.Mark)


def _with_laws(value):
    if isinstance(value, dict):
        law = law_of(value)
        return law if law else {name: _with_laws(inner) for name, inner in value.items()}
    if isinstance(value, list):
        return [_with_laws(item) for item in value]
    return float("inf") if value == "inf" else value

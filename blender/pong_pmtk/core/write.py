# SPDX-License-Identifier: GPL-3.0-or-later
"""`Model` -> model file. The same model gives the same bytes, and reading them back gives the same model.

The wheel lays the text out (`pong.model.write`); what is written, and in which order, is said here.
"""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

import numpy as np

from .canonical import canonical
from .engine import wheel
from .model import Group, Model, Primitive, Tagged
from .schema import SOLID_NUMBERS, friction_laws, normal_laws, primitives, tells_friction


def write_text(model: Model) -> str:
    """Text of a model file. Raises `WheelMissing`."""
    return wheel().model.write(data_of(canonical(model)))


def write_files(path, model: Model, meshes: dict[str, bytes] | None = None) -> None:
    """Writes a model file and its mesh files (paths relative to its folder), all of them or none.

    Everything is written beside its place first and moved there at the end; a fault leaves what was there before.
    """
    path = Path(path)
    contents = {path.parent / name: data for name, data in (meshes or {}).items()}
    contents[path] = write_text(model).encode("utf-8")
    ready: list[tuple[str, Path]] = []
    try:
        for target, data in contents.items():
            target.parent.mkdir(parents=True, exist_ok=True)
            handle, temporary = tempfile.mkstemp(prefix=f".{target.name}.", dir=target.parent)
            ready.append((temporary, target))
            with os.fdopen(handle, "wb") as file:
                file.write(data)
        for temporary, target in ready:
            os.chmod(temporary, 0o644)
            os.replace(temporary, target)
    finally:
        for temporary, _ in ready:
            if os.path.exists(temporary):
                os.unlink(temporary)


def data_of(model: Model) -> dict:
    """A model in the form of `pong.model`: fields in our order, `None` for missing ones."""
    return {
        "format": "pong-model",
        "version": 1,
        "name": model.name,
        "entry_memory": None if model.entry_memory else False,
        "surfaces": {name: _surface(fields) for name, fields in model.surfaces.items()},
        "pairs": [_pair(fields) for fields in model.pairs] or None,
        "filters": [tuple(groups) for groups in model.filters] or None,
        "root": _group(model.root),
    }


def _surface(fields: dict) -> dict:
    data = {"stiffness": float(fields["stiffness"])}
    data |= {name: float(fields[name]) for name in SOLID_NUMBERS if fields.get(name) is not None}
    if fields.get("normal") is not None:
        data["normal"] = _law(fields["normal"], normal_laws())
    if tells_friction(fields):
        data["friction"] = _law(fields["friction"], friction_laws())
    return data


def _pair(fields: dict) -> dict:
    data: dict = {"surfaces": tuple(fields["surfaces"])}
    if fields.get("stiffness") is not None:
        data["stiffness"] = float(fields["stiffness"])
    if fields.get("normal") is not None:
        data["normal"] = _law(fields["normal"], normal_laws())
    if "friction" in fields:
        data["friction"] = _law(fields["friction"], friction_laws())
    return data


def _law(tagged: Tagged | None, laws: dict) -> dict | None:
    if tagged is None:
        return None
    data = {}
    for field in laws[tagged.name]:
        value = tagged.fields.get(field.name)
        if value is not None and not (field.name == "parameters" and not len(value)):
            data[field.name] = _plain(value)
    return {tagged.name: data}


def _plain(value):
    """Numbers of laws, single, in lists and in nested groups, as float."""
    if isinstance(value, dict):
        return {key: float(inner) for key, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [float(x) for x in value]
    return value if isinstance(value, str) else float(value)


def _group(group: Group) -> dict:
    bound = group.bound
    if bound is not None and bound.startswith("Custom:"):
        bound = {"Custom": bound[7:]}
    pose = {"position": _numbers(group.position), "orientation": _numbers(group.orientation)}
    return {
        "name": group.name,
        "movable": group.movable or None,
        "pose": pose if any(part is not None for part in pose.values()) else None,
        "bound": bound,
        "leaf_size": group.leaf_size,
        "surface": group.surface,
        "contact": group.contact,
        "groups": [_group(below) for below in group.groups] or None,
        "primitives": [_primitive(primitive) for primitive in group.primitives] or None,
    }


def _numbers(values) -> tuple[float, ...] | None:
    return None if values is None else tuple(map(float, values))


def _primitive(primitive: Primitive) -> dict:
    fields = {"name": primitive.name, "surface": primitive.surface}
    for field in primitives()[primitive.kind]:
        if field.name in primitive.fields:
            fields[field.name] = _AS_DATA[field.kind](primitive.fields[field.name])
    return {primitive.kind: fields}


def _places(places) -> tuple:
    return tuple(map(_numbers, places))


def _faces(faces) -> np.ndarray | list:
    return faces if isinstance(faces, np.ndarray) else [np.asarray(face, dtype=np.int64) for face in faces]


_AS_DATA = {
    "vector": _numbers,
    "direction": _numbers,
    "semi_axes": _numbers,
    "rotation": _numbers,
    "vectors2": _places,
    "vectors3": _places,
    "number": float,
    "positive": float,
    "not_negative": float,
    "text": str,
    "boolean": bool,
    "word": str,
    "radii": _numbers,
    "booleans": lambda values: tuple(map(bool, values)),
    "numbers": lambda values: [float(x) for x in values],
    "indices": lambda values: [int(x) for x in values],
    "vertices": lambda array: np.asarray(array, dtype=np.float64).reshape(-1, 3),
    "triangles": _faces,
    "faces": _faces,
}

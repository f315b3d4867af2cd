"""Model files as data, and their rules for programs that make models (docs/python.md, Model files as data).

    data = pong.model.read("gripper.ron")            the file as it is written: dictionaries, tuples, arrays
    text = pong.model.write(data)                    data like that as the text of a model file
    tables = pong.model.schema()                     kinds and fields of the format
    found = pong.model.check(text)                   every error and warning of a text
    pong.model.check_polyhedron(vertices, faces)     what keeps a shape from being a polyhedron
    pong.model.check_triangles(corners)              what is wrong about the triangles of one body

All rules are those of the loader, because it is the loader that judges. `pong.Model` is a model that has passed.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _pong
from ._pong import Model, ModelError

__all__ = ["Checked", "check", "check_polyhedron", "check_triangles", "parse", "read", "schema", "write"]

_Path = str | os.PathLike[str]
_Indices = NDArray[np.integer[Any]]


@dataclass
class Checked:
    """Findings about a model. `model` is None if there is an error."""

    model: Model | None
    errors: list[dict[str, Any]] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)


def read(path: _Path) -> dict[str, Any]:
    """Reads a model file as written. Raises ModelError; shapes are not checked, and mesh files not read."""
    return _pong.read_authored(path)


def parse(text: str, *, name: str = "model") -> dict[str, Any]:
    """As `read`, from text. `name` stands for the file in errors."""
    return _pong.parse_authored(text, name=name)


def write(data: dict[str, Any], *, one_line: bool = False) -> str:
    """Text of a model file with this data, in the form that `read` gives. The same data gives the same text, and
    reading it gives the same data: numbers keep every bit. Nothing is checked; `check` checks the text."""
    return _pong.write_authored({"format": "pong-model", "version": 1} | data, one_line)


def schema() -> dict[str, Any]:
    """Kinds and fields of model files (docs/model_format.md), in the order of writing.

    `primitives`, `normal_laws` and `friction_laws` are tables of fields by kind; `model`, `surface`, `pair`, `group`
    and `primitive` (of every kind) are tables of fields; `bounds` are names. A field has `type`, `unit` and
    `required`, and may have `default` (as written in a file), `words` (of a default that is no value), `fields` and
    `choices`."""
    return _pong.model_schema()


def check(
    text: str, *, name: str = "model", folder: _Path | None = None, allow_files_below: Sequence[_Path] = ()
) -> Checked:
    """All errors, or all warnings, of the text of a model. Meshes are searched in `folder`."""
    try:
        model = Model.parse(text, name=name, folder=folder, allow_files_below=list(allow_files_below))
    except ModelError as refused:
        return Checked(None, refused.errors)
    return Checked(model, [], model.warnings)


def check_polyhedron(
    vertices: ArrayLike, faces: _Indices | Sequence[Sequence[int] | _Indices], inactive: Sequence[int] = ()
) -> list[dict[str, Any]]:
    """Faults that keep vertices (n, 3) and faces of vertex indices from being a polyhedron; empty if it is valid."""
    indices = faces.tolist() if isinstance(faces, np.ndarray) else [np.asarray(face).tolist() for face in faces]
    places = np.asarray(vertices, dtype=np.float64).reshape(-1, 3)
    return _pong.check_polyhedron(places, indices, list(map(int, inactive)))


def check_triangles(corners: ArrayLike) -> list[dict[str, Any]]:
    """Faults and oddities of the triangles of one body, given by their corners (n, 3, 3): an entry for each rule."""
    return _pong.check_triangles(np.asarray(corners, dtype=np.float64).reshape(-1, 3, 3))

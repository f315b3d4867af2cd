"""Model files as data, and their rules for programs that make models (docs/python.md, Model files as data).

    data = pong.model.read("gripper.ron")            the file as it is written: dictionaries, tuples, arrays
    text = pong.model.write(data)                    data like that as the text of a model file
    text = pong.model.join(parts, name="floor")     one model of files that never move relative to each other
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
from ._pong import BadValueError, Model, ModelError

__all__ = ["Checked", "check", "check_polyhedron", "check_triangles", "join", "parse", "read", "schema", "write"]

_Path = str | os.PathLike[str]
_Indices = NDArray[np.integer[Any]]


@dataclass
class Checked:
    """Findings about a model.

    Attributes
    ----------
    model : Model or None
        The model; None if there is an error.
    errors : list of dict
        Errors, with `line`, `column`, `cause` and `cure`.
    warnings : list of str
        Warnings of a model without errors.
    """

    model: Model | None
    errors: list[dict[str, Any]] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)


def read(path: _Path) -> dict[str, Any]:
    """Reads a model file as written. Shapes are not checked, and mesh files not read.

    Parameters
    ----------
    path : path_like
        Model file.

    Returns
    -------
    dict
        Fields of the model format by name. In meshes, `vertices` is an ndarray (n, 3) in m.

    Raises
    ------
    ModelError
        Notation, fields, types, names or indices are at fault.
    """
    return _pong.read_authored(path)


def parse(text: str, *, name: str = "model") -> dict[str, Any]:
    """Reads the text of a model file as written; see `read`.

    Parameters
    ----------
    text : str
        Text of a model file.
    name : str, default "model"
        Name that stands for the file in errors.

    Returns
    -------
    dict
        Fields of the model format by name.

    Raises
    ------
    ModelError
        Notation, fields, types, names or indices are at fault.

    Examples
    --------
    >>> data = pong.model.read("ball.ron")
    >>> data["root"]["primitives"][0]["Sphere"]["radius"]
    0.1
    >>> pong.model.parse(pong.model.write(data)) == data
    True
    """
    return _pong.parse_authored(text, name=name)


def write(data: dict[str, Any], *, one_line: bool = False) -> str:
    """Writes a model file. Nothing is checked; `check` checks the text.

    Parameters
    ----------
    data : dict
        Data in the form that `read` gives.
    one_line : bool, default False
        Write everything on one line.

    Returns
    -------
    str
        Text of a model file. The same data gives the same text, and reading it gives the same data: numbers keep every
        bit.
    """
    return _pong.write_authored({"format": "pong-model", "version": 1} | data, one_line)


def join(
    parts: Sequence[_Path | tuple[_Path, ArrayLike] | tuple[_Path, ArrayLike, ArrayLike]],
    *,
    name: str,
    folder: _Path = ".",
    one_surface: bool = True,
    allow_files_below: Sequence[_Path] = (),
) -> str:
    """Joins model files that never move relative to each other into one model, as `pong join` does.

    The root of each file becomes a group of the new root, named after its model; movable groups stay movable.

    Parameters
    ----------
    parts : sequence of path_like or tuple
        Model files. A tuple has a file, the position of its root in m, and, if wanted, its orientation as a quaternion
        (w, x, y, z). A file may be there several times.
    name : str
        Name of the new model.
    folder : path_like, default "."
        Folder in which the text is to be saved, or which is given to `pong.Model.parse`: meshes are named from there.
    one_surface : bool, default True
        Declare the new root one surface, so that nothing hops on the seams between the parts.
    allow_files_below : sequence of path_like, optional
        Further folders from which the models may read meshes.

    Returns
    -------
    str
        Text of the new model file.

    Raises
    ------
    ModelError
        A file is at fault.
    BadValueError
        The files cannot be joined: cause and cure.

    Examples
    --------
    >>> text = pong.model.join(["ball.ron", ("ball.ron", (1, 0, 0))], name="balls")
    >>> balls = pong.Model.parse(text)
    """
    places = [_placed(*part) if isinstance(part, tuple) else _placed(part) for part in parts]
    return _pong.join_models(places, name, folder, one_surface, list(allow_files_below))


def _placed(
    path: _Path, position: ArrayLike = (0.0, 0.0, 0.0), orientation: ArrayLike = (1.0, 0.0, 0.0, 0.0)
) -> tuple[str, list[float]]:
    place = np.concatenate([np.ravel(np.asarray(given, float)) for given in (position, orientation)])
    if len(place) != 7:
        cure = "give a position (x, y, z) in m and a quaternion (w, x, y, z)"
        raise BadValueError(f"parts: the place of {path} has {len(place)} numbers; {cure}")
    return os.fspath(path), place.tolist()


def schema() -> dict[str, Any]:
    """Returns kinds and fields of model files (docs/model_format.md), in the order of writing.

    Returns
    -------
    dict
        `primitives`, `normal_laws` and `friction_laws` are tables of fields by kind; `model`, `surface`, `pair`,
        `group` and `primitive` (of every kind) are tables of fields; `bounds` are names. A field has `type`, `unit`
        and `required`, and may have `default` (as written in a file), `words` (of a default that is no value),
        `fields` and `choices`.
    """
    return _pong.model_schema()


def check(
    text: str, *, name: str = "model", folder: _Path | None = None, allow_files_below: Sequence[_Path] = ()
) -> Checked:
    """Finds all errors, or all warnings, of the text of a model. It raises nothing.

    Parameters
    ----------
    text : str
        Text of a model file.
    name : str, default "model"
        Name that stands for the file in errors.
    folder : path_like, optional
        Folder in which meshes are searched.
    allow_files_below : sequence of path_like, optional
        Further folders from which the model may read meshes.

    Returns
    -------
    Checked
    """
    try:
        model = Model.parse(text, name=name, folder=folder, allow_files_below=list(allow_files_below))
    except ModelError as refused:
        return Checked(None, refused.errors)
    return Checked(model, [], model.warnings)


def check_polyhedron(
    vertices: ArrayLike, faces: _Indices | Sequence[Sequence[int] | _Indices], inactive: Sequence[int] = ()
) -> list[dict[str, Any]]:
    """Lists faults that keep a shape from being a polyhedron.

    Parameters
    ----------
    vertices : array_like, shape (n, 3)
        Vertices, m.
    faces : array_like or sequence of array_like of int
        Indices of the vertices of each face.
    inactive : sequence of int, optional
        Faces that take no contact.

    Returns
    -------
    list of dict
        Faults with `rule`, `cause`, `cure`, `face`, `places` (m) and `off` (m); empty if it is valid.
    """
    indices = faces.tolist() if isinstance(faces, np.ndarray) else [np.asarray(face).tolist() for face in faces]
    places = np.asarray(vertices, dtype=np.float64).reshape(-1, 3)
    return _pong.check_polyhedron(places, indices, list(map(int, inactive)))


def check_triangles(corners: ArrayLike) -> list[dict[str, Any]]:
    """Lists faults and oddities of the triangles of one body.

    Parameters
    ----------
    corners : array_like, shape (n, 3, 3)
        Corners of the triangles, m.

    Returns
    -------
    list of dict
        An entry for each rule: `severity`, `rule`, `cause`, `cure` and `triangles`, the indices.
    """
    return _pong.check_triangles(np.asarray(corners, dtype=np.float64).reshape(-1, 3, 3))

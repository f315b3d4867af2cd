# SPDX-License-Identifier: GPL-3.0-or-later
"""`Model` -> model file. The same model gives the same bytes, and reading them back gives the same model."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

import numpy as np

from .canonical import canonical
from .model import Group, Model, Primitive, Tagged
from .ron_text import Block, Filled, lay_out, number, rows, text, tuple_of
from .schema import FRICTION_LAWS, NORMAL_LAWS, PRIMITIVES


def write_text(model: Model) -> str:
    """The text of a model file."""
    model = canonical(model)
    items = [
        ("format: ", text("pong-model")),
        ("version: ", "1"),
        ("name: ", text(model.name)),
    ]
    if not model.entry_memory:
        items.append(("entry_memory: ", "false"))
    surfaces = [(text(name) + ": ", surface(fields)) for name, fields in model.surfaces.items()]
    items.append(("surfaces: ", Block("{", "}", surfaces, broken=bool(surfaces))))
    if model.pairs:
        items.append(("pairs: ", Block("[", "]", [("", pair(fields)) for fields in model.pairs], broken=True)))
    items.append(("root: ", group(model.root)))
    out: list[str] = []
    lay_out("", Block("(", ")", items, broken=True), "", out)
    out[-1] = ")"
    return "\n".join(out) + "\n"


def write_files(path, model: Model, meshes: dict[str, bytes] | None = None) -> None:
    """Writes a model file and the mesh files it names (paths seen from its folder), all of them or none.

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


def surface(fields: dict) -> Block:
    items = [("stiffness: ", number(fields["stiffness"]))]
    if fields.get("normal") is not None:
        items.append(("normal: ", law(fields["normal"], NORMAL_LAWS)))
    if fields.get("friction") is not None or ("friction" in fields and fields["stiffness"] == float("inf")):
        items.append(("friction: ", law(fields["friction"], FRICTION_LAWS)))
    return Block("(", ")", items)


def pair(fields: dict) -> Block:
    items: list[tuple[str, object]] = [("surfaces: ", "(" + ", ".join(map(text, fields["surfaces"])) + ")")]
    if fields.get("stiffness") is not None:
        items.append(("stiffness: ", number(fields["stiffness"])))
    if fields.get("normal") is not None:
        items.append(("normal: ", law(fields["normal"], NORMAL_LAWS)))
    if "friction" in fields:
        items.append(("friction: ", law(fields["friction"], FRICTION_LAWS)))
    return Block("(", ")", items)


def law(tagged: Tagged | None, laws: dict) -> Block | str:
    if tagged is None:
        return "None"
    items = []
    for field in laws[tagged.name]:
        value = tagged.fields.get(field.name)
        if value is not None and not (field.name == "parameters" and not len(value)):
            items.append((field.name + ": ", _law_value(value)))
    return Block(tagged.name + "(", ")", items)


def _law_value(value):
    if isinstance(value, dict):
        return Block("(", ")", [(key + ": ", number(inner)) for key, inner in value.items()])
    if isinstance(value, str):
        return text(value)
    return Filled([number(x) for x in value]) if isinstance(value, (list, tuple)) else number(value)


def group(node: Group) -> Block:
    items: list[tuple[str, object]] = [("name: ", text(node.name))]
    if node.movable:
        items.append(("movable: ", "true"))
    if node.position is not None or node.orientation is not None:
        items.append(("pose: ", pose(node)))
    if node.bound is not None:
        items.append(("bound: ", bound(node.bound)))
    if node.leaf_size is not None:
        items.append(("leaf_size: ", str(node.leaf_size)))
    if node.surface is not None:
        items.append(("surface: ", text(node.surface)))
    if node.groups:
        items.append(("groups: ", Block("[", "]", [("", group(below)) for below in node.groups], broken=True)))
    if node.primitives:
        below = [("", primitive(item)) for item in node.primitives]
        items.append(("primitives: ", Block("[", "]", below, broken=True)))
    return Block("(", ")", items, broken=True)


def bound(kind: str) -> str:
    return f"Custom({text(kind[7:])})" if kind.startswith("Custom:") else kind


def pose(node: Group) -> Block:
    items = []
    if node.position is not None:
        items.append(("position: ", tuple_of(node.position)))
    if node.orientation is not None:
        items.append(("orientation: ", tuple_of(node.orientation)))
    return Block("(", ")", items)


def primitive(item: Primitive) -> Block:
    items = [("name: ", text(item.name))]
    if item.surface is not None:
        items.append(("surface: ", text(item.surface)))
    for field in PRIMITIVES[item.kind]:
        if field.name in item.fields:
            items.append((field.name + ": ", _SHOWN[field.kind](item.fields[field.name])))
    return Block(item.kind + "(", ")", items)


def _places(places) -> Block:
    return Block("(", ")", [("", tuple_of(place)) for place in places])


def _triangles(faces) -> Filled:
    if isinstance(faces, np.ndarray):
        return Filled(rows(faces))
    return Filled(["(" + face[1:-1] + ")" for face in _faces(faces).tokens])


def _faces(faces) -> Filled:
    lists = faces.tolist() if isinstance(faces, np.ndarray) else faces
    return Filled(["[" + ", ".join(map(str, map(int, face))) + "]" for face in lists])


_SHOWN = {
    "vector": tuple_of,
    "direction": tuple_of,
    "semi_axes": tuple_of,
    "rotation": tuple_of,
    "vectors2": _places,
    "vectors3": _places,
    "number": number,
    "positive": number,
    "finite_stiffness": number,
    "not_negative": number,
    "text_value": text,
    "boolean": lambda value: "true" if value else "false",
    "response": str,
    "numbers": lambda values: Filled([number(x) for x in values]),
    "indices": lambda values: Filled([str(int(x)) for x in values]),
    "vertices": lambda array: Filled(rows(np.asarray(array, dtype=np.float64).reshape(-1, 3))),
    "triangles": _triangles,
    "faces": _faces,
}

# SPDX-License-Identifier: GPL-3.0-or-later
"""Model file -> `Model`, every number kept to the last bit.

The engine reads the file (core/engine.py) and judges notation, fields, types, names and indices, not the shapes: a model
whose polyhedron is open can be read, looked at and mended.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from .engine import wheel
from .model import Group, Model, Primitive, Tagged
from .schema import SOLID_NUMBERS, Field, Table, friction_laws, is_default, normal_laws, primitives, tells_friction


@dataclass(frozen=True)
class Fault:
    """One fault of a model file."""

    file: str
    line: int
    column: int
    path: str
    rule: str
    cause: str
    cure: str

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}: {self.path}: [{self.rule}] {self.cause}; {self.cure}"


class ModelFaults(ValueError):
    """A model file that cannot be read, with all of its faults."""

    def __init__(self, faults: list[Fault]):
        super().__init__("\n".join(map(str, faults)))
        self.faults = faults


def read_file(path) -> Model:
    """Reads a model file; raises `ModelFaults`, `WheelMissing`, or `OSError` if there is no such file."""
    with Path(path).open("rb"):
        pass  # what the system refuses is told as the system tells it
    return _read(lambda pong: pong.model.read(path))


def read_text(text: str, file: str = "model") -> Model:
    """Reads the text of a model file; raises `ModelFaults` or `WheelMissing`."""
    return _read(lambda pong: pong.model.parse(text, name=file))


def _read(read) -> Model:
    pong = wheel()
    try:
        return model_of(read(pong))
    except pong.ModelError as refused:
        raise ModelFaults([Fault(**error) for error in refused.errors]) from None


def model_of(data: dict) -> Model:
    """`Model` from the wheel's data; fields at their defaults are left out."""
    surfaces = {name: _surface(_fields(fields)) for name, fields in data["surfaces"].items()}
    pairs = [_pair(_fields(pair)) for pair in data.get("pairs") or []]
    entry_memory = data.get("entry_memory")
    filters = [tuple(pair) for pair in data.get("filters") or []]
    return Model(data["name"], surfaces, _group(data["root"], True), pairs, entry_memory is None or entry_memory, filters)


def _fields(value) -> dict:
    """The fields of a value; `Name` and `Name()` have none."""
    return value if isinstance(value, dict) else {}


def _tagged(value) -> tuple[str, dict]:
    """The name and the fields of `Name(…)`."""
    if isinstance(value, str):
        return value, {}
    ((name, fields),) = value.items()
    return name, _fields(fields)


def _surface(data: dict) -> dict:
    surface = {"stiffness": data["stiffness"]}
    surface |= {name: data[name] for name in SOLID_NUMBERS if data.get(name) is not None}
    if data.get("normal") is not None:
        surface["normal"] = _law(data["normal"], normal_laws())
    if tells_friction(data):
        surface["friction"] = _law(data["friction"], friction_laws())
    return surface


def _pair(data: dict) -> dict:
    pair = {"surfaces": tuple(data["surfaces"])}
    if data.get("stiffness") is not None:
        pair["stiffness"] = data["stiffness"]
    if data.get("normal") is not None:
        pair["normal"] = _law(data["normal"], normal_laws())
    if "friction" in data:
        # Here `None` is a value: no friction between these two.
        pair["friction"] = _law(data["friction"], friction_laws())
    return pair


def _law(value, laws: Table) -> Tagged | None:
    if value is None:
        return None
    name, fields = _tagged(value)
    return Tagged(name, _own(fields, laws[name]))


def _own(data: dict, wanted: tuple[Field, ...]) -> dict:
    """Fields present and not at their defaults, in the order of the schema."""
    found = {}
    for field in wanted:
        value = data.get(field.name)
        if field.kind in ("numbers", "indices") and value is not None:
            value = tuple(value)
        if value is not None and not is_default(value, field.default):
            found[field.name] = value
    return found


def _group(data: dict, is_root: bool = False) -> Group:
    pose, bound = _fields(data.get("pose")), data.get("bound")
    if isinstance(bound, dict):
        bound = f"Custom:{bound['Custom']}"
    return Group(
        data["name"],
        bool(data.get("movable")) and not is_root,
        pose.get("position"),
        pose.get("orientation"),
        None if bound == "Aabb" and (data.get("movable") or is_root) else bound,
        data.get("surface"),
        [_group(below) for below in data.get("groups") or []],
        [_primitive(primitive) for primitive in data.get("primitives") or []],
        data.get("leaf_size"),
        data.get("contact"),
    )


def _primitive(value) -> Primitive:
    kind, fields = _tagged(value)
    return Primitive(kind, fields["name"], _own(fields, primitives()[kind]), fields.get("surface"))

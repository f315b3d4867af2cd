# SPDX-License-Identifier: GPL-3.0-or-later
"""Nodes of RON -> Python values, with the same rules (and rule names) as the engine's loader."""

from __future__ import annotations

import difflib
import math
from dataclasses import dataclass

import numpy as np

from .ron_rows import Rows
from .ron_tree import List, Name, Node, Struct, Tuple, describe
from .schema import FRICTION_LAWS, NORMAL_LAWS, REQUIRED, RESPONSES, RESTITUTIONS, Field
from .model import Tagged

QUATERNION_NORM_TOLERANCE = 1e-3
LARGEST = 1e100  # of every number but a rigid stiffness, either sign: as the engine has it
SOFTEST, STIFFEST = 1e-100, LARGEST  # N/m, of what is not rigid


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
    """A model file that cannot be read, with all that is wrong with it."""

    def __init__(self, faults: list[Fault]):
        super().__init__("\n".join(map(str, faults)))
        self.faults = faults


class Unreadable(Exception):
    """A value of no use; the fault is noted already."""


def cure_for(name: str, candidates) -> str:
    near = difflib.get_close_matches(name, candidates, 1)
    return f"did you mean `{near[0]}`?" if near else f"choose from: {', '.join(candidates)}"


class ValueReader:
    """Reads values and notes faults; a value that makes no sense raises `Unreadable`."""

    def __init__(self, text: str, file: str):
        self.text, self.file, self.faults = text, file, []

    def fault(self, at: int, path: str, rule: str, cause: str, cure: str) -> None:
        line_start = self.text.rfind("\n", 0, at) + 1
        line = self.text.count("\n", 0, at) + 1
        self.faults.append(Fault(self.file, line, at - line_start + 1, path, rule, cause, cure))

    def refuse(self, node: Node, path: str, rule: str, cause: str, cure: str) -> None:
        self.fault(node.at, path, rule, cause, cure)
        raise Unreadable

    def wrong_type(self, node: Node, path: str, expected: str) -> None:
        cause = f"expected {expected}, found {describe(node.value)}"
        self.refuse(node, path, "wrong-type", cause, f"write {expected}")

    # --- fields --------------------------------------------------------------------------------------------------

    def open(self, node: Node, path: str, allowed: list[str]) -> dict[str, Node]:
        """The fields of a struct by name, those that are `None` too."""
        value = node.value
        if isinstance(value, Name) or (isinstance(value, Tuple) and not value.items):
            return {}
        if not isinstance(value, Struct):
            cause = f"expected named fields in parentheses, found {describe(value)}"
            self.refuse(node, path, "wrong-type", cause, f"write ({': …, '.join(allowed)}: …)")
        found: dict[str, Node] = {}
        for name, at, item in value.fields:
            if name not in allowed:
                self.fault(at, path, "unknown-field", f"there is no field `{name}` here", cure_for(name, allowed))
            elif name in found:
                self.fault(at, path, "repeated-field", f"the field `{name}` is given twice", "keep one of them")
            else:
                found[name] = item
        return found

    def optional(self, fields: dict[str, Node], name: str) -> Node | None:
        node = fields.get(name)
        return None if node is None else inner(node)

    def required(self, owner: Node, fields: dict[str, Node], name: str, path: str) -> Node:
        node = self.optional(fields, name)
        if node is None:
            self.refuse(owner, path, "missing-field", f"the field `{name}` is missing", f"add `{name}: …`")
        return node

    def read_fields(self, owner: Node, fields: dict[str, Node], wanted: tuple[Field, ...], path: str) -> dict:
        """All wanted fields that are there and not at their defaults."""
        values, whole = {}, True
        for field in wanted:
            try:
                if field.default is REQUIRED:
                    node = self.required(owner, fields, field.name, path)
                else:
                    node = self.optional(fields, field.name)
                if node is None:
                    continue
                value = getattr(self, field.kind)(node, path, field.name)
                if field.default is REQUIRED or not is_default(value, field.default):
                    values[field.name] = value
            except Unreadable:
                whole = False
        if not whole:
            raise Unreadable
        return values

    # --- single values -------------------------------------------------------------------------------------------

    def any_number(self, node: Node, path: str, _what: str = "") -> float:
        if isinstance(node.value, bool) or not isinstance(node.value, float):
            self.wrong_type(node, path, "a number")
        return node.value

    def finite(self, node: Node, path: str) -> float:
        value = self.any_number(node, path)
        if not math.isfinite(value):
            self.refuse(node, path, "not-finite", f"{value} is no finite number", "give a finite number")
        return value

    def number(self, node: Node, path: str, _what: str = "") -> float:
        value = self.finite(node, path)
        if abs(value) > LARGEST:
            cure = "give a smaller number; check its unit"
            self.refuse(node, path, "too-large", f"{value:g} is beyond ±{LARGEST:g}", cure)
        return value

    def positive(self, node: Node, path: str, what: str) -> float:
        return self.above_zero(node, path, what, self.number(node, path))

    def above_zero(self, node: Node, path: str, what: str, value: float) -> float:
        if value <= 0.0:
            self.refuse(node, path, "not-positive", f"the {what} is {value}", f"the {what} must be above zero")
        return value

    def finite_stiffness(self, node: Node, path: str, what: str) -> float:
        return self.in_range(node, path, what, self.above_zero(node, path, what, self.finite(node, path)))

    def in_range(self, node: Node, path: str, what: str, value: float, otherwise: str = "") -> float:
        if not SOFTEST <= value <= STIFFEST:
            cure = f"give {SOFTEST:g} to {STIFFEST:g} N/m{otherwise}"
            self.refuse(node, path, "stiffness-range", f"the {what} is {value:g}", cure)
        return value

    def not_negative(self, node: Node, path: str, what: str) -> float:
        value = self.number(node, path)
        if value < 0.0:
            self.refuse(node, path, "negative", f"the {what} is {value}", f"the {what} must be zero or above")
        return value

    def text_value(self, node: Node, path: str, _what: str = "") -> str:
        if not isinstance(node.value, str):
            self.wrong_type(node, path, "a text in quotes")
        return node.value

    def boolean(self, node: Node, path: str, _what: str = "") -> bool:
        if not isinstance(node.value, bool):
            self.wrong_type(node, path, "true or false")
        return node.value

    def variant(self, node: Node, path: str, expected) -> str:
        value = node.value
        name = value.text if isinstance(value, Name) else getattr(value, "name", None)
        if not isinstance(value, (Name, Struct, Tuple)) or name is None:
            self.wrong_type(node, path, "one of " + ", ".join(expected))
        if name not in expected:
            self.refuse(node, path, "unknown-kind", f"`{name}` is not known here", cure_for(name, list(expected)))
        return name

    def response(self, node: Node, path: str, _what: str = "") -> str:
        return self.variant(node, path, RESPONSES)

    def exponent(self, node: Node, path: str, _what: str = "") -> float:
        value = self.number(node, path)
        if value not in (1.0, 1.5):
            self.refuse(node, path, "exponent", f"the exponent is {value}", "it is 1.0 or 1.5")
        return value

    def restitution_e(self, node: Node, path: str, _what: str = "") -> float:
        value = self.number(node, path)
        if not 0.0 < value <= 1.0:
            cure = "it lies above 0 and is at most 1"
            self.refuse(node, path, "restitution-range", f"the restitution e is {value}", cure)
        return value

    def restitution_mass(self, node: Node, path: str, _what: str = "") -> dict:
        return self._restitution(node, path, "restitution_mass")

    def restitution_speed(self, node: Node, path: str, _what: str = "") -> dict:
        return self._restitution(node, path, "restitution_speed")

    def _restitution(self, node: Node, path: str, kind: str) -> dict:
        wanted = RESTITUTIONS[kind]
        return self.read_fields(node, self.open(node, path, [f.name for f in wanted]), wanted, path)

    # --- tuples and lists ----------------------------------------------------------------------------------------

    def tuple(self, node: Node, path: str, count: int, form: str) -> tuple[float, ...]:
        value = node.value
        if not isinstance(value, Tuple) or value.name or len(value.items) != count:
            self.wrong_type(node, path, form)
        return tuple(self.number(item, path) for item in value.items)

    def vector(self, node: Node, path: str, _what: str = "") -> tuple[float, ...]:
        return self.tuple(node, path, 3, "a tuple of three numbers (x, y, z)")

    def direction(self, node: Node, path: str, what: str) -> tuple[float, ...]:
        vector = self.vector(node, path)
        if not any(vector):
            self.refuse(node, path, "zero-direction", f"the {what} is zero", "give it a length; any will do")
        return vector

    def semi_axes(self, node: Node, path: str, _what: str = "") -> tuple[float, ...]:
        axes = self.vector(node, path)
        if min(axes) <= 0.0:
            cure = "all three must be above zero"
            self.refuse(node, path, "not-positive", f"a semi-axis is {min(axes)}", cure)
        return axes

    def rotation(self, node: Node, path: str, _what: str = "") -> tuple[float, ...]:
        quaternion = self.tuple(node, path, 4, "a quaternion (w, x, y, z)")
        norm = math.sqrt(sum(c * c for c in quaternion))
        if not abs(norm - 1.0) <= QUATERNION_NORM_TOLERANCE:
            cure = "give w, x, y, z with w² + x² + y² + z² = 1"
            self.refuse(node, path, "quaternion-norm", f"the norm of the quaternion is {norm}", cure)
        return quaternion

    def vectors2(self, node: Node, path: str, _what: str = "") -> tuple:
        return self._vectors(node, path, 2)

    def vectors3(self, node: Node, path: str, _what: str = "") -> tuple:
        return self._vectors(node, path, 3)

    def _vectors(self, node: Node, path: str, count: int) -> tuple:
        value = node.value
        if not isinstance(value, Tuple) or value.name or len(value.items) != count:
            self.wrong_type(node, path, f"a tuple of {count} places ((x, y, z), …)")
        return tuple(self.vector(item, path) for item in value.items)

    def list_items(self, node: Node, path: str) -> list[Node]:
        if not isinstance(node.value, List):
            self.wrong_type(node, path, "a list in brackets")
        return node.value.items

    def numbers(self, node: Node, path: str, _what: str = "") -> tuple[float, ...]:
        if not isinstance(node.value, List):
            self.wrong_type(node, path, "a list of numbers")
        return tuple(self.number(item, path) for item in node.value.items)

    def indices(self, node: Node, path: str, _what: str = "") -> tuple[int, ...]:
        values = self.numbers(node, path)
        for value in values:
            if value < 0.0 or value % 1.0:
                cure = "faces count from 0 in the order of the file"
                self.refuse(node, path, "index-out-of-range", f"there is no face {value}", cure)
        return tuple(int(value) for value in values)

    def rows(self, node: Node, path: str, form: str) -> Rows:
        """Rows of numbers, whatever way the list was read."""
        if isinstance(node.value, Rows):
            return node.value
        rows = [self._row(item, path, form) for item in self.list_items(node, path)]
        ends = np.cumsum([len(row) for row in rows], dtype=np.int64)
        numbers = np.array([number for row in rows for number in row], dtype=np.float64)
        return Rows(numbers, ends, self.text, node.at, node.at)

    def _row(self, item: Node, path: str, form: str) -> list[float]:
        if not isinstance(item.value, (Tuple, List)) or getattr(item.value, "name", None):
            self.wrong_type(item, path, form)
        return [self.any_number(number, path) for number in item.value.items]

    def vertices(self, node: Node, path: str, what: str = "vertices") -> np.ndarray:
        rows = self.rows(node, f"{path}/{what}", "(x, y, z)")
        if len(rows) and rows.width() != 3:
            cure = "write three finite numbers (x, y, z)"
            self.refuse(node, f"{path}/{what}", "wrong-type", "a vertex has not three numbers", cure)
        vertices = rows.numbers.reshape(-1, 3)
        bad = np.flatnonzero(~np.isfinite(vertices).all(axis=1))
        if len(bad):
            cure = "write three finite numbers (x, y, z)"
            self.refuse(node, f"{path}/{what}[{bad[0]}]", "not-finite", "a coordinate is not finite", cure)
        bad = np.flatnonzero(~(np.abs(vertices) <= LARGEST).all(axis=1))
        if len(bad):
            cause, cure = f"a coordinate is beyond ±{LARGEST:g}", "give smaller numbers; check their unit"
            self.refuse(node, f"{path}/{what}[{bad[0]}]", "too-large", cause, cure)
        return vertices

    def faces(self, node: Node, path: str, what: str = "faces") -> list[np.ndarray] | np.ndarray:
        """Vertex indices by face: an (n, k) array if all have k corners, else a list of arrays."""
        rows = self.rows(node, f"{path}/{what}", "a face of vertex indices")
        numbers = rows.numbers
        bad = np.flatnonzero(~((numbers >= 0.0) & (numbers < 2.0**32 - 1) & (numbers % 1.0 == 0.0)))
        if len(bad):
            face = int(np.searchsorted(rows.ends, bad[0], side="right"))
            cause, cure = f"{numbers[bad[0]]} is no index", "indices are whole numbers from 0"
            at = Node(rows.row_at(face) if rows.end > rows.start else node.at, None)
            self.refuse(at, f"{path}/{what}[{face}]", "not-an-index", cause, cure)
        indices, width = numbers.astype(np.int64), rows.width()
        if width is not None:
            return indices.reshape(-1, width)
        return np.split(indices, rows.ends[:-1]) if len(rows) else np.zeros((0, 3), dtype=np.int64)

    def triangles(self, node: Node, path: str, what: str = "triangles") -> list[np.ndarray] | np.ndarray:
        return self.faces(node, path, what)

    # --- laws ----------------------------------------------------------------------------------------------------

    def law(self, node: Node, path: str, laws: dict[str, tuple[Field, ...]]) -> Tagged:
        name = self.variant(node, path, laws)
        fields = self.open(node, path, [field.name for field in laws[name]])
        for one in ("damping", "dissipation"):
            if self.optional(fields, one) and self.optional(fields, "restitution"):
                cause = f"`{one}` and `restitution` say the same thing twice"
                self.refuse(fields["restitution"], path, "either-or", cause, "keep one of them")
        return Tagged(name, self.read_fields(node, fields, laws[name], path))

    def normal_law(self, node: Node, path: str, _what: str = "") -> Tagged:
        return self.law(node, path, NORMAL_LAWS)

    def friction_law(self, node: Node, path: str, _what: str = "") -> Tagged | None:
        if is_none(node):
            return None
        if isinstance(node.value, Name):
            self.variant(node, path, ["None", *FRICTION_LAWS])
        return self.law(node, path, FRICTION_LAWS)


def is_none(node: Node) -> bool:
    return isinstance(node.value, Name) and node.value.text == "None"


def inner(node: Node) -> Node | None:
    """`Some(x)` is `x`, `None` is nothing."""
    if is_none(node):
        return None
    value = node.value
    if isinstance(value, Tuple) and value.name == "Some" and len(value.items) == 1:
        return value.items[0]
    return node


def is_default(value, default) -> bool:
    if default is None:
        return False
    if isinstance(default, tuple):
        return not isinstance(value, np.ndarray) and tuple(value) == default
    return value == default

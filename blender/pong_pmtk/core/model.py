# SPDX-License-Identifier: GPL-3.0-or-later
"""A model as in a model file (docs/model_format.md): the result of `build`, read and written by `ron`.

Numbers are float64, metres and SI throughout; quaternions (w, x, y, z). `None` is a field that is left out.
"""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass
class Primitive:
    """`kind` and the fields of docs/model_format.md under the same names, in the order of writing."""

    kind: str
    name: str
    fields: dict  # without name and surface
    surface: str | None = None


@dataclass
class Group:
    name: str
    movable: bool = False
    position: tuple[float, float, float] | None = None  # in the frame of the group above
    orientation: tuple[float, float, float, float] | None = None
    bound: str | None = None  # "Aabb", "Sphere", "Obb", "Above" or "Custom:kind"
    surface: str | None = None
    groups: list[Group] = field(default_factory=list)
    primitives: list[Primitive] = field(default_factory=list)
    leaf_size: int | None = None  # most elements of a leaf
    contact: str | None = None  # "Solid" or "Marked"; `None` for that of the group above


@dataclass
class Tagged:
    """A named value such as `Linear(damping: 250.0)`: laws of force and friction."""

    name: str
    fields: dict


@dataclass
class Model:
    name: str
    surfaces: dict[str, dict]  # name -> fields; `normal` and `friction` are Tagged or None, the others numbers
    root: Group
    pairs: list[dict] = field(default_factory=list)
    entry_memory: bool = True
    filters: list[tuple[str, str]] = field(default_factory=list)  # groups that never touch, by path or name

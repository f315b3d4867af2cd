# SPDX-License-Identifier: GPL-3.0-or-later
"""Snapshot -> Model. Content that cannot be exported faithfully is a finding of severity error; then there is no model."""

from __future__ import annotations

from dataclasses import dataclass, field

from .build_groups import build_root
from .shape import Origin
from .engine import CURE, is_there
from .engine_check import check_loads
from .finding import Findings
from .model import Model, Primitive, Tagged
from .same_place import check_same_place
from .scene import Scene, check_scene, find_root
from .snapshot import Snapshot, SnapshotObject
from .surfaces import checked
from .touch import choose
from .triangle_check import check_triangles

MIXED = "a μ of 0.1 there becomes {:.3g}"


@dataclass
class Built:
    """Result of a build: a model (`None` if there are errors), its mesh files, and all findings."""

    model: Model | None
    findings: Findings
    files: dict[str, bytes] = field(default_factory=dict)
    origins: dict[int, Origin] = field(default_factory=dict)
    """Source object of each `Primitive` of the model, by id()."""
    loaded: object | None = None
    """The model as loaded by the engine (`pong.Model`), without custom primitives; `None` if it is empty without them."""

    def object_of(self, primitive: Primitive) -> str:
        return self.origins[id(primitive)].object


def build(snapshot: Snapshot, root: str = "") -> Built:
    """Builds the model below the root of that name, or below the only root."""
    findings = Findings()
    scene = Scene(snapshot, findings)
    top = find_root(scene, root)
    if top is None:
        return Built(None, findings)
    check_scene(scene, top)
    surfaces, pairs = _tables(scene, top)
    group, origins, files = build_root(scene, top, surfaces)
    check_same_place(scene, group, origins)
    settings = top.settings
    name = (settings.name if settings else "") or group.name
    model = Model(name, surfaces, group, pairs)
    if settings:
        model.entry_memory, model.filters = settings.entry_memory, list(settings.filters)
    choose(scene, top, model)
    _unused_surfaces(scene, top, model)
    _rigid_friction(scene, top, surfaces)
    loaded = _judged_by_engine(scene, top, model, files, origins)
    good = not findings.errors
    return Built(model if good else None, findings, files if good else {}, origins, loaded if good else None)


def _judged_by_engine(scene: Scene, top: SnapshotObject, model: Model, files: dict[str, bytes], origins):
    """Findings that only the engine can make; all others have been made by now."""
    if not is_there():
        cause = "the Python package `pong` is not there, so nobody can say whether the engine would take the model"
        scene.findings.error("no-wheel", ("", scene.snapshot.source), cause, CURE)
        return None
    check_triangles(scene, model.root, origins)
    return None if scene.findings.errors else check_loads(scene, top, model, files, origins)


def _tables(scene: Scene, root: SnapshotObject) -> tuple[dict, list]:
    if root.settings is None:
        return {}, []
    name = root.settings.name or root.model_name
    surfaces, pairs, faults = checked(root.settings.surfaces, root.settings.pairs, name)
    for fault in faults:
        scene.findings.error(fault.rule, (root.name, fault.path), fault.cause, fault.cure)
    return surfaces, pairs


def _unused_surfaces(scene: Scene, root: SnapshotObject, model: Model) -> None:
    used: set[str | None] = set()
    open_ = [model.root]
    while open_:
        group = open_.pop()
        used |= {group.surface, *(primitive.surface for primitive in group.primitives)}
        open_ += group.groups
    for name in model.surfaces:
        if name not in used:
            cause = f'nothing is made of the surface "{name}"'
            scene.findings.hint("unused-surface", (root.name, f"surfaces/{name}"), cause, "assign it, or remove it")


def _rigid_friction(scene: Scene, root: SnapshotObject, surfaces: dict) -> None:
    """Findings on rigid surfaces that change the friction of their partners."""
    for name, fields in surfaces.items():
        law = fields.get("friction")
        mu = law.fields.get("mu") if isinstance(law, Tagged) else None
        if fields.get("stiffness") != float("inf") or not mu:
            continue
        cause = f'the rigid surface "{name}" gives a μ of {mu:g}, which mixes with that of what it meets: {MIXED}'
        cure = "leave its friction to what it meets, unless this is meant"
        scene.findings.hint("rigid-friction", (root.name, f"surfaces/{name}"), cause.format(0.2 * mu / (0.1 + mu)), cure)

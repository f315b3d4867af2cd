# SPDX-License-Identifier: GPL-3.0-or-later
"""A finished model before the engine's loader: what it refuses is told at the object it comes from."""

from __future__ import annotations

import dataclasses
import re
import tempfile
from pathlib import Path

from .build_primitives import Origin
from .engine import wheel
from .model import Group, Model
from .scene import Scene
from .snapshot import SnapshotObject
from .write import write_files, write_text

ELEMENT = re.compile(r"/(triangles|faces|vertices)\[(\d+)\]$")


def check_loads(scene: Scene, top: SnapshotObject, model: Model, files: dict[str, bytes], origins: dict[int, Origin]):
    """Has the loader judge a model with its mesh files; returns it as the wheel has it, or `None`.

    Custom primitives and volumes are the host's, which the wheel does not know: the model is judged without them.
    """
    known = _known(model.root)
    if known is None:
        return None
    found = _judged(dataclasses.replace(model, root=known), files)
    paths = dict(_paths(known, known.name, origins))
    for error in found.errors:
        path = error["path"]
        element = ELEMENT.search(path)
        origin = paths.get(path[: element.start()] if element else path)
        where = (origin.object, origin.path) if origin else (top.name, path)
        faces = []
        if element and origin and element.group(1) != "vertices":
            face = int(element.group(2))
            faces = [face if origin.faces is None else origin.faces[face]]
        evaluated = bool(origin and origin.evaluated)
        scene.findings.error(error["rule"], where, error["cause"], error["cure"], faces=faces, evaluated=evaluated)
    return found.model


def _judged(model: Model, files: dict[str, bytes]):
    check = wheel().model.check
    if not files:
        return check(write_text(model))
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "model.ron"
        write_files(path, model, files)
        return check(path.read_text(encoding="utf-8"), folder=folder)


def _known(group: Group) -> Group | None:
    """A group without what is the host's own; `None` if nothing is left of it."""
    groups = [below for below in map(_known, group.groups) if below is not None]
    primitives = [primitive for primitive in group.primitives if primitive.kind != "Custom"]
    bound = None if (group.bound or "").startswith("Custom:") else group.bound
    if not groups and not primitives:
        return None
    return dataclasses.replace(group, bound=bound, groups=groups, primitives=primitives)


def _paths(group: Group, path: str, origins: dict[int, Origin]):
    """Every primitive's path in the model, with its origin."""
    for primitive in group.primitives:
        yield f"{path}/{primitive.name}", origins[id(primitive)]
    for below in group.groups:
        yield from _paths(below, f"{path}/{below.name}", origins)

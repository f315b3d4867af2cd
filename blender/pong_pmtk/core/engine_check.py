# SPDX-License-Identifier: GPL-3.0-or-later
"""Check of a finished model by the engine's loader: refusals and warnings are reported at their source objects."""

from __future__ import annotations

import dataclasses
import re
import tempfile
from pathlib import Path

from .shape import Origin
from .engine import wheel
from .model import Group, Model
from .scene import Scene
from .snapshot import SnapshotObject
from .touch import is_of_solids, tell_marked
from .write import write_files, write_text

ELEMENT = re.compile(r"/(triangles|faces|vertices)\[(\d+)\]$")
WARNING = re.compile(r"^[^:]*:\d+: (.*)$", re.DOTALL)  # file and line of the text, which nobody has seen
# The triangles of a body have been checked already, with a rule for every finding (triangle_check.py).
OF_TRIANGLES = ("it counts as free", "their common edge counts as free", "T-junction: ", "do not fit together")


def check_loads(scene: Scene, top: SnapshotObject, model: Model, files: dict[str, bytes], origins: dict[int, Origin]):
    """Checks a model and its mesh files with the loader; returns it as the wheel has it, or `None`.

    Custom primitives and volumes are the host's, which the wheel does not know: the model is judged without them.
    """
    known = _known(model.root)
    if known is None:
        return None
    found = _judged(dataclasses.replace(model, root=known), files)
    paths = dict(_paths(known, known.name, origins))
    refused = [error for error in found.errors if is_of_solids(error["rule"])]
    if top.mark.contact == "Automatic" and model.root.contact == "Solid" and refused:
        tell_marked(scene, top, f"{refused[0]['path']}: {refused[0]['cause']}")
        model.root.contact = known.contact = None
        found = _judged(dataclasses.replace(model, root=known), files)
    for error in found.errors:
        where, more = _place(error["path"], paths, top)
        fix = _fix(scene, where[0], error)
        scene.findings.error(error["rule"], where, error["cause"], error["cure"], fix=fix, **more)
    for warning in found.warnings:
        path, what = _parted(WARNING.sub(r"\1", warning), paths)
        if not any(words in what for words in OF_TRIANGLES):
            cause, _, cure = what.partition("; ")
            where, more = _place(path, paths, top)
            scene.findings.warn("loader-warning", where, cause, cure or "change it, or leave it: the model loads", **more)
    return found.model


def _fix(scene: Scene, name: str, error: dict) -> str:
    """Name of the repair of a fault of a solid; "" if there is none."""
    if error["rule"] == "solid-volume" and "faces inwards" in error["cause"]:
        return "recalculate-normals"
    if error["rule"] != "open-solid":
        return ""
    is_turned = any(finding.rule == "winding" and finding.object == name for finding in scene.findings)
    return "recalculate-normals" if is_turned else "merge-by-distance"


def _parted(warning: str, paths: dict[str, Origin | None]) -> tuple[str, str]:
    """Path and text of a warning. A name may contain a colon: the path is the longest known prefix."""
    known = max((path for path in paths if warning.startswith(path)), key=len, default="")
    element, _, what = warning[len(known) :].partition(": ")
    return known + element, what


def _place(path: str, paths: dict[str, Origin | None], top: SnapshotObject):
    """Source of a model path: object and path in the scene, and additional fields of a finding."""
    element = ELEMENT.search(path)
    origin = paths.get(path[: element.start()] if element else path)
    if origin is None:
        return (top.name, path), {}
    faces = []
    if element and element.group(1) != "vertices":
        face = int(element.group(2))
        faces = [face if origin.faces is None else origin.faces[face]]
    return (origin.object, origin.path), {"faces": faces, "evaluated": bool(origin.evaluated)}


def _judged(model: Model, files: dict[str, bytes]):
    check = wheel().model.check
    if not files:
        return check(write_text(model))
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "model.ron"
        write_files(path, model, files)
        return check(path.read_text(encoding="utf-8"), folder=folder)


def _known(group: Group) -> Group | None:
    """A group without host-defined kinds; `None` if it is empty then."""
    groups = [below for below in map(_known, group.groups) if below is not None]
    primitives = [primitive for primitive in group.primitives if primitive.kind != "Custom"]
    bound = None if (group.bound or "").startswith("Custom:") else group.bound
    if not groups and not primitives:
        return None
    return dataclasses.replace(group, bound=bound, groups=groups, primitives=primitives)


def _paths(group: Group, path: str, origins: dict[int, Origin]):
    """Every path in the model, with the origin of a primitive."""
    yield path, None
    for primitive in group.primitives:
        yield f"{path}/{primitive.name}", origins[id(primitive)]
    for below in group.groups:
        yield from _paths(below, f"{path}/{below.name}", origins)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Check, export and import: the common part of the operators and the command line."""

from dataclasses import dataclass, field
from pathlib import Path

import bpy

from ..core.build import build
from ..core.engine import WheelMissing
from ..core.finding import SEVERITIES
from ..core.mesh_file import MeshFileError
from ..core.model import Model
from ..core.read import ModelFaults, read_file
from ..core.touch import sentences
from ..core.unbuild import unbuild
from ..core.write import write_files
from .extract import snapshot
from .insert import insert


@dataclass
class Result:
    """Result of a check; `model` only if there is no error."""

    name: str
    model: Model | None
    findings: list
    files: dict = field(default_factory=dict)  # mesh files beside the model: path -> contents
    loaded: object | None = None  # the model as the engine has it (`Built.loaded` of the core)

    def summary(self):
        count = {level: sum(f.severity == level for f in self.findings) for level in SEVERITIES}
        told = ", ".join(f"{count[level]} {level}{'s' * (count[level] != 1)}" for level in SEVERITIES if count[level])
        return f"{self.name or 'model'}: {told or 'nothing to find fault with'}"


def touches(result):
    """Sentences about what touches what in the model of a result; none without a model."""
    return sentences(result.model) if result.model is not None else []


class Refused(ValueError):
    """An export that was refused; the message lists every error."""

    def __init__(self, result):
        super().__init__("\n".join(str(finding) for finding in result.findings if finding.severity == "error"))
        self.result = result


def check(context, root=""):
    """Builds the model of a root, or of the scene's only one, and writes nothing."""
    built = build(snapshot(context), root)
    return Result(root, built.model, built.findings, built.files, built.loaded)


def export(context, path, root=""):
    """Writes a model file, whole or not at all. Raises `Refused` if anything in the scene is an error."""
    result = check(context, root)
    if result.model is None:
        raise Refused(result)
    write_files(Path(path), result.model, result.files)
    return result


class NotMetres(ValueError):
    """A model in metres cannot be opened in a scene of other units."""


def load(context, path):
    """Opens a model file as marked objects; returns the root.

    Raises `OSError`, the core's `ModelFaults`, `MeshFileError` or `WheelMissing`, or `NotMetres`; then nothing was made.
    """
    path, scale = Path(path), context.scene.unit_settings.scale_length
    if scale != 1.0:
        raise NotMetres(f"{path}: models are in metres, a unit of this scene is {scale:g} m; set its unit scale to 1")
    facts = unbuild(read_file(path), path.parent, set(bpy.data.objects.keys()))
    made = insert(facts, context.scene)
    context.view_layer.update()
    return next(made[thing.name] for thing in facts.objects if thing.mark.role == "root")


LOAD_FAULTS = (ModelFaults, MeshFileError, NotMetres, WheelMissing)

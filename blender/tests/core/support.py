# SPDX-License-Identifier: GPL-3.0-or-later
"""Shared parts of the core's tests."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "blender" / "pong_pmtk"))

import numpy as np  # noqa: E402
from core import author, exact  # noqa: E402
from core.build import build  # noqa: E402
from core.write import write_files, write_text  # noqa: E402

STEEL = {"steel": {"stiffness": 1e6}}
PONG = os.environ.get("PONG")  # the built program; tests that need it are skipped without


def scene(name="model", **more):
    """A scene with a steel root."""
    return author.Scene(name, surfaces=dict(STEEL), surface="steel", **more)


def built(thing, **more):
    """The model of an authored scene, which must have no errors."""
    made = build(thing.snapshot(**more))
    assert made.model is not None, "\n".join(map(str, made.findings))
    return made


def rules(made, severity):
    return [finding.rule for finding in made.findings if finding.severity == severity]


def models():
    """All model files of the repository."""
    paths = sorted((ROOT / "models").glob("*/*.ron"))
    return [path for path in paths if '"pong-model"' in path.read_text()]


def mesh_files(path):
    """Mesh files named by a model file, beside it: name -> bytes."""
    names = re.findall(r'\bfile: "([^"]*)"', path.read_text(encoding="utf-8"))
    return {name: (path.parent / name).read_bytes() for name in names}


def check(path):
    """The engine's verdict on a model file: its hash, or `None` and the text of its faults."""
    result = subprocess.run([PONG, "check", "--alone", str(path)], capture_output=True, text=True)
    found = re.search(r"hash ([0-9a-f]{16})", result.stdout)
    return (found.group(1) if found and result.returncode == 0 else None), result.stdout + result.stderr


def check_model(model, files=None):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "model.ron"
        write_files(path, model, files)
        return check(path)


def in_single_precision(snapshot):
    """The snapshot as returned by Blender: all numbers that Blender stores in 32 bits are rounded."""
    for thing in snapshot.objects:
        place, mark = thing.transform, thing.mark
        for name in ("location", "rotation", "scale", "delta_location", "delta_rotation", "delta_scale"):
            setattr(place, name, tuple(exact.rounded(getattr(place, name)).tolist()))
        if place.parent_inverse is not None:
            place.parent_inverse = exact.rounded(place.parent_inverse)
        for mesh in (thing.mesh, thing.stored_mesh):
            if mesh is not None:
                mesh.vertices = exact.rounded(mesh.vertices)
        for name in ("radius", "length", "reach", "thickness", "file_scale"):
            if getattr(mark, name) is not None:
                setattr(mark, name, float(exact.rounded(getattr(mark, name))))
        mark.semi_axes = tuple(exact.rounded(mark.semi_axes).tolist())
        mark.radii = tuple(exact.rounded(mark.radii).tolist())
    return snapshot


__all__ = [
    "PONG",
    "ROOT",
    "STEEL",
    "author",
    "build",
    "built",
    "check",
    "check_model",
    "models",
    "np",
    "rules",
    "scene",
]
__all__ += ["in_single_precision", "write_files", "write_text"]

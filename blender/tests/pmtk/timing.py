# SPDX-License-Identifier: GPL-3.0-or-later
"""Durations of export and import, by number of triangles and of objects. No test: run it on a quiet machine.

    PYTHONPATH=blender target/blender/5.0.1/bin/python blender/tests/pmtk/timing.py [REPEATS]

Prints the least of some repeats. Reading the scene, building and writing are told apart.
"""

import os
import sys
import tempfile
import time
from pathlib import Path

import bpy
import numpy as np
import pong_pmtk
from pong_pmtk.core.build import build
from pong_pmtk.core.marks import Mark, ModelSettings
from pong_pmtk.core.read import read_file
from pong_pmtk.core.snapshot import Mesh
from pong_pmtk.core.unbuild import unbuild
from pong_pmtk.core.write import write_files
from pong_pmtk.scene.extract import snapshot
from pong_pmtk.scene.insert import insert
from pong_pmtk.scene.meshes import fill
from pong_pmtk.store import marks

TRIANGLES = (1_000, 100_000, 1_000_000)
OBJECTS = (1_000, 10_000)


def empty_file():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    root = bpy.data.objects.new("model", None)
    bpy.context.scene.collection.objects.link(root)
    marks.write_mark(root, Mark(role="root", surface="soil"))
    marks.write_settings(root, ModelSettings(surfaces={"soil": {"stiffness": 1e5}}))
    return root


def terrain(count):
    """A rolling square of about `count` triangles, 100 m wide."""
    side = round((count / 2) ** 0.5)
    x, y = (axis.ravel() for axis in np.meshgrid(*[np.linspace(-50, 50, side + 1)] * 2))
    vertices = np.stack([x, y, np.sin(x) * np.cos(0.7 * y)], axis=1)
    corner = (np.arange(side) * (side + 1))[:, None] + np.arange(side)
    a, b, c, d = (corner.ravel() + offset for offset in (0, 1, side + 2, side + 1))
    faces = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
    mesh = bpy.data.meshes.new("terrain")
    fill(mesh, Mesh(vertices, np.empty((0, 2), int), faces.ravel(), np.arange(0, faces.size + 1, 3)))
    obj = bpy.data.objects.new("terrain", mesh)
    bpy.context.scene.collection.objects.link(obj)
    obj.parent = empty_file_root
    marks.write_mark(obj, Mark(role="primitive", kind="TriangleMesh"))
    return len(faces)


def points(count):
    for index in range(count):
        obj = bpy.data.objects.new(f"tip_{index}", None)
        bpy.context.scene.collection.objects.link(obj)
        obj.parent, obj.location = empty_file_root, (index * 0.1, 0.0, 0.0)
        marks.write_mark(obj, Mark(role="primitive", kind="Point"))
    return count


def timed(times, name, function, *arguments):
    started = time.perf_counter()
    result = function(*arguments)
    times[name] = min(times.get(name, float("inf")), time.perf_counter() - started)
    return result


def measure(make, count, repeats, path):
    global empty_file_root
    empty_file_root = empty_file()
    made, times = make(count), {}
    bpy.context.view_layer.update()
    for _ in range(repeats):
        facts = timed(times, "read scene", snapshot, bpy.context)
        built = timed(times, "build", build, facts)
        assert built.model is not None, built.findings[:5]
        timed(times, "write file", write_files, path, built.model, built.files)
    for _ in range(repeats):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        model = timed(times, "read file", read_file, path)
        facts = timed(times, "unbuild", unbuild, model, path.parent)
        timed(times, "make scene", insert, facts, bpy.context.scene)
    parts = list(times.values())
    told = ", ".join(f"{name} {seconds:.2f}" for name, seconds in times.items())
    print(f"{made:>9} {make.__name__:8} export {sum(parts[:3]):7.2f} s  import {sum(parts[3:]):7.2f} s  "
          f"{path.stat().st_size / 1e6:7.1f} MB  ({told})", flush=True)


def main():
    repeats = int(sys.argv[1]) if len(sys.argv) > 1 else 3
    pong_pmtk.register()
    with tempfile.TemporaryDirectory() as folder:
        for count in TRIANGLES:
            measure(terrain, count, repeats, Path(folder) / "model.ron")
        for count in OBJECTS:
            measure(points, count, repeats, Path(folder) / "model.ron")
    sys.stdout.flush()
    os._exit(0)


main()

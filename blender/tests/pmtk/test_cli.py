# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line, in separate processes."""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import bpy
import pong_pmtk
from pong_pmtk.core.read import read_file
from pong_pmtk.core.write import write_text

from .scenes import CUBE, InBlender, mark, mesh, new, root

PACKAGE = Path(pong_pmtk.__file__).resolve().parent
MODEL = Path(__file__).resolve().parents[3] / "models" / "verification" / "socket.ron"


def pong(*arguments):
    paths = [str(PACKAGE.parent), os.environ.get("PYTHONPATH", "")]  # the wheel is on the tests' own path
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(paths)}
    command = [sys.executable, "-m", "pong_pmtk", *map(str, arguments)]
    return subprocess.run(command, env=environment, capture_output=True, text=True)


class CommandLine(InBlender):
    def setUp(self):
        super().setUp()
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.blend, self.ron = self.folder / "scene.blend", self.folder / "model.ron"

    def save(self):
        bpy.ops.wm.save_as_mainfile(filepath=str(self.blend), copy=True)

    def good_scene(self):
        mark(new("block", mesh(CUBE), root()), kind="Polyhedron")
        self.save()

    def bad_scene(self):
        mark(new("block", mesh((CUBE[0], CUBE[1][1:])), root()), kind="Polyhedron")
        self.save()

    def test_a_model_goes_in_and_comes_out_again(self):
        done = pong("import", MODEL, "-o", self.blend)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        done = pong("export", self.blend, "-o", self.ron)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.ron.read_text(), write_text(read_file(MODEL)))
        self.assertEqual(len(done.stdout.splitlines()), 2)  # Blender's own chatter is kept back

    def test_two_exports_are_the_same_to_the_byte(self):
        self.good_scene()
        texts = []
        for _ in range(2):
            self.assertEqual(pong("export", self.blend, "-o", self.ron).returncode, 0)
            texts.append(self.ron.read_bytes())
        self.assertEqual(*texts)

    def test_a_faulty_scene_is_refused_and_what_was_there_stays(self):
        self.bad_scene()
        self.ron.write_text("what was there")
        done = pong("export", self.blend, "-o", self.ron)
        self.assertEqual(done.returncode, 1)
        self.assertIn("model/block: error [open-polyhedron]", done.stderr)
        self.assertEqual(self.ron.read_text(), "what was there")
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["model.ron", "scene.blend"])

    def test_checking_writes_nothing(self):
        self.good_scene()
        for arguments in (("check", self.blend), ("export", self.blend, "-o", self.ron, "--check-only")):
            self.assertEqual(pong(*arguments).returncode, 0)
        self.assertFalse(self.ron.exists())
        self.bad_scene()
        self.assertEqual(pong("check", self.blend).returncode, 1)

    def test_of_several_roots_one_must_be_named(self):
        for name in ("left", "right"):
            mark(new(f"{name}_tip", parent=root(name)), kind="Point")
        self.save()
        self.assertIn("several-roots", pong("export", self.blend, "-o", self.ron).stderr)
        self.assertEqual(pong("export", self.blend, "-o", self.ron, "--root", "right").returncode, 0)
        self.assertEqual(read_file(self.ron).name, "right")

    def test_a_scene_can_be_named(self):
        mark(new("tip", parent=root()), kind="Point")
        first = bpy.context.scene.name
        second = bpy.data.scenes.new("empty")
        bpy.context.window.scene = second
        self.save()
        self.assertEqual(pong("check", self.blend, "--scene", "empty").returncode, 1)
        self.assertEqual(pong("check", self.blend, "--scene", first).returncode, 0)
        self.assertIn("choose from", pong("check", self.blend, "--scene", "none").stderr)

    def test_files_that_cannot_be_read_or_written(self):
        self.good_scene()
        (self.folder / "text.blend").write_text("no blend file")
        for arguments in (
            ("export", self.folder / "none.blend"),
            ("check", self.folder / "text.blend"),
            ("import", self.folder / "none.ron"),
            ("import", MODEL, "-o", self.folder / "none" / "a.blend"),
            ("export", self.blend, "-o", "/proc/none/a.ron"),
        ):
            with self.subTest(arguments=arguments):
                done = pong(*arguments)
                self.assertEqual(done.returncode, 3, done.stderr)
                self.assertNotIn("Traceback", done.stderr)
                self.assertTrue(done.stderr.strip())

    def test_a_faulty_model_is_refused_with_its_line(self):
        self.ron.write_text(MODEL.read_text().replace("stiffness", "stifness", 1))
        done = pong("import", self.ron, "-o", self.blend)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"model\.ron:\d+:\d+: .*\[unknown-field\]")
        self.assertFalse(self.blend.exists())

    def test_wrong_usage(self):
        self.assertEqual(pong("explode").returncode, 2)
        self.assertEqual(pong("--help").returncode, 0)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Every model of the repository opens as marked objects and exports again, byte for byte."""

import tempfile
from pathlib import Path

import bpy
from pong_pmtk.core.read import read_file
from pong_pmtk.core.write import write_text
from pong_pmtk.scene import session

from .scenes import InBlender

MODELS = sorted((Path(__file__).resolve().parents[3] / "models").glob("*/*.ron"))


class EveryModel(InBlender):
    def test_the_models_are_found(self):
        self.assertGreater(len(MODELS), 40)

    def test_through_a_saved_file(self):
        with tempfile.TemporaryDirectory() as folder:
            for path in MODELS:
                if not path.read_text().partition('format: "')[2].startswith("pong-model"):
                    continue
                with self.subTest(model=path.name):
                    self.round_trip(path, Path(folder))

    def round_trip(self, path, folder):
        blend, again, twice = (folder / f"{path.stem}.{end}" for end in ("blend", "ron", "2.ron"))
        bpy.ops.wm.read_factory_settings(use_empty=True)
        session.load(bpy.context, path)
        session.export(bpy.context, again)
        bpy.ops.wm.save_as_mainfile(filepath=str(blend))
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.ops.wm.open_mainfile(filepath=str(blend))
        session.export(bpy.context, twice)
        self.assertEqual(again.read_text(), write_text(read_file(path)))
        self.assertEqual(twice.read_bytes(), again.read_bytes())

    def test_two_models_in_one_scene_do_not_disturb_each_other(self):
        with tempfile.TemporaryDirectory() as folder:
            target = Path(folder) / "again.ron"
            path = next(path for path in MODELS if path.name == "idss_active.ron")
            session.load(bpy.context, path)
            second = session.load(bpy.context, path)
            session.export(bpy.context, target, second.name)
            self.assertEqual(target.read_text(), write_text(read_file(path)))

# SPDX-License-Identifier: GPL-3.0-or-later
"""A Blender that is too old for extensions: both refuse with a sentence, before anything is registered."""

import importlib
import sys
import tomllib
import types
import unittest
from pathlib import Path
from unittest import mock

BLENDER = Path(__file__).resolve().parents[2]


class OldBlender(unittest.TestCase):
    def test_both_extensions_say_which_version_they_need(self):
        old = types.SimpleNamespace(app=types.SimpleNamespace(version=(4, 1, 1)))
        for name in ("pong_pmtk", "pong_viz"):
            with mock.patch.dict(sys.modules, {"bpy": old}), mock.patch.object(sys, "path", [str(BLENDER), *sys.path]):
                # A newer Blender has taken it out of the module of an extension.
                vars(importlib.import_module(name)).pop("bl_info", None)
                with self.assertRaisesRegex(RuntimeError, r"needs Blender 4\.2\.0, and this is 4\.1\.1: install a newer"):
                    importlib.import_module(name).register()

    def test_what_old_versions_read_is_what_the_manifest_says(self):
        for name in ("pong_pmtk", "pong_viz"):
            with mock.patch.object(sys, "path", [str(BLENDER), *sys.path]):
                module = importlib.import_module(name)
            told = module.bl_info
            manifest = tomllib.loads((BLENDER / name / "blender_manifest.toml").read_text(encoding="utf-8"))
            self.assertEqual(told["name"], manifest["name"])
            self.assertEqual(told["blender"], module.OLDEST_BLENDER)
            for key, written in (("version", "version"), ("blender", "blender_version_min")):
                self.assertEqual(".".join(map(str, told[key])), manifest[written])


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-3.0-or-later
"""Zips of the extensions: one for all systems, with one wheel for each."""

import sys
import tempfile
import tomllib
import unittest
import zipfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
import build_zips

# File names as maturin gives them, and the platforms as Blender's manual of extensions writes them.
WHEELS = {
    "manylinux_2_17_x86_64.manylinux2014_x86_64": "linux-x64",
    "manylinux_2_17_aarch64.manylinux2014_aarch64": "linux-arm64",
    "linux_x86_64": "linux-x64",
    "win_amd64": "windows-x64",
    "macosx_10_12_x86_64": "macos-x64",
    "macosx_11_0_arm64": "macos-arm64",
}


def wheel(folder, tag, version="0.1.0"):
    path = Path(folder) / f"pong-{version}-cp310-abi3-{tag}.whl"
    path.write_bytes(tag.encode())
    return path


class Zips(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def test_every_platform_of_blender_has_its_name(self):
        for tag, platform in WHEELS.items():
            self.assertEqual(build_zips.platform_of(Path(f"pong-0.1.0-cp310-abi3-{tag}.whl")), platform)

    def test_one_zip_has_the_wheels_of_all_systems_in_any_order(self):
        wheels = [wheel(self.folder, tag) for tag in WHEELS if not tag.startswith("linux")]
        zips = []
        for order in (wheels, wheels[::-1]):
            out = self.folder / str(len(zips))
            zips.append(build_zips.build("pong_viz", out, build_zips.by_platform(order)))
        self.assertEqual(zips[0].read_bytes(), zips[1].read_bytes())
        with zipfile.ZipFile(zips[0]) as content:
            manifest = tomllib.loads(content.read("blender_manifest.toml").decode())
            self.assertEqual(set(manifest["platforms"]), set(WHEELS.values()))
            # Blender 4.2.0 to 4.3 looks for its Python, 3.11, among the tags, and does not count upwards from 3.10.
            expected = {path.name.replace("-cp310-", "-cp310.cp311-"): path for path in wheels}
            self.assertEqual({Path(name).name for name in manifest["wheels"]}, set(expected))
            for name in manifest["wheels"]:
                self.assertEqual(content.read(name.removeprefix("./")), expected[Path(name).name].read_bytes())

    def test_what_does_not_fit_is_refused_with_cause_and_cure(self):
        linux = wheel(self.folder, "manylinux_2_17_x86_64.manylinux2014_x86_64")
        for other, words in (
            (wheel(self.folder, "musllinux_1_2_x86_64"), ("musllinux_1_2_x86_64", "take wheels for")),
            (wheel(self.folder, "linux_x86_64"), ("for linux-x64, too", "name one wheel for each")),
            (wheel(self.folder, "win_amd64", "0.2.0"), ("not of the version", "from one commit")),
        ):
            with self.assertRaises(OSError) as refused:
                build_zips.by_platform([linux, other])
            for word in (other.name, *words):
                self.assertIn(word, str(refused.exception))


if __name__ == "__main__":
    unittest.main()

"""The wheel as installed by pip; importing it is enough. Skipped where ci/mujoco has not built one."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import zipfile

import mujoco
from support import ball_on_ground

WHEEL = os.environ.get("WHEEL")


@unittest.skipUnless(WHEEL, "no WHEEL")
class Wheel(unittest.TestCase):
    def test_what_is_in_it(self):
        with zipfile.ZipFile(WHEEL) as wheel:
            names = wheel.namelist()
            metadata = wheel.read(next(name for name in names if name.endswith("METADATA"))).decode()
        self.assertIn("-py3-none-", pathlib.Path(WHEEL).name)
        for name in ("libpong_contact.so", "libpong.so.1"):
            self.assertIn(f"pong_mujoco/binaries/{mujoco.__version__}/{name}", names)
        self.assertTrue(any(name.endswith("THIRD_PARTY_LICENSES.md") for name in names))
        self.assertIn(f"Requires-Dist: mujoco=={mujoco.__version__}", metadata)

    def test_importing_it_is_enough(self):
        subprocess.run([sys.executable, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-deps", "--upgrade",
                        "--target", "wheel_installed", WHEEL], check=True)
        m = ball_on_ground("0 0 0.0995", damping=100.0)
        mujoco.mj_saveModel(m, "ball.mjb", None)
        program = """
import mujoco, pong_mujoco
m = mujoco.MjModel.from_binary_path("ball.mjb")
d = mujoco.MjData(m)
mujoco.mj_step(m, d, 1000)
print(pong_mujoco.versions(), d.sensordata[0], round(d.sensordata[5], 3))
mujoco.__version__ = "3.9.0"
pong_mujoco.plugin_path()
"""
        done = subprocess.run([sys.executable, "-c", program], env=dict(os.environ, PYTHONPATH="wheel_installed"),
                              capture_output=True, text=True)
        self.assertEqual(done.stdout, f"['{mujoco.__version__}'] 1.0 9.81\n", done.stderr)
        self.assertIn("ImportError: pong_mujoco has no plugin for MuJoCo 3.9.0, only for 4.0.0: install that version", done.stderr)

    def test_a_library_of_another_platform_is_told_with_cause_and_cure(self):
        with tempfile.TemporaryDirectory() as folder, zipfile.ZipFile(WHEEL) as wheel:
            wheel.extractall(folder)
            library = pathlib.Path(folder) / "pong_mujoco/binaries" / mujoco.__version__ / "libpong.so.1"
            content = bytearray(library.read_bytes())
            content[18] ^= 0xFF  # the processor in the header of the file
            library.write_bytes(content)
            done = subprocess.run([sys.executable, "-c", "import pong_mujoco"], env=dict(os.environ, PYTHONPATH=folder),
                                  capture_output=True, text=True)
        self.assertIn("ImportError: pong_mujoco was installed for another platform than linux", done.stderr)
        self.assertIn("it has libpong.so.1, libpong_contact.so (", done.stderr)
        self.assertIn("install its wheel for this platform", done.stderr)


if __name__ == "__main__":
    unittest.main()

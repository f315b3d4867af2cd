"""The examples of docs/mujoco.md behave as the page says."""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from support import PLUGIN, ROOT, docking

PAGE = (ROOT / "docs/mujoco.md").read_text()


class Page(unittest.TestCase):
    def test_from_nothing_to_the_first_wrench(self):
        xml, program = (re.search(rf"```{kind}\n(.*?)```", PAGE, re.S)[1] for kind in ("xml", "python"))
        self.assertIn('"target/mujoco/libpong_contact.so"', program)
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "ball.xml").write_text(xml)
            program = program.replace("target/mujoco/libpong_contact.so", PLUGIN)
            done = subprocess.run([sys.executable, "-c", program], cwd=folder, capture_output=True, text=True)
        self.assertEqual(done.stderr, "")
        numbers = [float(number) for number in re.findall(r"[-\d.e+]+", done.stdout)]
        self.assertEqual(numbers[:3], [1, 0, 0])
        self.assertAlmostEqual(numbers[5], 9.81, delta=1e-3)
        self.assertAlmostEqual(numbers[11], -9.81, delta=1e-3)

    def test_every_key_is_on_the_page(self):
        source = (ROOT / "hosts/mujoco/plugin/config.c").read_text()
        keys = re.findall(r'"(\w+)"', re.search(r"contact_attributes\[\] = \{(.*?)\}", source, re.S)[1])
        self.assertEqual(len(keys), 13)
        for key in keys:
            self.assertIn(f"`{key}`", PAGE.replace("`text1` … `text4`", "`text1` `text2` `text3` `text4`"))

    def test_the_size_of_the_state(self):
        self.assertIn(f"{docking().npluginstate:,} numbers", PAGE)


if __name__ == "__main__":
    unittest.main()

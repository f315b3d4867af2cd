# SPDX-License-Identifier: GPL-3.0-or-later
"""Missing wheel `pong`: the toolkit reports it, checks what is possible without it, and exports nothing."""

import unittest
from unittest import mock

from support import build, built, rules, scene
from core.author import box
from core.engine import CURE, WheelMissing
from core.read import read_text


def without_wheel():
    """Makes `import pong` fail, as without an installation."""
    return mock.patch.dict("sys.modules", {"pong": None, "pong.model": None})


class WithoutWheel(unittest.TestCase):
    def block(self):
        s = scene()
        s.mesh("block", "Polyhedron", box((1.0, 1.0, 1.0)))
        return s

    def test_a_good_scene_is_refused_once_with_cause_and_cure(self):
        s = self.block()
        built(s)
        with without_wheel():
            made = build(s.snapshot())
        self.assertEqual(rules(made, "error"), ["no-wheel"])
        self.assertEqual((made.model, made.files, made.loaded), (None, {}, None))
        self.assertIn("`pong`", made.findings.errors[0].cause)
        self.assertEqual(made.findings.errors[0].cure, CURE)

    def test_what_is_no_matter_of_the_engine_is_told_at_once_all_the_same(self):
        s = self.block()
        s.primitive("ball", "Sphere", radius=-1.0)
        s.primitive("a/b", "Point")
        with without_wheel():
            found = rules(build(s.snapshot()), "error")
        self.assertEqual(sorted(found), ["no-radius", "no-wheel", "slash-in-name"])

    def test_reading_says_what_is_missing_and_what_to_do(self):
        with without_wheel(), self.assertRaisesRegex(WheelMissing, "`pong`: it cannot be imported .*; install"):
            read_text("()")


if __name__ == "__main__":
    unittest.main()

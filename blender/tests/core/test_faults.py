# SPDX-License-Identifier: GPL-3.0-or-later
"""Faulty scenes give named errors, one each, and nothing is written."""

import pathlib
import re
import unittest

from support import ROOT, build, rules, scene
from faulty_scenes import FAULTY, good, one, part
from core.author import box, changed, mesh
from core.finding import FIXES

RULES = ROOT / "docs" / "modelling_rules.md"


class FaultyScenes(unittest.TestCase):
    def test_the_scene_they_are_made_from_is_right(self):
        made = build(good().snapshot())
        self.assertEqual(list(made.findings), [])
        self.assertIsNotNone(made.model)

    def test_each_gives_its_own_error_alone(self):
        for rule, snapshot in FAULTY.items():
            with self.subTest(rule):
                made = build(snapshot)
                self.assertEqual(set(rules(made, "error")), {rule}, "\n".join(map(str, made.findings)))

    def test_nothing_is_built(self):
        for rule, snapshot in FAULTY.items():
            with self.subTest(rule):
                made = build(snapshot)
                self.assertIsNone(made.model)
                self.assertEqual(made.files, {})

    def test_there_are_more_than_fifty(self):
        self.assertGreaterEqual(len(FAULTY), 50)

    def test_every_error_says_where_why_and_what_to_do(self):
        for rule, snapshot in FAULTY.items():
            for finding in build(snapshot).findings.errors:
                with self.subTest(rule):
                    self.assertTrue(finding.cause and finding.cure)
                    names = {thing.name for thing in snapshot.objects}
                    self.assertIn(finding.object, names | {""})
                    self.assertTrue(finding.path or rule in ("no-root", "several-roots", "unit-scale"))
                    self.assertIn(finding.fix, {"", *FIXES})


class LoaderWarnings(unittest.TestCase):
    """Loader warnings without a rule are reported at the object; those with a rule are not repeated."""

    def told(self, snapshot):
        return [(f.rule, f.severity, f.object, list(f.faces)) for f in build(snapshot).findings]

    def test_a_wall_without_a_twin_is_told_at_its_face(self):
        walled = scene()
        walled.mesh("a: thing", "Polyhedron", box((1, 1, 1)), inactive_faces=[4])
        made = build(walled.snapshot())
        self.assertIsNotNone(made.model)
        (finding,) = made.findings
        self.assertEqual((finding.rule, finding.severity), ("loader-warning", "warning"))
        self.assertEqual((finding.object, finding.faces), ("a: thing", [4]))
        self.assertIn("no twin", finding.cause)
        self.assertTrue(finding.cure)

    def test_a_leaf_size_without_effect_is_told_at_its_group(self):
        grouped = good()
        changed(grouped.objects[0], leaf_size=4)
        changed(part(grouped, "arm"), bound="Aabb")
        self.assertEqual(self.told(grouped.snapshot()), [("loader-warning", "warning", "model", [])])

    def test_triangles_are_told_once(self):
        vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1]]
        fan = mesh(vertices, [[0, 1, 2], [1, 0, 3], [0, 1, 4]])
        self.assertEqual([rule for rule, *_ in self.told(one("TriangleMesh", fan).snapshot())], ["crowded-edge"])


class Rules(unittest.TestCase):
    """The list in docs/modelling_rules.md is complete, and so are the scenes."""

    def listed(self):
        rows = re.findall(r"^\| `([a-z-]+)` \| (error|warning|hint)", RULES.read_text(), re.MULTILINE)
        self.assertEqual(len(rows), len({rule for rule, _ in rows}))
        return dict(rows)

    def in_the_code(self):
        text = "".join(path.read_text() for path in pathlib.Path(ROOT / "blender/pong_pmtk/core").glob("*.py"))
        calls = re.findall(r"\.(error|warn|hint)\(\s*\"([a-z-]+)\"", text)
        return {rule for _, rule in calls}

    def test_every_rule_of_the_code_is_listed(self):
        self.assertEqual(self.in_the_code() - set(self.listed()), set())

    def test_every_listed_error_has_a_faulty_scene(self):
        errors = {rule for rule, severity in self.listed().items() if severity == "error"}
        self.assertEqual(errors - set(FAULTY), {"unknown-root", "no-wheel"})  # which are not the scene's fault
        self.assertEqual(set(FAULTY) - errors, set())

    def test_a_root_that_is_not_there_is_an_error(self):
        self.assertEqual(rules(build(good().snapshot(), "modell"), "error"), ["unknown-root"])


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: GPL-3.0-or-later
"""Faulty scenes give named errors, one each, and nothing is written."""

import pathlib
import re
import unittest

from support import ROOT, build, rules, scene
from faulty_scenes import BOX_FACES, FAULTY, good, one, part
from core.author import box, changed, mesh
from core.finding import FIXES
from core.marks import Part
from core.touch import sentences

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


class Solids(unittest.TestCase):
    """An automatic root makes shapes solids unless the author marks what touches or a shape is not closed."""

    def made(self, change=None, contact="Automatic"):
        s = one("TriangleMesh", box((1, 1, 1)))
        changed(s.root, contact=contact)
        if change:
            change(s)
        return build(s.snapshot())

    def assert_marked(self, made, words):
        self.assertIsNone(made.model.root.contact)
        (finding,) = [finding for finding in made.findings if finding.rule == "not-solid"]
        self.assertEqual((finding.severity, finding.object), ("hint", "model"))
        for word in (words, "Solid or Marked"):
            self.assertIn(word, str(finding))

    def test_closed_shapes_are_solids(self):
        made = self.made()
        self.assertEqual(made.model.root.contact, "Solid")
        self.assertNotIn("not-solid", rules(made, "hint"))
        self.assertIsNone(self.made(contact="Default").model.root.contact)

    def test_corners_and_parts_by_hand_keep_the_shapes_marked(self):
        self.assert_marked(self.made(lambda s: s.primitive("foot", "Point", location=(0, 0, -0.5))), '"foot" is a Point')
        faces = Part("lid", "TriangleMesh", faces=[1])
        self.assert_marked(self.made(lambda s: changed(part(s, "thing"), kind="", parts=[faces])), '"lid"')

    def test_points_in_a_marked_group_do_not_count_if_they_are_outside(self):
        def apart(s):
            changed(part(s, "thing"), parent=s.group("body").name)
            s.primitive("foot", "Point", above=s.group("feet", contact="Marked", location=(9, 0, 0)))

        made = self.made(apart)
        self.assertEqual(made.model.root.contact, "Solid")
        self.assertEqual(made.findings.errors, [])

    def test_shapes_that_are_not_closed_keep_the_shapes_marked(self):
        def opened(s):
            part(s, "thing").mesh = mesh(box((1, 1, 1)).vertices, [[0, 2, 3, 1], [4, 5, 7, 6]])

        self.assert_marked(self.made(opened), "the mesh is open")

    def test_a_model_without_shapes_has_nothing_to_choose(self):
        s = one("Sphere", radius=1.0)
        changed(s.root, contact="Automatic")
        self.assertEqual(list(build(s.snapshot()).findings), [])

    def test_faults_of_solids_offer_repairs(self):
        fixes = {rule: build(FAULTY[rule]).findings.errors[0].fix for rule in ("solid-volume", "open-solid")}
        self.assertEqual(fixes, {"solid-volume": "recalculate-normals", "open-solid": "merge-by-distance"})
        turned = one("TriangleMesh", mesh(box((1, 1, 1)).vertices, [[0, 1, 3, 2], [4, 5, 7, 6], *BOX_FACES[2:]]))
        changed(turned.root, contact="Solid")
        (error,) = build(turned.snapshot()).findings.errors
        self.assertEqual((error.rule, error.object, error.fix), ("open-solid", "thing", "recalculate-normals"))

    def test_corners_of_a_solid_are_refused_at_their_object_with_the_cure(self):
        errors = build(FAULTY["solid-corner"]).findings.errors
        self.assertEqual({error.object for error in errors}, {"thing"})
        self.assertEqual({error.path for error in errors}, {"model/thing/feet"})
        self.assertIn("leave it out", errors[0].cure)

    def test_the_panel_says_what_touches(self):
        s = scene()
        changed(s.root, contact="Solid")
        for name, x in (("base", 0), ("arm", 3), ("tip", 6)):
            s.mesh(f"{name} box", "Polyhedron", box((1, 1, 1), (x, 0, 0)), above=s.group(name, movable=name != "base"))
        s.primitive("ground", "Plane", above=part(s, "base"))
        s.root.settings.filters = [("arm", "base")]
        told = sentences(build(s.snapshot()).model)
        self.assertEqual(told[:3], ["model: 1 solid shape, 1 plane", "model/arm: 1 solid shape", "model/tip: 1 solid shape"])
        pairs = [text for text in told if text.endswith("by shared volume")]
        self.assertEqual(pairs, ["model – model/tip: by shared volume", "model/arm – model/tip: by shared volume"])
        changed(s.root, contact="Default")
        told = sentences(build(s.snapshot()).model)
        self.assertEqual(told[1], "model/arm: 1 marked primitive")
        self.assertIn("faces alone touch nothing", told[-1])


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

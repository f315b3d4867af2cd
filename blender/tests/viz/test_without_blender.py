# SPDX-License-Identifier: GPL-3.0-or-later
"""Logs, films and marks: the parts that need only numpy."""

import shutil
import tempfile
import unittest
from pathlib import Path

import numpy as np

from pong_viz import marks, patches, shapes, timeline
from pong_viz.core.model import Primitive
from pong_viz.log import Log, LogError

from . import sample


class WithLog(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.log = Log(sample.write_log(self.folder / "log"))


class Logs(WithLog):
    def test_contacts_of_a_frame(self):
        self.assertEqual(self.log.contacts_of(50)["normal_force"].tolist(), [15.0])
        self.assertEqual(len(self.log.contacts_of(51)), 0)
        self.assertEqual(self.log.pairs_that_touch(), [(0, 1)])

    def test_a_log_that_was_cut_off_plays_as_far_as_all_tables_go(self):
        np.save(self.log.folder / "states.npy", np.array(self.log.states)[:40])
        self.assertEqual(len(Log(self.log.folder).times), 40)
        np.save(self.log.folder / "contacts.npy", np.array(self.log.contacts)[:20])
        self.assertEqual(len(Log(self.log.folder).times), 20)

    def test_a_table_cut_in_the_middle_of_a_row_plays_as_far_as_it_goes(self):
        for name, row in (("states", 2 * 13 * 8), ("contacts", self.log.contacts.dtype.itemsize), ("frames", self.log.frames.dtype.itemsize)):
            folder = sample.write_log(self.folder / name)
            path = folder / f"{name}.npy"
            path.write_bytes(path.read_bytes()[:-row * 10 - 7])
            log = Log(folder)
            whole = 40 if name == "contacts" else 101 - 11  # contacts end at row 51
            self.assertEqual(len(log.times), whole)
            self.assertRegex(" ".join(log.notes), f"{name}.npy: it is cut off; .* rows are there")
            np.testing.assert_array_equal(log.states[:whole], self.log.states[:whole])

    def test_rows_behind_those_that_the_header_counts_are_not_read(self):
        path = self.log.folder / "frames.npy"
        path.write_bytes(path.read_bytes() + b"\1" * 4000)
        self.assertEqual(len(Log(self.log.folder).times), 101)

    def test_a_run_that_is_not_finished_is_told(self):
        sample.change_run(self.log.folder, finished=False, lost=3)
        self.assertRegex(" ".join(Log(self.log.folder).notes), "cut off, or still goes on; .* 1 s.*lost 3 frames")

    def test_a_run_without_a_contact(self):
        sample.without_contacts(self.log.folder)
        log = Log(self.log.folder)
        self.assertEqual((len(log.times), log.pairs_that_touch()), (101, []))
        film = timeline.film(log)
        self.assertEqual(marks.slots(log, film, timeline.view(log, film)).shown.shape, (31, 0))
        self.assertEqual((marks.touched(log, film), marks.largest_force(log)), ({}, 0.0))

    def test_the_run_json_may_be_named_itself(self):
        self.assertEqual(len(Log(self.log.folder / "run.json").times), 101)

    def test_faults_name_the_file_and_the_cure(self):
        for damage, told in (
            (lambda f: (f / "states.npy").unlink(), "states.npy: it is missing"),
            (lambda f: (f / "frames.npy").write_bytes(b"nothing"), "frames.npy: it is no NumPy table"),
            (lambda f: (f / "run.json").write_text("{"), "run.json: it is damaged"),
            (lambda f: (f / "run.json").write_text('{"format": "x"}'), "this is no response log"),
            (lambda f: (f / "run.json").unlink(), "there is no run.json"),
            (lambda f: sample.change_run(f, pairs=3), "run.json: it is damaged"),
            (lambda f: sample.change_run(f, version=9), "version 9 is not known"),
            (lambda f: np.save(f / "contacts.npy", np.zeros(3)), "contacts.npy: it lacks friction_force"),
            (lambda f: np.save(f / "states.npy", np.zeros((101, 3), sample.STATES)), "columns for 2 bodies"),
        ):
            folder = Path(tempfile.mkdtemp(dir=self.folder))
            damage(sample.write_log(folder))
            with self.subTest(told), self.assertRaisesRegex(LogError, told):
                Log(folder)


class Films(WithLog):
    def test_pictures_show_the_contacts_of_the_last_row_before_them(self):
        film = timeline.film(self.log, fps=30)
        self.assertEqual(len(film.times), 31)
        np.testing.assert_array_equal(film.rows, np.floor(film.times * 100 + 1e-9).astype(int))

    def test_slow_motion_and_cuts(self):
        film = timeline.film(self.log, fps=50, speed=0.1, start=0.2, end=0.3)
        np.testing.assert_allclose(film.times, 0.2 + np.arange(51) * 0.002)
        with self.assertRaisesRegex(ValueError, "the log runs from 0.0 to 1.0 s"):
            timeline.film(self.log, start=2.0)

    def test_far_from_the_origin_ways_are_exact(self):
        film = timeline.film(self.log, fps=60)
        way = timeline.track(self.log, film, 0, timeline.view(self.log, film))
        expected = np.stack([0.5 * film.times, 0 * film.times, np.full(len(film.times), 0.1)], axis=1)
        # The log's own coordinates have that resolution at 6.8e6 m.
        np.testing.assert_allclose(way.positions - way.positions[0], expected - expected[0], atol=2e-9)

    def test_turns_are_smooth_though_the_log_changes_sign(self):
        film = timeline.film(self.log, fps=60)
        q = timeline.track(self.log, film, 0, timeline.view(self.log, film)).orientations
        np.testing.assert_allclose(q[:, 0], np.cos(1.5 * film.times), atol=1e-12)
        np.testing.assert_allclose(q[:, 2], np.sin(1.5 * film.times), atol=1e-12)

    def test_a_body_that_is_held_still_does_not_move_and_others_move_against_it(self):
        film = timeline.film(self.log, fps=30)
        seen = timeline.view(self.log, film, body=0)
        ball = timeline.track(self.log, film, 0, seen)
        np.testing.assert_allclose(ball.positions, 0.0, atol=1e-12)
        np.testing.assert_allclose(ball.orientations, np.tile([1.0, 0, 0, 0], (31, 1)), atol=1e-12)
        ground = timeline.track(self.log, film, 1, seen)
        angle = 3.0 * film.times
        offset = -np.stack([0.5 * film.times, 0 * angle, np.full(31, 0.1)], axis=1)
        # Rotated back about y by the ball's angle.
        expected = np.stack([np.cos(angle) * offset[:, 0] - np.sin(angle) * offset[:, 2], 0 * angle,
                             np.sin(angle) * offset[:, 0] + np.cos(angle) * offset[:, 2]], axis=1)
        np.testing.assert_allclose(ground.positions, expected, atol=2e-9)


    def test_a_body_waits_where_its_state_is_first_known(self):
        states = np.array(self.log.states)
        for name in ("position", "orientation"):
            states[name][:30, 0] = np.nan
            states[name][60:70, 0] = np.nan
        np.save(self.log.folder / "states.npy", states)
        log = Log(self.log.folder)
        film = timeline.film(log, fps=100)
        ways = timeline.track(log, film, 0, timeline.view(log, film)).positions[:, 0]
        expected = 0.5 * np.maximum(film.times, 0.3)  # straight, at constant speed, across the gap
        np.testing.assert_allclose(ways - ways[0], expected - expected[0], atol=2e-9)

    def test_a_body_without_a_state_does_not_pull_the_view_to_the_origin(self):
        states = np.array(self.log.states)
        states["position"][:, 1] = np.nan
        np.save(self.log.folder / "states.npy", states)
        sample.without_contacts(self.log.folder)
        log = Log(self.log.folder)
        film = timeline.film(log)
        self.assertFalse(timeline.is_known(log, 1))
        self.assertLess(timeline.travel(log, film, timeline.view(log, film)), 1.0)
        with self.assertRaisesRegex(ValueError, "`ground` has no state"):
            timeline.view(log, film, body=1)

    def test_bodies_that_rush_together_are_followed(self):
        states = np.array(self.log.states)
        states["position"][:, :, 1] += 7500.0 * self.log.times[:, None]
        np.save(self.log.folder / "states.npy", states)
        log = Log(self.log.folder)
        film = timeline.film(log)
        seen = timeline.view(log, film, extent=0.2)
        self.assertEqual(seen.followed, 0)
        way = timeline.track(log, film, 1, seen).positions
        np.testing.assert_allclose(way[:, 0] - way[0, 0], -0.5 * film.times, atol=2e-9)
        np.testing.assert_allclose(way[:, 1], 0.0, atol=2e-9)
        still = Log(sample.write_log(self.folder / "still"))
        self.assertIsNone(timeline.view(still, film, extent=0.2).followed)

    def test_shapes_far_from_the_origin_of_their_body_are_exact(self):
        """A terrain relative to the middle of a planet: the anchor's path has the coordinates of the contacts."""
        middle = np.array([0.0, 0.0, 4.2e6])
        anchor = shapes.anchor_of(np.array([middle - 1.0, middle + 1.0]))
        np.testing.assert_array_equal(anchor, middle)
        states = np.array(self.log.states)
        states["position"][:, 1] -= middle
        np.save(self.log.folder / "states.npy", states)
        log = Log(self.log.folder)
        film = timeline.film(log)
        anchors = np.array([np.zeros(3), anchor])
        seen = timeline.view(log, film, None, 0.2, anchors)
        np.testing.assert_allclose(timeline.track(log, film, 1, seen, anchor).positions, 0.0, atol=2e-9)
        self.assertLess(timeline.travel(log, film, seen, anchors), 1.0)

class Marks(WithLog):
    def test_arrows_have_place_direction_and_size_of_the_force(self):
        film = timeline.film(self.log, fps=100)
        seen = timeline.view(self.log, film)
        slots = marks.slots(self.log, film, seen)
        np.testing.assert_array_equal(slots.shown[:, 0], film.times <= 0.5)
        np.testing.assert_array_equal(slots.sticks[:51, 0], film.times[:51] > 0.25)
        for picture in (0, 20, 50):
            force = np.array([-2.0, 0.0, 10.0 * (1.0 + film.times[picture])])
            self.assertAlmostEqual(slots.forces[picture, 0], np.linalg.norm(force), places=12)
            pointed = timeline.turned(slots.turns[picture, 0], np.array([0.0, 0.0, 1.0]))
            np.testing.assert_allclose(pointed, force / np.linalg.norm(force), atol=1e-12)
        self.assertAlmostEqual(marks.largest_force(self.log), np.hypot(15.0, 2.0), places=12)

    def test_forces_are_those_on_the_first_object_whichever_is_a(self):
        swapped = np.array(self.log.contacts)
        swapped["primitive_a"], swapped["primitive_b"] = 2, 0
        np.save(self.log.folder / "contacts.npy", swapped)
        log = Log(self.log.folder)
        film = timeline.film(log, fps=100)
        turn = marks.slots(log, film, timeline.view(log, film)).turns[0, 0]
        self.assertLess(timeline.turned(turn, np.array([0.0, 0.0, 1.0]))[2], 0.0)

    def test_too_many_contacts_keep_the_largest_and_are_counted(self):
        film = timeline.film(self.log, fps=100)
        slots = marks.slots(self.log, film, timeline.view(self.log, film), most=0)
        self.assertEqual((slots.shown.shape[1], slots.left_out), (0, 51))

    def test_a_primitive_is_lit_while_it_touches(self):
        film = timeline.film(self.log, fps=100)
        lit = marks.touched(self.log, film)
        self.assertEqual(set(lit), {0, 2})
        np.testing.assert_array_equal(lit[0], film.times <= 0.5)

    def test_marks_lie_in_the_tangent_plane_and_arrows_end_at_their_tips(self):
        film = timeline.film(self.log, fps=100)
        slots = marks.slots(self.log, film, timeline.view(self.log, film))
        np.testing.assert_allclose(slots.tangents[:51, 0], np.tile([1.0, 0.0, 0.0, 0.0], (51, 1)), atol=1e-12)
        t = film.times[:51]
        forces = np.stack([np.full(51, -2.0), 0.0 * t, 10.0 * (1.0 + t)], axis=1)
        np.testing.assert_allclose(slots.tips(0.01), slots.points[:51, 0] + 0.01 * forces, atol=1e-9)

    def test_hundreds_of_contacts(self):
        sample.many_contacts(self.log.folder, 300)
        log = Log(self.log.folder)
        film = timeline.film(log, fps=100)
        slots = marks.slots(log, film, timeline.view(log, film), most=200)
        self.assertEqual((slots.shown.shape, slots.left_out), ((101, 200), 51 * 100))
        # Contact k has 1 + k N: the least hundred are left out.
        np.testing.assert_allclose(slots.forces[0], np.hypot(1.0 + np.arange(100, 300), 2.0))

    def test_cells_of_one_face_are_one_patch(self):
        sample.as_solids(self.log.folder)
        log = Log(self.log.folder)
        film = timeline.film(log, fps=100)
        slots = marks.slots(log, film, timeline.view(log, film))
        self.assertEqual(slots.shown.shape[1], 4)  # the patch, the wedge at the rim, two contacts with friction
        np.testing.assert_allclose(slots.areas[:51], np.tile([sample.AREA_M2, 1e-6, 0.0, 0.0], (51, 1)))
        t = film.times[:51]
        np.testing.assert_allclose(slots.forces[:51], np.stack([10.0 * (1.0 + t), 1e-3 * (1.0 + t), 1.0 + 0.0 * t, 1.0 + 0.0 * t], axis=1))
        np.testing.assert_allclose(slots.points[:51, 0, 1], 0.0, atol=1e-12)
        np.testing.assert_allclose(slots.pressures[:51, 0], 10.0 * (1.0 + t) / sample.AREA_M2)
        self.assertAlmostEqual(slots.pressure_scale, 15.0 / sample.AREA_M2, delta=0.05 * 15.0 / sample.AREA_M2)
        self.assertEqual(slots.areas[51:].max(), 0.0)

    def test_forces_and_areas_stay_when_cells_become_patches(self):
        random = np.random.default_rng(1)
        contacts = np.zeros(200, dtype=sample.CONTACTS)
        contacts["pair"], contacts["point"] = random.integers(0, 3, 200), random.uniform(-1e-2, 1e-2, (200, 3))
        contacts["normal"] = np.eye(3)[random.integers(0, 3, 200)]
        contacts["weight"], contacts["normal_force"] = random.uniform(0.0, 1e-4, 200), random.uniform(0.0, 5.0, 200)
        contacts["end"] = np.array([0, 4, 5, 6], dtype=np.uint32)[random.integers(0, 4, 200)] << np.uint32(29)
        made = patches.merged(contacts)
        self.assertLess(len(made), 150)
        self.assertEqual((~patches.are_cells(made)).sum(), (~patches.are_cells(contacts)).sum())
        for name in ("weight", "normal_force"):
            self.assertAlmostEqual(made[name].sum(), contacts[name].sum(), places=10)
        moment = lambda rows: (rows["normal_force"][:, None] * rows["point"]).sum(axis=0)  # noqa: E731
        np.testing.assert_allclose(moment(made), moment(contacts), atol=1e-12)

    def test_colours_of_pressures(self):
        found = patches.colours(np.array([0.0, 5.0, 10.0, 20.0]), 10.0)
        np.testing.assert_allclose(found, patches.RAMP[[0, 2, 4, 4]])
        self.assertEqual(patches.colours(np.zeros(0), 0.0).shape, (0, 4))

    def test_shortest_turn_from_z(self):
        for direction in ((0, 0, 2), (0, 0, -3), (1, 0, 0), (-1, 2, -5)):
            direction = np.array(direction, dtype=float)
            turned = timeline.turned(timeline.from_z(direction), np.array([0.0, 0.0, 1.0]))
            np.testing.assert_allclose(turned, direction / np.linalg.norm(direction), atol=1e-12)


class Shapes(WithLog):
    def test_boxes_of_bodies(self):
        ball, ground = (shapes.load(path) for path in self.log.models)
        np.testing.assert_allclose(shapes.boxes_of(ball)["ball"], [[-0.1] * 3, [0.1] * 3], atol=1e-12)
        self.assertAlmostEqual(shapes.extent_of(ball), 0.2)
        self.assertEqual(shapes.extent_of(ground), 0.0)

    def test_a_model_that_is_missing_is_told(self):
        with self.assertRaisesRegex(OSError, "none.ron: the model cannot be read .*; copy the whole folder of the log"):
            shapes.load(self.folder / "none.ron")

    def test_balls_and_arrows_are_closed_and_face_outwards(self):
        for vertices, faces in (shapes.ball(12, 6), marks.arrow()):
            edges = [(f[i], f[(i + 1) % len(f)]) for f in faces for i in range(len(f))]
            self.assertEqual(len(edges), len(set(edges)))
            self.assertEqual({(b, a) for a, b in edges}, set(edges))
            self.assertGreater(_volume(vertices, faces), 0.0)

    def test_volume_of_a_fine_ball(self):
        vertices, faces = shapes.ball(128, 64)
        self.assertAlmostEqual(_volume(vertices, faces), 4.0 / 3.0 * np.pi, delta=6e-3)


    def test_round_parts_lie_where_their_fields_say(self):
        ends, sizes = ((1.0, 2.0, 3.0), (1.0, 2.0, 5.0)), shapes.Sizes(0.0, 0.0, 0.0)
        full = np.pi * 2.0
        for kind, fields, low, high, volume in (
            ("Capsule", {"radius": 0.5}, 2.5, 5.5, full * 0.25 + full * 0.25 / 3.0),
            ("Cylinder", {"radius": 0.5}, 3.0, 5.0, full * 0.25),
            ("Cone", {"radii": (0.5, 0.0)}, 3.0, 5.0, full * 0.25 / 3.0),
            ("Bore", {"radii": (0.5, 0.25)}, 3.0, 5.0, None),
        ):
            part = Primitive(kind, "part", {"ends": ends, **fields}, None)
            drawn = shapes.shape("m/part", part, np.eye(3), np.zeros(3), sizes)
            away = drawn.vertices - np.array([1.0, 2.0, 0.0])
            np.testing.assert_allclose([away[:, 2].min(), away[:, 2].max()], [low, high], atol=1e-12)
            self.assertAlmostEqual(float(np.hypot(away[:, 0], away[:, 1]).max()), 0.5)
            if volume is not None:
                self.assertAlmostEqual(_volume(away - [0.0, 0.0, 4.0], drawn.faces) / volume, 1.0, delta=0.03)
            else:  # the wall of a hole is seen from within
                normals = [np.cross(away[f[1]] - away[f[0]], away[f[2]] - away[f[0]]) for f in drawn.faces]
                inward = [normal @ (away[list(f)].mean(axis=0) * [1.0, 1.0, 0.0]) for normal, f in zip(normals, drawn.faces)]
                self.assertLess(max(inward), 0.0)


def _volume(vertices, faces):
    return sum(np.dot(vertices[f[0]], np.cross(vertices[f[i]], vertices[f[i + 1]])) / 6.0
               for f in faces for i in range(1, len(f) - 1))

# SPDX-License-Identifier: GPL-3.0-or-later
"""Logs, films and marks: what needs numpy alone."""

import shutil
import tempfile
import unittest
from pathlib import Path

import numpy as np

from pong_viz import marks, shapes, timeline
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
        self.assertEqual(self.log.touching(), {0, 2})

    def test_a_log_that_was_cut_off_plays_as_far_as_all_tables_go(self):
        np.save(self.log.folder / "states.npy", np.array(self.log.states)[:40])
        self.assertEqual(len(Log(self.log.folder).times), 40)
        np.save(self.log.folder / "contacts.npy", np.array(self.log.contacts)[:20])
        self.assertEqual(len(Log(self.log.folder).times), 20)

    def test_faults_name_the_file_and_the_cure(self):
        for damage, told in (
            (lambda f: (f / "states.npy").unlink(), "states.npy: it is missing"),
            (lambda f: (f / "frames.npy").write_bytes(b"nothing"), "frames.npy: it is no NumPy table"),
            (lambda f: (f / "run.json").write_text("{"), "run.json: it is damaged"),
            (lambda f: (f / "run.json").write_text('{"format": "x"}'), "this is no response log"),
            (lambda f: (f / "run.json").unlink(), "there is no run.json"),
        ):
            folder = self.folder / told.replace(" ", "_").replace("/", "_")
            damage(sample.write_log(folder))
            with self.assertRaisesRegex(LogError, told):
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
        # The log's own coordinates are that coarse at 6.8e6 m.
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
        # Turned back about y by the ball's angle.
        expected = np.stack([np.cos(angle) * offset[:, 0] - np.sin(angle) * offset[:, 2], 0 * angle,
                             np.sin(angle) * offset[:, 0] + np.cos(angle) * offset[:, 2]], axis=1)
        np.testing.assert_allclose(ground.positions, expected, atol=2e-9)


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
        np.testing.assert_array_equal(marks.touched(self.log, film, 0), film.times <= 0.5)
        self.assertFalse(marks.touched(self.log, film, 1).any())

    def test_shortest_turn_from_z(self):
        for direction in ((0, 0, 2), (0, 0, -3), (1, 0, 0), (-1, 2, -5)):
            direction = np.array(direction, dtype=float)
            turned = timeline.turned(timeline.from_z(direction), np.array([0.0, 0.0, 1.0]))
            np.testing.assert_allclose(turned, direction / np.linalg.norm(direction), atol=1e-12)


class Shapes(unittest.TestCase):
    def test_balls_and_arrows_are_closed_and_face_outwards(self):
        for vertices, faces in (shapes.ball(12, 6), marks.arrow()):
            edges = [(f[i], f[(i + 1) % len(f)]) for f in faces for i in range(len(f))]
            self.assertEqual(len(edges), len(set(edges)))
            self.assertEqual({(b, a) for a, b in edges}, set(edges))
            self.assertGreater(_volume(vertices, faces), 0.0)

    def test_volume_of_a_fine_ball(self):
        vertices, faces = shapes.ball(128, 64)
        self.assertAlmostEqual(_volume(vertices, faces), 4.0 / 3.0 * np.pi, delta=6e-3)


def _volume(vertices, faces):
    return sum(np.dot(vertices[f[0]], np.cross(vertices[f[i]], vertices[f[i + 1]])) / 6.0
               for f in faces for i in range(1, len(f) - 1))

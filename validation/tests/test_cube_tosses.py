"""Protocol, data and adapters of the cube tosses."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

from validation.cube_tosses import data, facts, for_fit, identify, momentum, protocol, study
from validation.cube_tosses.engines.engine import MissingEngine
from validation.cube_tosses.engines.table import ENGINES, make
from validation.kit import rotation
from validation.kit.statistics import interval

TOSSES = data.load()
SMOKE = 20  # tosses


def flight(frames=30, turning=(1.0, -2.0, 3.0)):
    """Free flight of a cube over a table that it does not reach."""
    time = data.FRAME * np.arange(frames)
    states = np.zeros((frames, 13))
    states[:, :3] = (
        np.array([0.1, 0.2, 0.6]) + np.outer(time, [1.0, -0.5, 0.3]) - np.outer(time**2, [0, 0, data.GRAVITY / 2])
    )
    states[:, 3:7] = rotation.of_rotation_vector(np.outer(time, turning))
    states[:, 7:10] = np.array([1.0, -0.5, 0.3]) - np.outer(time, [0, 0, data.GRAVITY])
    states[:, 10:] = turning
    return states


class Data(unittest.TestCase):
    def test_there_are_550_tosses_of_58362_frames(self):
        self.assertEqual(len(TOSSES), data.TOSSES)
        self.assertEqual(sum(len(toss) for toss in TOSSES), 58_362)

    def test_a_missing_file_is_named_with_the_cure(self):
        with self.assertRaisesRegex(
            data.DataError, "nowhere.npz: there is no such file; the tosses come with the repository"
        ):
            data.load("nowhere.npz")

    def test_records_for_a_fit_begin_two_frames_before_the_touch(self):
        chosen = for_fit.records(TOSSES)
        self.assertEqual(len(chosen), for_fit.RECORDS)
        for _, states in chosen:
            self.assertTrue((data.lowest_corner(states[: for_fit.BEFORE]) >= 0.0).all())
            self.assertLess(data.lowest_corner(states[for_fit.BEFORE]), 0.0)
        lines = for_fit.text(chosen[:2]).splitlines()
        self.assertEqual(len(lines), len(for_fit.NOISE) + 2 + 2 * for_fit.FRAMES)
        self.assertTrue(all(line.count(",") == for_fit.COLUMNS.count(",") for line in lines[-52:]))

    def test_a_file_of_another_layout_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "odd.npz"
            np.savez(path, frames=np.array([3]), states=np.zeros((2, 13)))
            with self.assertRaisesRegex(data.DataError, "states for 3 frames"):
                data.load(path)

    def test_the_lowest_corner_of_a_cube_on_its_tip_is_half_a_diagonal_down(self):
        # A turn that takes the diagonal (1, 1, 1) down.
        diagonal = np.ones(3) / np.sqrt(3.0)
        axis = np.cross(diagonal, [0, 0, -1.0])
        q = rotation.of_rotation_vector(axis / np.linalg.norm(axis) * np.arccos(-diagonal[2]))
        state = np.concatenate([[0, 0, 1.0], q, np.zeros(6)])
        self.assertAlmostEqual(float(data.lowest_corner(state)), 1.0 - np.sqrt(3.0) * data.HALF_EDGE, places=9)

    def test_the_angular_velocity_is_along_the_axes_of_the_cube(self):
        own, common = facts.axes_of_turning(TOSSES)
        self.assertLess(np.degrees(own), 1.0)
        self.assertGreater(np.degrees(common), 20.0)


class Protocol(unittest.TestCase):
    def test_the_published_start_falls_behind_by_a_frame_and_the_corrected_one_does_not(self):
        toss = flight()
        published, corrected = (protocol.start_state(toss, 20, one) for one in (False, True))
        self.assertAlmostEqual(published[9] - toss[20, 9], data.GRAVITY * data.FRAME, places=9)
        np.testing.assert_allclose(corrected[7:], toss[20, 7:], atol=1e-9)

    def test_an_error_of_half_an_edge_counts_half_an_edge(self):
        measured = flight()
        case = protocol.Case(0, measured[0], measured)
        poses = measured[:, :7].copy()
        poses[:, 0] += data.HALF_EDGE
        found = protocol.errors(case, poses)
        self.assertAlmostEqual(found.e_q, data.HALF_EDGE)
        self.assertAlmostEqual(found.place, 0.5)

    def test_an_error_of_rotation_counts_its_square(self):
        measured = flight()
        poses = measured[:, :7].copy()
        poses[:, 3:] = rotation.product(rotation.of_rotation_vector(np.array([0.0, 0.2, 0.0])), poses[:, 3:])
        self.assertAlmostEqual(protocol.errors(protocol.Case(0, measured[0], measured), poses).e_q, 0.04)

    def test_training_and_test_tosses_share_none(self):
        self.assertFalse(set(protocol.training()) & set(protocol.TEST))

    def test_a_window_ends_its_horizon_after_the_touch(self):
        for case in protocol.after_touch(TOSSES, range(SMOKE)):
            touch = protocol.touch_frame(case.measured)
            self.assertLessEqual(abs((len(case.measured) - 1 - touch) * data.FRAME - protocol.HORIZON), data.FRAME / 2)


class Engines(unittest.TestCase):
    def test_free_flight_is_exact_in_pong(self):
        measured = flight()
        engine = make("pong-linear")
        engine.configure({"stiffness": 2e4, "damping": 50.0, "mu": 0.2})
        poses = engine.poses(protocol.Case(0, measured[0], measured))
        np.testing.assert_allclose(poses[:, :3], measured[:, :3], atol=1e-9)
        self.assertLess(rotation.angle_between(poses[:, 3:], measured[:, 3:7]).max(), 1e-6)

    def test_a_run_leaves_nothing_to_the_next(self):
        engine = next(entry for entry in identify.load() if entry.engine == "pong-linear").made()
        first, second = protocol.whole_tosses(TOSSES, [0, 1])
        alone = engine.poses(first)
        engine.poses(second)
        np.testing.assert_array_equal(engine.poses(first), alone)

    def test_round_corners_and_a_lower_table_change_where_the_cube_rests(self):
        engine = make("pong-linear")
        start = np.array([0, 0, 0.0524, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0], dtype=float)
        case = protocol.Case(0, start, np.tile(start, (150, 1)))
        for radius, table in ((0.0, 0.0), (0.003, -0.00117)):
            engine.configure({"stiffness": 2e4, "damping": 100.0, "mu": 0.2}, data.Body(corner_radius=radius), table)
            depth = 0.37 * data.GRAVITY / (4 * 2e4)
            self.assertAlmostEqual(engine.poses(case)[-1, 2], data.HALF_EDGE + table - depth, places=6)

    def test_every_installed_engine_lets_a_cube_fall_and_rest(self):
        start = np.array([0, 0, 0.08, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0], dtype=float)
        case = protocol.Case(0, start, np.tile(start, (200, 1)))
        for name in ENGINES:
            engine = make(name)
            try:
                engine.configure({one: free.start for one, free in engine.free.items()})
            except MissingEngine:
                continue
            poses = engine.poses(case)
            with self.subTest(name):
                # Drake has one contact of a box with a half space, so that the cube tips a little.
                self.assertAlmostEqual(poses[-1, 2], data.HALF_EDGE, delta=3e-3)
                self.assertAlmostEqual(poses[5, 2], 0.08 - data.GRAVITY / 2 * (5 * data.FRAME) ** 2, delta=5e-4)

    def test_an_unknown_parameter_is_named(self):
        with self.assertRaisesRegex(ValueError, "pong-linear: parameter `friction` is missing or unknown"):
            make("pong-linear").configure({"stiffness": 1.0, "damping": 1.0, "mu": 0.1, "friction": 1.0})


class Momentum(unittest.TestCase):
    def test_the_inertia_of_simulated_tosses_is_found(self):
        engine = make("pong-linear")
        generator = np.random.default_rng(5)
        for wanted in (0.0008, 0.0013):
            engine.configure({"stiffness": 1.5e4, "damping": 70.0, "mu": 0.18}, data.Body(inertia=wanted))
            simulated = [noisy(engine.poses(case), generator) for case in from_first_frame(range(0, 550, 3))]
            rows = np.array([touch.row for touch in momentum.touches(simulated, 0.0)])
            self.assertGreater(len(rows), 40)
            found = interval(rows, momentum.inertia)
            # What is left is that a touch of some frames counts as an instant.
            self.assertAlmostEqual(found.value, wanted, delta=0.06 * wanted)

    def test_measured_touches_give_more_than_the_published_inertia(self):
        height, _ = facts.table(TOSSES)
        found, low, high, count = facts.inertia(TOSSES, height.value)
        self.assertGreater(count, 40)
        self.assertTrue(0.0012 < found.value < 0.0014, found)
        self.assertGreater(low.low, data.PUBLISHED_BODY.inertia)


def from_first_frame(numbers):
    """Cases that begin with the record: the flight of the corrected start, followed back to the first frame."""
    for case in protocol.whole_tosses(TOSSES, numbers, corrected=True):
        toss = TOSSES[case.number]
        time = data.FRAME * protocol.first_frame(toss)
        start = case.start.copy()
        start[7:10] += [0.0, 0.0, data.GRAVITY * time]
        start[:3] += -start[7:10] * time + np.array([0.0, 0.0, data.GRAVITY / 2 * time**2])
        start[3:7] = rotation.product(start[3:7], rotation.of_rotation_vector(-start[10:] * time))
        yield protocol.Case(case.number, start, toss)


def noisy(poses, generator):
    """Poses with the noise of measurement, as states."""
    states = np.zeros((len(poses), 13))
    states[:, :3] = poses[:, :3] + generator.normal(0.0, 3e-4, (len(poses), 3))
    states[:, 3:7] = rotation.product(
        rotation.of_rotation_vector(generator.normal(0.0, 3e-3, (len(poses), 3))), poses[:, 3:]
    )
    return states


class Study(unittest.TestCase):
    def test_twenty_tosses_stay_near_the_measurement(self):
        cases = protocol.after_touch(TOSSES, list(protocol.TEST)[:SMOKE])
        errors = {
            entry.body: study.run(title, maker(), cases).e_q.mean()
            for title, maker, entry in study.found("touch", ["pong-linear"])
        }
        published, inertia, round_corners = (errors[body] for body in identify.BODIES)
        self.assertLess(inertia, 0.035)
        self.assertLess(round_corners, 0.035)
        self.assertLess(inertia, published)

    def test_found_parameters_are_within_their_bounds(self):
        for entry in identify.load():
            free = {**ENGINES[entry.engine].free, **identify.BODIES[entry.body][0]}
            values = {**entry.values, "inertia": entry.inertia, "corner_radius": entry.corner_radius}
            for name, one in free.items():
                self.assertTrue(0.999 * one.low <= values[name] <= 1.001 * one.high, (entry.engine, name))


if __name__ == "__main__":
    unittest.main()

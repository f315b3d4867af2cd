"""Rotations, intervals and the search, against closed forms."""

import unittest

import numpy as np

from validation.kit import rotation
from validation.kit.search import Free, minimise
from validation.kit.statistics import interval, paired


class Rotations(unittest.TestCase):
    def test_rotation_vectors_round_trip(self):
        vectors = np.random.default_rng(1).uniform(-1.8, 1.8, size=(100, 3))
        np.testing.assert_allclose(rotation.rotation_vector(rotation.of_rotation_vector(vectors)), vectors, atol=1e-12)

    def test_a_quaternion_and_its_negative_are_one_rotation(self):
        q = rotation.of_rotation_vector(np.array([[0.3, -0.2, 1.0]]))
        self.assertAlmostEqual(float(rotation.angle_between(q, -q)[0]), 0.0, places=7)

    def test_products_turn_one_after_the_other(self):
        a, b = rotation.of_rotation_vector(np.random.default_rng(2).normal(size=(2, 3)))
        x = np.array([1.0, 2.0, 3.0])
        np.testing.assert_allclose(
            rotation.turned(rotation.product(a, b), x), rotation.turned(a, rotation.turned(b, x)), atol=1e-12
        )
        np.testing.assert_allclose(rotation.matrix(a) @ x, rotation.turned(a, x), atol=1e-12)

    def test_a_quarter_turn_about_z_takes_x_to_y(self):
        q = rotation.of_rotation_vector(np.array([0.0, 0.0, np.pi / 2]))
        np.testing.assert_allclose(rotation.turned(q, np.array([1.0, 0.0, 0.0])), [0.0, 1.0, 0.0], atol=1e-12)


class Intervals(unittest.TestCase):
    def test_the_interval_of_a_mean_is_that_of_the_normal_distribution(self):
        sample = np.random.default_rng(3).normal(2.0, 1.0, size=400)
        found, error = interval(sample), np.std(sample) / 20.0
        self.assertAlmostEqual(found.low, sample.mean() - 1.96 * error, delta=0.1 * error)
        self.assertAlmostEqual(found.high, sample.mean() + 1.96 * error, delta=0.1 * error)

    def test_a_constant_difference_has_no_width(self):
        sample = np.random.default_rng(4).normal(size=50)
        found = paired(sample + 0.5, sample)
        self.assertAlmostEqual(found.low, 0.5)
        self.assertAlmostEqual(found.high, 0.5)


class Search(unittest.TestCase):
    def test_a_quadratic_is_minimised_within_the_evaluations(self):
        free = {"a": Free(1.0, 0.1, 10.0), "b": Free(0.5, 0.0, 1.0)}
        found = minimise(lambda v: np.log(v["a"] / 3.0) ** 2 + (v["b"] - 0.2) ** 2, free, 80)
        self.assertLessEqual(found.evaluations, 80)
        self.assertAlmostEqual(found.values["a"], 3.0, delta=0.05)
        self.assertAlmostEqual(found.values["b"], 0.2, delta=0.01)
        self.assertEqual(found.at_bound, [])

    def test_an_optimum_beyond_a_bound_is_told(self):
        found = minimise(lambda v: (v["a"] - 20.0) ** 2, {"a": Free(5.0, 1.0, 10.0)}, 60)
        self.assertEqual(found.at_bound, ["a"])


if __name__ == "__main__":
    unittest.main()

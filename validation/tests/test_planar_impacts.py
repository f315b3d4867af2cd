"""Planar impacts: a data set that is made here stands for the published one, which has no licence."""

import contextlib
import io
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

from validation.planar_impacts import __main__ as command
from validation.planar_impacts import data, jacobians, rigid, with_pong

RESTITUTION, FRICTION = 0.6, 0.2


def impacts(count=60):
    """Impacts of a rigid ellipse with the geometry of the real one."""
    generator = np.random.default_rng(6)
    angle = generator.uniform(-np.pi, np.pi, count)
    a, b = data.SEMI_AXES
    height = np.hypot(a * np.sin(angle), b * np.cos(angle))
    before = np.column_stack(
        [generator.uniform(-0.8, 0.8, count), generator.uniform(-3.0, -2.2, count), generator.uniform(-8, 8, count)]
    )
    one = data.Impacts(angle, before, before, -(a**2 - b**2) * np.sin(angle) * np.cos(angle) / height, -height, {})
    after = rigid.after(one, RESTITUTION, FRICTION)
    return data.Impacts(angle, before, after, one.normal, one.tangent, {name: after for name in data.MODELS})


def write(folder, one, tangent_sign=-1.0):
    """The files of the data set, the tangential Jacobian with the other sign as in the published ones."""
    from scipy.io import savemat

    zero, unit = np.zeros(len(one)), np.ones(len(one))
    states = [np.column_stack([zero, zero, one.angle, velocities]) for velocities in (one.before, one.after)]
    fields = {
        "states_i": states[0],
        "states_f": states[1],
        "n": np.column_stack([zero, unit, one.normal]),
        "d": np.column_stack([unit, zero, tangent_sign * one.tangent]),
    }
    savemat(Path(folder) / "data_ellipse.mat", {"data": fields})
    savemat(Path(folder) / "v_models.mat", {"v_models": np.hstack(list(one.predicted.values()))})


class Files(unittest.TestCase):
    def test_a_missing_data_set_is_named_with_sizes_and_place(self):
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaisesRegex(
                data.DataError,
                r"data_ellipse.mat: there is no such file; the data set has no licence.*182,950 bytes.*mcubelab",
            ):
                data.load(folder)

    def test_a_file_that_is_not_of_matlab_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in data.FILES:
                (Path(folder) / name).write_bytes(b"nothing of the kind" * 20)
            with self.assertRaisesRegex(data.DataError, "not a MATLAB file"):
                data.load(folder)

    def test_another_size_is_noted_and_the_rows_are_read(self):
        with tempfile.TemporaryDirectory() as folder:
            one = impacts()
            write(folder, one)
            read, notes = data.load(folder)
            self.assertEqual(len(notes), 2)
            np.testing.assert_allclose(read.before, one.before)
            np.testing.assert_allclose(read.tangent, -one.tangent)

    def test_rows_of_different_numbers_are_refused(self):
        from scipy.io import savemat

        with tempfile.TemporaryDirectory() as folder:
            write(folder, impacts())
            savemat(Path(folder) / "v_models.mat", {"v_models": np.zeros((7, 18))})
            with self.assertRaisesRegex(data.DataError, "not n × 6, n × 3 and n × 18"):
                data.load(folder)


def stiff(values, one):
    """Velocities after the impacts in Pong, on a spring so stiff that the ellipse hardly turns meanwhile."""
    with mock.patch.object(with_pong, "STIFFNESS", 1e8):
        engine = with_pong.Ellipse("linear", "Coulomb")
        engine.configure(values)
        return engine.after(one)


class Physics(unittest.TestCase):
    def test_the_wrong_sign_is_found_and_the_right_one_is_not(self):
        right = impacts()
        found = jacobians.signs(right)
        self.assertAlmostEqual(found.tangential.value, found.expected, delta=1e-6 * found.expected)
        self.assertAlmostEqual(found.normal.value, found.expected, delta=1e-6 * found.expected)
        wrong = jacobians.signs(jacobians.corrected(right))
        self.assertLess(wrong.tangential.high, 0.0)

    def test_some_impulse_explains_every_impact_of_a_rigid_body(self):
        one = impacts()
        self.assertLess(data.error(one, jacobians.best_impulse(one)).max(), 1e-9)

    def test_rigid_impacts_keep_the_laws_of_friction_and_restitution(self):
        one = impacts()
        change = one.after - one.before
        self.assertTrue((np.abs(change[:, 0]) <= FRICTION * change[:, 1] + 1e-12).all())
        approach, leaving = (velocities[:, 1] + one.normal * velocities[:, 2] for velocities in (one.before, one.after))
        self.assertTrue((leaving > 0).all())
        self.assertTrue((data.length(one.after) <= data.length(one.before) + 1e-12).all())
        self.assertTrue((approach < 0).all())

    def test_a_central_impact_without_friction_returns_the_restitution(self):
        one = impacts(1).part(slice(0, 1))
        upright = data.Impacts(
            np.zeros(1), np.array([[0.0, -2.0, 0.0]]), one.after, np.zeros(1), np.array([-0.025]), {}
        )
        np.testing.assert_allclose(rigid.after(upright, 0.6, 0.0), [[0.0, 1.2, 0.0]], atol=1e-12)

    def test_pong_without_friction_meets_the_rigid_impact_in_every_pose(self):
        one = impacts(12)
        # Damping ratio 0: the impact is elastic.
        self.assertLess(data.length(stiff({"mu": 0.0, "zeta": 0.0}, one) - rigid.after(one, 1.0, 0.0)).max(), 0.005)

    def test_pong_with_friction_that_slips_throughout_meets_the_rigid_impact(self):
        one = impacts(30)
        fast = data.Impacts(one.angle, one.before + [6.0, 0.0, 0.0], one.after, one.normal, one.tangent, {})
        self.assertLess(data.length(stiff({"mu": 0.1, "zeta": 0.0}, fast) - rigid.after(fast, 1.0, 0.1)).max(), 0.008)


class Command(unittest.TestCase):
    def test_the_command_tells_the_wrong_sign(self):
        with tempfile.TemporaryDirectory() as folder:
            write(folder, impacts())
            out = io.StringIO()
            with (
                mock.patch.object(sys, "argv", ["planar_impacts", folder, "--laws", "linear"]),
                contextlib.redirect_stdout(out),
            ):
                command.main()
            self.assertIn("the tangential Jacobian has the wrong sign", out.getvalue())
            self.assertIn("rigid (Routh), e 0.6, μ 0.2, sign corrected | 0.000", out.getvalue())


if __name__ == "__main__":
    unittest.main()

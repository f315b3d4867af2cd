"""Motions with closed-form solutions, under every integrator of MuJoCo."""

import math
import unittest

import mujoco
import numpy as np
from support import INTEGRATORS, ball_on_ground


class ClosedForms(unittest.TestCase):
    def bounce(self, integrator, timestep, damping=0.0):
        """A ball that flies to the ground without gravity: (greatest depth, speed of the rebound, longest force)."""
        m = ball_on_ground("0 0 0.1001", integrator=integrator, timestep=timestep, gravity="0 0 0", damping=damping)
        d = mujoco.MjData(m)
        d.qvel[2] = -1.0
        depth = 0.0
        for _ in range(round(0.05 / timestep)):
            mujoco.mj_step(m, d)
            depth = max(depth, 0.1 - d.qpos[2])
        self.assertEqual(d.sensordata[0], 0)
        return depth, d.qvel[2]

    def test_undamped_bounce(self):
        # Half a period of m·x'' = −k·x: depth v·√(m/k), speed as before. The step divides neither contact onset nor
        # half period, so the truncation at both ends remains: first order in h·ω = 0.014.
        omega = math.sqrt(2e4)
        for integrator in INTEGRATORS:
            with self.subTest(integrator=integrator):
                depth, speed = self.bounce(integrator, 1e-4)
                self.assertLess(abs(depth * omega - 1.0), 1e-3)
                self.assertLess(abs(speed - 1.0), 2e-3)

    def test_runge_kutta_is_better(self):
        depth, speed = self.bounce("RK4", 1e-4)
        self.assertLess(abs(depth * math.sqrt(2e4) - 1.0), 1e-4)
        self.assertLess(abs(speed - 1.0), 1e-5)

    def test_damped_bounce(self):
        # m·x'' = −k·x − c·x' from x = 0, x' = v while the force pushes: it ends where k·x + c·x' = 0.
        k, c, v = 2e4, 40.0, 1.0
        decay, omega = c / 2, math.sqrt(k - c * c / 4)
        # x = v/ω·e^(−γt)·sin ωt; k·x + c·x' = 0 where tan ωt = −c·ω/(k − c·γ), in the second quadrant.
        end = (math.pi - math.atan2(c * omega, k - c * decay)) / omega
        rebound = v * math.exp(-decay * end) * (decay / omega * math.sin(omega * end) - math.cos(omega * end))
        for integrator in INTEGRATORS:
            with self.subTest(integrator=integrator):
                _, speed = self.bounce(integrator, 2e-5, damping=c)
                self.assertLess(abs(speed - rebound), 2e-3)

    def test_rest(self):
        # The weight is supported: depth m·g/k, force m·g on the ball and −m·g on the ground.
        for integrator in INTEGRATORS:
            with self.subTest(integrator=integrator):
                m = ball_on_ground("0 0 0.0995", integrator=integrator, damping=100.0)
                d = mujoco.MjData(m)
                mujoco.mj_step(m, d, 1000)
                self.assertAlmostEqual(0.1 - d.qpos[2], 9.81 / 2e4, delta=1e-12)
                self.assertEqual(d.sensordata[0], 1)
                np.testing.assert_allclose(d.sensordata[3:], [0, 0, 9.81, 0, 0, 0, 0, 0, -9.81, 0, 0, 0], atol=1e-7)

    def settles(self, integrator, damping_number, stiffness_number):
        """True if a ball at rest returns to rest after a small push: h·c/m and h·√(k/m) as given."""
        h = 1e-3
        m = ball_on_ground("0 0 0.09", integrator=integrator, timestep=h, stiffness=(stiffness_number / h) ** 2,
                           damping=damping_number / h, gravity=f"0 0 {-0.01 * (stiffness_number / h) ** 2}", check="false")
        d = mujoco.MjData(m)
        d.qvel[2] = 1e-4
        speeds = []
        for _ in range(40):
            mujoco.mj_step(m, d)
            speeds.append(abs(d.qvel[2]))
        return max(speeds[30:]) < 1e-4

    def test_limits_of_stability(self):
        # Contact is explicit: 2·h·c/m + h²·k/m < 4 with one evaluation a step, whatever is implicit in MuJoCo. RK4: |R(z)| < 1 at
        # both roots z of z² + (h·c/m)·z + h²·k/m = 0.
        def growth(c, k):
            return max(abs(1 + z + z**2 / 2 + z**3 / 6 + z**4 / 24) for z in np.roots([1, c, k * k]))

        for c, k in ((1.9, 0.1), (2.1, 0.1), (0.9, 1.3), (0.9, 1.6), (0.1, 1.9), (0.1, 2.05)):
            for integrator in INTEGRATORS:
                with self.subTest(integrator=integrator, damping=c, stiffness=k):
                    expected = growth(c, k) < 1 if integrator == "RK4" else 2 * c + k * k < 4
                    self.assertEqual(self.settles(integrator, c, k), expected)

    def test_bristle_holds_on_a_slope(self):
        # Gravity is tilted by atan 0.2, and friction 0.5 holds: the bristle is deflected by m·g_x/k_t. Without a commit
        # in each step it would have no memory, and the ball would slide away.
        slides = "<joint type='slide' axis='1 0 0'/><joint type='slide' axis='0 0 1'/>"
        for integrator in INTEGRATORS:
            with self.subTest(integrator=integrator):
                m = ball_on_ground("0 0 0.0995", joints=slides, gravity="1.962 0 -9.81", integrator=integrator, damping=100.0,
                                   mu=0.5, tangential=1e4, tangential_damping=100.0)
                d = mujoco.MjData(m)
                mujoco.mj_step(m, d)
                first = d.qpos[0]  # a contact that is there at the start has its bristle from the first commit on
                mujoco.mj_step(m, d, 4000)
                self.assertAlmostEqual(d.qpos[0] - first, 1.962 / 1e4, delta=1e-10)
                self.assertAlmostEqual(d.sensordata[3], -1.962, delta=1e-6)

    def test_sliding_stops_where_friction_has_taken_the_energy(self):
        # v²/(2·μ·g), less the energy kept by the bristle: μ·m·g/k_t at most.
        slides = "<joint type='slide' axis='1 0 0'/><joint type='slide' axis='0 0 1'/>"
        for integrator in INTEGRATORS:
            with self.subTest(integrator=integrator):
                m = ball_on_ground("0 0 0.0995095", joints=slides, integrator=integrator, damping=100.0, mu=0.5, tangential=1e4,
                                   tangential_damping=100.0)
                d = mujoco.MjData(m)
                d.qvel[0] = 1.0
                mujoco.mj_step(m, d, 1000)
                self.assertAlmostEqual(d.qpos[0], 1.0 / (2 * 0.5 * 9.81), delta=3 * 0.5 * 9.81 / 1e4)
                self.assertLess(abs(d.qvel[0]), 1e-3)

    def test_force_acts_at_the_place_of_the_contact(self):
        # A ball that slides without rolling: friction turns it with the moment r·F about its centre.
        m = ball_on_ground("0 0 0.0995095", damping=100.0, mu=0.3, tangential=1e4)
        d = mujoco.MjData(m)
        d.qvel[0] = 3.0
        mujoco.mj_step(m, d, 100)
        force, moment = d.sensordata[3:6], d.sensordata[6:9]
        self.assertAlmostEqual(force[0], -0.3 * force[2], delta=1e-6)
        arm = np.array([0, 0, -d.qpos[2]])
        np.testing.assert_allclose(moment, np.cross(arm, force), atol=1e-3)
        self.assertAlmostEqual(moment[1] / force[0], -0.1, delta=5e-4)

    def test_action_and_reaction(self):
        m = ball_on_ground("0 0 0.1001", gravity="0 0 0", mu=0.3, damping=10.0)
        d = mujoco.MjData(m)
        d.qvel[:] = 0.2, 0.1, -1.0, 1.0, 2.0, 3.0
        most = 0.0
        for _ in range(60):
            mujoco.mj_step(m, d)
            most = max(most, d.sensordata[5])
            np.testing.assert_allclose(d.sensordata[3:6], -d.sensordata[9:12], atol=1e-12)
        self.assertGreater(most, 50.0)


if __name__ == "__main__":
    unittest.main()

"""Visualization added by the plugin to MuJoCo's scenes, tested without a display."""

import unittest

import mujoco
import numpy as np
from support import ball_on_ground, full_state, run

POINT, FORCE = mujoco.mjtVisFlag.mjVIS_CONTACTPOINT, mujoco.mjtVisFlag.mjVIS_CONTACTFORCE


class Picture(unittest.TestCase):
    def setUp(self):
        self.m = ball_on_ground("0.3 0 0.0995", damping=100.0, mu=0.5)
        self.d = mujoco.MjData(self.m)
        mujoco.mj_step(self.m, self.d, 500)

    def geoms(self, *flags, maxgeom=100):
        scene, option = mujoco.MjvScene(self.m, maxgeom=maxgeom), mujoco.MjvOption()
        option.flags[POINT] = option.flags[FORCE] = 0
        for flag in flags:
            option.flags[flag] = 1
        mujoco.mjv_updateScene(self.m, self.d, option, None, mujoco.MjvCamera(), mujoco.mjtCatBit.mjCAT_ALL.value, scene)
        return [scene.geoms[i] for i in range(scene.ngeom)]

    def test_nothing_unless_asked_for(self):
        self.assertEqual(len(self.geoms()), 0)

    def test_an_arrow_along_the_force(self):
        (arrow,) = self.geoms(FORCE)
        self.assertEqual(arrow.type, mujoco.mjtGeom.mjGEOM_ARROW)
        np.testing.assert_allclose(arrow.pos, [0.3, 0, 0], atol=1e-3)
        np.testing.assert_allclose(arrow.mat[:, 2], [0, 0, 1], atol=1e-6)
        # MuJoCo's own scale: force · map.force / meanmass, N to m.
        length = 9.81 * self.m.vis.map.force / self.m.stat.meanmass
        self.assertAlmostEqual(arrow.size[2], length, delta=1e-3 * length)

    def test_a_disc_green_where_it_sticks(self):
        (disc,) = self.geoms(POINT)
        self.assertEqual(disc.type, mujoco.mjtGeom.mjGEOM_CYLINDER)
        self.assertGreater(disc.rgba[1], disc.rgba[0])
        self.d.qvel[0] = 3.0
        mujoco.mj_step(self.m, self.d, 3)
        (disc,) = self.geoms(POINT)
        self.assertGreater(disc.rgba[0], disc.rgba[1])

    def test_no_more_than_the_scene_holds(self):
        self.assertEqual(len(self.geoms(POINT, FORCE, maxgeom=1)), 1)

    def test_looking_changes_nothing(self):
        other = mujoco.MjData(self.m)
        mujoco.mj_copyData(other, self.m, self.d)
        expected = run(self.m, other, 50)
        for bits in expected:
            self.geoms(POINT, FORCE)
            mujoco.mj_step(self.m, self.d)
            self.assertTrue(full_state(self.m, self.d).tobytes() + self.d.sensordata.tobytes() == bits)


if __name__ == "__main__":
    unittest.main()

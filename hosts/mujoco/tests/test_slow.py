"""Long steps with copies: rebounds, joints, bits of states, messages (docs/mujoco.md, long steps)."""

import copy
import pickle
import unittest

import mujoco
import numpy as np
from support import FREE, GROUND, SENSOR, assert_same_bits, ball_model, full_state, instance, mjcf, run

STIFFNESS = 2e4


def falling(timestep=0.02, substeps="5000", integrator="implicitfast", joints=None, place="0 0 0.2", gravity="0 0 -9.81", **surface):
    body = FREE.format(place=place, mass=1.0, i=0.004)
    if joints is not None:
        body = body.replace("<freejoint/>", joints)
    keys = {"substeps_max": substeps} if substeps else {}
    inside = instance("ball = text1; ground = text2", bodies="ground = world", text1=ball_model(stiffness=STIFFNESS, **surface),
                      text2=GROUND, check_step="false", **keys)
    return mujoco.MjModel.from_xml_string(mjcf(body, inside, integrator, timestep, gravity, more=SENSOR))


class Rebounds(unittest.TestCase):
    def rebound(self, m, speed=1.0, steps=20):
        d = mujoco.MjData(m)
        d.qvel[2] = -speed
        mujoco.mj_step(m, d, steps)
        self.assertEqual(d.sensordata[2], 0)
        return d.qvel[2] / speed

    def test_a_step_longer_than_the_contact(self):
        # 22 ms of contact in steps of 20 and 50 ms; a held wrench throws the ball up.
        for timestep in (0.02, 0.05):
            for integrator in ("Euler", "implicit", "implicitfast"):
                for start in range(4):
                    place = f"0 0 {0.15 + 0.25 * start * timestep}"
                    m = falling(timestep, integrator=integrator, place=place, gravity="0 0 0")
                    self.assertLess(abs(self.rebound(m) - 1.0), 2e-3)
        self.assertGreater(self.rebound(falling(0.05, substeps="", place="0 0 0.15", gravity="0 0 0")), 2.0)

    def test_a_ball_on_a_slide_and_on_a_hinge(self):
        slide = "<joint type='slide' axis='0 0 1'/>"
        m = falling(0.05, joints=slide, place="0 0 0.15", gravity="0 0 0")
        d = mujoco.MjData(m)
        d.qvel[0] = -1.0
        mujoco.mj_step(m, d, 20)
        self.assertLess(abs(d.qvel[0] - 1.0), 2e-3)
        # An arm of 10 m: 0.1 rad/s is 1 m/s at the ball; inertia 100.004 kg·m² about the hinge.
        hinge = "<joint type='hinge' axis='0 1 0' pos='-10 0 0'/>"
        m = falling(0.05, joints=hinge, place="0 0 0.15", gravity="0 0 0")
        d = mujoco.MjData(m)
        d.qvel[0] = 0.1  # down
        mujoco.mj_step(m, d, 20)
        self.assertLess(abs(d.qvel[0] / -0.1 - 1.0), 5e-3)

    def test_rest(self):
        m = falling(0.05, place="0 0 0.0995", damping=100.0)
        d = mujoco.MjData(m)
        mujoco.mj_step(m, d, 200)
        self.assertAlmostEqual(0.1 - d.qpos[2], 9.81 / STIFFNESS, delta=1e-9)
        np.testing.assert_allclose(d.sensordata[3:9], [0, 0, 9.81, 0, 0, 0], atol=1e-6)
        self.assertEqual(d.sensordata[0], 1)


class Mechanisms(unittest.TestCase):
    """Balls of 1 m/s in steps of 20 and 50 ms, whose touch lasts 22 ms and less."""

    def touching(self, bodies, objects, pairs, timestep, **texts):
        keys = {"bodies": "ground = world"} if "ground" in objects else {}
        inside = instance(objects, pairs=pairs, check_step="false", substeps_max="5000", **keys, **texts)
        return mujoco.MjModel.from_xml_string(mjcf(bodies, inside, "implicitfast", timestep, gravity="0 0 0"))

    def test_two_groups_of_one_body(self):
        """A bar with a ball at each end falls flat on both, and rebounds as fast."""
        ends = "".join(f"<body name='{name}' pos='{x} 0 0'/>" for name, x in (("left", -1), ("right", 1)))
        for joint in ("<freejoint/>", "<joint type='slide' axis='0 0 1' damping='1e-9'/>"):
            for timestep in (0.02, 0.05):
                bar = f"<body name='bar' pos='0 0 0.13'>{joint}<inertial mass='2' pos='0 0 0' diaginertia='.1 1 1'/>{ends}</body>"
                m = self.touching(bar, "left = text1; right = text1; ground = text2", "left, ground; right, ground", timestep,
                                  text1=ball_model(stiffness=STIFFNESS), text2=GROUND)
                d = mujoco.MjData(m)
                up = 2 if "free" in joint else 0
                d.qvel[up] = -1.0
                mujoco.mj_step(m, d, 12)
                self.assertLess(abs(d.qvel[up] - 1.0), 2e-3)

    def test_a_body_that_is_lifted_off_its_limit(self):
        """A ball meets another of its mass that rests on the limit of its slide: it stops, and the other one goes on."""
        for timestep in (0.02, 0.05):
            ball = FREE.format(place="0 0 0", mass=1.0, i=0.004)
            rest = "<joint type='slide' axis='0 0 1' limited='true' range='0 9' stiffness='1e-3' springref='-1000'/>"
            other = f"<body name='other' pos='0 0 0.23'>{rest}<inertial mass='1' pos='0 0 0' diaginertia='.1 .1 .1'/></body>"
            m = self.touching(ball + other, "ball = text1; other = text1", "ball, other", timestep,
                              text1=ball_model(stiffness=STIFFNESS))
            d = mujoco.MjData(m)
            d.qvel[2] = 1.0
            mujoco.mj_step(m, d, 6)
            # The spring takes 1 N·s a second.
            self.assertLess(abs(d.qvel[2]), 0.15)
            self.assertLess(abs(d.qvel[6] - 1.0), 0.15 + 6 * timestep)


class States(unittest.TestCase):
    def test_restored_and_copied_states_go_on_with_the_same_bits(self):
        m = falling(damping=20.0, mu=0.5, place="0 0 0.12")
        d = mujoco.MjData(m)
        d.qvel[:] = 0.3, 0.1, -0.5, 1.0, 2.0, 3.0
        mujoco.mj_step(m, d, 7)
        saved = full_state(m, d)
        other, pickled = copy.copy(d), pickle.loads(pickle.dumps(d))
        expected = run(m, d, 20)
        assert_same_bits(self, run(m, other, 20), expected)
        assert_same_bits(self, run(m, pickled, 20), expected)
        mujoco.mj_setState(m, d, saved, mujoco.mjtState.mjSTATE_INTEGRATION)
        mujoco.mj_forward(m, d)
        assert_same_bits(self, run(m, d, 20), expected)
        # A run of its own in between, from the beginning.
        mujoco.mj_resetData(m, d)
        mujoco.mj_step(m, d, 3)
        mujoco.mj_setState(m, d, saved, mujoco.mjtState.mjSTATE_INTEGRATION)
        assert_same_bits(self, run(m, d, 20), expected)

    def test_pictures_change_nothing(self):
        m = falling(place="0 0 0.12", mu=0.5)
        d, watched = mujoco.MjData(m), mujoco.MjData(m)
        option, scene = mujoco.MjvOption(), mujoco.MjvScene(m, 100)
        option.flags[mujoco.mjtVisFlag.mjVIS_CONTACTPOINT] = 1
        for _ in range(10):
            mujoco.mj_step(m, d)
            mujoco.mj_step(m, watched)
            mujoco.mjv_updateScene(m, watched, option, None, mujoco.MjvCamera(), mujoco.mjtCatBit.mjCAT_ALL, scene)
        self.assertEqual(full_state(m, d).tobytes(), full_state(m, watched).tobytes())


class Messages(unittest.TestCase):
    def test_refused(self):
        for keys, text in (
            ({"integrator": "RK4"}, "integrator to Euler"),
            ({"integrator": "discrete"}, "integrator to Euler"),
            ({"substeps": "0"}, "no whole number from 1"),
            ({"substeps": "many"}, "no whole number from 1"),
        ):
            with self.assertRaisesRegex(ValueError, text):
                mujoco.MjData(falling(**keys))

    def test_too_few_substeps(self):
        told = []
        mujoco.set_mju_user_warning(told.append)
        try:
            m = falling(0.05, substeps="9", place="0 0 0.12")
            d = mujoco.MjData(m)
            mujoco.mj_step(m, d, 20)
        finally:
            mujoco.set_mju_user_warning(None)
        self.assertEqual(len([text for text in told if "substeps_max is 9" in text]), 1, told)
        self.assertLess(abs(d.qpos[2]), 0.2)


if __name__ == "__main__":
    unittest.main()

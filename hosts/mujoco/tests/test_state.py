"""Continuation from a saved state of MuJoCo gives the same bits."""

import concurrent.futures
import os
import pickle
import subprocess
import sys
import tempfile
import unittest

import mujoco
import mujoco.batch
import mujoco.rollout
import numpy as np
from support import (FREE, FULL, GROUND, INTEGRATORS, assert_same_bits, ball_model, ball_on_ground, full_state, instance, mjcf, run,
                     several_balls)

MIDDLE, AFTER = 150, 300
FULLPHYSICS = mujoco.mjtState.mjSTATE_FULLPHYSICS


class SameBits(unittest.TestCase):
    """A run is interrupted in contact and continued in many ways."""

    @classmethod
    def setUpClass(cls):
        cls.m = several_balls()
        cls.d = mujoco.MjData(cls.m)
        run(cls.m, cls.d, MIDDLE)
        assert cls.d.sensordata[0] >= 3, "the run is left in contact"
        cls.middle = full_state(cls.m, cls.d)
        cls.copy = pickle.dumps(cls.d)
        cls.whole = run(cls.m, cls.d, AFTER)

    def at_middle(self):
        d = mujoco.MjData(self.m)
        mujoco.mj_setState(self.m, d, self.middle, FULL)
        return d

    def test_set_state_in_new_data(self):
        assert_same_bits(self, run(self.m, self.at_middle(), AFTER), self.whole)

    def test_set_state_in_data_with_another_history(self):
        d = mujoco.MjData(self.m)
        d.qvel[:] = 1.0
        run(self.m, d, 137)
        mujoco.mj_setState(self.m, d, self.middle, FULL)
        assert_same_bits(self, run(self.m, d, AFTER), self.whole)

    def test_set_full_physics(self):
        d = mujoco.MjData(self.m)
        run(self.m, d, 50)
        state = full_state(self.m, self.at_middle(), FULLPHYSICS)
        mujoco.mj_setState(self.m, d, state, FULLPHYSICS)
        d.qacc_warmstart[:] = self.at_middle().qacc_warmstart
        assert_same_bits(self, run(self.m, d, AFTER), self.whole)

    def test_the_way_back_in_the_same_data(self):
        d = self.at_middle()
        run(self.m, d, 77)
        mujoco.mj_setState(self.m, d, self.middle, FULL)
        assert_same_bits(self, run(self.m, d, AFTER), self.whole)

    def test_copied_data(self):
        source = self.at_middle()
        copies = [mujoco.MjData(self.m), mujoco.MjData(self.m)]
        run(self.m, copies[1], 200)
        for d in copies:
            mujoco.mj_copyData(d, self.m, source)
            assert_same_bits(self, run(self.m, d, AFTER), self.whole)

    def test_pickled_data(self):
        d = pickle.loads(self.copy)
        assert_same_bits(self, run(self.m, d, AFTER), self.whole)
        del d
        # The world of the first differs from that of the second.
        assert_same_bits(self, run(self.m, pickle.loads(self.copy), AFTER), self.whole)

    def test_pickled_into_another_process(self):
        program = (
            "import pickle, sys, support; m, d = pickle.loads(sys.stdin.buffer.read());"
            f"sys.stdout.buffer.write(pickle.dumps(support.run(m, d, {AFTER})))"
        )
        sent = pickle.dumps((self.m, pickle.loads(self.copy)))
        done = subprocess.run([sys.executable, "-c", program], input=sent, capture_output=True, check=True)
        assert_same_bits(self, pickle.loads(done.stdout), self.whole)

    def test_reset(self):
        d = mujoco.MjData(self.m)
        fresh = run(self.m, d, 250)
        mujoco.mj_resetData(self.m, d)
        self.assertFalse(d.plugin_state.any())
        assert_same_bits(self, run(self.m, d, 250), fresh)

    def test_keyframe_begins_without_a_past(self):
        key = "<keyframe><key name='k' qvel='0.3 0 -1 0 0 0'/></keyframe>"
        m = ball_on_ground("0 0 0.11", mu=0.3, more="<sensor><plugin name='contact' instance='c'/></sensor>" + key)
        runs = []
        for before in (0, 120):
            d = mujoco.MjData(m)
            run(m, d, before)
            mujoco.mj_resetDataKeyframe(m, d, 0)
            runs.append(run(m, d, 300))
        assert_same_bits(self, *runs)

    def test_step_in_two_halves(self):
        d = self.at_middle()
        for step, expected in enumerate(self.whole):
            mujoco.mj_step1(self.m, d)
            mujoco.mj_step2(self.m, d)
            self.assertTrue(full_state(self.m, d).tobytes() + d.sensordata.tobytes() == expected, f"step {step}")

    def test_evaluations_between_steps_leave_no_trace(self):
        # Forward and inverse dynamics, at the state and elsewhere; only MuJoCo's warm start of the solver remains.
        d = self.at_middle()
        for step, expected in enumerate(self.whole):
            state = full_state(self.m, d)
            mujoco.mj_forward(self.m, d)
            d.qpos[2] -= 0.01
            mujoco.mj_forward(self.m, d)
            mujoco.mj_inverse(self.m, d)
            mujoco.mj_setState(self.m, d, state, FULL)
            mujoco.mj_step(self.m, d)
            self.assertTrue(full_state(self.m, d).tobytes() + d.sensordata.tobytes() == expected, f"step {step}")

    def test_the_same_states_with_another_past(self):
        # Without their bristles the same positions give other forces: those of data without a history.
        fresh = mujoco.MjData(self.m)
        d = self.at_middle()
        mujoco.mj_forward(self.m, d)
        with_past = d.sensordata.copy()
        d.plugin_state[:] = 0
        fresh.qpos[:], fresh.qvel[:] = d.qpos, d.qvel
        for data in (d, fresh):
            mujoco.mj_forward(self.m, data)
        self.assertTrue((d.sensordata == fresh.sensordata).all())
        self.assertFalse((d.sensordata == with_past).all())

    def test_rollout_in_threads(self):
        states = np.stack([full_state(self.m, self.at_middle(), FULLPHYSICS)] * 4)
        states[1:, 1] += 1e-3 * np.arange(1, 4)  # four runs that differ
        results = []
        for threads in (1, 2, 4):
            datas = [mujoco.MjData(self.m) for _ in range(threads)]
            with mujoco.rollout.Rollout(nthread=threads) as rollout:
                state, sensors = rollout.rollout(self.m, datas, states, nstep=100)
            results.append((state.tobytes(), sensors.tobytes()))
        self.assertTrue(results[0] == results[1])
        self.assertTrue(results[0] == results[2])
        alone = mujoco.MjData(self.m)
        mujoco.mj_setState(self.m, alone, states[2], FULLPHYSICS)
        run(self.m, alone, 100)
        np.testing.assert_array_equal(state[2, -1], full_state(self.m, alone, FULLPHYSICS))

    def test_batch_in_threads(self):
        # An mjData serves many simulations in turn; the memory of each comes from its own state.
        results = []
        for threads, persistent in ((1, False), (2, False), (4, False), (2, True)):
            batch = mujoco.batch.Batch(self.m, 6, threads, persistent=persistent)
            batch.bind("qvel")[:, 0] = 0.1 * np.arange(6)
            batch.step(nstep=250)
            results.append(np.hstack([batch.bind("qpos"), batch.bind("qvel"), batch.bind("plugin_state")]).tobytes())
        self.assertEqual(len(set(results)), 1)
        alone = mujoco.MjData(self.m)
        alone.qvel[0] = 0.1 * 4
        run(self.m, alone, 250)
        numbers = np.frombuffer(results[0]).reshape(6, -1)[4]
        self.assertTrue((numbers == np.hstack([alone.qpos, alone.qvel, alone.plugin_state])).all())

    def test_data_made_and_deleted_in_threads(self):
        # Worlds are created and destroyed while others step; each mjData finds its own.
        def work(_):
            return [hash(b"".join(run(self.m, self.at_middle(), 60))) for _ in range(5)]

        with concurrent.futures.ThreadPoolExecutor(6) as pool:
            hashes = {number for numbers in pool.map(work, range(6)) for number in numbers}
        self.assertEqual(hashes, {hash(b"".join(self.whole[:60]))})

    def test_saved_and_loaded_model(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "balls.mjb")
            mujoco.mj_saveModel(self.m, path, None)
            m = mujoco.MjModel.from_binary_path(path)
        d = mujoco.MjData(m)
        mujoco.mj_setState(m, d, self.middle, FULL)
        assert_same_bits(self, run(m, d, AFTER), self.whole)

    def test_every_integrator(self):
        for integrator in INTEGRATORS:
            with self.subTest(integrator=integrator):
                m = several_balls(4, integrator)
                d = mujoco.MjData(m)
                run(m, d, 200)
                state = full_state(m, d)
                whole = run(m, d, 100)
                other = mujoco.MjData(m)
                run(m, other, 30)
                mujoco.mj_setState(m, other, state, FULL)
                assert_same_bits(self, run(m, other, 100), whole)


class Numbers(unittest.TestCase):
    def test_every_number_of_the_state_is_ordinary(self):
        m = several_balls()
        d = mujoco.MjData(m)
        for _ in range(400):
            mujoco.mj_step(m, d)
            numbers = np.abs(d.plugin_state)
            self.assertTrue(np.isfinite(numbers).all())
            self.assertFalse(((numbers > 0) & (numbers < np.finfo(float).tiny)).any(), "a denormal number")

    def test_the_rest_of_the_state_is_zero(self):
        # Contacts begin and end; their memory is released.
        m = ball_on_ground("0 0 0.12", mu=0.3)
        d = mujoco.MjData(m)
        used = []
        for _ in range(400):
            mujoco.mj_step(m, d)
            used.append(np.flatnonzero(d.plugin_state).max())
        self.assertGreater(max(used), min(used[20:]))
        end = 9 + 12 + int(d.plugin_state[0] + 3) // 4
        self.assertFalse(d.plugin_state[end:].any())


    def test_numbers_that_were_changed_are_refused(self):
        # A stale wrench would act, and a wrench that is not finite would reset MuJoCo.
        m = ball_on_ground("0 0 0.0995", mu=0.3)
        d = mujoco.MjData(m)
        mujoco.mj_step(m, d, 50)
        saved = full_state(m, d)
        mujoco.mj_step(m, d)
        whole = d.qpos.copy()
        for place in range(9 + 12):
            for change in (1.0, np.nan, 1000.0):
                for data in (d, mujoco.MjData(m)):
                    mujoco.mj_setState(m, data, saved, FULL)
                    data.plugin_state[place] += change
                    mujoco.mj_step(m, data)
                    self.assertEqual(data.sensordata[2], 10, f"number {place}: it is taken")
                    self.assertEqual(data.sensordata[0], 0, f"number {place}: contact acts")
                    self.assertTrue(np.isfinite(data.qpos).all())
        mujoco.mj_setState(m, d, saved, FULL)
        mujoco.mj_step(m, d)
        self.assertTrue((d.qpos == whole).all(), "what was refused can be set right")


class RestOfData(unittest.TestCase):
    def test_a_step_leaves_mujocos_own_arrays_as_they_are(self):
        # The commit needs kinematics of the new state; MuJoCo's values for the old one are restored afterwards.
        # Compared with the same body without the plugin, far from everything.
        arm = "<body name='arm' pos='3 0 0'><joint type='hinge' axis='0 1 0'/><geom size='.1 .2' type='capsule' pos='.3 0 0'/>" \
               "<site name='tip' pos='.5 0 0'/><camera pos='.5 0 1'/><light pos='.5 0 2'/><body pos='.4 0 0'><joint type='ball' pos='0 .1 0'/><geom size='.05' pos='0 0 .3'/></body></body>"
        inside = instance("ball = text1; ground = text2", bodies="ground = world", text1=ball_model(), text2=GROUND)
        body = FREE.format(place="0 0 9", mass=1.0, i=0.004) + arm
        for integrator in INTEGRATORS:
            with self.subTest(integrator=integrator):
                text = mjcf(body, inside, integrator)
                begin, end = text.index("<extension>"), text.index("</extension>") + len("</extension>")
                with_plugin = mujoco.MjModel.from_xml_string(text)
                without = mujoco.MjModel.from_xml_string(text[:begin] + text[end:])
                datas = []
                for m in (with_plugin, without):
                    d = mujoco.MjData(m)
                    d.qvel[:] = np.linspace(0.1, 1.0, m.nv)
                    mujoco.mj_step(m, d, 20)
                    datas.append(d)
                # MuJoCo computes these two before any sensor plugin that needs velocities.
                left_out = {"buffer", "arena", "plugin", "plugin_data", "plugin_state", "subtree_linvel", "subtree_angmom"}
                compared = 0
                for name in dir(datas[0]):
                    first, second = (getattr(d, name, None) for d in datas)
                    if isinstance(first, np.ndarray) and name not in left_out:
                        compared += 1
                        self.assertTrue(first.tobytes() == second.tobytes(), name)
                self.assertGreater(compared, 80)

    def test_derivatives_by_finite_differences(self):
        # mjd_transitionFD against differences of whole steps by hand, at rest in contact.
        m = ball_on_ground("0 0 0.0995", damping=30.0)
        d = mujoco.MjData(m)
        mujoco.mj_step(m, d, 200)
        state, eps = full_state(m, d), 1e-6
        a = np.zeros((2 * m.nv, 2 * m.nv))
        mujoco.mjd_transitionFD(m, d, eps, True, a, None, None, None)
        self.assertTrue(full_state(m, d).tobytes() == state.tobytes())

        def after(place, speed):
            other = mujoco.MjData(m)
            mujoco.mj_setState(m, other, state, FULL)
            other.qpos[2] += place
            other.qvel[2] += speed
            mujoco.mj_step(m, other)
            return np.array([other.qpos[2], other.qvel[2]])

        by_place = (after(eps, 0) - after(-eps, 0)) / (2 * eps)
        by_speed = (after(0, eps) - after(0, -eps)) / (2 * eps)
        nv = m.nv
        np.testing.assert_allclose([a[2, 2], a[nv + 2, 2]], by_place, rtol=1e-7)
        np.testing.assert_allclose([a[2, nv + 2], a[nv + 2, nv + 2]], by_speed, rtol=1e-7)


if __name__ == "__main__":
    unittest.main()

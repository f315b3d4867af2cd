"""Refusals give the thing, the cause and the cure through MuJoCo's own channel, and leave nothing half done."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import mujoco
import numpy as np
from support import FREE, GROUND, PLUGIN, assert_same_bits, ball_model, ball_on_ground, full_state, instance, mjcf, run

BALL = FREE.format(place="0 0 0.3", mass=1.0, i=0.004)
TEXTS = {"text1": ball_model(), "text2": GROUND}


class Compiling(unittest.TestCase):
    def refused(self, instances, *expected, bodies=BALL, flags=""):
        with self.assertRaises(ValueError) as caught:
            mujoco.MjModel.from_xml_string(mjcf(bodies, instances, flags=flags))
        said = str(caught.exception)
        self.assertLess(len(said), 500, "MuJoCo cuts longer messages")
        for text in ("pong.contact, instance `c", *expected):
            self.assertIn(text, said)

    def test_a_body_that_is_not_there(self):
        inside = instance("ball = text1; ground = text2", bodies="ground = flor", **TEXTS)
        self.refused(inside, "`ground`", "`flor`, which is not in the model", "`ground = BODY`")

    def test_a_body_with_the_prefix_of_an_attached_model(self):
        inside = instance("ball = text1; ground = text2", bodies="ground = world", prefix="left_", **TEXTS)
        self.refused(inside, "`left_ball`, which is not in the model", "`prefix`")

    def test_a_group_that_is_not_there(self):
        inside = instance("ball = text1; ground = text2", bodies="grund = world", **TEXTS)
        self.refused(inside, "no movable group `grund`", "`ball`, `ground`")

    def test_a_group_twice(self):
        inside = instance("ball = text1; ground = text2", bodies="ground = world; ground = ball", **TEXTS)
        self.refused(inside, "`ground` is there twice")

    def test_two_instances_of_one_pair(self):
        one = instance("ball = text1; ground = text2", bodies="ground = world", **TEXTS)
        other = instance("floor = text1; bullet = text2", "c2", bodies="floor = world; bullet = ball", text1=GROUND, text2=ball_model())
        self.refused(one + other, "instance `c2`", "`floor, bullet` is the pair `ball, ground` of the instance `c`", "act twice")

    def test_one_pair_twice_in_an_instance(self):
        inside = instance("ball = text1; ground = text2", bodies="ground = world", pairs="ball, ground; ground, ball", **TEXTS)
        self.refused(inside, "key `pairs`", "`ball`", "`ground`")

    def test_two_objects_that_are_one(self):
        inside = instance("ball = text1; b = text1; ground = text2", bodies="ground = world; b = ball",
                          pairs="ball, ground; b, ground", **TEXTS)
        self.refused(inside, "`b, ground` is the pair `ball, ground`")

    def test_two_objects_of_one_model_whose_groups_are_other_bodies(self):
        """Both roots are attached to the world; the movable groups decide whether they are the same."""
        arm = """(format: "pong-model", version: 1, name: "arm", surfaces: { "rubber": (stiffness: 1e4) }, root: (name: "arm",
            surface: "rubber", groups: [(name: "tip", movable: true, primitives: [Sphere(name: "s", center: (0, 0, 0), radius: 0.1)])]))"""
        bodies = "".join(BALL.replace('ball', name) for name in ("a/tip", "b/tip"))

        def two(b_tip):
            return instance("a = text1; b = text1; ground = text2", pairs="a, ground; b, ground", text1=arm, text2=GROUND,
                            bodies=f"a = world; b = world; ground = world; b/tip = {b_tip}")

        m = mujoco.MjModel.from_xml_string(mjcf(bodies, two("b/tip")))
        self.assertEqual(m.nplugin, 1)
        with self.assertRaisesRegex(ValueError, "act twice"):
            mujoco.MjModel.from_xml_string(mjcf(bodies, two("a/tip")))

    def test_two_instances_of_different_contacts(self):
        one = instance("ball = text1; ground = text2", bodies="ground = world", **TEXTS)
        other = instance("ball = text1; ground = text2", "c2", bodies="ground = world", text1=ball_model(radius=0.2), text2=GROUND)
        m = mujoco.MjModel.from_xml_string(mjcf(BALL, one + other))
        self.assertEqual(m.nplugin, 2)

    def test_a_model_file_that_is_not_there(self):
        inside = instance("ball = nowhere.ron; ground = text2", bodies="ground = world", text2=GROUND)
        self.refused(inside, "nowhere.ron", f"working folder `{os.getcwd()}`", "absolute")
        inside = instance("ball = nowhere.ron; ground = text2", bodies="ground = world", text2=GROUND, dir="/some/folder")
        self.refused(inside, "/some/folder/nowhere.ron")
        inside = instance("ball = nowhere.ron; ground = text2", bodies="ground = world", text2=GROUND, dir="some/folder")
        self.refused(inside, "some/folder/nowhere.ron", f"working folder `{os.getcwd()}`")

    def test_a_faulty_model(self):
        faulty = ball_model().replace("radius: 0.1", "radius: -0.1")
        inside = instance("ball = text1; ground = text2", bodies="ground = world", text1=faulty, text2=GROUND)
        self.refused(inside, "text1", "radius")

    def test_a_model_with_many_faults_is_cut_at_a_line(self):
        sphere = 'Sphere(name: "shell", center: (0, 0, 0), radius: 0.1)'
        many = ", ".join(sphere.replace("shell", f"s{i}").replace("0.1", "-0.1") for i in range(20))
        faulty = ball_model().replace(sphere, many)
        self.assertIn("s19", faulty)
        inside = instance("ball = text1; ground = text2", bodies="ground = world", text1=faulty, text2=GROUND)
        self.refused(inside, "text1", "more lines: `pong check MODEL.ron` shows all")

    def test_a_text_that_is_missing(self):
        inside = instance("ball = text1; ground = text3", bodies="ground = world", **TEXTS)
        self.refused(inside, "names the model `text3`", "the key `text3` is missing or empty")

    def test_keys_that_cannot_be_read(self):
        rest = {"bodies": "ground = world", **TEXTS}
        self.refused(instance("ball text1", **rest), "`ball text1` is not of the form `FIRST = SECOND`")
        self.refused(instance("ball = ; ground = text2", **rest), "an empty side")
        self.refused(instance("", **rest), "the key `objects` is missing")
        self.refused(instance("a = text1; b = text1; ground = text2", **rest), "the key `pairs` is missing")
        for value in ("0", "-4", "many", "1e3", "70000"):
            self.refused(instance("ball = text1; ground = text2", contact_capacity=value, **rest), f"`{value}` is no whole number")
        self.refused(instance("ball = text1; ground = text2", check_step="yes", **rest), "none of `true`, `notes` and `false`")

    def test_a_key_that_there_is_not(self):
        with self.assertRaisesRegex(ValueError, "objekts"):
            mujoco.MjModel.from_xml_string(mjcf(BALL, instance("ball = text1; ground = text2", objekts="x", **TEXTS)))

    def test_surfaces_that_cannot_be_combined(self):
        inside = instance("ball = text1; ground = text2", bodies="ground = world", text1=ball_model(stiffness="inf"), text2=GROUND)
        self.refused(inside, "rigid")

    def test_after_a_refusal_all_goes_on(self):
        m = ball_on_ground()
        d = mujoco.MjData(m)
        before = run(m, mujoco.MjData(m), 200)
        for _ in range(20):
            with self.assertRaises(ValueError):
                mujoco.MjModel.from_xml_string(mjcf(BALL, instance("ball = text1; ground = nowhere.ron", text1=ball_model())))
        assert_same_bits(self, run(m, d, 200), before)


class Running(unittest.TestCase):
    """Warnings of a run go to MuJoCo's log; the test reads the file."""

    def warnings_of(self, program, plugin=PLUGIN, expect=0):
        prologue = "import mujoco, numpy as np; from support import *\n"
        with tempfile.TemporaryDirectory() as folder:
            environment = dict(os.environ, PLUGIN=plugin, PYTHONPATH=str(pathlib.Path(__file__).parent))
            done = subprocess.run([sys.executable, "-c", prologue + program], cwd=folder, env=environment, capture_output=True, text=True)
        self.assertEqual(done.returncode, expect, done.stderr)
        return done.stdout + done.stderr

    def test_the_limit_is_told_once_in_a_run(self):
        program = """
names = "abc"
bodies = "".join(FREE.format(place=f"{i} 0 .0995", mass=1, i=.004).replace("'ball'", f"'{n}'") for i, n in enumerate(names))
inside = instance("a = text1; b = text1; c = text1; ground = text2", bodies="ground = world", contact_capacity=2,
    pairs="a, ground; b, ground; c, ground", text1=ball_model(damping=50.), text2=GROUND)
m = mujoco.MjModel.from_xml_string(mjcf(bodies, inside, more=SENSOR))
d = mujoco.MjData(m)
for run_of_three in range(3):
    mujoco.mj_resetData(m, d)
    mujoco.mj_step(m, d, 50)
    assert d.sensordata[0] == 2 and d.sensordata[1] == 1 and d.sensordata[2] == 0, d.sensordata
"""
        said = self.warnings_of(program)
        self.assertEqual(said.count("3 contacts at once are more than contact_capacity allows"), 3)
        self.assertIn("Set contact_capacity to 3", said)

    def test_what_cannot_be_shared_is_told_by_its_cause(self):
        program = """
CELLS = 24
def place(i, j):
    up, around = .25 + 2.6 * j / CELLS, 2 * np.pi * i / CELLS
    return f"({.1995 * np.sin(up) * np.sin(around)},{.1995 * np.sin(up) * np.cos(around)},{-.1995 * np.cos(up)})"
vertices = ",".join(place(i, j) for j in range(CELLS + 1) for i in range(CELLS + 1))
corners = [j * (CELLS + 1) + i for j in range(CELLS) for i in range(CELLS)]
triangles = ",".join(f"({v},{v + 1},{v + CELLS + 2}),({v},{v + CELLS + 2},{v + CELLS + 1})" for v in corners)
shell = GROUND.replace('Plane(name: "floor", normal: (0, 0, 1), offset: 0)',
    f'TriangleMesh(name: "shell", vertices: [{vertices}], triangles: [{triangles}])')
for capacity in (1000, 40000):
    inside = instance("ball = text1; ground = text2", bodies="ground = world", contact_capacity=capacity, check_step="false",
        text1=ball_model(radius=.2), text2=shell)
    m = mujoco.MjModel.from_xml_string(mjcf(FREE.format(place="0 0 0", mass=1, i=.004), inside))
    mujoco.mj_step(m, mujoco.MjData(m), 1)
"""
        said = self.warnings_of(program)
        self.assertEqual(said.count("a ball touched one surface in more places than could be shared exactly"), 2, said)
        self.assertIn("Set contact_capacity to 2000", said)
        self.assertIn("contact_capacity can be 65536 at most", said)

    def test_tunnelling_is_told(self):
        program = """
m = ball_on_ground("0 0 .15")
m = mujoco.MjModel.from_xml_string(mjcf(FREE.format(place="0 0 .5", mass=1, i=.004), instance("ball = text1; wall = text2",
    bodies="wall = world", text1=ball_model(radius=.01), text2=GROUND.replace('Plane(name: "floor", normal: (0, 0, 1), offset: 0)',
    'Triangle(name: "sheet", vertices: ((-1, -1, 0), (1, -1, 0), (0, 1, 0)), thickness: 0.01)')), gravity="0 0 0", more=SENSOR))
d = mujoco.MjData(m)
d.qvel[2] = -300.0
mujoco.mj_step(m, d, 10)
assert d.qpos[2] < -1
"""
        self.assertEqual(self.warnings_of(program).count("went right through"), 1)

    def test_a_step_that_is_too_long(self):
        said = self.warnings_of("m = ball_on_ground(timestep=0.02, stiffness=1e5); [mujoco.MjData(m) for _ in range(3)]")
        self.assertIn("pong.contact, instance `c`", said)
        self.assertEqual(said.count("instance `c`"), 1, "once for all mjData")
        # 2·√(m/k) is 6.3 ms; the limit of the stages of RK4 is 2.8·√(m/k).
        for made in ("timestep=0.001", "timestep=0.008, integrator='RK4'", "timestep=0.008, check='false'"):
            said = self.warnings_of(f"ball_on_ground({made}, stiffness=1e5)")
            self.assertNotIn("pong.contact", said)

    def test_a_state_of_another_model(self):
        program = """
m = ball_on_ground("0 0 .0995", mu=.3); d = mujoco.MjData(m); mujoco.mj_step(m, d, 30); state = full_state(m, d)
other = ball_on_ground("0 0 .0995"); d = mujoco.MjData(other); mujoco.mj_step(other, d, 3)
mujoco.mj_setState(other, d, state, FULL); mujoco.mj_step(other, d, 2)
assert d.sensordata[2] == 10 and not d.sensordata[3:].any(), d.sensordata
mujoco.mj_resetData(other, d); mujoco.mj_step(other, d, 5)
assert d.sensordata[0] == 1 and d.sensordata[2] == 0, d.sensordata
"""
        self.assertEqual(self.warnings_of(program).count("was saved by a world that was built from other models"), 1)

    def test_numbers_that_are_no_state(self):
        program = """
m = ball_on_ground("0 0 .0995")
for bad in (np.nan, -1.0, 0.5, 1e300, 2.0**40):
    d = mujoco.MjData(m); mujoco.mj_step(m, d, 3); d.plugin_state[:] = bad
    mujoco.mj_step(m, d, 3)
    assert d.sensordata[2] == 10, d.sensordata
    d = mujoco.MjData(m); mujoco.mj_step(m, d, 3); d.plugin_state[20:] = bad; d.plugin_state[1] += 1
    mujoco.mj_step(m, d, 3)
    assert d.sensordata[2] == 10, d.sensordata
"""
        self.assertEqual(self.warnings_of(program).count("mj_resetData()"), 10)

    def test_more_movable_groups_than_were_compiled(self):
        program = """
import pathlib
pathlib.Path("ball.ron").write_text(ball_model())
with_arm = ball_model().replace("primitives: [", 'groups: [(name: "arm", movable: true, primitives: '
    '[Sphere(name: "s", center: (0, 0, 0), radius: 0.1)]), (name: "skin", primitives: [')[:-2] + ")]))"
inside = instance("ball = ball.ron; ground = text1", bodies="ground = world", text1=GROUND)
bodies = FREE.format(place="0 0 .3", mass=1, i=.004)
m = mujoco.MjModel.from_xml_string(mjcf(bodies + bodies.replace("'ball'", "'ball/arm'"), inside, more=SENSOR))
mujoco.MjData(m)
pathlib.Path("ball.ron").write_text(with_arm)
try:
    mujoco.MjData(m)
except mujoco.FatalError:
    print("refused")
"""
        said = self.warnings_of(program)
        self.assertIn("the model files are not those that this mjModel was compiled with", said)
        self.assertIn("refused", said)

    def test_sleep(self):
        # MuJoCo compiles as if sleep were disabled; creating an mjData fails.
        program = """
awake = FREE.format(place="0 0 .3", mass=1, i=.004).replace("<body ", "<body sleep='never' ")
inside = instance("ball = text1; ground = text2", bodies="ground = world", text1=ball_model(), text2=GROUND)
mujoco.MjData(mujoco.MjModel.from_xml_string(mjcf(awake, inside, flags="sleep='enable'")))
m = mujoco.MjModel.from_xml_string(mjcf(awake.replace("sleep='never'", ""), inside, flags="sleep='enable'"))
try:
    mujoco.MjData(m)
except mujoco.FatalError:
    print("refused")
"""
        said = self.warnings_of(program)
        self.assertEqual(said.count("`ball` may fall asleep"), 1)
        self.assertIn('write sleep="never"', said)
        self.assertIn("refused", said)

    def test_sleep_that_is_enabled_later(self):
        program = """
m = ball_on_ground("0 0 .0995"); d = mujoco.MjData(m); mujoco.mj_step(m, d, 3)
m.opt.enableflags |= mujoco.mjtEnableBit.mjENBL_SLEEP
mujoco.mj_step(m, d, 3)
assert d.sensordata[2] == 5 and not d.sensordata[3:].any()
"""
        self.assertEqual(self.warnings_of(program).count("sleep was enabled"), 1)

    def test_what_cannot_be_computed_applies_no_force_and_is_told_once(self):
        program = """
m = ball_on_ground("0 0 .0995"); d = mujoco.MjData(m); mujoco.mj_step(m, d, 3)
d.qvel[2] = -1e200
mujoco.mj_forward(m, d)
mujoco.mj_forward(m, d)
assert d.sensordata[2] == 7 and not d.sensordata[3:].any(), d.sensordata
"""
        said = self.warnings_of(program)
        self.assertEqual(said.count("no contact force in this step"), 1)

    def test_another_version_of_mujoco(self):
        other = pathlib.Path(PLUGIN).parent / "other_version" / "libpong_contact.so"
        said = self.warnings_of("ball_on_ground()", plugin=str(other), expect=1)
        self.assertIn("built for MuJoCo 3012001 and this is 4000000: it is not registered", said)
        self.assertIn("plugin pong.contact not found", said)


if __name__ == "__main__":
    unittest.main()

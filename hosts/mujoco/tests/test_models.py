"""Ways for a model to have contacts: inserted models, instances without a name, bodies that are welded or prescribed."""

import pathlib
import tempfile
import unittest

import mujoco
import numpy as np
from support import FREE, GROUND, SENSOR, ball_model, instance, mjcf

BALL = FREE.format(place="0 0 0.0995095", mass=1.0, i=0.004)
KEYS = {"bodies": "ground = world", "text1": ball_model(damping=100.0, mu=0.5, tangential_damping=100.0), "text2": GROUND}
OBJECTS = "ball = text1; ground = text2"


def settled(m, steps=500):
    d = mujoco.MjData(m)
    mujoco.mj_step(m, d, steps)
    return d


class Inserted(unittest.TestCase):
    def test_two_copies_of_a_model(self):
        # MuJoCo adds the prefix to names, not to configurations: the key `prefix` does that.
        parent = mujoco.MjSpec()
        for prefix, place in (("left_", [-1, 0, 0]), ("right_", [1, 0, 0])):
            child = mujoco.MjSpec.from_string(mjcf(BALL, instance(OBJECTS, prefix=prefix, **KEYS), more=SENSOR, timestep=2e-3))
            parent.attach(child, prefix=prefix, frame=parent.worldbody.add_frame(pos=place))
        d = settled(parent.compile())
        for prefix in ("left_", "right_"):
            self.assertAlmostEqual(d.sensor(prefix + "contact").data[5], 9.81, delta=1e-6)

    def test_a_model_without_a_sensor(self):
        parent = mujoco.MjSpec()
        text = mjcf(BALL.replace("<freejoint/>", "<plugin instance='c'/><freejoint/>"), instance(OBJECTS, prefix="in_", **KEYS),
                    timestep=2e-3)
        parent.attach(mujoco.MjSpec.from_string(text), prefix="in_", frame=parent.worldbody.add_frame())
        self.assertAlmostEqual(settled(parent.compile()).qpos[2], 0.1 - 9.81 / 2e4, delta=1e-6)

    def test_written_and_read_again(self):
        spec = mujoco.MjSpec.from_string(mjcf(BALL, instance(OBJECTS, **KEYS), more=SENSOR))
        first = settled(spec.compile())
        again = settled(mujoco.MjModel.from_xml_string(spec.to_xml()))
        self.assertTrue((first.qpos == again.qpos).all())
        self.assertEqual(again.sensordata[0], 1)

    def test_a_changed_file_counts_for_the_next_model_and_for_no_earlier_one(self):
        # All mjData of an mjModel have clones of one world.
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "ball.ron")
            text = mjcf(BALL, instance(f"ball = {file}; ground = text2", **KEYS), more=SENSOR, timestep=2e-3)
            depths = []
            kept = []
            for stiffness in (2e4, 4e4):
                file.write_text(ball_model(stiffness, damping=100.0, mu=0.5, tangential_damping=100.0))
                m = mujoco.MjModel.from_xml_string(text)
                kept.append((m, settled(m)))
                depths += [0.1 - settled(model).qpos[2] for model, _ in kept]
            for depth, stiffness in zip(depths, (2e4, 2e4, 4e4)):
                self.assertAlmostEqual(depth, 9.81 / stiffness, delta=1e-6)

    def test_an_instance_without_a_name(self):
        config = "".join(f"<config key='{key}' value='{value}'/>" for key, value in {"objects": OBJECTS, **KEYS}.items())
        more = f"<sensor><plugin name='contact' plugin='pong.contact'>{config}</plugin></sensor>"
        d = settled(mujoco.MjModel.from_xml_string(mjcf(BALL, "", more=more)))
        self.assertAlmostEqual(d.sensordata[5], 9.81, delta=1e-6)


class Filters(unittest.TestCase):
    # A ball with an arm that reaches deeper into the ground than the ball does.
    LANDER = """(format: "pong-model", version: 1, name: "lander", surfaces: { "rubber": (stiffness: 2e4, normal: Linear(damping: 100.0)) },
        root: (name: "lander", surface: "rubber", groups: [
            (name: "body", primitives: [Sphere(name: "shell", center: (0, 0, 0), radius: 0.1)]),
            (name: "arm", movable: true, primitives: [Point(name: "tip", position: (0, 0, -0.2))])]))"""
    BODIES = BALL.replace("'ball'", "'lander'").replace("</body>", """<body name='lander/arm'><joint type='slide' axis='1 0 0'
        range='-0.01 0.01' limited='true'/><inertial mass='0.1' pos='0 0 0' diaginertia='1e-3 1e-3 1e-3'/></body></body>""")

    def rest(self, **keys):
        inside = instance("lander = text1; ground = text2", bodies="ground = world", text1=self.LANDER, text2=GROUND, **keys)
        return settled(mujoco.MjModel.from_xml_string(mjcf(self.BODIES, inside, more=SENSOR)), 3000)

    def test_a_group_that_is_kept_apart_touches_nothing(self):
        self.assertAlmostEqual(self.rest(filters="lander/arm, ground").qpos[2], 0.1 - 1.1 * 9.81 / 2e4, delta=1e-6)
        self.assertGreater(self.rest().qpos[2], 0.15)

    def test_filters_that_lead_nowhere(self):
        for filters, words in (("lander/leg, ground", "lander/leg"), ("moon, ground", "moon"), ("ground", "FIRST , SECOND")):
            with self.assertRaisesRegex(ValueError, f"key `filters`.*{words}"):
                self.rest(filters=filters)


class Bodies(unittest.TestCase):
    def test_a_body_below_another(self):
        # The ball is welded to an arm on a hinge: the moment about the hinge is force times lever.
        body = """<body name='arm' pos='-1 0 0.1'><joint type='hinge' axis='0 1 0' damping='5'/>
            <inertial mass='0.5' pos='0.5 0 0' diaginertia='.01 .01 .01'/>
            <body name='ball' pos='1 0 0'><inertial mass='1' pos='0 0 0' diaginertia='.004 .004 .004'/></body></body>"""
        keys = {**KEYS, "text1": ball_model(damping=100.0)}
        d = settled(mujoco.MjModel.from_xml_string(mjcf(body, instance(OBJECTS, **keys), more=SENSOR)), 3000)
        # Weight of 1 kg at 1 m and 0.5 kg at 0.5 m, supported at 1 m.
        self.assertAlmostEqual(d.sensordata[5], 1.25 * 9.81, delta=1e-3)
        self.assertAlmostEqual(d.qfrc_passive[0], -1.25 * 9.81, delta=1e-2)

    def test_a_mocap_body_pushes(self):
        # A ball rests on a plate that the host holds and raises.
        plate = "<body name='ground' mocap='true'/>"
        m = mujoco.MjModel.from_xml_string(mjcf(BALL + plate, instance(OBJECTS, **{**KEYS, "bodies": ""}), more=SENSOR))
        d = settled(m)
        self.assertAlmostEqual(d.sensordata[5], 9.81, delta=1e-6)
        for _ in range(1000):
            d.mocap_pos[0, 2] += 1e-5
            mujoco.mj_step(m, d)
        mujoco.mj_step(m, d, 500)
        self.assertAlmostEqual(d.qpos[2], 0.01 + 0.1 - 9.81 / 2e4, delta=1e-6)

    def test_two_free_bodies_keep_their_momentum(self):
        text = mjcf(BALL + BALL.replace("name='ball'", "name='other'").replace("pos='0 0 0.0995095'", "pos='0.05 0.02 0.4'"),
                    instance("ball = text1; other = text1", text1=ball_model(damping=10.0, mu=0.3)), gravity="0 0 0", more=SENSOR)
        m = mujoco.MjModel.from_xml_string(text)
        d = mujoco.MjData(m)
        d.qvel[:] = 0.1, 0, 0, 1, 2, 3, 0, 0, -2, -3, 2, 1
        most = 0.0
        for _ in range(200):
            mujoco.mj_step(m, d)
            most = max(most, np.abs(d.sensordata[3:6]).max())
        self.assertGreater(most, 100.0)
        np.testing.assert_allclose(d.qvel[:3] + d.qvel[6:9], [0.1, 0, -2], atol=1e-12)
        # Angular momentum about the origin: spin along the axes of the world, and the path.
        spins = sum(0.004 * d.body(name).xmat.reshape(3, 3) @ d.qvel[at : at + 3] for name, at in (("ball", 3), ("other", 9)))
        paths = sum(np.cross(d.qpos[at : at + 3], d.qvel[v : v + 3]) for at, v in ((0, 0), (7, 6)))
        begin = 0.004 * np.array([-2, 4, 4]) + np.cross([0, 0, 0.0995095], [0.1, 0, 0]) + np.cross([0.05, 0.02, 0.4], [0, 0, -2])
        np.testing.assert_allclose(spins + paths, begin, atol=1e-4)


if __name__ == "__main__":
    unittest.main()

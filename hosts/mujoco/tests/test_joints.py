"""Stable step in the plugin's warning, which counts the joints of MuJoCo's model: compared with closed forms and with
MuJoCo's own matrices."""

import re
import unittest

import mujoco
import numpy as np
from support import GROUND, INTEGRATORS, instance, mjcf

STIFFNESS = 2e4
TIP = np.array([0.3, 0.1, -0.2])
LINK = f"""(format: "pong-model", version: 1, name: "link", surfaces: {{ "rubber": (stiffness: {STIFFNESS}) }},
    root: (name: "link", surface: "rubber", primitives: [Point(name: "tip", position: ({TIP[0]}, {TIP[1]}, {TIP[2]}))]))"""
MASS, CENTRE, MOMENTS = 2.0, np.array([0.1, 0.0, -0.05]), np.array([0.02, 0.03, 0.04])
INERTIAL = f"<inertial mass='{MASS}' pos='{CENTRE[0]} {CENTRE[1]} {CENTRE[2]}' diaginertia='{MOMENTS[0]} {MOMENTS[1]} {MOMENTS[2]}'/>"
cases = 0


def compiled(bodies, timestep=1.0, check="true", **options):
    """A model and its data, with the warnings of their creation."""
    global cases
    cases += 1  # what was told once is not told again
    inside = instance("link = text1; ground = text2", f"j{cases}", bodies="ground = world", text1=LINK, text2=GROUND, check_step=check)
    told = []
    mujoco.set_mju_user_warning(told.append)
    try:
        m = mujoco.MjModel.from_xml_string(mjcf(bodies, inside, timestep=timestep, **options))
        d = mujoco.MjData(m)
    finally:
        mujoco.set_mju_user_warning(None)
    return m, d, told


def told_mass(bodies, **options):
    """Least effective mass at the tip, from the step in the warning: 2·√(m/k), or 2.828·√(m/k) with the stages of RK4."""
    m, d, told = compiled(bodies, **options)
    step = float(re.search(r"the longest stable step is (\S+) s", told[0])[1])
    factor = 8 if m.opt.integrator == mujoco.mjtIntegrator.mjINT_RK4 else 4
    return m, d, step**2 * STIFFNESS / factor


def least_mass(m, d):
    """Least effective mass at the tip in the present pose, by MuJoCo's mass matrix and Jacobian."""
    mujoco.mj_forward(m, d)
    body, place = m.body("link").id, d.body("link").xpos + d.body("link").xmat.reshape(3, 3) @ TIP
    matrix, jacobian = np.zeros((m.nv, m.nv)), np.zeros((3, m.nv))
    mujoco.mj_fullM(m, d, matrix)
    mujoco.mj_jac(m, d, jacobian, None, place, body)
    return 1 / np.linalg.eigvalsh(jacobian @ np.linalg.solve(matrix, jacobian.T)).max()


def body(name, joint, inside="", pos="0 0 0", euler="0 0 0"):
    return f"<body name='{name}' pos='{pos}' euler='{euler}'>{joint}{INERTIAL}{inside}</body>"


class ClosedForms(unittest.TestCase):
    def test_a_hinge_on_the_world(self):
        anchor = np.array([0.05, 0.02, 0.1])
        joint = f"<joint type='hinge' axis='0 1 0' pos='{anchor[0]} {anchor[1]} {anchor[2]}'/>"
        arm, lever = (CENTRE - anchor)[[0, 2]], (TIP - anchor)[[0, 2]]
        expected = (MOMENTS[1] + MASS * arm @ arm) / (lever @ lever)
        for integrator in INTEGRATORS:
            with self.subTest(integrator):
                _, _, mass = told_mass(body("link", joint, euler="10 20 30"), integrator=integrator)
                self.assertAlmostEqual(mass / expected, 1.0, delta=2e-3)

    def test_a_slide_on_the_world(self):
        _, _, mass = told_mass(body("link", "<joint type='slide' axis='1 2 3'/>"))
        self.assertAlmostEqual(mass / MASS, 1.0, delta=2e-3)

    def test_a_free_body_and_what_is_welded_to_it(self):
        m, d, mass = told_mass(body("link", "<freejoint/>"))
        self.assertAlmostEqual(mass / least_mass(m, d), 1.0, delta=2e-3)
        # The group may be the welded body.
        m, d, mass = told_mass(body("base", "<freejoint/>", body("link", "", pos="0.2 0.1 0.3", euler="30 40 50")))
        self.assertAlmostEqual(mass / least_mass(m, d), 1.0, delta=2e-3)

    def test_the_step_below_the_limit_is_quiet(self):
        joint = "<joint type='slide' axis='0 0 1'/>"
        limit = 2 * np.sqrt(MASS / STIFFNESS)
        self.assertEqual(compiled(body("link", joint), timestep=0.99 * limit)[2], [])
        self.assertEqual(len(compiled(body("link", joint), timestep=1.01 * limit)[2]), 1)

    def test_a_changed_joint_is_another_model(self):
        m, _, mass = told_mass(body("link", "<joint type='hinge' axis='0 1 0'/>"))
        m.jnt_pos[0] = 0.0, 0.0, 0.1
        told = []
        mujoco.set_mju_user_warning(told.append)
        mujoco.MjData(m)
        mujoco.set_mju_user_warning(None)
        self.assertEqual(len(told), 1)


class Mechanisms(unittest.TestCase):
    @staticmethod
    def joint(random, name):
        axis, place = random.normal(size=3), random.uniform(-0.2, 0.2, 3)
        kind = random.choice(["hinge", "hinge", "slide", "ball"])
        limits = "range='-0.3 0.4' limited='true'" if kind == "slide" and random.random() < 0.8 else ""
        write = lambda numbers: " ".join(map(repr, map(float, numbers)))
        return f"<joint name='{name}' type='{kind}' axis='{write(axis)}' pos='{write(place)}' {limits}/>"

    def chain(self, random):
        """Bodies on joints below the world or a free base, some with a branch; the last is the link."""
        inside = body("link", self.joint(random, "j0"), pos="0.3 0 0.1", euler="20 -30 40")
        for number in range(1, random.integers(1, 4)):
            branch = body(f"s{number}", self.joint(random, f"s{number}"), pos="-0.2 0.1 0") if random.random() < 0.5 else ""
            inside = body(f"b{number}", self.joint(random, f"j{number}"), inside + branch, pos="0.1 0.2 0", euler="5 50 -60")
        return body("base", "<freejoint/>", inside) if random.random() < 0.5 else inside

    def test_no_pose_has_less_mass_than_is_told(self):
        random = np.random.default_rng(20261128)
        shares, gains = [], []
        for number in range(60):
            bodies = self.chain(random)
            m, d, told = told_mass(bodies)
            least = np.inf
            for _ in range(100):
                for joint in range(m.njnt):
                    at, kind = int(m.jnt_qposadr[joint]), mujoco.mjtJoint(m.jnt_type[joint])
                    if kind in (mujoco.mjtJoint.mjJNT_HINGE, mujoco.mjtJoint.mjJNT_SLIDE):
                        low, high = m.jnt_range[joint] if m.jnt_limited[joint] else (-3.0, 3.0)
                        d.qpos[at] = random.uniform(low, high)
                    else:
                        quat = random.normal(size=4)
                        at += 3 if kind == mujoco.mjtJoint.mjJNT_FREE else 0
                        d.qpos[at : at + 4] = quat / np.linalg.norm(quat)
                least = min(least, least_mass(m, d))
            self.assertLessEqual(told, least * 1.001, f"{number}: {bodies}")
            shares.append(told / least)
            free = told_mass(body("link", "<freejoint/>"))[2]
            self.assertGreaterEqual(told, free * 0.999)
            gains.append(told / free)
        print(f"joints: told mass over true, median {np.median(shares):.2f}, least {min(shares):.2f}; over free {np.median(gains):.2f}")
        self.assertGreater(np.median(shares), 0.4)


class Notes(unittest.TestCase):
    def test_springs_of_joints_are_noted_where_asked_for(self):
        # A spring of 1e5 N/m alone on 2 kg is stable up to 8.9 ms; with the contact's 2e4 N/m up to 8.2 ms.
        joint = "<joint type='slide' axis='0 0 1' stiffness='1e5'/>"
        for step, noted in ((8.0e-3, False), (8.4e-3, True)):
            _, _, told = compiled(body("link", joint), timestep=step, check="notes")
            self.assertEqual(bool(told), noted, told)
        self.assertEqual(compiled(body("link", joint), timestep=8.4e-3)[2], [], "warnings alone")

    def test_dampers_count_where_they_are_explicit(self):
        joint = "<joint type='slide' axis='0 0 1' damping='900'/>"
        for integrator, noted in (("Euler", False), ("implicitfast", False), ("RK4", True)):
            _, _, told = compiled(body("link", joint), timestep=8e-3, check="notes", integrator=integrator)
            self.assertEqual(bool(told), noted, f"{integrator} {told}")


if __name__ == "__main__":
    unittest.main()

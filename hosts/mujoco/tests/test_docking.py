"""The docking of models/idss_docking in MuJoCo and in the executive behind `pong run`."""

import csv
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import mujoco
import numpy as np
from support import FREE, GROUND, PONG, ROOT, SENSOR, ball_model, docking, instance, mjcf

DOCKING = pathlib.Path(__file__).resolve().parents[1] / "docking"
COLUMNS = ("x_m", "y_m", "z_m", "qw", "qx", "qy", "qz", "vx_m_per_s", "vy_m_per_s", "vz_m_per_s")


def run_scene(text, folder, models):
    """States written by `pong run`: {step: {body: numbers}}, with the step of the scene."""
    scene = pathlib.Path(folder) / "scene.ron"
    scene.write_text(re.sub(r'": "(idss_\w+\.ron)"', lambda found: f'": "{models}/{found[1]}"', text))
    subprocess.run([PONG, "run", "--quiet", "--csv", "-o", folder, scene], check=True, stderr=subprocess.DEVNULL)
    step = float(re.search(r"\n\s*step: ([0-9.e-]+)", text)[1])
    rows = {}
    with open(pathlib.Path(folder) / "states.csv", newline="") as file:
        for row in csv.DictReader(file):
            at = rows.setdefault(round(float(row["time_s"]) / step), {})
            at[row["body"]] = np.array([float(row[column]) for column in COLUMNS])
    return rows


def states_of(m, d, names):
    mujoco.mj_kinematics(m, d)
    mujoco.mj_comPos(m, d)
    mujoco.mj_comVel(m, d)
    velocity = np.empty(6)
    for name in names:
        body = d.body(name)
        mujoco.mj_objectVelocity(m, d, mujoco.mjtObj.mjOBJ_XBODY, body.id, velocity, 0)
        quaternion = body.xquat if body.xquat[np.argmax(np.abs(body.xquat))] > 0 else -body.xquat
        yield name, np.concatenate([body.xpos, quaternion, velocity[3:]])


def deviations(m, d, rows):
    """(step, largest difference of positions and quaternions, of velocities) for the steps that the executive recorded."""
    for step in range(max(rows) + 1):
        if step in rows:
            worst = np.zeros(len(COLUMNS))
            for name, numbers in states_of(m, d, rows[step]):
                other = rows[step][name].copy()
                if other[3:7] @ numbers[3:7] < 0:
                    other[3:7] *= -1
                worst = np.maximum(worst, np.abs(numbers - other))
            yield step, worst[:7].max(), worst[7:].max()
        mujoco.mj_step(m, d)


class Docking(unittest.TestCase):
    def test_the_file_is_what_its_script_writes(self):
        subprocess.run([sys.executable, DOCKING / "build.py", "--check"], check=True)

    def test_as_the_executive_does(self):
        # Equal to rounding in free flight and while the petals align the ring. When the first latch slips over its
        # striker, at 1.17 s, the two diverge by 1e-5 m, as does each from itself at half the step, because the event
        # lies within a step.
        text = (ROOT / "models/idss_docking/scene_soft_capture.ron").read_text()
        text = text.replace("duration: 8.0", "duration: 2.4")
        with tempfile.TemporaryDirectory() as folder:
            rows = run_scene(text, folder, ROOT / "models/idss_docking")
        m = docking()
        d = mujoco.MjData(m)
        mujoco.mj_resetDataKeyframe(m, d, 0)
        aligning, latching, contacts = 0.0, 0.0, 0
        for step, place, speed in deviations(m, d, rows):
            if step * m.opt.timestep < 1.16:
                aligning = max(aligning, place, speed)
                contacts += d.sensordata[0]
            latching = max(latching, place)
        print(f"docking beside pong run: {aligning:.1e} while it aligns, {latching:.1e} m at most")
        self.assertGreater(contacts, 20)
        self.assertLess(aligning, 1e-8)
        self.assertLess(latching, 1e-4)
        self.assertGreaterEqual(d.sensordata[0], 4)
        self.assertEqual(d.sensordata[1:3].tolist(), [0, 0])


class Ball(unittest.TestCase):
    def test_a_bouncing_and_spinning_ball_as_in_the_executive(self):
        # Contact, slip and stick. The Euler steps of the two are equal up to rounding; their Runge-Kutta steps differ
        # in the truncation error of the rotation.
        scene = """(format: "pong-scene", version: 1, name: "ball", models: { "ball": "ball.ron", "ground": "ground.ron" },
            objects: [(name: "ball", model: "ball", bodies: [(motion: Free, mass: 1.0, inertia: Diagonal(0.004, 0.004, 0.004),
                position: (0.0, 0.0, 0.15), linear_velocity: (1.0, 0.3, 0.0), angular_velocity: (3.0, -2.0, 5.0))]),
                (name: "ground", model: "ground", bodies: [(motion: Fixed)])],
            pairs: [("ball", "ground")], gravity: (0.0, 0.0, -9.81), integrator: INTEGRATOR,
            step: 2e-4, duration: 1.0, record_every: 5)"""
        surface = {"stiffness": 2e4, "damping": 20.0, "mu": 0.3, "tangential_damping": 2.0}
        for ours, theirs, allowed in (("RungeKutta4", "RK4", 1e-8), ("SemiImplicitEuler", "Euler", 1e-11)):
            with self.subTest(integrator=theirs), tempfile.TemporaryDirectory() as folder:
                (pathlib.Path(folder) / "ball.ron").write_text(ball_model(**surface))
                (pathlib.Path(folder) / "ground.ron").write_text(GROUND)
                rows = run_scene(scene.replace("INTEGRATOR", ours), folder, folder)
                body = FREE.format(place="0 0 0.15", mass=1.0, i=0.004)
                inside = instance("ball = ball.ron; ground = ground.ron", bodies="ground = world", dir=folder)
                m = mujoco.MjModel.from_xml_string(mjcf(body, inside, theirs, 2e-4, more=SENSOR))
                d = mujoco.MjData(m)
                d.qvel[:] = 1.0, 0.3, 0.0, 3.0, -2.0, 5.0
                for at in rows.values():
                    del at["ground"]
                worst = max(max(differences) for _, *differences in deviations(m, d, rows))
                print(f"ball beside pong run, {theirs}: {worst:.1e}")
                self.assertLess(worst, allowed)


if __name__ == "__main__":
    unittest.main()

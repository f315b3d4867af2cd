"""The ring on its six legs alone, the chaser held: kinematics, stiffness, a stuck leg."""

import dimensions as d
import mujoco
import numpy as np
import stewart
from kit import mjcf
from kit.rows import Row

LAW = d.Impedance(1e3, 300.0)  # for the rig: settles soon


def model(level=d.ANALYSIS):
    text = (
        f'<mujoco><compiler angle="radian"/><option timestep="1e-3" integrator="Euler" gravity="0 0 0"/><worldbody>'
        f'<body name="chaser"><geom size="0.1" mass="1"/>{stewart.bodies()}{stewart.ring()}</body></worldbody>'
        f"{stewart.closures(level)}<actuator>{stewart.actuators()}</actuator></mujoco>"
    )
    made = mujoco.MjModel.from_xml_string(text)
    return made, mujoco.MjData(made)


def turned(vector):
    """Rotation matrix of a rotation vector."""
    quaternion, matrix = np.empty(4), np.empty(9)
    angle = np.linalg.norm(vector)
    mujoco.mju_axisAngle2Quat(quaternion, vector / angle if angle else np.array([1.0, 0, 0]), angle)
    mujoco.mju_quat2Mat(matrix, quaternion)
    return matrix.reshape(3, 3)


def random_poses(count, seed=1):
    random = np.random.default_rng(seed)
    for _ in range(count):
        yield stewart.NEUTRAL + random.uniform(-0.1, 0.1, 3), turned(random.uniform(-0.15, 0.15, 3))


def kinematics():
    """The closed form's joint angles and slides close all six loops in MuJoCo."""
    m, data = model()
    gap, rates = 0.0, 0.0
    for place, attitude in random_poses(50):
        stewart.set_pose(m, data, place, attitude)
        mujoco.mj_forward(m, data)
        gap = max(gap, np.abs(data.efc_pos[: 3 * stewart.LEGS]).max())
        rates = max(rates, _wrong_rates(m, data, place, attitude))
    yield Row("50 random poses: joints of the closed form leave open, at most", gap, 0.0, 1e-12, "m")
    yield Row("and J is the difference quotient of the legs", rates, 0.0, 1e-8)


def _wrong_rates(m, data, place, attitude, step=1e-5):
    """J compared with central differences of MuJoCo's distance between base and ring joints."""
    found = np.empty((stewart.LEGS, 6))
    for column in range(6):
        ends = []
        for side in (1, -1):
            moved = np.zeros(6)
            moved[column] = side * step
            stewart.set_pose(m, data, place + moved[:3], turned(moved[3:]) @ attitude)
            mujoco.mj_kinematics(m, data)
            ring = data.body("ring")
            tips = ring.xpos + stewart.ON_RING @ ring.xmat.reshape(3, 3).T
            ends.append([np.linalg.norm(tip - data.body(f"cylinder_{i}").xpos) for i, tip in enumerate(tips)])
        found[:, column] = (np.array(ends[0]) - np.array(ends[1])) / (2 * step)
    return np.abs(found - stewart.jacobian(place, attitude)).max()


def settled(wrench, laws, seconds=25.0):
    """Twist coordinates of the ring's equilibrium under a wrench about its origin."""
    m, data = model()
    stewart.command(m, data, np.zeros(stewart.LEGS), laws)
    data.xfrc_applied[m.body("ring").id] = wrench
    mujoco.mj_step(m, data, round(seconds / m.opt.timestep))
    place, attitude = stewart.pose(m, data)
    vector, quaternion = np.empty(3), mjcf.quaternion_of(attitude)
    mujoco.mju_quat2Vel(vector, quaternion, 1.0)
    return np.hstack([place - stewart.NEUTRAL, vector])


def stiffness():
    """Compliance from six small wrenches, compared with the inverse of JᵀKJ; the same with one leg stuck."""
    jacobian = stewart.jacobian()
    for label, laws in (("six legs", [LAW] * 6), ("one leg stuck", [d.STUCK] + [LAW] * 5)):
        springs = np.diag([law.stiffness for law in laws])
        predicted = np.linalg.inv(jacobian.T @ springs @ jacobian)
        measured = np.column_stack([settled(0.01 * unit, laws) / 0.01 for unit in np.eye(6)])
        # Each entry relative to the geometric mean of its two diagonals: metres and radians are mixed.
        scale = np.sqrt(np.outer(np.diag(predicted), np.diag(predicted)))
        yield Row(
            f"{label}: compliance against (JᵀKJ)⁻¹, greatest entry off",
            np.abs((measured - predicted) / scale).max(),
            0.0,
            1e-3,
        )


def rows():
    yield from kinematics()
    yield from stiffness()

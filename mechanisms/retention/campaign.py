"""Dispersed pulls by the arm at a latched truss: whether a joint stalls, and whether JᵀF is its torque then.

The claws have closed on the pins. Then the arm is told to move the tip, as in pull.py, until a joint stalls or the way of
the tip is over. The truss does not move, so that statics of the elastic arm (elastic.py) says at which way a joint
stalls. Cases within 5 % of that are counted apart: the rotors lag and swing. The servos are MuJoCo's own actuators
with the controller's law, and the integrator is semi-implicit Euler. All dispersions are chosen.
"""

import math

import elastic
import mujoco
import numpy as np
import pull
import rig
from dimensions import model
from kit.arm import Arm, kinematics
from kit.arm.dimensions import LINKS, READY, SERVO_DAMPING, SERVO_STIFFNESS, TORQUE
from kit.campaign import Study, Uniform

TICK = 0.01  # s: period of the controller
NEARLY, LATCHED = 0.02, 1.0  # rad from where claws are closed; s until they have and hold
DISPERSED = {
    "way": Uniform(0.010, 0.050),  # of the tip, m
    "aside": Uniform(-0.25, 0.25),  # of the pull, which goes aft, rad
    "up": Uniform(-0.25, 0.25),
    "friction": Uniform(0.7 * model.FRICTION, 1.3 * model.FRICTION),
    "mass": Uniform(0.9, 1.1),  # factor of the truss's
    **{f"motor_{link.name}": Uniform(0.6, 1.2) for link in LINKS},  # factors of their greatest torque
}


def direction(values):
    aside, up = values["aside"], values["up"]
    return np.array((math.cos(aside) * math.cos(up), math.sin(aside) * math.cos(up), math.sin(up)))


def limits(values):
    return np.array([TORQUE * values[f"motor_{link.name}"] for link in LINKS])


def begin(values):
    """The machine and its arm, whose servos are force-limited actuators."""
    made = rig.machine(pull.START, friction=values["friction"])
    made.model.opt.integrator = mujoco.mjtIntegrator.mjINT_EULER
    made.scale_mass("truss", values["mass"])
    mujoco.mj_setConst(made.model, made.data)
    rig.open_claws(made, NEARLY)  # the line above has put all joints to zero
    for name in rig.CLAWS:
        rig.drive(made, name, -1.0)
    arm, most = Arm(made, law=pull.STIFF), limits(values)
    arm.pose(READY)
    motors = made.model.actuator_gainprm[arm.motors], made.model.actuator_biasprm[arm.motors]
    made.model.actuator_biastype[arm.motors] = mujoco.mjtBias.mjBIAS_AFFINE
    motors[0][:, 0], motors[1][:, 1], motors[1][:, 2] = SERVO_STIFFNESS, -SERVO_STIFFNESS, -SERVO_DAMPING
    made.model.actuator_gainprm[arm.motors], made.model.actuator_biasprm[arm.motors] = motors
    made.model.actuator_ctrllimited[arm.motors], made.model.actuator_forcelimited[arm.motors] = 0, 1
    made.model.actuator_forcerange[arm.motors] = np.column_stack((-most, most))
    return made, arm


def asked(made, arm):
    """JᵀF: motor torques for the latches' wrench on the truss, transferred to the tip, N·m."""
    wrench, beside = made.wrench("truss"), made.place("truss") - made.place("tip")
    return arm.jacobian().T @ np.r_[wrench[:3], wrench[3:] + np.cross(beside, wrench[:3])]


def attempt(values):
    made, arm = begin(values)
    most, along, aim = limits(values), np.r_[direction(values), 0.0, 0.0, 0.0], np.array(READY)
    way, used, load, share = 0.0, 0.0, 0.0, math.nan
    made.data.ctrl[arm.motors] = aim
    made.stride(LATCHED)
    stood = made.place("truss")
    while way < values["way"] and used < 0.9999:
        rate = pull.RATE[0] * min(1.0, (made.time + TICK / 2 - LATCHED) / pull.RISE)
        speeds = kinematics.resolve(arm.jacobian(), rate * along, arm.law.damping)
        aim, way = aim + TICK * speeds, way + TICK * rate
        made.data.ctrl[arm.motors] = aim + SERVO_DAMPING / SERVO_STIFFNESS * speeds
        made.stride(TICK)
        given = np.abs(made.data.actuator_force[arm.motors]) / most
        used = float(given.max())
        load = max(load, float(np.linalg.norm(made.wrench("truss")[:3])))
    if used >= 0.9999:
        joint = int(given.argmax())
        share = abs(float(asked(made, arm)[joint])) / most[joint]
    return {
        "success": int(used < 0.9999),
        "margin": 1.0 - values["way"] / elastic.stalls_at(direction(values), most),
        "load": load,
        "share": share,
        "moved": float(np.linalg.norm(made.place("truss") - stood)),
        "tunnelled": int(made.tunnelled),
    }


STUDY = Study(
    "retention",
    DISPERSED,
    attempt,
    {
        "load": ("greatest force of the arm against the latches", "N", 1.0),
        "share": ("JᵀF of the joint that stalls, over its torque", "", 1.0),
        "moved": ("way of the truss while it is pulled", "mm", 1e3),
    },
    success="without a stall",
    band=0.05,
)

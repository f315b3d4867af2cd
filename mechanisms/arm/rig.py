"""The arm on a turned base, with a ball at its tip, before a pad that is turned as well."""

import pathlib
import re

import numpy as np
from dimensions import PAD_STIFFNESS, TOOL_RADIUS

from kit import mjcf
from kit.arm import Arm, Law, body, kinematics
from kit.arm.dimensions import READY
from kit.machine import Machine

HERE = pathlib.Path(__file__).resolve().parent
BASE = (np.array([1.0, -2.0, 0.5]), kinematics.rotation(np.array([2.0, -1.0, 2.0]) / 3.0, 0.8))
TRAINING, ANALYSIS = 1e-3, 2.5e-4  # s


def model_text(name, stiffness=PAD_STIFFNESS):
    """A model file on one line, as the plugin requires, optionally with another stiffness of the pad."""
    lines = (HERE / f"{name}.ron").read_text(encoding="utf-8").splitlines()
    text = " ".join(line.strip() for line in lines if not line.lstrip().startswith("//"))
    return text if name != "pad" else re.sub(r"stiffness: [0-9.e]+", f"stiffness: {float(stiffness)!r}", text)


def standing(posture=READY):
    """Position and attitude of the tip in a posture."""
    return kinematics.forward(posture, *BASE)[2:]


def pad_pose(posture=READY, gap=0.002, tilt=0.3):
    """Pose of the pad's face: in front of the ball, tilted against the direction of the tool."""
    place, attitude = standing(posture)
    turned = attitude @ kinematics.rotation(np.array([0.6, 0.8, 0.0]), tilt)
    return place - (TOOL_RADIUS + gap) * turned[:, 2], turned


def machine(step=TRAINING, stiffness=PAD_STIFFNESS, gap=0.002, law=Law(), posture=READY, integrator="RK4"):
    """Returns the machine, its arm in that posture at rest with brakes on, and the normal of the pad."""
    arm = body(place=BASE[0], quaternion=kinematics.quaternion(BASE[1]), payload=_ball())
    where, turned = pad_pose(posture, gap)
    pad = (
        f'<body name="pad" pos="{mjcf.numbers(where)}" quat="{mjcf.numbers(kinematics.quaternion(turned))}">'
        '<geom type="box" size="0.4 0.4 0.02" pos="0 0 -0.02" mass="0" rgba="0.45 0.5 0.6 1"/></body>'
    )
    extension = mjcf.contact_instance(
        {"tool": "text1", "pad": "text2"},
        [("tool", "pad")],
        {"tool": arm.tip},
        [model_text("tool"), model_text("pad", stiffness)],
    )
    text = mjcf.model("arm", extension, arm.world + pad, arm.more, step, integrator)
    made = Machine(text, [arm.tip, "pad"])
    controller = Arm(made, law=law)
    controller.pose(posture)
    return made, controller, turned[:, 2]


def _ball():
    return f'<geom type="sphere" size="{TOOL_RADIUS:g}" mass="0" rgba="0.8 0.35 0.2 1"/>'

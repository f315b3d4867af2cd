"""The six legs that carry the soft-capture ring: closed forms of their geometry, and their MJCF.

Poses are those of the ring's frame (origin in the middle of its face) seen from the chaser. A leg turns about two axes at
its base (universal joint), slides along its third, and holds the ring at its end (spherical joint, closed by `connect`).
"""

import math

import dimensions as d
import numpy as np
from kit.mjcf import numbers, quaternion_of

LEGS = 6
UPRIGHT = np.eye(3)


def _joints(radius, height, middles, half_angle):
    return np.array([d.on_circle(radius, middle + side * half_angle, height) for middle, side in middles])


# Leg i runs from the base at 0 + 14° to the ring at 60 − 20°, and so on around.
BASE = _joints(
    d.BASE_RADIUS, d.BASE_HEIGHT, [(0, 1), (120, -1), (120, 1), (240, -1), (240, 1), (0, -1)], d.BASE_HALF_ANGLE
)
ON_RING = _joints(
    d.RING_JOINT_RADIUS,
    d.RING_JOINT_HEIGHT,
    [(60, -1), (60, 1), (180, -1), (180, 1), (300, -1), (300, 1)],
    d.RING_JOINT_HALF_ANGLE,
)
NEUTRAL = np.array([0.0, 0.0, d.EXTENDED])


def legs(place, turned=UPRIGHT):
    """Vectors from the base joints to the ring's joints: the inverse kinematics."""
    return place + ON_RING @ np.asarray(turned).T - BASE


AXES = legs(NEUTRAL) / np.linalg.norm(legs(NEUTRAL), axis=1)[:, None]
LENGTHS = np.linalg.norm(legs(NEUTRAL), axis=1)


def frames():
    """Frame of each leg in the neutral pose: columns are the two hinge axes and the slide."""
    made = []
    for axis, base in zip(AXES, BASE):
        radial = base * (1, 1, 0)
        first = np.cross(axis, radial)
        first /= np.linalg.norm(first)
        made.append(np.column_stack([first, np.cross(axis, first), axis]))
    return made


FRAMES = frames()


def joints(place, turned=UPRIGHT):
    """Two angles and the slide of each leg for a pose of the ring, in closed form."""
    answer = []
    for vector, frame, neutral in zip(legs(place, turned), FRAMES, LENGTHS):
        x, y, z = frame.T @ vector
        answer.append((math.atan2(-y, z), math.atan2(x, math.hypot(y, z)), float(np.linalg.norm(vector)) - neutral))
    return np.array(answer)


def slides(height):
    """Slides of the legs for a centred ring with its face at a height; all are equal."""
    return np.linalg.norm(legs(np.array([0.0, 0.0, height])), axis=1) - LENGTHS


def jacobian(place=NEUTRAL, turned=UPRIGHT):
    """Rates of the legs for a velocity of the ring's origin and an angular velocity, both along the chaser's axes."""
    vectors = legs(place, turned)
    units = vectors / np.linalg.norm(vectors, axis=1)[:, None]
    return np.hstack([units, np.cross(ON_RING @ np.asarray(turned).T, units)])


def bodies():
    """Bodies of the legs, in the chaser."""
    text = ""
    for i, (base, frame, length) in enumerate(zip(BASE, FRAMES, LENGTHS)):
        inertia = numbers(d.LEG_INERTIA)
        text += (
            f'<body name="cylinder_{i}" pos="{numbers(base)}" quat="{numbers(quaternion_of(frame))}">'
            f'<joint name="leg_{i}_a" axis="1 0 0"/><joint name="leg_{i}_b" axis="0 1 0"/>'
            f'<inertial pos="0 0 0.15" mass="{d.CYLINDER_MASS}" diaginertia="{inertia}"/>'
            '<geom type="cylinder" fromto="0 0 0 0 0 0.35" size="0.022" rgba="0.3 0.35 0.4 1"/>'
            f'<body name="rod_{i}" pos="0 0 {length:.15g}"><joint name="leg_{i}" type="slide" axis="0 0 1"/>'
            f'<inertial pos="0 0 -0.15" mass="{d.ROD_MASS}" diaginertia="{inertia}"/>'
            '<geom type="cylinder" fromto="0 0 -0.36 0 0 0" size="0.012" rgba="0.8 0.8 0.85 1"/></body></body>'
        )
    return text


def ring(inside=""):
    """The ring, free relative to the chaser except for its legs."""
    slides_ = "".join(
        f'<joint name="ring_{name}" type="slide" axis="{axis}"/>'
        for name, axis in (("x", "1 0 0"), ("y", "0 1 0"), ("z", "0 0 1"))
    )
    return (
        f'<body name="ring" pos="{numbers(NEUTRAL)}">{slides_}<joint name="ring_turn" type="ball"/>'
        f'<inertial pos="0 0 0" mass="{d.RING_MASS}" diaginertia="{numbers(d.RING_INERTIA)}"/>{inside}</body>'
    )


def closures(level):
    """`closure`: time constant of MuJoCo's soft constraint; 0.9999 is the hardest that it allows."""
    each = "".join(
        f'<connect name="leg_{i}" body1="rod_{i}" body2="ring" anchor="0 0 0" solref="{level.closure:g} 1" '
        'solimp="0.9999 0.9999 0.001"/>'
        for i in range(LEGS)
    )
    return f"<equality>{each}</equality>"


def actuators():
    """Force along each leg: stiffness·(commanded − slide) − damping·rate; `command` sets the three."""
    return "".join(
        f'<general name="leg_{i}" joint="leg_{i}" gaintype="fixed" gainprm="0" biastype="affine" biasprm="0 0 0"/>'
        for i in range(LEGS)
    )


def actuator_slice(model):
    """Slice of the six legs among the actuators."""
    first = model.actuator("leg_0").id
    return slice(first, first + LEGS)


def command(model, data, slides_, impedances):
    """Sets the law of each leg, one `Impedance` for each."""
    six = actuator_slice(model)
    stiffness = [law.stiffness for law in impedances]
    model.actuator_gainprm[six, 0] = stiffness
    model.actuator_biasprm[six, 1] = np.negative(stiffness)
    model.actuator_biasprm[six, 2] = [-law.damping for law in impedances]
    data.ctrl[six] = slides_


def set_pose(model, data, place, turned=UPRIGHT):
    """Sets ring and legs to the closed form's pose."""
    for name, value in zip("xyz", place - NEUTRAL):
        data.qpos[model.joint(f"ring_{name}").qposadr[0]] = value
    first = model.joint("ring_turn").qposadr[0]
    data.qpos[first : first + 4] = quaternion_of(turned)
    for i, (a, b, slide) in enumerate(joints(place, turned)):
        for name, value in ((f"leg_{i}_a", a), (f"leg_{i}_b", b), (f"leg_{i}", slide)):
            data.qpos[model.joint(name).qposadr[0]] = value


def pose(model, data):
    """Pose of the ring relative to the chaser: position of its origin and rotation matrix."""
    chaser, ring_ = data.body("chaser"), data.body("ring")
    frame = chaser.xmat.reshape(3, 3)
    return frame.T @ (ring_.xpos - chaser.xpos), frame.T @ ring_.xmat.reshape(3, 3)

"""The tripod on its ground, free or at the tip of the arm."""

import pathlib

import numpy as np
from dimensions import GRAVITY, HEIGHT, INERTIA, LEAN, MASS, RADIUS, REACH, STIFFNESS

from kit import mjcf
from kit.arm import Arm, Law, body, kinematics
from kit.arm.dimensions import READY
from kit.machine import Machine

HERE = pathlib.Path(__file__).resolve().parent
PLAIN = HERE.parents[1] / "models" / "tripod"  # of validation case V2, without damping
TRAINING, ANALYSIS = 1e-3, 1e-4  # s
FEET = np.array([[np.cos(a), np.sin(a)] for a in np.pi * (0.5 + 2.0 / 3.0 * np.arange(3))])  # directions
X, Z = np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0])


def made(text, more, step, folder, gravity, legs):
    """`legs`: True if each foot is a separate movable group, as in the models here."""
    feet = {f"tripod/foot_{i}": "tripod" for i in range(3)} if legs else {}
    extension = mjcf.contact_instance(
        {"tripod": "tripod.ron", "ground": "ground.ron"}, [("tripod", "ground")], feet, folder=str(folder)
    )
    carriers = ["tripod"] * (1 + len(feet)) + ["ground"]
    model = mjcf.model("tripod", extension, text, more, step, gravity=gravity)
    return Machine(model, carriers, ["tripod", *feet, "ground"])


def shape(height):
    """Visual geoms: three legs from the centre of mass, and feet."""
    legs = "".join(
        f'<geom type="capsule" size="0.015" fromto="0 0 {height:g} {RADIUS * x:.6f} {RADIUS * y:.6f} 0.015" mass="0" '
        f'rgba="0.8 0.6 0.3 1"/>'
        for x, y in FEET
    )
    return legs + f'<geom type="sphere" size="0.08" pos="0 0 {height:g}" mass="0" rgba="0.8 0.6 0.3 1"/>'


def floor(place, attitude):
    return (
        f'<body name="ground" pos="{mjcf.numbers(place)}" quat="{mjcf.numbers(kinematics.quaternion(attitude))}">'
        '<geom type="box" size="1.2 1.2 0.02" pos="0 0 -0.02" mass="0" rgba="0.5 0.55 0.5 1"/></body>'
    )


def free(step, slope=0.0, yaw=0.0, height=HEIGHT, sunk=True, plain=False):
    """Tripod on a slope that rises along the y of the ground, turned by `yaw` on it; in balance, or just touching."""
    attitude = kinematics.rotation(Z, 0.4) @ kinematics.rotation(X, slope)
    place = np.array([2.0, -1.0, 0.7])
    depth, tilt = balance(slope, height) if sunk else (0.0, 0.0)
    turned = attitude @ kinematics.rotation(X, tilt) @ kinematics.rotation(Z, yaw)
    text = (
        f'<body name="tripod" pos="{mjcf.numbers(place - depth * attitude[:, 2])}" '
        f'quat="{mjcf.numbers(kinematics.quaternion(turned))}"><freejoint/>'
        f'<inertial pos="0 0 {height:g}" mass="{MASS:g}" diaginertia="{mjcf.numbers(INERTIA)}"/>{shape(height)}</body>'
    )
    folder = PLAIN if plain else HERE
    return made(text + floor(place, attitude), "", step, folder, (0, 0, -GRAVITY), not plain), attitude


def balance(slope, height):
    """Depth of the middle of the feet in the ground, m, and their rotation about x, rad: statics."""
    weight = MASS * GRAVITY
    return weight * np.cos(slope) / (3 * STIFFNESS), height * weight * np.sin(slope) / (1.5 * STIFFNESS * RADIUS**2)


def loads(slope, yaw, height=HEIGHT):
    """Load of each foot on a slope, N: forces normal to it and moments about the middle of the feet."""
    weight = MASS * GRAVITY
    uphill = np.array([np.sin(yaw), np.cos(yaw)])  # in the frame of the tripod
    share = 2.0 * height * weight * np.sin(slope) / (3.0 * RADIUS)
    return weight * np.cos(slope) / 3.0 - share * (FEET @ uphill)


def feet(machine, normal):
    """The load of each foot along the normal of the ground, N."""
    return np.array([machine.on(f"tripod/foot_{i}")[:3] @ normal for i in range(3)])


def held(step, gap=0.005):
    """Tripod at the tip of the arm, `gap` before a slope that leans against its feet. The law has no dead band here."""
    place, attitude = kinematics.forward(READY)[2:]
    lean = kinematics.rotation(np.array([0.6, 0.8, 0.0]), LEAN)
    ground = place + attitude @ np.array([0.0, 0.0, -REACH - RADIUS * LEAN - gap])
    carried = f'<body name="tripod" pos="0 0 {-REACH:g}">{shape(REACH)}</body>'
    arm = body(payload=carried)
    machine = made(arm.world + floor(ground, attitude @ lean), arm.more, step, HERE, (0, 0, 0), True)
    controller = Arm(machine, law=Law(band=0.0, band_turn=0.0))
    controller.pose(READY)
    return machine, controller, (attitude @ lean)[:, 2]

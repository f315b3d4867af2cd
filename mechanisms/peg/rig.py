"""The peg on its wrist: soft across and about a centre of compliance, behind a feed along the hole."""

import pathlib

import numpy as np
from dimensions import (
    ACROSS,
    CHAMFER,
    DAMPED,
    FAR,
    HOLE,
    LENGTH,
    MASS,
    NEAR,
    OFFSET,
    RADIUS,
    SLOW,
    SLOWLY,
    SPEED,
    TILT,
    TURN,
)

from kit import mjcf
from kit.machine import Machine

HERE = pathlib.Path(__file__).resolve().parent
TRAINING, ANALYSIS = 1e-3, 2e-4  # s
STAND = ((0.5, -1.0, 0.3), (0.6, 0.48, -0.64, 0.0))  # place of the hole and how it is turned
ABOVE = CHAMFER + 0.002  # m, height of the tip at the start


def hole(place, quaternion):
    """Visual walls of the hole, cut open."""
    plates = "".join(
        f'<geom type="box" size="0.003 {HOLE * 0.27:.6f} 0.05" pos="{(HOLE + 0.003) * np.cos(a):.6f} '
        f'{(HOLE + 0.003) * np.sin(a):.6f} -0.05" euler="0 0 {a:.6f}" mass="0" rgba="0.5 0.55 0.6 0.6"/>'
        for a in np.arange(0.0, 4.2, np.pi / 6)
    )
    return f'<body name="hole" pos="{mjcf.numbers(place)}" quat="{mjcf.numbers(quaternion)}">{plates}</body>'


def shaft():
    return f'<geom name="shaft" type="cylinder" size="{RADIUS:g}" fromto="0 0 0 0 0 {LENGTH:g}" mass="0" rgba="0.8 0.6 0.3 1"/>'


def wrist(centre, offset=OFFSET, tilt=TILT, start=ABOVE, inside=""):
    """Bodies `slider` and `peg`, in a frame whose z points out of the hole; the tip begins at the height `start`."""
    lean = (np.cos(tilt / 2), 0.0, np.sin(tilt / 2), 0.0)
    turned = (offset + tilt * centre - np.sin(tilt) * centre, 0.0, start)
    damped = 2 * DAMPED * np.sqrt(ACROSS * MASS)
    inertia = MASS * (LENGTH**2 / 12 + centre**2)
    return (
        f'<body name="slider" pos="{mjcf.numbers(turned)}"><joint name="across" type="slide" axis="1 0 0" '
        f'stiffness="{ACROSS:g}" damping="{damped:g}"/>'
        '<inertial pos="0 0 0.2" mass="0.2" diaginertia="1e-3 1e-3 1e-3"/>'
        f'<body name="peg" quat="{mjcf.numbers(lean)}"><joint name="turn" axis="0 1 0" pos="0 0 {centre:g}" '
        f'stiffness="{TURN:g}" damping="{2 * DAMPED * np.sqrt(TURN * inertia):g}"/><inertial pos="0 0 {LENGTH / 2:g}" '
        f'mass="{MASS:g}" diaginertia="0.004 0.004 0.001"/>{shaft()}{inside}</body></body>'
    )


def extension():
    return mjcf.contact_instance({"hole": "hole.ron", "peg": "peg.ron"}, [("hole", "peg")], {}, folder=str(HERE))


def machine(centre, step, limit=2000.0, made=Machine):
    """Machine with a feed that pushes with at most `limit`, N. `made`: the class of machine, for other contacts."""
    feed = (
        f'<body name="stand" pos="{mjcf.numbers(STAND[0])}" quat="{mjcf.numbers(STAND[1])}"><body name="feed">'
        '<joint name="feed" type="slide" axis="0 0 -1"/><inertial pos="0 0 0.3" mass="2" diaginertia="0.01 0.01 0.01"/>'
        f"{wrist(centre)}</body></body>"
    )
    drive = (
        '<actuator><general name="feed" joint="feed" gaintype="fixed" gainprm="1e5" biastype="affine" '
        f'biasprm="0 -1e5 -2e3" forcelimited="true" forcerange="{-limit:g} {limit:g}"/></actuator>'
    )
    return made(mjcf.model("peg", extension(), hole(*STAND) + feed, drive, step), ["hole", "peg"])


def axes(machine):
    """Rotation matrix of the hole."""
    return machine.data.xmat[machine.model.body("hole").id].reshape(3, 3)


def height(machine):
    """Height of the tip over the end of the chamfer, m."""
    return float(axes(machine)[:, 2] @ (machine.place("peg") - machine.place("hole")))


def lean(machine):
    """Tilt of the peg to the axis of the hole, rad."""
    along = machine.data.xmat[machine.model.body("peg").id].reshape(3, 3)[:, 2]
    return float(np.arctan2(along @ axes(machine)[:, 0], along @ axes(machine)[:, 2]))


def resistance(machine):
    """Axial force of the hole on the peg, N."""
    return float(machine.wrench("peg")[:3] @ axes(machine)[:, 2])


def feed(machine):
    """Sets its aim; a stalled feed does not aim further than it can push."""
    time = machine.time
    aim = SLOW * min(time, SLOWLY) + SPEED * max(0.0, time - SLOWLY)
    machine.data.ctrl[0] = min(aim, machine.joint("feed") + 0.02)


CENTRES = {"near": NEAR, "far": FAR}

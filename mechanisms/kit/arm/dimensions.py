"""Dimensions of the arm: joints from the base to the tip, in the posture in which all angles are zero.

Public: P. K. Nguyen and P. C. Hughes, Teleoperation: from the space shuttle to the space station, Progress in
Astronautics and Aeronautics 161, 1994, as the public robot descriptions of the arm restate it (TraceableRobotModels,
Space ROS): offsets, axes, masses, inertias, torque and speed of a joint. Everything else is chosen, and said so.
"""

import math
from dataclasses import dataclass

HOUSING = (105.98, (12.13, 12.13, 3.061))  # kg, kg·m²: a joint with what is fixed to it, its long axis z


@dataclass(frozen=True)
class Link:
    name: str  # of its joint
    offset: tuple  # of this joint from the one before, m
    axis: tuple
    mass: float  # kg
    center: tuple  # of mass, from the joint, m (chosen: the middle of the part)
    inertia: (
        tuple  # about the centre of mass, kg·m² (public numbers; that they belong to the centre of mass is chosen)
    )


# End effectors have 1.0 m (chosen: the stretched arm is then 17.57 m from tip to tip, of which 17.6 m is public).
END = 1.0
TIP_MASS = 20.0  # kg, chosen: the part of the end effector beyond the force-moment sensor
LINKS = (
    Link("shoulder_roll", (0.0, 0.0, 0.0), (0, 0, 1), HOUSING[0], (0.12541, 0.0, -0.175), (12.13, 12.13, 3.061)),
    Link("shoulder_yaw", (0.25082, 0.0, -0.175), (1, 0, 0), HOUSING[0], (0.175, 0.0, -0.12541), HOUSING[1]),
    Link(
        "shoulder_pitch", (0.175, 0.0, -0.25082), (0, 0, 1), 314.88, (3.80582, 0.0, -0.175), (15.41, 2094.71, 2103.19)
    ),
    Link("elbow_pitch", (7.61164, 0.0, -0.6), (0, 0, 1), 279.20, (-3.80582, 0.0, -0.175), (9.522, 1966.28, 1966.28)),
    Link("wrist_pitch", (-7.61164, 0.0, -0.35), (0, 0, -1), HOUSING[0], (0.0, 0.0, -0.12541), HOUSING[1]),
    Link("wrist_yaw", (-0.175, 0.0, -0.25082), (1, 0, 0), HOUSING[0], (-0.12541, 0.0, -0.0875), HOUSING[1]),
    Link("wrist_roll", (-0.25082, 0.0, -0.175), (0, 0, 1), 243.66 - TIP_MASS, (0.0, 0.0, -0.5), (44.41, 44.41, 9.336)),
)
TIP = (0.0, 0.0, -END)  # from the last joint; the tool points along −z of the last link

TORQUE = 2332.0  # N·m, greatest of a joint's motor (public)
SPEED = math.radians(4.0)  # rad/s, greatest of a joint (public)

# Chosen, all of these. The rotor's inertia is that of 3e-4 kg·m² behind a gear of about 1800.
ROTOR = 1000.0  # kg·m², at the joint
GEAR_STIFFNESS = (1e6, 1e6, 1e6, 1e6, 5e5, 5e5, 5e5)  # N·m/rad between motor and link
GEAR_DAMPING = (2e4, 2e4, 2e4, 2e4, 2e3, 2e3, 2e3)  # N·m·s/rad
BRAKE_TORQUE = 3000.0  # N·m at which a brake slips
BRAKE_STIFFNESS = 1e7  # N·m/rad, while it holds
BRAKE_DAMPING = 1.4e5  # N·m·s/rad, while it holds: 0.7 of critical for the rotor
SERVO_STIFFNESS = 4e5  # N·m/rad, on the integral of the error of rate
SERVO_DAMPING = 2e5  # N·m·s/rad, on the error of rate

# A posture away from all singular ones, rad (chosen).
READY = tuple(math.radians(angle) for angle in (0.0, 35.0, 25.0, 110.0, 55.0, -20.0, 10.0))

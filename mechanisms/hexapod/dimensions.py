"""Dimensions of the hexapod: m, kg, s, N, rad. README.md says where each comes from.

x is ahead, y to the left, z up. The origin of the body lies in the plane of the six hips, at their middle.
"""

import math
import pathlib
from dataclasses import dataclass

HERE = pathlib.Path(__file__).resolve().parent

# --- kinematics: twice the size of OpenSHC's default hexapod (config/default.yaml) ---
SCALE = 2.0
HIPS = SCALE * 0.050  # radius of the circle of the hips
COXA, FEMUR, TIBIA = SCALE * 0.050, SCALE * 0.050, SCALE * 0.100  # from joint to joint, and to the middle of the foot
AZIMUTHS = tuple(map(math.radians, (30.0, 90.0, 150.0, -150.0, -90.0, -30.0)))  # of the legs, from ahead to the left
TRIPODS = ((0, 2, 4), (1, 3, 5))  # legs that swing together
STANCE = SCALE * 0.150  # radius of the circle of the feet
HEIGHT = SCALE * 0.100  # of the hips above the middles of the feet
LOW = 0.100  # the same, where the body shifts until it tips: a low body reaches further

# --- masses, chosen ---
BODY_MASS, BODY_SIZE = 4.0, (0.20, 0.20, 0.06)  # a box
COXA_MASS, FEMUR_MASS, TIBIA_MASS = 0.15, 0.15, 0.10  # rods
MASS = BODY_MASS + 6 * (COXA_MASS + FEMUR_MASS + TIBIA_MASS)
GRAVITY = 9.81

# --- servos, chosen: of the size of a strong hobby servo ---
SERVO_STIFFNESS, SERVO_DAMPING = 100.0, 2.0  # N·m/rad, N·m·s/rad
SERVO_TORQUE = 8.0  # greatest, N·m
ROTOR_INERTIA = 0.01  # as it is felt at the joint, kg·m²

# --- feet and ground, chosen ---
FOOT_RADIUS = 0.015
STIFFNESS, DAMPING = 2e4, 40.0  # of a foot on rigid ground: N/m, N·s/m
FRICTION, STICKING_DAMPING = 0.6, 20.0  # N·s/m of the bristle
TILE, TILE_HALF_WIDTH, CELL = 5.0, 1.0, 0.1  # of the terrain, which repeats in x; sides of its squares
# Waves of the terrain: amplitude, how many in a tile along x and along y (over its width), phase.
WAVES = ((0.020, 2, 1, 0.0), (0.012, 5, -1, 1.0), (0.008, 3, 3, 2.0), (0.006, 11, 2, 4.0))

# --- gait: frequency of OpenSHC's default; the rest chosen ---
PERIOD, STRIDE = 1.0, 0.16  # of a whole cycle; way of the body in it
DUTY = 0.6  # share of a period that a foot stands
LIFT = 0.050  # of a foot above where it stood
DEEPEST = 0.060  # that a foot feels for the ground below where it should be
TOUCH = 4.0  # N: a foot that bears more has touched
TICK = 2e-3  # of the controller


@dataclass(frozen=True)
class Level:
    step: float


TRAINING, ANALYSIS = Level(1e-3), Level(2.5e-4)

# Values of surfaces in model files (kit/parameters.py): file, surface, and the path of the value.
ON_SURFACES = {
    "STIFFNESS": [("foot.ron", "rubber", "stiffness")],
    "DAMPING": [("foot.ron", "rubber", "normal", "Linear", "damping")],
    "FRICTION": [("foot.ron", "rubber", "friction", "Bristle", "mu"), ("plane.ron", "rock", "friction", "Bristle", "mu")],
    "STICKING_DAMPING": [("foot.ron", "rubber", "friction", "Bristle", "damping")],
}

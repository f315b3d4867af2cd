"""Dimensions of the box, its rails, its connector and its gripper: m, kg, s, N, rad. All are chosen; README.md says why.

x is the way in, y to the left, z up. The rails begin at x = 0. The origin of the box is its middle.
"""

import math
import pathlib
from dataclasses import dataclass

HERE = pathlib.Path(__file__).resolve().parent
SIDES = {"left": 1, "right": -1}
LEVELS = {"upper": 1, "lower": -1}

# --- box and rails -------------------------------------------------------------------------------------------------------
LENGTH, WIDTH, HEIGHT = 0.190, 0.160, 0.070
CLEARANCE = 0.0005  # on each side, and above and below
GAP = WIDTH + 2 * CLEARANCE  # between the rails
ROUNDING = 0.004  # radius of the corners of the box, and of the mouths of the rails
BETWEEN = LENGTH - 2 * ROUNDING  # from the front corners to the rear ones
STOP = 0.220  # where the rails end
WALL = 0.020  # thickness of rails and of the back
LIP = 0.020  # by which a rail reaches above and below the box
FRICTION = 0.2
STIFFNESS, DAMPING = 1e6, 600.0  # of a corner on a rail: N/m, N·s/m
STICKING_DAMPING = 300.0  # N·s/m
RAMP = 2e-5  # depth over which damping sets in
MASS = 4.5
INERTIA = tuple(MASS / 12 * (a * a + b * b) for a, b in ((WIDTH, HEIGHT), (LENGTH, HEIGHT), (LENGTH, WIDTH)))

# --- connector: two pins on the front of the box, two sprung contacts between them ---------------------------------------
PIN_Y, PIN_RADIUS, PIN_LENGTH = 0.040, 0.004, 0.030
BORE_RADIUS, FUNNEL_RADIUS, FUNNEL_LENGTH = 0.0048, 0.008, 0.006  # the pins must be free while the rails lead
SPRING_Y = 0.020
SPRING_STROKE = 0.012
SPRING_STIFFNESS, SPRING_DAMPING = 2500.0, 20.0  # of each

# --- fixture: a cone on the rear of the box, held by two flat jaws that lie along lines of it ------------------------------------------------------
GRIP_FRICTION = 0.3
HALF_ANGLE = math.radians(8.0)
CONE_LENGTH, CONE_RADIUS = 0.040, 0.016  # radius at its root
GRIP_STIFFNESS, GRIP_DAMPING = 1e6, 600.0
JAW_MASS, JAW_ARMATURE = 0.3, 2.0  # kg: a jaw, and rotor and gear as felt there
JAW_STALL, JAW_SPEED = 150.0, 0.030  # N, m/s: of the motor of a jaw
TOOL_MASS = 10.0  # of the gripper on its wrist
JAW_OPEN = 0.010  # way of an open jaw
ABOUT_LIMIT = {"below": 0.97, "above": 1.03}  # tan of the half-angle over the friction, for the two trial fixtures

# --- arm: holds the box at a place on its rear, with compliance. Chosen. --------------------------------------------------
ARM_STIFFNESS, ARM_DAMPING = 2e4, 2e3  # along the way in: N/m, N·s/m
ARM_ACROSS = 20.0  # N·s/m: it gives way across
ARM_TURNING, ARM_TURNING_DAMPING = 100.0, 5.0  # N·m/rad, N·m·s/rad
ARM_FORCE = 120.0  # at most
ACCOMMODATION = 0.004  # rad/s of the wrist for each N·m
SPEED = 0.020  # m/s


def half_angle(trial):
    return HALF_ANGLE if trial == "nominal" else math.atan(ABOUT_LIMIT[trial] * GRIP_FRICTION)


TRIALS = ("nominal", *ABOUT_LIMIT)


@dataclass(frozen=True)
class Level:
    step: float


TRAINING, ANALYSIS = Level(1e-3), Level(2.5e-4)

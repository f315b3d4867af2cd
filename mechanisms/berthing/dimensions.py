"""Dimensions of the moving berthing mechanism: m, kg, s, N, rad. README.md says where each comes from.

Rings, guides, fittings, standoffs and the module are those of models/common_berthing, here `common`. Frames are its
frames: z runs out of the active half, and the height of the passive frame is the gap.
"""

import math
import pathlib
from dataclasses import dataclass

from kit.files import module_of

HERE = pathlib.Path(__file__).resolve().parent
COMMON = HERE.parent.parent / "models" / "common_berthing"

common = module_of(COMMON / "dimensions.py", "common_berthing_dimensions")

# --- latches: four-bar linkages in the plane (radius, z) of their azimuth. All chosen: no public number was found. ------
CRANK_PIVOT = (0.500, -0.040)  # on the ring; the motor turns the crank
FOLLOWER_PIVOT = (0.680, -0.137)
CRANK, COUPLER, FOLLOWER = 0.065, 0.085, 0.170  # lengths between pins
ROLLER_AT = (0.193, -0.028)  # on the coupler: along it from the crank's pin, and across
ROLLER_RADIUS = common.TIP_RADIUS
ROLLER_HALF_WIDTH = 0.015  # of the straight part, along the circumference
STOWED = -2.26  # angle of the crank above the outward direction; the latch closes as it grows
CRANK_MOST = 1.25  # where a latch that meets no fitting stops
CRANK_MASS, COUPLER_MASS, FOLLOWER_MASS = 0.6, 1.5, 1.2
ROLLER_FRICTION = 0.03  # of its bearing

# --- motors of the latches, as they are felt at the crank. Chosen. ------------------------------------------------------
STALL_TORQUE = 220.0  # N·m: about 2.5 kN at the roller
FREE_SPEED = 0.60  # rad/s
ROTOR_INERTIA = 2.0  # kg·m²: 8e-6 kg·m² behind a gear of 500
CAPTURE_SHARE = 0.10  # of the stall torque while the module is caught; standoffs then still carry it

# --- ready-to-latch indicators. Chosen, but for what `common` has. ------------------------------------------------------
PLUNGER_TIP_RADIUS = 0.010
PLUNGER_MASS = 0.5
PLUNGER_SPRING = common.PLUNGER_STIFFNESS
PLUNGER_SLIDE_DAMPING = 20.0  # N·s/m: 0.63 of critical
TIP_STIFFNESS, TIP_DAMPING = 5e4, 30.0  # of the tip on the fitting
PADDLE_HINGE_DAMPING = 0.05  # N·m·s/rad
READY_STROKE = 0.008  # of a plunger
READY_TURN = math.radians(8.0)  # of a paddle

# --- duckhead bumpers: a bill of 40 mm with round ends, where the models have a sphere. Chosen. --------------------------
BILL_HALF_WIDTH = 0.020

# --- standoffs: springs with little loss, so that they push the module off. Chosen. --------------------------------------
STANDOFF_DAMPING = 50.0  # N·s/m

# --- masses. Public, of low trust: 240 and 311 kg for active halves. ----------------------------------------------------
ACTIVE_MASSES = (240.0, 311.0)

# --- the arm, at the grapple point: springs and dampers of the models' arm. Chosen. ---------------------------------------
ARM_STIFFNESS = (4e3, 4e3, 4e3, 1.5e4, 1.5e4, 1.5e4)  # N/m, N·m/rad
ARM_DAMPING = (3.8e3, 3.8e3, 3.8e3, 3e4, 3e4, 3e4)
START_GAP = 0.120
APPROACH_SPEED = 0.020  # m/s
PUSHED_GAP = 0.030  # to which the arm is commanded; the guides stop the module earlier


@dataclass(frozen=True)
class Level:
    """Numerical resolution of the machine.

    `armature`: of the pins of coupler and follower, kg·m². It slows what the stiff closure of the loop has to hold.
    `closure`: time constant of that closure, s; MuJoCo wants two steps at least.
    """

    name: str
    step: float
    armature: float
    closure: float


TRAINING = Level("training", 1e-3, 0.20, 2e-3)
ANALYSIS = Level("analysis", 5e-4, 0.05, 1e-3)

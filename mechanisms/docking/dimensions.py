"""Dimensions of the docking mechanism, SI units and degrees. README.md says which are public and which are chosen."""

import math
import pathlib
import sys
from dataclasses import dataclass

from kit.files import module_of

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]


def _interface():
    """Dimensions of the two sides with their petals and latches: models/idss_docking."""
    sys.path.append(str(ROOT / "models"))
    return module_of(ROOT / "models/idss_docking/dimensions.py", "idss_dimensions")


IDSS = _interface()

# --- bodies: those of models/idss_docking/scenes.py -------------------------------------------------------------------
CHASER_MASS, CHASER_INERTIA, CHASER_CENTER = 12e3, (76e3, 76e3, 24e3), (0.0, 0.0, -4.5)
TARGET_MASS, TARGET_INERTIA, TARGET_CENTER = 420e3, (1.2e8, 1.2e8, 1.2e8), (0.0, 0.0, -20.0)
RING_MASS, RING_INERTIA = 57.0, (11.0, 11.0, 20.0)
LATCH_MASS, LATCH_INERTIA = 1.0, 1e-3
LATCH_STIFFNESS, LATCH_DAMPING = 600.0, 5.0  # along its slide
LATCH_PULL = 60.0  # N: of the solenoid that opens it
LATCH_STROKE = 0.050  # inwards
LATCH_STOP, LATCH_STOP_TIME = 0.0005, 0.004  # m outwards; s, time constant of MuJoCo's soft stop

# --- the six legs: chosen ---------------------------------------------------------------------------------------------
BASE_RADIUS, BASE_HEIGHT, BASE_HALF_ANGLE = 0.630, -0.350, 14.0
RING_JOINT_RADIUS, RING_JOINT_HEIGHT, RING_JOINT_HALF_ANGLE = 0.630, -0.030, 20.0
CYLINDER_MASS, ROD_MASS, LEG_INERTIA = 1.5, 1.0, (0.02, 0.02, 1e-3)


@dataclass(frozen=True)
class Impedance:
    """Impedance of each leg: N/m and N·s/m."""

    stiffness: float
    damping: float


CAPTURING = Impedance(400.0, 100.0)  # soft, so that the petals align the ring with the little energy there is
ATTENUATING = Impedance(1e3, 3e3)  # near critical for the chaser
ALIGNING = Impedance(2e4, 1.5e4)  # brings the ring back, and pulls the vehicles together
STUCK = Impedance(2e5, 2e3)  # a leg that does not move
RAMP = 2.0  # s from one impedance to the next

# --- hard capture: chosen, but for the number of hooks ----------------------------------------------------------------
HOOKS = 12
HARD_FACE = -IDSS.RING_HEIGHT  # of the passive side, behind the face of its soft-capture ring
FLANGE_RADII, FLANGE_THICKNESS = (0.680, 0.760), 0.030
HARD_PAD_RADIUS, HARD_PAD_STIFFNESS, HARD_PAD_DAMPING = 0.700, 2e7, 5e4  # twelve, each against a rigid flange
HOOK_PIVOT_RADIUS, HOOK_PIVOT_HEIGHT, HOOK_ARM, HOOK_HALF_WIDTH = 0.800, 0.030, 0.080, 0.015
HOOK_STIFFNESS, HOOK_DAMPING = 1e7, 2e4
HOOK_STALL, HOOK_FREE_SPEED = 2400.0, 0.8  # N·m, rad/s at the hook
HOOK_MASS, HOOK_ARMATURE = 2.0, 64.0  # kg; kg·m² of rotor and gear
HOOK_OPEN = 1.2  # rad from where its arm lies across the axis

# --- pushers: chosen --------------------------------------------------------------------------------------------------
PUSHERS, PUSHER_RADIUS, PUSHER_LENGTH, PUSHER_STIFFNESS = 3, 0.730, 0.080, 2e3

# Values of surfaces in model files (kit/parameters.py): file, surface, and the path of the value.
_ACTIVE = "mechanisms/docking/hard_active.ron"
ON_SURFACES = {
    "HARD_PAD_STIFFNESS": [(_ACTIVE, "pad", "stiffness")],
    "HARD_PAD_DAMPING": [(_ACTIVE, "pad", "normal", "Linear", "damping")],
    "HOOK_STIFFNESS": [(_ACTIVE, "hook", "stiffness")],
    "HOOK_DAMPING": [(_ACTIVE, "hook", "normal", "Linear", "damping")],
    "PUSHER_STIFFNESS": [(_ACTIVE, "pusher", "stiffness")],
}

# --- retraction -------------------------------------------------------------------------------------------------------
EXTENDED = IDSS.RING_EXTENSION
MATED = HARD_FACE  # height of the ring's face when the hard faces meet
SLOW_FROM = 0.012  # m above that: from here the ring goes slowly
PULLED_DEEPER = 0.020  # m below it: the legs hold the vehicles together by themselves
RETRACT_TIME, SLOW_TIME = 8.0, 6.0

# --- initial contact conditions of the docking standard, second hand --------------------------------------------------
CLOSING = (0.05, 0.10)  # m/s
LATERAL, LATERAL_RATE = 0.10, 0.04  # m, m/s
TILT, ROLL, RATE = math.radians(4.0), math.radians(4.0), math.radians(0.20)


@dataclass(frozen=True)
class Level:
    step: float
    integrator: str
    closure: float  # s: time constant of the closures of the legs


TRAINING = Level(1e-3, "Euler", 4e-3)
ANALYSIS = Level(2.5e-4, "RK4", 2e-3)


def on_circle(radius, azimuth, z=0.0):
    """Azimuth, degrees."""
    a = math.radians(azimuth)
    return (radius * math.cos(a), radius * math.sin(a), z)

"""Dimensions of the moving retention latches: m, kg, s, N, rad. README.md says where each comes from.

Latches and pins are those of models/payload_retention, here `model`; x is aft, y to starboard, z up. The arm is that of
kit/arm.
"""

import math
import pathlib

from kit.files import module_of

HERE = pathlib.Path(__file__).resolve().parent
MODEL = HERE.parent.parent / "models" / "payload_retention"

model = module_of(MODEL / "dimensions.py", "payload_retention_dimensions")

# --- truss ---------------------------------------------------------------------------------------------------------------
TRUSS_MASS = 14061.0
TRUSS_SIZE = (13.84, 4.97, 4.48)  # along x, y, z
TRUSS_INERTIA = tuple(TRUSS_MASS / 12 * (sum(s * s for s in TRUSS_SIZE) - own * own) for own in TRUSS_SIZE)

# --- motors of claws and keel jaws ----------------------------------------------------------------------------------------
CLAW_MASS, CLAW_ARMATURE = 15.0, 20.0  # kg; rotor and gear, kg·m²
CLAW_STALL, CLAW_FREE_SPEED = 170.0, 0.5  # N·m, rad/s
OPEN = math.radians(model.OPEN_DEG)
JAW_MASS, JAW_ARMATURE = 20.0, 2000.0  # kg
JAW_STALL, JAW_FREE_SPEED = 5000.0, 0.01  # N, m/s
JAW_TRAVEL = model.KEEL_OPEN_GAP - model.KEEL_CLOSED_GAP

TRAINING, ANALYSIS = 1e-3, 5e-4  # steps, s

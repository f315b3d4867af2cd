"""Dimensions of the moving pallet: m, kg, s, N, rad. README.md says where each comes from.

Pallet, wheels and rails are those of models/htv_pallet, here `model`; so are the frames: x is the way in, y to the left,
z up. New are the tie-downs and the arm.
"""

import pathlib
from dataclasses import dataclass

from kit.files import module_of

HERE = pathlib.Path(__file__).resolve().parent
MODEL = HERE.parent.parent / "models" / "htv_pallet"

model = module_of(MODEL / "dimensions.py", "htv_pallet_dimensions")
SIDES = {"left": 1, "right": -1}

# --- tie-downs: a hook on a hinge at each rear corner pulls a pin of the pallet inwards. All chosen. ----------------------
PIN_X, PIN_Y = -2.000, 1.100  # of the pins in the pallet
PIN_RADIUS = 0.020
LEVER = 0.150  # from the hook's hinge to the pin, across
HOOK_THICKNESS = 0.030
HOOK_HALF_HEIGHT = 0.040
HOOK_BEYOND = 0.030  # of the hook past the pin
HOOK_STIFFNESS, HOOK_DAMPING = 1e6, 3000.0  # where hook and pin meet: N/m, N·s/m
HOOK_MASS = 2.0
HOOK_ARMATURE = 2.0  # of rotor and gear, kg·m²
HOOK_STALL, HOOK_FREE_SPEED = 75.0, 0.6  # N·m, rad/s: 500 N on a pin
HOOK_OPEN = -1.4  # angle; 0 is square to the way in
HOOK_MOST = 0.2
FACE_X = model.SEATED_X + PIN_X - PIN_RADIUS  # of a closed hook: a pallet that just touches its stops touches it, too

# --- arm: a six-axis drive, compliant at the grapple fixture. Chosen, in the class of a long arm. -------------------------
FIXTURE = (-model.PALLET_LENGTH / 2, 0.0, 0.0)  # in the pallet
ARM_STIFFNESS = (5e3, 5e3, 5e3)  # N/m
ARM_DAMPING = (4e3, 4e3, 4e3)  # N·s/m
ARM_TURNING = (4e4, 4e4, 4e4)  # N·m/rad
ARM_TURNING_DAMPING = 2e4  # N·m·s/rad
ARM_FORCE, ARM_MOMENT = 1000.0, 3000.0  # greatest, N and N·m
ACCOMMODATION = 5e-6  # rad/s of the tip for each N·m beyond the dead band
DEAD_BAND = 20.0  # N·m


@dataclass(frozen=True)
class Level:
    step: float


TRAINING, ANALYSIS = Level(1e-3), Level(2.5e-4)

# Values of surfaces in model files (kit/parameters.py): file, surface, and the path of the value.
ON_SURFACES = {
    "HOOK_STIFFNESS": [("tie_downs.ron", "steel", "stiffness")],
    "HOOK_DAMPING": [("tie_downs.ron", "steel", "normal", "Linear", "damping")],
}

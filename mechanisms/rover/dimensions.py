"""Dimensions of the six-wheeled rover: m, kg, s, N, rad. README.md says where each comes from.

Wheels, tyres, grounds and gravity are those of models/rover, here `model`. x is ahead, y to the left, z up; the origin of
the chassis lies midway between the middle wheels, at the height of the axles.
"""

import math
import pathlib
import sys
from dataclasses import dataclass

from kit.files import module_of

HERE = pathlib.Path(__file__).resolve().parent
MODEL = HERE.parent.parent / "models" / "rover"


def _of_the_model(name):
    return module_of(MODEL / f"{name}.py", f"rover_{name}")


model = _of_the_model("dimensions")
SIDES = {"left": 1, "right": -1}

# --- rocker and bogie: the rocker bears the front wheel and the bogie, the bogie the middle and the rear wheel ------------
AXLE_X = {"front": model.WHEELBASE / 2, "middle": 0.0, "rear": -model.WHEELBASE / 2}
HALF_TRACK = model.TRACK / 2
BOGIE_X, BOGIE_Z = AXLE_X["rear"] / 2, 0.0  # pivot of the bogie on the rocker: even loads of middle and rear
ROCKER_Z = 0.250  # pivot of the rocker on the chassis, at x = 0: a third of the weight on the front wheels
ROCKER_MASS, BOGIE_MASS, STEER_MASS = 10.0, 6.0, model.HUB_MASS
GROSS_MASS = model.GROSS_MASS
CHASSIS_MASS = GROSS_MASS - 2 * (ROCKER_MASS + BOGIE_MASS) - 6 * (STEER_MASS + model.WHEEL_MASS)
# A chassis of another mass has the size of the one in the model, so that its moments grow with its mass.
CHASSIS_INERTIA = tuple(
    moment * CHASSIS_MASS / (CHASSIS_MASS + model.GROSS_MASS - GROSS_MASS) for moment in model.CHASSIS_INERTIA
)
CHASSIS_Z = 0.350  # of its centre of mass
PIVOT_DAMPING = 50.0  # of rockers and bogies, N·m·s/rad

# --- drive and steering ----------------------------------------------------------------------------------------------------
STALL_TORQUE = 30.0  # of each wheel's motor behind its gear, N·m
FREE_SPEED = 10000 * 2 * math.pi / 60 / 80  # rad/s at the wheel
ROTOR_INERTIA = 1.0  # as it is felt at the wheel, kg·m²
STEER_STIFFNESS, STEER_DAMPING = 2000.0, 150.0  # N·m/rad, N·m·s/rad
STEER_TORQUE = 150.0  # greatest

# --- tyres: the wheels of the rigs of models/rover ---------------------------------------------------------------------------
RIGID_RAMP = 1e-4  # m of depth in which damping sets in
OF_MODEL = "../../models/rover/"
TYRES = {
    "fine": OF_MODEL + "rig_balls.ron",
    "coarse": OF_MODEL + "rig_ellipsoid.ron",
    "drum": OF_MODEL + "rig_cylinder.ron",
    "rigid": "rigid_wheel.ron",
    "rigid drum": "rigid_drum.ron",
}


@dataclass(frozen=True)
class Level:
    tyre: str
    step: float


TRAINING, ANALYSIS = Level("coarse", 1e-3), Level("fine", 5e-4)
RIGID = Level("rigid", 1e-3)
DRUM, RIGID_DRUM = Level("drum", 1e-3), Level("rigid drum", 1e-3)


def _tyre_heights():
    """Height of the axle under the weight of one wheel of six, by tyre."""
    sys.modules["dimensions"], kept = model, sys.modules.get("dimensions")
    tyre = _of_the_model("tyre")
    sys.modules["dimensions"] = kept
    weight = GROSS_MASS * model.GRAVITY / 6
    one = round(tyre.CORNER_WEIGHT / (model.WHEEL_RADIUS - tyre.STATIC_HEIGHT), -1)
    soft, rigid = (model.WHEEL_RADIUS - weight / stiffness for stiffness in (one, model.RIGID_STIFFNESS))
    return {"fine": tyre.height_under(weight), "coarse": soft, "drum": soft, "rigid": rigid, "rigid drum": rigid}


AXLE_HEIGHT = _tyre_heights()

"""Dimensions of the attachment structure and its payload: m, kg, s, N, rad. README.md says where each comes from.

The frame is that of the platform: its origin is in the middle of the three pins when they are seated, z away from it.
"""

import math
import pathlib
from dataclasses import dataclass

HERE = pathlib.Path(__file__).resolve().parent

# --- payload ----------------------------------------------------------------------------------------------------------
MASS = 1258.0
SIZE = (1.85, 0.80, 1.00)  # along x, y, z
CENTER = (0.0, 0.0, 0.500)  # of mass, and of the body
DRAWN, DRAWN_Z = (1.20, 0.80, 0.60), 0.70  # shown only: shorter, so that vanes and claw are seen
INERTIA = tuple(MASS / 12 * (sum(s * s for s in SIZE) - own * own) for own in SIZE)

# --- three vanes: grooves along the radius, open away from the platform ---------------------------------------------------
AZIMUTHS = {f"vane_{i + 1}": math.radians(90.0 + 120.0 * i) for i in range(3)}
RADIUS = 0.400  # of the pins
PIN = 0.020  # radius of the ball of a pin
FLANK = math.radians(60.0)  # from the platform
OPENING = 0.050  # half of it, between the crests
CREST, BASE = 0.010, 0.010  # flat width of a crest; thickness below the root
HALF_LENGTH = 0.080
ROOT_Z = -PIN / math.cos(FLANK)
CREST_Z = ROOT_Z + OPENING * math.tan(FLANK)

# --- claw and capture bar ----------------------------------------------------------------------------------------------
BAR_Z, BAR_RADIUS, BAR_HALF = -0.060, 0.010, 0.030  # the bar lies along y
LEVER = 0.150  # from the hinge to the bar, along x
HINGE = (-LEVER, 0.0, BAR_Z + BAR_RADIUS)  # the face that pulls goes through the axis of the hinge
CLAW_HEEL, CLAW_REACH, CLAW_HALF_WIDTH, CLAW_THICKNESS = 0.020, 0.210, 0.045, 0.030
CLAW_MASS, CLAW_ARMATURE = 8.0, 40.0  # kg; rotor and gear, kg·m²
CLAW_STALL, CLAW_FREE_SPEED = 900.0, 0.25  # N·m, rad/s
OPEN = math.radians(70.0)
READY_Z = 0.030  # the claw closes when the bar is nearer to its seat than this

# --- surfaces: those of the platform; pins and bar are rigid ----------------------------------------------------------------
STIFFNESS, DAMPING, RAMP = 5e6, 6e4, 2e-4
FRICTION = 0.1


# --- arms: springs and dampers between a fixture and its commanded pose
# -------------------------------------------------------
@dataclass(frozen=True)
class Holder:
    """Stiffness along x, y, z in N/m and about them in N·m/rad, damping in N·s/m and N·m·s/rad."""

    name: str
    fixture: tuple
    stiffness: tuple
    damping: tuple


FIRST = Holder("first", (0.6, 0.0, 0.5), (5e3,) * 3 + (2e4,) * 3, (3.5e3,) * 3 + (4e3,) * 3)
SECOND = Holder("second", (-0.6, 0.0, 0.5), (8e3,) * 3 + (3e4,) * 3, (4.5e3,) * 3 + (5e3,) * 3)
# Guides along z and holds tilt; sideways and about z the payload only meets a damper.
LIMP = Holder("limp", CENTER, (0.0, 0.0, 5e3, 3e4, 3e4, 0.0), (500.0, 500.0, 3.5e3, 5e3, 5e3, 100.0))


@dataclass(frozen=True)
class Level:
    name: str
    step: float


TRAINING, ANALYSIS = Level("training", 1e-3), Level("analysis", 2.5e-4)

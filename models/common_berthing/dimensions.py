"""Dimensions of both halves of the berthing mechanism: m, kg, s, N. README.md says where each comes from.

z runs out of the active half into the passive one; both frames lie in the middle of the mating plane. Mated, they are
one. The gap is the height of the passive frame above the active one.
"""

import math

# --- rings -------------------------------------------------------------------------------------------------------------
RING_OUTER = 0.900
RING_INNER = 0.820
RING_MIDDLE = (RING_OUTER + RING_INNER) / 2

LATCH_AZIMUTHS = (0.0, 90.0, 180.0, 270.0)  # of latches, capture fittings and indicators
GUIDE_AZIMUTHS = (45.0, 135.0, 225.0, 315.0)  # of guides and bumpers
STANDOFF_AZIMUTHS = tuple(22.5 + 45.0 * i for i in range(8))  # of standoffs, stops and striker plates

# --- coarse alignment guides -----------------------------------------------------------------------------------------
FIN_HEIGHT = 0.100  # of a passive guide, towards the active side
FIN_STRAIGHT = 0.020  # of it, at the root
FIN_HALF_WIDTH = 0.060
FLARE_DEG = 30.0  # from the way in, of fins and posts alike
FIN_LEAN = 0.030  # by how much its inner face leans outwards at the tip
GUIDE_CLEARANCE = 0.002  # between the straight parts, each side
POST_FOOT = -0.030
POST_THROAT = 0.020  # where the flare of an active guide begins
POST_TOP = 0.090

# --- bumpers -----------------------------------------------------------------------------------------------------------
BUMPER_RADIUS = 0.015
BUMPER_CLEARANCE = 0.005
BUMPER_Z = 0.030

# --- standoffs, stops, striker plates ----------------------------------------------------------------------------------
STANDOFF_RADIUS = 0.845
STANDOFF_STROKE = 0.020
STANDOFF_SOCKET = 0.030  # how deep a plunger sits in its ring
STOP_RADIUS = 0.875
PLATE_HALF_WIDTH = 0.050
PLATE_THICKNESS = 0.020

# --- capture fittings and latches --------------------------------------------------------------------------------------
FITTING_INNER, FITTING_OUTER = 0.690, 0.800
FITTING_HALF_WIDTH = 0.040
FITTING_TOP, FITTING_BOTTOM = -0.005, -0.030  # in the passive frame; a latch pulls at the top
TIP_RADIUS = 0.012
STOWED_RADIUS, CLOSED_RADIUS = 0.655, 0.720  # where tips are, from the middle
STOWED_Z, REACH_Z = 0.0, 0.110
TIP_BITE = 1.2e-3  # by how much a closed tip would overlap its fitting if nothing gave way
CLOSED_Z = FITTING_TOP + TIP_RADIUS - TIP_BITE

# --- ready-to-latch indicators -------------------------------------------------------------------------------------------
PLUNGER_RADIUS = 0.770  # from the middle
PLUNGER_TIP_Z = 0.050
PLUNGER_LENGTH = 0.100
HINGE = (0.675, 0.0, -0.035)
PADDLE_LENGTH = 0.100
PADDLE_HALF_WIDTH = 0.020
PADDLE_DEG = 60.0  # above the mating plane
PADDLE_MASS = 0.2
PADDLE_SPRING = 3.2  # N·m/rad

# --- surfaces --------------------------------------------------------------------------------------------------------
RING_STIFFNESS = 2e7
GUIDE_STIFFNESS = 5e6
LATCH_STIFFNESS = 2e6
BUMPER_STIFFNESS = 1e5
STANDOFF_STIFFNESS = 1e4
PLUNGER_STIFFNESS = 500.0
PADDLE_STIFFNESS = 5e4
RING_DAMPING = 8e4
GUIDE_DAMPING = 3e4
LATCH_DAMPING = 2e4
BUMPER_DAMPING = 3e3
STANDOFF_DAMPING = 3e3
PLUNGER_DAMPING = 50.0
PADDLE_DAMPING = 30.0
STICKING_DAMPING = 5e3  # of guides, latches and ring, tangential
DAMPING_RAMP = 1e-4
FRICTION = 0.2
STANDOFF_FRICTION = 0.1
STANDOFF_STICKING = 200.0

# --- modules -----------------------------------------------------------------------------------------------------------
MODULE_MASS = 10e3
MODULE_INERTIA = (41e3, 41e3, 22e3)  # of an even cylinder of 4.2 × 6 m, kg·m²
MODULE_CENTER = (0.0, 0.0, 3.2)
GRAPPLE = (0.0, 2.1, 3.2)
RING_MASS = 200.0  # of a passive half by itself
RING_INERTIA = (75.0, 75.0, 148.0)  # of a thin hoop, kg·m²


def series(first, second=RING_STIFFNESS):
    """Stiffness of a pair of surfaces; the second is the passive half's."""
    return first * second / (first + second)


def radial(radius, azimuth_deg, z=0.0):
    a = math.radians(azimuth_deg)
    return (radius * math.cos(a), radius * math.sin(a), z)

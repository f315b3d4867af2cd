"""Dimensions of the rover and its ground: m, kg, s, N. README.md says where each comes from."""

GRAVITY = 1.62  # of the Moon, m/s²
SIDES = ((1, "left"), (-1, "right"))
ENDS = ((1, "front"), (-1, "rear"))

# --- vehicle -----------------------------------------------------------------------------------------------------------
WHEELBASE = 2.29
TRACK = 1.83
GROSS_MASS = 700.0  # 210 kg and a payload of 490 kg
WHEEL_MASS = 5.5
WHEEL_SPIN_INERTIA = 0.55  # about the axle, kg·m²
WHEEL_CROSS_INERTIA = 0.30
HUB_MASS = 10.0  # motor, gear, brake and half of the arms
HUB_INERTIA = (0.10, 0.15, 0.10)
CHASSIS_MASS = GROSS_MASS - 4 * (WHEEL_MASS + HUB_MASS)
CHASSIS_INERTIA = (150.0, 330.0, 400.0)
MASS_CENTER = (-0.12, 0.04, 0.35)  # of the chassis with payload, from the middle of the axles

# --- wheel -------------------------------------------------------------------------------------------------------------
WHEEL_RADIUS = 0.409
WHEEL_WIDTH = 0.23
BALLS = 36  # of the tyre, a ring
BALL_RADIUS = WHEEL_WIDTH / 2
RING_RADIUS = WHEEL_RADIUS - BALL_RADIUS
STOP_BALLS = 18  # of the bump stop within
STOP_RADIUS = 0.324
STOP_BALL_RADIUS = 0.080
HUB_RADIUS = 0.100

# --- suspension and axles ----------------------------------------------------------------------------------------------
CLEARANCE_LOST = 0.076  # under a payload of 490 kg: tyre and suspension together
SUSPENSION_STIFFNESS = 3850.0  # upright, per wheel: what the tyre leaves of the lost clearance
SUSPENSION_DAMPING = 500.0
ARM_STIFFNESS = 1e5  # of the arms along and across, N/m
ARM_DAMPING = 300.0
ARM_TURNING = (2e4, 2e4, 2e4)  # N·m/rad
ARM_TURNING_DAMPING = (40.0, 40.0, 40.0)
BEARING_HALF_SPAN = 0.100
BEARING_STIFFNESS = 2e5  # of each of two, N/m
BEARING_DAMPING = 400.0
BRAKE_STIFFNESS = 5e3  # of a wheel held by its brake, about the axle, N·m/rad
BRAKE_DAMPING = 20.0

# --- surfaces ----------------------------------------------------------------------------------------------------------
BALL_STIFFNESS = 1500.0  # of one ball, N/m
BALL_DAMPING = 20.0
BALL_BRISTLE = 3000.0
BALL_BRISTLE_DAMPING = 20.0
STOP_STIFFNESS = 2e4
STOP_DAMPING = 100.0
FRAME_STIFFNESS = 1e5  # of hubs and frame
FRAME_DAMPING = 500.0
FRICTION = 0.6
RIGID_STIFFNESS = 5e5  # of a wheel that hardly yields, for the step
RIGID_DAMPING = 1800.0
DAMPING_RAMP = 2e-3

# --- chassis -----------------------------------------------------------------------------------------------------------
FRAME_RADIUS = 0.050
FRAME_PITCH = 0.100  # from ball to ball
FRAME_X = 1.40
FRAME_Y = 0.50
FRAME_Z = 0.041  # above the axles: 0.356 m of clearance under load, as published


# --- terrain -----------------------------------------------------------------------------------------------------------
TERRAIN_X = (-4.0, 16.0)
TERRAIN_Y = (-4.0, 4.0)
CELL = 0.25
OCTAVES = ((6.0, 0.50), (2.0, 0.10), (0.75, 0.02))  # length, height over all
LANE_HALF_WIDTH = 1.5  # where the rover drives: no rock stands higher than LANE_ROCK there
LANE_ROCK = 0.16
ROCKS = 130
BOULDERS = 30


def _wheels():
    """Name -> position of the wheel's middle in the chassis."""
    places = {}
    for end, where in ENDS:
        for side, label in SIDES:
            places[f"{where}_{label}"] = (end * WHEELBASE / 2, side * TRACK / 2, 0.0)
    return places


WHEELS = _wheels()

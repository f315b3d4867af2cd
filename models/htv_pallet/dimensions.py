"""Dimensions of the pallet and its rails: m, kg, s, N. README.md says where each comes from."""

SIDES = ((1, "left"), (-1, "right"))

# --- pallet ----------------------------------------------------------------------------------------------------------
PALLET_LENGTH = 4.1
CHASSIS_HALF_WIDTH = 1.220
CHASSIS_HALF_HEIGHT = 0.100
PALLET_MASS = 1500.0  # with cargo
PALLET_INERTIA = (1641.0, 2763.0, 3081.0)  # of an even box of 4.1 × 2.8 × 2.3 m, kg·m²

MAIN_WHEEL_RADIUS = 0.040  # its axle across the pallet
MAIN_WHEEL_HALF_WIDTH = 0.018
MAIN_WHEEL_X = 1.320  # of the front pair; the rear pair is its mirror image
MAIN_WHEEL_Y = 1.340
SIDE_ROLLER_RADIUS = 0.030  # its axle upright
SIDE_ROLLER_HALF_WIDTH = 0.015
SIDE_ROLLER_X = 1.500
MAIN_WHEEL_MASS = 1.5
SIDE_ROLLER_MASS = 1.0
BEARING_HALF_SPAN = 0.020  # from the wheel's middle to each of its two bearings
BEARING_STIFFNESS = 5e5  # of each, N/m
BEARING_DAMPING = 250.0  # of each, N·s/m
BEARING_DRAG = 0.002  # about the axle, N·m·s/rad
AXIAL_SHARE = 0.5  # of the stiffness along the axle
SEIZED_STIFFNESS = 500.0  # of each bearing about the axle, N·m/rad, where a roller is seized
SEIZED_DAMPING = 0.5  # N·m·s/rad

BUMPER_RADIUS = 0.025
BUMPER_TIP_X = 2.070
BUMPER_Y = 1.100

# --- rails -----------------------------------------------------------------------------------------------------------
LATERAL_CLEARANCE = 0.004  # of the side rollers between the two webs, both sides together
VERTICAL_CLEARANCE = 0.003  # of a main wheel between the flanges
WEB_Y = 1.400
WEB_THICKNESS = 0.020
WEB_HALF_HEIGHT = 0.100
FLANGE_INNER_Y = 1.270
FLANGE_THICKNESS = 0.015
FLARE_LENGTH = 0.250
LATERAL_FLARE = 0.040
VERTICAL_FLARE = 0.025
STOP_X = 3.750
STOP_THICKNESS = 0.050
STOP_HALF_WIDTH = 0.080

SIDE_ROLLER_Y = WEB_Y - LATERAL_CLEARANCE / 2 - SIDE_ROLLER_RADIUS
SEATED_X = STOP_X - BUMPER_TIP_X  # of the pallet's origin when its bumpers touch

# --- surfaces --------------------------------------------------------------------------------------------------------
WHEEL_STIFFNESS = 1e6
WHEEL_DAMPING = 630.0
STEEL_STIFFNESS = 1e7
STEEL_DAMPING = 600.0
BUMPER_STIFFNESS = 2e5
BUMPER_DAMPING = 6000.0
DAMPING_RAMP = 2e-5
FRICTION = 0.2


def _wheels():
    """Name -> position of the axle's middle in the pallet."""
    places = {}
    for end, where in ((1, "front"), (-1, "rear")):
        for side, label in SIDES:
            places[f"wheel_{where}_{label}"] = (end * MAIN_WHEEL_X, side * MAIN_WHEEL_Y, 0.0)
            places[f"roller_{where}_{label}"] = (end * SIDE_ROLLER_X, side * SIDE_ROLLER_Y, 0.0)
    return places


WHEELS = _wheels()


def is_roller(name):
    return name.startswith("roller")


def wheel_radius(name):
    return SIDE_ROLLER_RADIUS if is_roller(name) else MAIN_WHEEL_RADIUS


def axle(name):
    """Axis of a wheel: 0, 1 or 2."""
    return 2 if is_roller(name) else 1


def wheel_half_width(name):
    return SIDE_ROLLER_HALF_WIDTH if is_roller(name) else MAIN_WHEEL_HALF_WIDTH


def wheel_mass(name):
    return SIDE_ROLLER_MASS if is_roller(name) else MAIN_WHEEL_MASS

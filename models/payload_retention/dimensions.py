"""Dimensions of the retention latches and the payload: m, kg, s, N. README.md says where each comes from.

x is aft, y to starboard, z up. The bay's origin lies midway between the four seated longeron trunnions; so does the
payload's: seated, both frames are one. A latch's own origin is the middle of its seated pin.
"""

import math

INCH = 0.0254

# --- positions of the latches ----------------------------------------------------------------------------------------
SILL_Y = 94 * INCH
KEEL_Z = (305 - 414) * INCH
BAY_AXIS_Z = (400 - 414) * INCH
STATION_X = 45 * 3.933 * INCH / 2  # of the aft latches; the forward ones are their mirror images

# name -> (x, side of the bay)
LATCHES = {
    "primary_port": (-STATION_X, -1),
    "primary_starboard": (-STATION_X, 1),
    "secondary_port": (STATION_X, -1),
    "secondary_starboard": (STATION_X, 1),
}

# --- pins ------------------------------------------------------------------------------------------------------------
PIN_RADIUS = 3.250 / 2 * INCH
KEEL_PIN_RADIUS = 3.00 / 2 * INCH
PIN_LENGTH = 9.5 * INCH  # beyond the scuff plate
SCUFF_FLAT_RADIUS = 11 * INCH
SCUFF_RADIUS = 14 * INCH  # with its flange, which is bent back by 45°
KEEL_PIN_END = 0.060  # from the middle of the keel latch to that of the pin's round end

# --- longeron latches ------------------------------------------------------------------------------------------------
PRIMARY_CLEARANCE = 0.0015  # between pin and socket, each side
SECONDARY_CLEARANCE = 0.013  # likewise: it holds upwards and downwards only
FLARE_DEG = 45.0  # of the guides, from the vertical
WALL_TOP = 0.012  # where a primary socket ends and its flare begins, above the pin's middle
GUIDE_HALF_WIDTH = 12 * INCH  # of the mouth, at the tips of the guides
GUIDE_BACK = 0.030  # thickness of a guide at its tip
FLOOR_THICKNESS = 0.050
SIDE_CLEARANCE = 0.025  # between scuff plate and guides, each side of the bay
INNER_Y = SILL_Y - PIN_LENGTH / 2 + SIDE_CLEARANCE  # inboard faces of the guides
GUIDE_HALF_DEPTH = SILL_Y - INNER_Y


def flare_z(x):
    """Height of the flare at a distance from the middle of the latch: one plane for primary and secondary latches."""
    return WALL_TOP + (x - PIN_RADIUS - PRIMARY_CLEARANCE) / math.tan(math.radians(FLARE_DEG))


TIP_Z = flare_z(GUIDE_HALF_WIDTH)

# --- claws -----------------------------------------------------------------------------------------------------------
HINGE_X, HINGE_Z = 0.085, 0.045
CLAW_REACH = 0.135  # from the hinge to the tip
CLAW_HEEL = 0.020  # from the hinge to where the face begins
CLAW_THICKNESS = 0.030
CLAW_HALF_WIDTH = 0.050
CLAW_BITE = 4e-4  # by how much a closed claw would overlap the seated pin
OPEN_DEG = 140.0

# --- keel latch ------------------------------------------------------------------------------------------------------
KEEL_OPEN_GAP = 0.012  # between pin and wall, each side, before the jaws close
KEEL_CLOSED_GAP = 2.5e-4
KEEL_WALL_TOP = 0.025  # above the middle of the latch
KEEL_MOUTH = 0.090  # by how much the flare widens the open gap, each side
KEEL_HALF_LENGTH = 0.120  # along x
KEEL_DEPTH = 0.120  # below the middle

# --- ready-to-latch plungers -------------------------------------------------------------------------------------------
PLUNGER_STROKE = 0.015  # by how much it stands out below a pin: too short to reach a flare that the pin slides on
PLUNGER_STIFFNESS = 500.0

# --- surfaces --------------------------------------------------------------------------------------------------------
STEEL_STIFFNESS = 2e7  # 1e7 where pin and latch meet
PIN_DAMPING = 1.9e5
PIN_STICKING_DAMPING = 5e4
PLUNGER_DAMPING = 5.0
DAMPING_RAMP = 1e-4
FRICTION = 0.2

PAIR_STIFFNESS = STEEL_STIFFNESS / 2
PRELOAD = PAIR_STIFFNESS * CLAW_BITE / 2  # claw and floor yield alike

# --- payload -----------------------------------------------------------------------------------------------------------
PAYLOAD_MASS = 10e3
PAYLOAD_INERTIA = (24.2e3, 46.2e3, 46.2e3)  # of an even cylinder of 4.4 × 6.4 m, kg·m²
MASS_CENTER = (0.0, 0.0, BAY_AXIS_Z)
GRAPPLE = (0.0, 0.0, BAY_AXIS_Z + 2.2)


def hinge(name):
    """Hinge of a latch's claw, in the bay."""
    x, side = LATCHES[name]
    return (x + HINGE_X, side * SILL_Y, HINGE_Z)


def keel_jaw(side):
    """Frame of an open keel jaw, in the bay: in its wall."""
    return (0.0, side * (KEEL_PIN_RADIUS + KEEL_OPEN_GAP), KEEL_Z)

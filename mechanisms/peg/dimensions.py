"""Dimensions of the peg, its hole and the wrist that holds it. All are chosen, in proportions of assembly parts."""

import math

RADIUS = 0.025  # m, of the peg
LENGTH = 0.15  # m
HOLE = 0.02525  # m, radius of the hole: a clearance of a hundredth
DEPTH = 0.10  # m, of the hole below its chamfer
CHAMFER = 0.004  # m, how far the chamfer goes down and, at 45 degrees, outwards
SLOPE = math.radians(45.0)  # between the chamfer and the axis
FRICTION = 0.2
STIFFNESS = 1e6  # N/m of peg on wall; half of it at each end of the peg
DAMPING = 300.0  # N·s/m
STICKING_DAMPING = 100.0  # N·s/m of the bristle

ACROSS = 1e4  # N/m, of the wrist across
TURN = 300.0  # N·m/rad, of the wrist about its centre of compliance
DAMPED = 0.1  # of critical, across and about the centre: little, for the closed forms have none
MASS = 2.0  # kg of the peg
NEAR, FAR = 0.0, 0.3  # m from the tip up to the centre of compliance
OFFSET = 0.002  # m, the tip beside the axis of the hole
TILT = math.radians(1.0)  # of the peg when nothing pushes
SLOW, SLOWLY = 0.004, 2.2  # m/s of the feed, and s for which it goes so: until the chamfer is crossed
SPEED = 0.02  # m/s after that
LIMIT = 40.0  # N, of a feed that may jam

# Values of surfaces in model files (kit/parameters.py): file, surface, and the path of the value.
ON_SURFACES = {
    "STIFFNESS": [("peg.ron", "steel", "stiffness")],
    "DAMPING": [("peg.ron", "steel", "normal", "Linear", "damping")],
    "FRICTION": [
        ("peg.ron", "steel", "friction", "Bristle", "mu"),
        ("hole.ron", "steel", "friction", "Bristle", "mu"),
    ],
    "STICKING_DAMPING": [("peg.ron", "steel", "friction", "Bristle", "damping")],
}

"""Dimensions of the tripod, its grounds and its fall: models/tripod (validation case V2) except for damping; all chosen."""

RADIUS = 0.5  # m, circle of the feet
STIFFNESS = 1e5  # N/m of a foot on rigid ground
DAMPING = 300.0  # N·s/m of a foot: 0.26 of critical for a third of the mass (models/tripod has none)
FRICTION = 0.5
STICKING_DAMPING = 200.0  # N·s/m of the bristle

MASS = 10.0  # kg
INERTIA = (1.0, 1.0, 1.5)  # kg·m²
HEIGHT = 0.3  # m, centre of mass above the feet
TALL = 0.6  # m, of the one that tips before it slides
GRAVITY = 9.81  # m/s²

REACH = 0.6  # m from the tip of the arm to the plane of the feet
LEAN = 0.02  # rad between the feet and the slope that the arm sets them down on
PUSH = 300.0  # N, with which the arm presses

# Values of surfaces in model files (kit/parameters.py): file, surface, and the path of the value.
ON_SURFACES = {
    "STIFFNESS": [("tripod.ron", "foot", "stiffness")],
    "DAMPING": [("tripod.ron", "foot", "normal", "Linear", "damping")],
    "FRICTION": [("tripod.ron", "foot", "friction", "Bristle", "mu"), ("ground.ron", "rock", "friction", "Bristle", "mu")],
    "STICKING_DAMPING": [("tripod.ron", "foot", "friction", "Bristle", "damping")],
}

"""Dimensions of the docking interfaces, for build.py, scenes.py and outcome.py. README.md says where each comes from."""

import geometry as g

# --- dimensions, m and degrees -------------------------------------------------------------------------------------

FACETS = 18  # of every ring and cone; the facet's middle lies on the radius given
STEP = 360.0 / FACETS
RIM_RADIUS = 0.600  # inner rim of the soft-capture ring: the standard's 1.2 m
RING_OUTER_RADIUS = 0.660
RING_HEIGHT = 0.060
PASSAGE_RADIUS = 0.400  # the standard's 0.8 m, kept free by the petals

PETAL_CLEARANCE = 0.003  # between a petal's root and the other side's rim when mated
PETAL_ROOT_INSIDE = 0.505  # distance of a petal's flat inner side from the axis, at the ring's face
PETAL_TIP_THICKNESS = 0.025  # along the radius
PETAL_ROOT_HALF_ANGLE = 29.8  # at the ring's face; 30 would touch the neighbour
PETAL_TIP_HALF_ANGLE = 6.0
PETAL_ANGLE = 45.0  # of the petals to the docking axis; drawn into the formulas below
ACTIVE_PETALS = (0.0, 120.0, 240.0)
PASSIVE_PETALS = (60.0, 180.0, 300.0)

RING_EXTENSION = 0.300  # of the active ring above its vehicle's hard-capture plane
HARD_RING_INNER_RADIUS = 0.620
HARD_RING_OUTER_RADIUS = 0.700
HARD_RING_HEIGHT = 0.040

PAD_RADIUS = 0.632  # of the circle of points that stand for the active ring's face
PADS_PER_RING = 12
PLATE_INNER_RADIUS = 0.604  # striker plates on the passive ring's face
PLATE_OUTER_RADIUS = 0.656
PLATE_RELIEF = 0.001  # by which the ring's own face lies below its plates

STRIKER_RECESS = 0.003  # of a striker's slope behind the cone through the ring's rim
STRIKER_FRONT = 0.005  # depth of its front edge and of its back face below the ring's face
STRIKER_BACK = 0.075
STRIKER_HALF_WIDTH = 0.160

LATCH_PLAY = 0.006  # between a latch's catch and the striker's back, mated
LATCH_ENGAGEMENT = 0.014  # by which the catch reaches over the striker's back face
LATCH_HALF_WIDTH = 0.020

CONE_RADIUS = RIM_RADIUS - PETAL_CLEARANCE  # of the petals' outer side at the ring's face
PETAL_HEIGHT = CONE_RADIUS - PASSAGE_RADIUS - PETAL_TIP_THICKNESS
UP = (0.0, 0.0, 1.0)


def latch_frame(azimuth):
    """Axes of a latch: x away from the docking axis (its slide), y along the ring, z out of the ring."""
    radial = g.on_circle(1.0, azimuth)
    return radial, g.cross(UP, radial), UP


def latch_tip(azimuth):
    """Middle of the catch's edge, latch extended."""
    radius = RIM_RADIUS + STRIKER_RECESS - STRIKER_BACK + LATCH_ENGAGEMENT
    return g.on_circle(radius, azimuth, STRIKER_BACK + LATCH_PLAY)

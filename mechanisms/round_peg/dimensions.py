"""Dimensions of the round peg, its hole and the spring that holds it. All are chosen."""

DIAMETER = 0.050  # d of the peg, m
HOLE = 0.0502  # D, m
DEPTH = 0.100  # of the hole, m
FRICTION = 0.2
STIFFNESS = 2e6  # N/m of peg on wall
DAMPING = 200.0  # N·s/m
MASS = 1.0  # kg, all in the middle of the tip, so that loads are given there
TURN = 50.0  # N·m/rad of the spring that holds a peg that turns upright as it enters
UPRIGHT_AT = 0.012  # m: depth of the second touch at the tilt at which it is held

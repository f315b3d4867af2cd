"""Dimensions of the tool and the pad for the arm's checks; the arm itself: kit/arm/dimensions.py. All are chosen."""

TOOL_RADIUS = 0.05  # m
PAD_STIFFNESS = 2e4  # N/m: a berthing interface with soft guides
PAD_DAMPING = 200.0  # N·s/m
PUSH = 300.0  # N, with which the arm is commanded to press

ON_SURFACES = {"PAD_STIFFNESS": []}  # rig.py writes it into the text of the pad (kit/parameters.py)

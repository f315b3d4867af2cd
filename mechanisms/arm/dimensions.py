"""Of the tool and the pad that the arm is checked with; the arm itself: kit/arm/dimensions.py. All is chosen."""

TOOL_RADIUS = 0.05  # m
PAD_STIFFNESS = 2e4  # N/m: a berthing interface with soft guides
PAD_DAMPING = 200.0  # N·s/m

"""A single duckhead bumper: an off-centre module meets it before the guides, and it pushes back as a spring."""

import math

import numpy as np

import mechanism
import ready
from dimensions import TRAINING, common
from kit.machine import Machine
from kit.rows import Row

GAP = 0.060
OFFSET = 0.011  # m toward a guide: less than its play at this gap, more than the bumper behind leaves
AZIMUTH = math.radians(common.GUIDE_AZIMUTHS[0])


def play():
    """Lateral clearance of the guides at this gap, m."""
    return common.GUIDE_CLEARANCE + (GAP - common.FIN_STRAIGHT - common.POST_THROAT) * math.tan(
        math.radians(common.FLARE_DEG)
    )


def depth():
    """Depth of the bill in the inner face of the fin, which leans outwards below its straight part."""
    slope = common.FIN_LEAN / (common.FIN_HEIGHT - common.FIN_STRAIGHT)
    below = -common.FIN_STRAIGHT - (common.BUMPER_Z - GAP)
    axis = common.RING_INNER - common.BUMPER_CLEARANCE - common.BUMPER_RADIUS
    distance = common.RING_INNER + slope * below - OFFSET - axis
    return common.BUMPER_RADIUS - distance / math.hypot(1.0, slope), slope


def rows():
    place = (OFFSET * math.cos(AZIMUTH), OFFSET * math.sin(AZIMUTH))
    scene = mechanism.Scene(TRAINING, ready.IMMOVABLE, mechanism.Start(place, gap=GAP))
    machine = Machine(mechanism.text(scene), mechanism.carried(scene).values())
    force = machine.wrench("world")[:3]
    sunk, slope = depth()
    spring = common.series(common.BUMPER_STIFFNESS) * sunk
    yield Row(
        f"bumper, {OFFSET * 1e3:g} of {play() * 1e3:.1f} mm off-centre: force",
        float(np.linalg.norm(force)),
        spring,
        1e-6,
        "N",
    )
    # The face leans outwards on its way down: it is pushed out and up, the bumper in and down.
    outward = float(force[0] * math.cos(AZIMUTH) + force[1] * math.sin(AZIMUTH))
    yield Row("its share across the axis", outward, spring / math.hypot(1.0, slope), 1e-6, "N")

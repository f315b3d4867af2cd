"""Outcomes of the docking interfaces' scene and their predictions. Run by models/outcomes.py."""

import math

from dimensions import *  # noqa: F403
from outcomes import force, norm, orientation, position, speed, turned
from scenes import ATTENUATION, ATTENUATION_DAMPING, CHASER_CENTER, CHASER_MASS, LATCH_MASS, RING_MASS, SPEED, TARGET_CENTER, TARGET_MASS

REDUCED_MASS = 1 / (1 / (CHASER_MASS + RING_MASS + 3 * LATCH_MASS) + 1 / TARGET_MASS)
STRIKER_EDGE = RIM_RADIUS + STRIKER_RECESS - STRIKER_BACK  # inner edge of its back face, from the axis
MASSES = {"chaser": CHASER_MASS, "chaser/ring": RING_MASS, "target": TARGET_MASS}
MASSES |= {f"chaser/ring/latch_{i}": LATCH_MASS for i in range(3)}
CENTERS = {"chaser": CHASER_CENTER, "target": TARGET_CENTER}


def momentum(run, time):
    """Momentum of all bodies, N·s."""
    total = [0.0, 0.0, 0.0]
    for row in (row for row in run.table("states") if row["time_s"] == time):
        w = (row["wx_rad_per_s"], row["wy_rad_per_s"], row["wz_rad_per_s"])
        r = turned(orientation(row), CENTERS.get(row["body"], (0.0, 0.0, 0.0)))
        v = (row["vx_m_per_s"], row["vy_m_per_s"], row["vz_m_per_s"])
        turning = (w[1] * r[2] - w[2] * r[1], w[2] * r[0] - w[0] * r[2], w[0] * r[1] - w[1] * r[0])
        total = [p + MASSES[row["body"]] * (a + b) for p, a, b in zip(total, v, turning)]
    return total


def seen_from(row, point):
    """A point in the axes of a body."""
    q = orientation(row)
    return turned((q[0], -q[1], -q[2], -q[3]), [a - b for a, b in zip(point, position(row))])


def soft_capture(run):
    times = run.times()
    start, end = momentum(run, times[0]), momentum(run, times[-1])
    yield "change of the momentum of all, of that at the start", norm([b - a for a, b in zip(start, end)]) / norm(start), 0.0, 1e-9

    # A mass on the attenuation alone, once the ring is at rest: √(k/m), ζ = c/(2√(km)).
    omega = math.sqrt(ATTENUATION[2] / REDUCED_MASS)
    zeta = ATTENUATION_DAMPING[2] / (2 * math.sqrt(ATTENUATION[2] * REDUCED_MASS))
    decay = math.exp(-zeta / math.sqrt(1 - zeta**2) * math.acos(zeta))
    pairs = zip(run.of("states", "chaser"), run.of("states", "chaser/ring"))
    strokes = [RING_EXTENSION - seen_from(vehicle, position(ring))[2] for vehicle, ring in pairs]
    yield "stroke of the attenuation over that of a mass on it, what alignment takes being lost", max(strokes) / (SPEED / omega * decay), 0.95, 1.0

    ring, port = run.last("chaser/ring"), run.last("target")
    x, y, z = seen_from(port, position(ring))
    yield "ring off the target's axis at the end, mm", math.hypot(x, y) * 1e3, 0.0, 3.0
    yield "gap between the rings at the end, mm: the latches' play at most", -z * 1e3, -0.1, LATCH_PLAY * 1e3
    for i in range(3):
        catch = seen_from(port, position(run.last(f"chaser/ring/latch_{i}")))
        yield f"catch of latch {i} behind its striker, mm", (-STRIKER_BACK - catch[2]) * 1e3, 0.0, 2 * LATCH_PLAY * 1e3
        yield f"and over it, mm of {LATCH_ENGAGEMENT * 1e3:g}", (math.hypot(*catch[:2]) - STRIKER_EDGE) * 1e3, 8.0, 20.0
    yield "speed of the ring against the target at the end, mm/s", abs(speed(ring) - speed(port)) * 1e3, 0.0, 0.5
    yield "greatest force between the vehicles, N: of the attenuation", max(norm(force(row)) for row in run.of("wrenches", "target")), 400.0, SPEED * omega * REDUCED_MASS


OUTCOMES = {"scene_soft_capture.ron": soft_capture}
# Edges meet the other side's solids, and pads its plates; pairs among these kinds need no tester.
WARNINGS = {"scene_soft_capture.ron": ("have no tester and ignore each other",)}

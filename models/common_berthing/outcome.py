"""Outcomes of the berthing mechanism's scenes and their predictions. Run by models/outcomes.py."""

import math

from dimensions import *  # noqa: F403
from outcomes import force, norm, orientation, place, speed, turn_rate
from scenes import (
    BERTHED, HELD, MOMENT_RATIOS, MOMENT_TIMES, OFFSET, PRESS_FORCE, PRESS_X, PULL, ROLL_DEG, ROLL_GAP,
)

FLARE = math.radians(FLARE_DEG)
SLIPPED = 2e-4  # m at the guides: a module that came so far does not stick
TURNED_DEG = 3.0  # a paddle that turned so far tells that it is touched
FLAT = math.asin((FITTING_BOTTOM - HINGE[2]) / PADDLE_LENGTH)  # where paddles end up, rad above the mating plane
READY = 0.005  # m: a plunger pressed so far likewise


def contacts(run, time, *names):
    """Contacts of a record between primitives whose paths contain all of the names."""
    rows = [row for row in run.table("contacts") if abs(row["time_s"] - time) < 1e-6]
    return [row for row in rows if all(name in row["a"] + " " + row["b"] for name in names)]


def at(run, body, time):
    return min(run.of("states", body), key=lambda row: abs(row["time_s"] - time))


def roll_deg(row):
    return math.degrees(2 * math.asin(row["qz"]))


def lateral(row):
    return norm((row["x_m"], row["y_m"]))


# --- press -----------------------------------------------------------------------------------------------------------

def press(run):
    """Springs on circles: their depth is F/Σk, their tilt F·e/Σ(k·r²/2), and they share the load accordingly."""
    end = run.last("passive")
    standoff, plunger = series(STANDOFF_STIFFNESS), series(PLUNGER_STIFFNESS)
    upright = 8 * standoff + 4 * plunger
    turning = 4 * standoff * STANDOFF_RADIUS**2 + 2 * plunger * PLUNGER_RADIUS**2
    sink, tilt = PRESS_FORCE / upright, PRESS_FORCE * PRESS_X / turning
    yield "sunk over that of the springs", (STANDOFF_STROKE - end["z_m"]) / sink, 0.999, 1.001
    yield "tilt over that of the springs", 2 * math.asin(end["qy"]) / tilt, 0.995, 1.005
    shares = []
    for row in contacts(run, end["time_s"], "/standoff "):
        expected = standoff * (sink + tilt * row["x_m"])
        shares.append(row["normal_force_n"] / expected)
    yield "standoffs that carry", len(shares), 8, 8
    yield "least share of a standoff over that of the lever", min(shares), 0.995, 1.0
    yield "greatest", max(shares), 1.0, 1.005
    yield "stops that are touched", len(contacts(run, end["time_s"], "/stop")), 0, 0
    yield "speed at the end, mm/s", speed(end) * 1e3, 0.0, 1e-9


# --- roll ------------------------------------------------------------------------------------------------------------

def roll(run):
    """Fins on flares of half angle α, friction angle φ: they slide in once moment/(push·radius) is below cot(α + φ)."""
    rows = run.of("states", "passive")
    start = at(run, "passive", MOMENT_TIMES[0])
    slid = [r for r in rows if math.radians(roll_deg(start) - roll_deg(r)) * RING_MIDDLE > SLIPPED and r["time_s"] > MOMENT_TIMES[0]]
    gone = [*slid, rows[-1]][0]
    share = (gone["time_s"] - MOMENT_TIMES[0]) / (MOMENT_TIMES[1] - MOMENT_TIMES[0])
    ratio = MOMENT_RATIOS[0] + share * (MOMENT_RATIOS[1] - MOMENT_RATIOS[0])
    limit = 1 / math.tan(FLARE + math.atan(FRICTION))
    yield "moment over push × radius when it slides, over cot(flare + friction angle)", ratio / limit, 0.975, 1.01
    middle = [*(r for r in rows if r["z_m"] < ROLL_GAP - 0.010), rows[-1]][0]
    turned = math.radians(roll_deg(start) - roll_deg(middle)) * RING_MIDDLE
    yield "way round over way in, over tan(flare)", turned / (start["z_m"] - middle["z_m"]) / math.tan(FLARE), 0.99, 1.01
    yield "off the middle, mm", lateral(rows[-1]) * 1e3, 0.0, 1e-6


# --- berthing --------------------------------------------------------------------------------------------------------

def play(gap):
    """Lateral clearance of a fin between its posts, m."""
    shoulder = gap - FIN_STRAIGHT - POST_THROAT
    return GUIDE_CLEARANCE + max(0.0, shoulder) * math.tan(FLARE)


def raised_deg(run, i, time):
    """Angle of a paddle above the mating plane, degrees."""
    row = at(run, f"indicator_{i}/paddle", time)
    tip = place(row, (PADDLE_LENGTH, 0.0, 0.0))
    return math.degrees(math.asin((tip[2] - row["z_m"]) / PADDLE_LENGTH))


def closed_forces():
    """Force of a latch and of all stops when closed, N: their springs share the bite against standoffs and plungers."""
    tip, stops = series(LATCH_STIFFNESS), 8 * series(RING_STIFFNESS)
    others = 8 * series(STANDOFF_STIFFNESS) * STANDOFF_STROKE
    others += 4 * series(PLUNGER_STIFFNESS) * (PLUNGER_TIP_Z - FITTING_BOTTOM)
    others += 4 * PADDLE_SPRING * (math.radians(PADDLE_DEG) - FLAT) / (PADDLE_LENGTH * math.cos(FLAT))
    # 4·tip·(bite − sunk) = stops·sunk + others; the dependence of `others` on `sunk` is negligible.
    sunk = (4 * tip * TIP_BITE - others) / (stops + 4 * tip)
    return tip * (TIP_BITE - sunk), stops * sunk


def berthing(run):
    start, ready, end = at(run, "passive", 0.0), at(run, "passive", HELD), run.last("passive")
    yield "misaligned at first, mm", lateral(start) * 1e3, norm(OFFSET) * 1e3 * 0.99, norm(OFFSET) * 1e3 * 1.01
    yield "roll at first, degrees", roll_deg(start), ROLL_DEG - 0.01, ROLL_DEG + 0.01
    room = play(ready["z_m"] + 0.010)  # tilted, some of the fins are less far in
    yield "misaligned at the hand-over, over the play of the guides", lateral(ready) / room, 0.0, 1.0
    yield "roll at the hand-over, over that play", math.radians(roll_deg(ready)) * RING_MIDDLE / room, 0.0, 1.0
    plungers = [row["depth_m"] for row in contacts(run, HELD, "plunger/")]
    yield "plungers pressed at the hand-over", len(plungers), 4, 4
    yield "least pressed, mm", min(plungers, default=0.0) * 1e3, READY * 1e3, PLUNGER_LENGTH * 1e3
    yield "least turned paddle at the hand-over, degrees", min(PADDLE_DEG - raised_deg(run, i, HELD) for i in range(4)), TURNED_DEG, 60.0
    before = [norm(force(row)) for row in run.of("wrenches", "passive") if row["time_s"] < HELD]
    yield "greatest force until then, N", max(before), 50.0, 4e3

    drawn = at(run, "passive", PULL[1] + 1.0)
    yield "misaligned when drawn in, mm", lateral(drawn) * 1e3, 0.0, math.sqrt(2) * GUIDE_CLEARANCE * 1e3
    yield "roll when drawn in, over the play", math.radians(abs(roll_deg(drawn))) * RING_MIDDLE / GUIDE_CLEARANCE, 0.0, 1.02
    latch, stops = closed_forces()
    for i in range(4):
        held = norm(force(run.of("wrenches", f"active/quadrant_{i}/latch_{i}")[-1]))
        yield f"force of latch {i} over that of the springs", held / latch, 0.985, 1.015
    carried = sum(row["normal_force_n"] for row in contacts(run, end["time_s"], "/stop"))
    yield "force on the stops over that of the springs", carried / stops, 0.985, 1.015
    shared = [row["normal_force_n"] for row in contacts(run, end["time_s"], "/standoff ")]
    yield "standoffs that carry", len(shared), 8, 8
    full = series(STANDOFF_STIFFNESS) * STANDOFF_STROKE
    yield "least force of a standoff over its full stroke's", min(shared) / full, 0.99, 1.02
    yield "greatest", max(shared) / full, 0.99, 1.02
    pressed = [row["depth_m"] * 1e3 for row in contacts(run, BERTHED, "plunger/")]
    yield "least pressed plunger at the end, mm", min(pressed), 79.0, 81.0
    yield "paddles at the end, degrees off the fittings' undersides", max(abs(raised_deg(run, i, BERTHED) - math.degrees(FLAT)) for i in range(4)), 0.0, 1.0
    tilt = math.degrees(2 * math.asin(norm(orientation(end)[1:3])))
    yield "tilt at the end, degrees", tilt, 0.0, 0.005
    yield "speed at the end, mm/s", speed(end) * 1e3, 0.0, 1e-3
    yield "turning at the end, degrees/s", math.degrees(turn_rate(end)), 0.0, 1e-4


OUTCOMES = {"scene_press.ron": press, "scene_roll.ron": roll, "scene_berthing.ron": berthing}

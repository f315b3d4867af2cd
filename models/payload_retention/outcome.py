"""Outcomes of the retention latches' scenes and their predictions. Run by models/outcomes.py."""

import math

from dimensions import *  # noqa: F403
from outcomes import force, norm, speed, turn_rate
from scenes import (
    KEEL_CLOSING, LIMP, LOAD_HOLD, LOAD_RAMP, LOAD_X, LOAD_Y, LOAD_Z, LOAD_Z_X, LOWERED, PUSH, WEDGE_OFFSET,
    WEDGE_RATIOS, WEDGE_TIMES,
)

FLARE = math.radians(FLARE_DEG)
SLIPPED = 2e-4  # m: a payload that came so far does not stick
FRICTION_OF_PRELOAD = FRICTION * 2 * PRELOAD * len(LATCHES)  # every pin rubs on its floor and on its claw


def contacts(run, time, *names):
    """Contacts of a record between primitives whose paths contain all of the names."""
    rows = [row for row in run.table("contacts") if abs(row["time_s"] - time) < 1e-6]
    return [row for row in rows if all(name in row["a"] + " " + row["b"] for name in names)]


def pressed(run, time, *names):
    return sum(row["normal_force_n"] for row in contacts(run, time, *names))


def depths(run, time, *names):
    return {row["a"]: row["depth_m"] for row in contacts(run, time, *names)}


def at(run, body, time):
    return min(run.of("states", body), key=lambda row: abs(row["time_s"] - time))


# --- wedge -----------------------------------------------------------------------------------------------------------

def wedge(run):
    """Wedge on a flare at an angle α from the direction of entry, friction angle φ: slides once the force back is below
    cot(α + φ)."""
    rows = run.of("states", "payload")
    start = next(row for row in rows if row["time_s"] >= WEDGE_TIMES[0])
    slid = [row for row in rows if row["time_s"] > WEDGE_TIMES[0] and start["x_m"] - row["x_m"] > SLIPPED]
    gone = [*slid, rows[-1]][0]
    share = (gone["time_s"] - WEDGE_TIMES[0]) / (WEDGE_TIMES[1] - WEDGE_TIMES[0])
    ratio = WEDGE_RATIOS[0] + share * (WEDGE_RATIOS[1] - WEDGE_RATIOS[0])
    limit = 1 / math.tan(FLARE + math.atan(FRICTION))
    yield "force back over push when it slides, over cot(flare + friction angle)", ratio / limit, 0.985, 1.0
    end = rows[-1]
    yield "way inwards by then, mm", (WEDGE_OFFSET - end["x_m"]) * 1e3, 1.0, 20.0
    slope = (end["x_m"] - start["x_m"]) / (end["z_m"] - start["z_m"])
    yield "way inwards over way down, over tan(flare)", slope / math.tan(FLARE), 0.99, 1.01
    yield "tilt, degrees", math.degrees(2 * math.asin(norm((end["qx"], end["qy"], end["qz"])))), 0.0, 0.001
    last = run.of("wrenches", "bay")[-1]
    slips = abs(last["fx_n"] / last["fz_n"])
    yield "sideways over downward force on the latches while it slides, over the limit", slips / limit, 0.999, 1.001


# --- berthing --------------------------------------------------------------------------------------------------------

def berthing(run):
    ready = at(run, "payload", LOWERED + 1.0)
    yield "off the middle of the primary sockets before anything closes, mm", abs(ready["x_m"]) * 1e3, 0.0, PRIMARY_CLEARANCE * 1e3
    yield "off the middle sideways before anything closes, mm", abs(ready["y_m"]) * 1e3, 0.0, SIDE_CLEARANCE * 1e3
    plungers = depths(run, LOWERED + 1.0, "plunger")
    yield "plungers pressed", len(plungers), 4, 4
    yield "least pressed of the four, mm of 15", min(plungers.values()) * 1e3, 14.5, 15.5
    centred = at(run, "payload", KEEL_CLOSING[1] + 1.0)
    yield "off the middle sideways with the keel latch closed, mm", abs(centred["y_m"]) * 1e3, 0.0, KEEL_CLOSED_GAP * 1e3 + 0.1
    end = run.last("payload")
    yield "below the seat at the end, µm", -end["z_m"] * 1e6, CLAW_BITE / 2 * 1e6 * 0.98, CLAW_BITE / 2 * 1e6 * 1.02
    for name in LATCHES:
        held = pressed(run, end["time_s"], name, "claw")
        yield f"force of the claw of {name} over its preload", held / PRELOAD, 0.98, 1.02
    turn = math.degrees(2 * math.asin(norm((end["qx"], end["qy"], end["qz"]))))
    most = 2 * PRIMARY_CLEARANCE / (2 * SILL_Y)  # both primary pins at the ends of their play
    yield "turned at the end, degrees", turn, 0.0, 1.05 * math.degrees(most)
    yield "speed at the end, mm/s", speed(end) * 1e3, 0.0, 1e-6
    yield "turning at the end, degrees/s", math.degrees(turn_rate(end)), 0.0, 1e-6
    before = [row for row in run.of("wrenches", "payload") if row["time_s"] < LOWERED]
    yield "greatest force on the latches on the way in, N", max(norm(force(row)) for row in before), 300.0, 10e3
    arm = [row for row in run.of("states", "arm") if row["time_s"] > LIMP[1]][-1]
    yield "arm's tip off the payload's place at the end, mm", abs(arm["x_m"] - end["x_m"]) * 1e3, 0.0, 1.5


# --- loads -----------------------------------------------------------------------------------------------------------

def held_at(i):
    """The end of the i-th load's hold."""
    return 1.0 + i * (2 * LOAD_RAMP + LOAD_HOLD + 1.0) + LOAD_RAMP + LOAD_HOLD


def upward(run, time, station):
    """Net force of the two latches at a station on the payload."""
    floors = pressed(run, time, station, "floor")
    return floors - pressed(run, time, station, "claw")


def loads(run):
    up = held_at(0)
    for station, x in (("primary", -STATION_X), ("secondary", STATION_X)):
        lever = 0.5 + LOAD_Z_X * x / (2 * STATION_X**2)
        yield f"load upwards on the {station} latches over that of the lever", -upward(run, up, station) / (LOAD_Z * lever), 0.99, 1.01
    rise = (at(run, "payload", up)["z_m"] - at(run, "payload", 0.5)["z_m"]) / (LOAD_Z / (2 * PAIR_STIFFNESS * len(LATCHES)))
    yield "rise over that of four claws and four floors", rise, 0.97, 1.03
    aft = pressed(run, held_at(1), "bay/primary", "guide_aft")
    least = (LOAD_X - FRICTION_OF_PRELOAD) / LOAD_X
    yield "share of the load aft on the primary sockets, the rest being friction", aft / LOAD_X, 0.99 * least, 1.0
    yield "on the secondary sockets, N", pressed(run, held_at(1), "bay/secondary", "guide"), 0.0, 0.0
    keel = pressed(run, held_at(2), "keel_jaw_starboard")
    least = (LOAD_Y - FRICTION_OF_PRELOAD) / LOAD_Y
    yield "share of the load to starboard on the keel latch, the rest being friction", keel / LOAD_Y, 0.99 * least, 1.0
    yield "speed at the end, mm/s", speed(run.last("payload")) * 1e3, 0.0, 1e-4


OUTCOMES = {"scene_wedge.ron": wedge, "scene_berthing.ron": berthing, "scene_loads.ron": loads}

"""Outcomes of the pallet's scenes and their predictions. Run by models/outcomes.py; README.md derives the closed forms."""

import math

from dimensions import *  # noqa: F403
from outcomes import force, norm, place, position, speed, turn_rate
from scenes import ALIGN_TIME, ARM_STIFFNESS, CORNER_SPEED, CORNER_Y, DRAG, FIXTURE, HOLD_TIME, OVERTRAVEL

ROLLER_SPAN = 2 * SIDE_ROLLER_X  # along the rails, between the rollers that take a turning moment
WHEEL_SPAN = 2 * MAIN_WHEEL_X


# --- insertion -------------------------------------------------------------------------------------------------------

def arm_force(arm, pallet):
    """Force of the arm's spring on the pallet, N; without its damping."""
    return [k * (a - p) for k, a, p in zip(ARM_STIFFNESS, position(arm), place(pallet, FIXTURE))]


def yaw_deg(row):
    """Yaw of a pallet with a small rotation; `pitch_deg` likewise."""
    return math.degrees(2 * row["qz"])


def pitch_deg(row):
    return math.degrees(2 * row["qy"])


def slack_deg(run, wheels, clearance, span):
    """Largest rotation of the pallet allowed by a pair of wheels: clearance, and deflections of tread, rail and bearings."""
    greatest = max(norm(force(row)) for name in wheels for row in run.of("wrenches", f"pallet/{name}"))
    yielded = greatest * (1 / WHEEL_STIFFNESS + 1 / STEEL_STIFFNESS + 1 / (2 * BEARING_STIFFNESS))
    return math.degrees((clearance + 2 * yielded) / span)


def insertion(run):
    yield from on_the_way(run)
    yield from pressed(run)
    yield from seated(run)


def on_the_way(run):
    """Insertion with all wheels in the rails, before the stops: only wheels touch, and the rotation is within their limit."""
    inside = [row for row in run.of("states", "pallet") if SIDE_ROLLER_X < row["x_m"] < SEATED_X - 0.005]
    off = max(abs(row["y_m"]) for row in inside)
    yield "off the middle sideways on the way, mm", off * 1e3, 0.0, LATERAL_CLEARANCE / 2 * 1e3
    rollers = [name for name in WHEELS if is_roller(name)]
    most = slack_deg(run, rollers, LATERAL_CLEARANCE, ROLLER_SPAN)
    yield "yaw on the way, degrees", min(map(yaw_deg, inside)), -most, 0.0
    most = slack_deg(run, WHEELS.keys() - rollers, VERTICAL_CLEARANCE, WHEEL_SPAN)
    yield "pitch on the way, degrees", max(map(pitch_deg, inside)), 0.0, most
    times = {row["time_s"] for row in run.of("states", "pallet") if row["x_m"] < SEATED_X - 0.005}
    touched = max(norm(force(row)) for row in run.of("wrenches", "pallet") if row["time_s"] in times)
    yield "force of the pallet's body on the rails before the stops, N", touched, 0.0, 0.0


def pressed(run):
    """Rest against the stops with the arm misaligned: the rails carry the force of the arm's spring."""
    time = max(t for t in run.times() if t <= run.times()[-1] - HOLD_TIME - ALIGN_TIME)
    arm, pallet, rails = (
        next(row for row in run.of(table, body) if row["time_s"] == time)
        for table, body in (("states", "arm"), ("states", "pallet"), ("wrenches", "rails"))
    )
    off = norm([r - f for r, f in zip(force(rails), arm_force(arm, pallet))])
    yield "force on the rails out of line, N", norm(force(rails)), 300.0, 400.0
    yield "what that differs from the arm's, N", off, 0.0, 0.05
    peaks = {name: max(norm(force(row)) for row in run.of("wrenches", f"pallet/{name}")) for name in WHEELS}
    yield "greatest force on a wheel, N", max(peaks.values()), 100.0, 300.0
    arms = [norm(arm_force(*rows)) for rows in zip(run.of("states", "arm"), run.of("states", "pallet"))]
    yield "the arm's greatest force, N", max(arms), ARM_STIFFNESS[0] * OVERTRAVEL, 500.0


def seated(run):
    """Aligned: both bumpers against the stops, in series with the arm."""
    end = run.last("pallet")
    bumpers = 2 / (1 / BUMPER_STIFFNESS + 1 / STEEL_STIFFNESS)
    push = OVERTRAVEL / (1 / ARM_STIFFNESS[0] + 1 / bumpers)
    held = run.of("wrenches", "rails")[-1]["fx_n"]
    yield "force on the stops over that of the springs in series", held / push, 0.999, 1.001
    yield "depth of the bumpers over theirs", (end["x_m"] - SEATED_X) * bumpers / push, 0.99, 1.01
    yield "off the middle sideways, mm", abs(end["y_m"]) * 1e3, 0.0, LATERAL_CLEARANCE / 2 * 1e3
    yield "off the middle in height, mm", abs(end["z_m"]) * 1e3, 0.0, VERTICAL_CLEARANCE / 2 * 1e3
    yield "out of square, degrees", abs(yaw_deg(end)), 0.0, 0.001
    yield "pitch, degrees", abs(pitch_deg(end)), 0.0, math.degrees(VERTICAL_CLEARANCE / WHEEL_SPAN)
    yield "speed at the end, mm/s", speed(end) * 1e3, 0.0, 0.01
    yield "turning at the end, degrees/s", math.degrees(turn_rate(end)), 0.0, 0.01


# --- corner push -----------------------------------------------------------------------------------------------------

def steady(run, table, body, keys):
    """Means over the last two seconds, when the pallet moves steadily."""
    rows = [row for row in run.of(table, body) if row["time_s"] > run.times()[-1] - 2.0]
    return [sum(row[key] for row in rows) / len(rows) for key in keys]


def lever(run):
    """Lever of the strut about the drag, m: a yawed pallet carries its corner slightly outwards."""
    end = run.last("pallet")
    return place(end, (FIXTURE[0], CORNER_Y, 0.0))[1] - end["y_m"]


def corner_push(run):
    """Turning rollers: only the drag of two bearings resists."""
    held = steady(run, "wrenches", "rails", ["fx_n"])[0]
    drag = 2 * BEARING_DRAG * CORNER_SPEED / SIDE_ROLLER_RADIUS**2
    yield "force of the rails against the push over that of two rollers", held / drag, 0.98, 1.02
    yield from loads(run, DRAG * lever(run) / ROLLER_SPAN)


def corner_push_seized(run):
    """Sliding rollers: the drawer's law."""
    held = steady(run, "wrenches", "rails", ["fx_n"])[0]
    push = DRAG / (1 - 2 * FRICTION * lever(run) / ROLLER_SPAN)
    yield "push over that of the drawer's law", (DRAG + held) / push, 0.995, 1.005
    yield from loads(run, push * lever(run) / ROLLER_SPAN)


def loads(run, expected):
    """The two rollers that resist the pallet's rotation; the others are free."""
    for name in ("roller_front_right", "roller_rear_left"):
        load = abs(steady(run, "wrenches", f"pallet/{name}", ["fy_n"])[0])
        yield f"load of {name} over that of the lever", load / expected, 0.99, 1.01
    for name in ("roller_front_left", "roller_rear_right"):
        load = norm(steady(run, "wrenches", f"pallet/{name}", ["fx_n", "fy_n", "fz_n"]))
        yield f"load of {name}, N", load, 0.0, 0.0
    yield "speed at the end over the strut's", run.last("pallet")["vx_m_per_s"] / CORNER_SPEED, 0.99, 1.01


OUTCOMES = {
    "scene_insertion.ron": insertion,
    "scene_corner_push.ron": corner_push,
    "scene_corner_push_seized.ron": corner_push_seized,
}

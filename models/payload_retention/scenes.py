"""Scenes of the retention latches (docs/scene_format.md): an arm lowers the payload, claws close, loads are applied."""

import math

from dimensions import *  # noqa: F403
from geometry import rounded
from scene_text import UPRIGHT, about_axis, glide, numbers, on, product, scene, spring, stroke, table, turned


PAIRS = [("bay", "payload")]

# --- berthing --------------------------------------------------------------------------------------------------------
ARM_STIFFNESS = (4e3, 4e3, 4e3, 5e4, 5e4, 5e4)  # N/m, N·m/rad
ARM_DAMPING = (3.8e3, 3.8e3, 3.8e3, 4.8e4, 4.8e4, 4.8e4)
START = (0.050, 0.040, 0.600)  # of the payload's frame: aft and to starboard of the latches, above them
ROLL_DEG, PITCH_DEG, YAW_DEG = 0.5, -0.5, 0.5
SPEED = 0.030
OVERTRAVEL = 0.150  # of the arm below the seated payload: 600 N
LOWERED = 26.0  # s; the arm holds from here
KEEL_CLOSING = (28.0, 32.0)  # s: the keel latch centres the payload first
CLOSING = (34.0, 44.0)  # of the claws
LIMP = (46.0, 50.0)  # the arm gives way to where the payload sits
BERTHED = 58.0
STEPS = 20  # of each of these, joined smoothly

# --- wedge: pushed down on the aft flares, held back along x by a force that fades away ----------------------------
PUSH = 2000.0
WEDGE_OFFSET = 0.150
WEDGE_RATIOS = (0.72, 0.60)  # of the holding force over the push, at the times below
WEDGE_TIMES = (4.0, 52.0)
WEDGE_END = 32.0

# --- loads on the latched payload, one after the other --------------------------------------------------------------
LOAD_X, LOAD_Y, LOAD_Z = 20e3, 10e3, 8e3
LOAD_Z_X = -0.8  # where the upward load acts: forward of the middle
LOAD_RAMP, LOAD_HOLD = 2.0, 3.0


def texts():
    return {"scene_wedge.ron": wedge(), "scene_berthing.ron": berthing(), "scene_loads.ron": loads()}


def attitude():
    """Yaw about z after pitch about y after roll about x."""
    return product(about_axis(2, YAW_DEG), product(about_axis(1, PITCH_DEG), about_axis(0, ROLL_DEG)))


# --- bodies ------------------------------------------------------------------------------------------------------------

def body(group, rows):
    """One line: a movable group at rest (one row) or moving through poses at times."""
    if len(rows) == 1:
        return f'(group: "{group}", motion: Fixed, position: {numbers(rows[0][1])}, orientation: {numbers(rows[0][2])}),'
    return f'(group: "{group}", motion: Prescribed(Table([{table(rows)}]))),'


def claw(name, closing):
    """Rows of a claw that closes between two times; None: it is closed."""
    place = rounded(hinge(name))
    if closing is None:
        return [(0.0, place, UPRIGHT)]
    return glide(closing, lambda share: (place, about_axis(1, OPEN_DEG * (1 - share))), STEPS)


def keel_jaw_rows(side, closing):
    open_ = rounded(keel_jaw(side))
    travel = KEEL_OPEN_GAP - KEEL_CLOSED_GAP

    def row(share):
        return ((open_[0], open_[1] - side * share * travel, open_[2]), UPRIGHT)

    return [(0.0, *row(1.0))] if closing is None else glide(closing, row, STEPS)


def bay(claws, keel):
    lines = ['(name: "bay", model: "bay", bodies: [', "    (motion: Fixed),"]
    lines += ["    " + body(f"bay/{name}/claw", claws(name)) for name in LATCHES]
    lines += ["    " + body(f"bay/keel_jaw_{label}", keel(side)) for side, label in ((-1, "port"), (1, "starboard"))]
    return lines + ["]),"]


def payload(position, orientation):
    return [
        '(name: "payload", model: "payload", bodies: [(',
        f"    motion: Free, mass: {PAYLOAD_MASS}, inertia: Diagonal{numbers(PAYLOAD_INERTIA)}, "
        f"mass_center: {numbers(MASS_CENTER)},",
        f"    position: {numbers(position)}, orientation: {numbers(orientation)},",
        ")]),",
    ]


def arm(rows):
    return [f'(name: "arm", model: "arm", bodies: [(motion: Prescribed(Table([{table(rows)}])))]),']


# --- scenes ------------------------------------------------------------------------------------------------------------

def arm_rows():
    """Path of the arm's tip: down at constant speed past the seat, holds, then yields to the seated payload's pose."""
    q = attitude()
    grip = turned(q, GRAPPLE)
    travel = START[2] + OVERTRAVEL

    def place(down):
        return tuple(s + g for s, g in zip((START[0], START[1], START[2] - down), grip))

    held = place(travel)

    def limp(share):
        return (tuple(h + share * (g - h) for h, g in zip(held, GRAPPLE)), UPRIGHT if share > 0.0 else q)

    return stroke(place, q, travel, SPEED) + glide(LIMP, limp, STEPS)


def berthing():
    about = [
        "An arm lowers the payload into its latches at 30 mm/s, 50 mm too far aft, 40 mm to starboard, rolled, pitched",
        "and yawed by half a degree. Guides bring it in, the keel latch centres it, claws draw it down, the arm goes limp.",
        "Written by build.py.",
    ]
    objects = [
        *bay(lambda name: claw(name, CLOSING), lambda side: keel_jaw_rows(side, KEEL_CLOSING)),
        *payload(START, attitude()),
        *arm(arm_rows()),
    ]
    hold = spring(on("arm"), on("payload", GRAPPLE), ARM_STIFFNESS, ARM_DAMPING)
    return scene("berthing", about, ("bay", "payload", "arm"), objects, PAIRS, BERTHED, 50, springs=[hold])


def open_claw(name):
    return claw(name, (0.0, 1.0))[:1]


def wedge():
    about = [
        "With its pins on the aft flares, the payload is pushed down by 2 kN and held back by a force along x that fades",
        "from 0.72 to 0.60 of the push. It sticks until the ratio falls below cot(flare + friction angle) = 0.667.",
        "Written by build.py.",
    ]
    touch = PIN_RADIUS / math.sin(math.radians(FLARE_DEG)) + flare_z(WEDGE_OFFSET)  # 45°: straight above the flare
    rows = [(0.0, 0.0, 0.0), (2.0, WEDGE_RATIOS[0], 1.0), (WEDGE_TIMES[0], WEDGE_RATIOS[0], 1.0)]
    rows += [(WEDGE_TIMES[1], WEDGE_RATIOS[1], 1.0)]
    steps = ", ".join(f"(time: {t!r}, force: {numbers((PUSH * h, 0.0, -PUSH * v))})" for t, h, v in rows)
    objects = [
        *bay(open_claw, lambda side: keel_jaw_rows(side, (0.0, 1.0))[:1]),
        *payload((WEDGE_OFFSET, 0.0, touch), UPRIGHT),
    ]
    return scene("wedge", about, ("bay", "payload"), objects, PAIRS, WEDGE_END, 50, loads=[f'(body: "payload", table: [{steps}]),'])


def loads():
    about = [
        "Loads on the latched payload, each for three seconds: 8 kN upwards ahead of the middle, which all four latches",
        "take by the lever; 20 kN aft, which the primary latches take; 10 kN to starboard, which the keel latch takes.",
        "Written by build.py.",
    ]
    lines = []
    cases = [  # force, and where it is held, so that nothing turns
        ((0.0, 0.0, LOAD_Z), (LOAD_Z_X, 0.0, 0.0)),
        ((LOAD_X, 0.0, 0.0), (0.0, 0.0, 0.0)),
        ((0.0, LOAD_Y, 0.0), (0.0, 0.0, KEEL_Z)),
    ]
    for i, (force, place) in enumerate(cases):
        start = 1.0 + i * (2 * LOAD_RAMP + LOAD_HOLD + 1.0)
        times = (start, start + LOAD_RAMP, start + LOAD_RAMP + LOAD_HOLD, start + 2 * LOAD_RAMP + LOAD_HOLD)
        forces = ((0.0, 0.0, 0.0), force, force, (0.0, 0.0, 0.0))
        steps = ", ".join(f"(time: {t!r}, force: {numbers(f)})" for t, f in zip(times, forces))
        lines.append(f'(body: "payload", point: {numbers(place)}, table: [{steps}]),')
    objects = [*bay(lambda name: claw(name, None), lambda side: keel_jaw_rows(side, None))]
    objects += payload((0.0, 0.0, -CLAW_BITE / 2), UPRIGHT)
    duration = 1.0 + 3 * (2 * LOAD_RAMP + LOAD_HOLD + 1.0)
    return scene("loads", about, ("bay", "payload"), objects, PAIRS, duration, 20, loads=lines)

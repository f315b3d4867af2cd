"""Scenes of the berthing mechanism (docs/scene_format.md): an arm brings the module, latches pull it in."""

import math

from dimensions import *  # noqa: F403
from geometry import rounded

UPRIGHT = (1.0, 0.0, 0.0, 0.0)
MODELS = ("active", "passive", "indicator")

# --- berthing --------------------------------------------------------------------------------------------------------
ARM_STIFFNESS = (4e3, 4e3, 4e3, 1.5e4, 1.5e4, 1.5e4)  # N/m, N·m/rad
ARM_DAMPING = (3.8e3, 3.8e3, 3.8e3, 3e4, 3e4, 3e4)
OFFSET = (0.025, -0.020)  # of the passive ring
ROLL_DEG, PITCH_DEG, YAW_DEG = 1.2, 0.5, -0.4  # about z, y, x
START_GAP = 0.260
HANDOVER_GAP = 0.030
SPEED = 0.020
HELD = 19.0  # s; the arm has stopped and sways no more
RISE = (20.0, 24.0)  # s: the latches' tips rise beside the fittings
SWING = (24.0, 27.0)  # they move over them
PULL = (27.0, 52.0)  # they pull
LIMP = (54.0, 58.0)  # the arm gives way to where the module sits
BERTHED = 66.0
STEPS = 12  # of each of these, joined smoothly
FOLDED_DEG = -30.0  # where paddles are out of the way, above the mating plane

# --- press: the ring alone pushed onto its standoffs, off the middle ---------------------------------------------------
PRESS_FORCE = 800.0
PRESS_X = 0.15
PRESS_RAMP = 3.0
PRESSED = 12.0
REST = 4 * series(PLUNGER_STIFFNESS) * (PLUNGER_TIP_Z - STANDOFF_STROKE - FITTING_BOTTOM)  # N: holds the plungers down

# --- roll: pushed in while a moment that fades away holds the roll -----------------------------------------------------
PUSH = 2000.0
ROLL_GAP = 0.075
MOMENT_RATIOS = (1.20, 1.00)  # of the moment over push × radius, at the times below
MOMENT_TIMES = (4.0, 44.0)
ROLL_END = 26.0


def texts():
    return {"scene_berthing.ron": berthing(), "scene_press.ron": press(), "scene_roll.ron": roll()}


# --- numbers ----------------------------------------------------------------------------------------------------------

def numbers(values):
    return "(" + ", ".join(repr(round(float(x), 12) + 0.0) for x in values) + ")"


def about_axis(axis, angle_deg):
    half = math.radians(angle_deg) / 2
    return (math.cos(half), *(math.sin(half) * float(i == axis) for i in range(3)))


def product(p, q):
    return (
        p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
        p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
        p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
        p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0],
    )


def turned(q, v):
    inverse = (q[0], -q[1], -q[2], -q[3])
    return product(product(q, (0.0, *v)), inverse)[1:]


def attitude():
    """Roll about z after pitch about y after yaw about x."""
    return product(about_axis(2, ROLL_DEG), product(about_axis(1, PITCH_DEG), about_axis(0, YAW_DEG)))


def paddle_attitude(raised_deg):
    """Of a paddle that stands this far above the mating plane, in its indicator."""
    return about_axis(1, -raised_deg)


def smooth(t):
    return t**3 * (10 - 15 * t + 6 * t**2)


# --- bodies ------------------------------------------------------------------------------------------------------------

def table(rows):
    return ", ".join(f"(time: {time!r}, position: {numbers(p)}, orientation: {numbers(q)})" for time, p, q in rows)


def glide(times, first, last, orientation, steps=STEPS):
    """Rows of a straight way between two times that begins and ends gently; it stands still for a second around it."""
    start, end = times
    rows = [(start - 1.0, first, orientation)]
    for i in range(steps + 1):
        share = smooth(i / steps)
        place = tuple(f + share * (e - f) for f, e in zip(first, last))
        rows.append((round(start + i / steps * (end - start), 9), place, orientation))
    return [*rows, (end + 1.0, last, orientation)]


def joined(*ways):
    """Ways one after the other; where one ends as the next begins, neither stands still."""
    rows = []
    for way in ways:
        rows = [row for row in rows if row[0] < way[1][0]] + (way if not rows or rows[-1][0] < way[0][0] else way[1:])
    return rows


def tip_rows(azimuth_deg):
    """The way of a latch's tip: up, over the fitting, down onto it."""
    corners = ((STOWED_RADIUS, STOWED_Z), (STOWED_RADIUS, REACH_Z), (CLOSED_RADIUS, REACH_Z), (CLOSED_RADIUS, CLOSED_Z))
    places = [radial(radius, azimuth_deg, z) for radius, z in corners]
    q = about_axis(2, azimuth_deg)
    return joined(*(glide(times, *places[i : i + 2], q) for i, times in enumerate((RISE, SWING, PULL))))


def latches(moving):
    for i, azimuth in enumerate(LATCH_AZIMUTHS):
        if moving:
            yield f'(group: "latch_{i}", motion: Prescribed(Table([{table(tip_rows(azimuth))}]))),'
        else:
            yield f'(group: "latch_{i}", motion: Fixed),'


def active(moving):
    lines = ["(motion: Fixed),", *latches(moving)]
    return ['(name: "active", model: "active", bodies: ['] + ["    " + line for line in lines] + ["]),"]


def indicators(hinged):
    """Paddles on their hinges, or folded away."""
    about = PADDLE_MASS * (2 * PADDLE_HALF_WIDTH) ** 2 / 12
    across = PADDLE_MASS * PADDLE_LENGTH**2 / 12
    for i, azimuth in enumerate(LATCH_AZIMUTHS):
        q = about_axis(2, azimuth)
        yield f'(name: "indicator_{i}", model: "indicator", bodies: ['
        yield f"    (motion: Fixed, orientation: {numbers(q)}),"
        yield '    (group: "plunger", motion: Fixed),'
        if hinged:
            yield (
                f'    (group: "paddle", motion: Free, mass: {PADDLE_MASS}, '
                f"mass_center: {numbers((PADDLE_LENGTH / 2, 0.0, 0.0))}, "
                f"inertia: Diagonal{numbers((about, across, about + across))}),"
            )
        else:
            folded = numbers(product(q, paddle_attitude(FOLDED_DEG)))
            yield f'    (group: "paddle", motion: Fixed, orientation: {folded}),'
        yield "]),"


def passive(mass, inertia, center, position, orientation):
    return [
        '(name: "passive", model: "passive", bodies: [(',
        f"    motion: Free, mass: {mass}, inertia: Diagonal{numbers(inertia)}, mass_center: {numbers(center)},",
        f"    position: {numbers(position)}, orientation: {numbers(orientation)},",
        ")]),",
    ]


def arm(rows):
    return [f'(name: "arm", model: "arm", bodies: [(motion: Prescribed(Table([{table(rows)}])))]),']


def hinges():
    """Stiff but about y, about which the paddle's spring raises it."""
    for i in range(len(LATCH_AZIMUTHS)):
        yield (
            f'(first: On(body: "indicator_{i}", position: {numbers(HINGE)}, '
            f"orientation: {numbers(paddle_attitude(PADDLE_DEG))}), "
            f'second: On(body: "indicator_{i}/paddle"), '
            f"stiffness: {numbers((1e5, 1e5, 1e5, 50.0, PADDLE_SPRING, 50.0))}, "
            f"damping: {numbers((80.0, 80.0, 80.0, 0.05, 0.05, 0.05))}),"
        )


# --- scenes ------------------------------------------------------------------------------------------------------------

def scene(name, about, objects, duration, record_every, loads=(), springs=(), models=()):
    lines = [f"// {line}" for line in about]
    lines += ["(", '    format: "pong-scene",', "    version: 1,", f'    name: "{name}",']
    lines += ["    models: { " + ", ".join(f'"{model}": "{model}.ron"' for model in MODELS + models) + " },"]
    lines += ["    objects: ["] + ["        " + line for line in objects] + ["    ],"]
    pairs = ["active"] + [f"indicator_{i}" for i in range(len(LATCH_AZIMUTHS))]
    lines += ["    pairs: [" + ", ".join(f'("{name}", "passive")' for name in pairs) + "],"]
    lines += ["    loads: ["] + ["        " + line for line in loads] + ["    ],"] if loads else []
    lines += ["    springs: ["] + ["        " + line for line in springs] + ["    ],"] if springs else []
    lines += ["    integrator: RungeKutta4,", "    step: 1e-3,", f"    duration: {duration!r},"]
    lines += [f"    record_every: {record_every},", "    ledger: true,", ")"]
    return "\n".join(lines) + "\n"


def arm_rows():
    """Where the arm's tip goes: in at one speed to the hand-over, holds against the latches, then gives way."""
    q = attitude()
    grip = turned(q, GRAPPLE)
    travel = START_GAP - HANDOVER_GAP

    def place(way):
        return tuple(s + g for s, g in zip((*OFFSET, START_GAP - way), grip))

    even = (travel - 4 * SPEED) / SPEED
    stops = ((0.0, 0.0), (1.0, 0.0), (3.0, SPEED), (4.0, 2 * SPEED), (4.0 + even, travel - 2 * SPEED))
    stops += ((5.0 + even, travel - SPEED), (7.0 + even, travel), (8.0 + even, travel))
    rows = [(round(time, 9), place(way), q) for time, way in stops]
    limp = glide(LIMP, place(travel), GRAPPLE, UPRIGHT)
    return rows + [(limp[0][0], limp[0][1], q), (*limp[1][:2], q), *limp[2:]]


def berthing():
    about = [
        "An arm brings a 10 t module at 20 mm/s to a gap of 30 mm, 25 mm and 20 mm off-centre, rolled by 1.2 degrees,",
        "pitched by 0.5 and yawed by -0.4. Guides align it, paddles and plungers tell that it can be latched, latches pull",
        "it in against the arm, the arm goes limp. Written by build.py.",
    ]
    start = (*OFFSET, START_GAP)
    objects = [
        *active(moving=True),
        *indicators(hinged=True),
        *passive(MODULE_MASS, MODULE_INERTIA, MODULE_CENTER, start, attitude()),
        *arm(arm_rows()),
    ]
    hold = (
        f'(first: On(body: "arm"), second: On(body: "passive", position: {numbers(GRAPPLE)}), '
        f"stiffness: {numbers(ARM_STIFFNESS)}, damping: {numbers(ARM_DAMPING)}),"
    )
    return scene(
        "berthing", about, objects, BERTHED, 50, springs=[*hinges(), hold], models=("arm",)
    )


def press():
    about = [
        "The passive ring alone, aligned, is pushed onto its standoffs by 800 N at 0.15 m from the middle: they share the",
        "load by the lever. 120 N in the middle hold down the plungers of the indicators. Written by build.py.",
    ]
    objects = [
        *active(moving=False),
        *indicators(hinged=False),
        *passive(RING_MASS, RING_INERTIA, (0.0, 0.0, 0.0), (0.0, 0.0, STANDOFF_STROKE), UPRIGHT),
    ]
    push = numbers((0.0, 0.0, -PRESS_FORCE))
    load = f'(body: "passive", point: {numbers((PRESS_X, 0.0, 0.0))}, table: [(time: 0.0), (time: {PRESS_RAMP!r}, force: {push})]),'
    rest = f'(body: "passive", force: {numbers((0.0, 0.0, -REST))}),'
    return scene("press", about, objects, PRESSED, 20, loads=[rest, load])


def roll_touch():
    """The roll at which, at ROLL_GAP, every fin touches the flare of a post, rad."""
    straight = ROLL_GAP - FIN_STRAIGHT  # height of the fins' shoulders
    play = GUIDE_CLEARANCE + (straight - POST_THROAT) * math.tan(math.radians(FLARE_DEG))
    return play / RING_MIDDLE


def roll():
    about = [
        "The module is pushed in by 2 kN along its axis, its fins on the flares of one sense of roll, and held back by a",
        "moment about the axis that fades from 1.20 to 1.00 of push times radius. It sticks until that falls below",
        "cot(flare + friction angle) = 1.138. Written by build.py.",
    ]
    angle = math.degrees(roll_touch())
    objects = [
        *active(moving=False),
        *indicators(hinged=False),
        *passive(MODULE_MASS, MODULE_INERTIA, MODULE_CENTER, (0.0, 0.0, ROLL_GAP), about_axis(2, angle)),
    ]
    lever = PUSH * RING_MIDDLE
    rows = [(0.0, 0.0, 0.0), (2.0, MOMENT_RATIOS[0], 1.0), (MOMENT_TIMES[0], MOMENT_RATIOS[0], 1.0)]
    rows += [(MOMENT_TIMES[1], MOMENT_RATIOS[1], 1.0)]
    steps = ", ".join(
        f"(time: {t!r}, force: {numbers((0.0, 0.0, -PUSH * p))}, moment: {numbers((0.0, 0.0, lever * m))})"
        for t, m, p in rows
    )
    return scene("roll", about, objects, ROLL_END, 50, loads=[f'(body: "passive", table: [{steps}]),'])

"""Scenes of the berthing mechanism (docs/scene_format.md): an arm brings the module, latches pull it in."""

import math

from dimensions import *  # noqa: F403
from scene_text import (
    UPRIGHT, about_axis, glide, joined, numbers, on, product, scene, spring, stroke, table, turned,
)

MODELS = ("active", "passive", "indicator")
PAIRS = [(name, "passive") for name in ("active", "indicator_0", "indicator_1", "indicator_2", "indicator_3")]
HINGE_STIFFNESS = (1e5, 1e5, 1e5, 50.0, PADDLE_SPRING, 50.0)  # N/m, N·m/rad
HINGE_DAMPING = (80.0, 80.0, 80.0, 0.05, 0.05, 0.05)

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


def attitude():
    """Roll about z after pitch about y after yaw about x."""
    return product(about_axis(2, ROLL_DEG), product(about_axis(1, PITCH_DEG), about_axis(0, YAW_DEG)))


def paddle_attitude(raised_deg):
    """Attitude of a paddle at this angle above the mating plane, in its indicator."""
    return about_axis(1, -raised_deg)


# --- bodies ------------------------------------------------------------------------------------------------------------

def tip_rows(azimuth_deg):
    """Path of a latch's tip: up, over the fitting, down onto it."""
    corners = ((STOWED_RADIUS, STOWED_Z), (STOWED_RADIUS, REACH_Z), (CLOSED_RADIUS, REACH_Z), (CLOSED_RADIUS, CLOSED_Z))
    places = [radial(radius, azimuth_deg, z) for radius, z in corners]
    q = about_axis(2, azimuth_deg)

    def way(first, last):
        return lambda share: (tuple(f + share * (e - f) for f, e in zip(first, last)), q)

    legs = zip((RISE, SWING, PULL), places, places[1:])
    return joined(*(glide(times, way(first, last), STEPS) for times, first, last in legs))


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
    """Stiff except about y, about which the paddle's spring raises it."""
    for i in range(len(LATCH_AZIMUTHS)):
        fixed = on(f"indicator_{i}", HINGE, paddle_attitude(PADDLE_DEG))
        yield spring(fixed, on(f"indicator_{i}/paddle"), HINGE_STIFFNESS, HINGE_DAMPING)


# --- scenes ------------------------------------------------------------------------------------------------------------

def arm_rows():
    """Path of the arm's tip: in at constant speed to the hand-over, holds against the latches, then yields."""
    q = attitude()
    grip = turned(q, GRAPPLE)
    travel = START_GAP - HANDOVER_GAP

    def place(way):
        return tuple(s + g for s, g in zip((*OFFSET, START_GAP - way), grip))

    held = place(travel)

    def limp(share):
        return (tuple(h + share * (g - h) for h, g in zip(held, GRAPPLE)), UPRIGHT if share > 0.0 else q)

    return stroke(place, q, travel, SPEED) + glide(LIMP, limp, STEPS)


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
    hold = spring(on("arm"), on("passive", GRAPPLE), ARM_STIFFNESS, ARM_DAMPING)
    return scene("berthing", about, (*MODELS, "arm"), objects, PAIRS, BERTHED, 50, springs=[*hinges(), hold])


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
    return scene("press", about, MODELS, objects, PAIRS, PRESSED, 20, loads=[rest, load])


def roll_touch():
    """Roll at which, at ROLL_GAP, every fin touches the flare of a post, rad."""
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
    return scene("roll", about, MODELS, objects, PAIRS, ROLL_END, 50, loads=[f'(body: "passive", table: [{steps}]),'])

"""Scenes of the pallet (docs/scene_format.md): wheels on bearings, an arm that pushes through a six-axis spring."""

import math

from dimensions import *  # noqa: F403
from outcomes import turned

ARM_STIFFNESS = (5e3, 5e3, 5e3, 5e3, 5e3, 5e3)  # N/m, N·m/rad
ARM_DAMPING = (1.5e3, 1.5e3, 1.5e3, 7e3, 7e3, 7e3)
FIXTURE = (-PALLET_LENGTH / 2, 0.0, 0.0)  # where the arm holds the pallet

# Insertion: the arm holds the pallet off-centre all the way, as with an inaccurate view of the rails.
START_X = -1.800  # of the pallet's origin; the first rollers reach the flare 20 mm later
SPEED = 0.020
OVERTRAVEL = 0.060  # of the arm's tip beyond the seated pallet
OFFSET_Y, OFFSET_Z = 0.015, 0.008
YAW_DEG, PITCH_DEG = -0.5, 0.2
PRESS_TIME = 14.0  # s, for which the arm then holds still, out of line
ALIGN_TIME = 6.0  # in which it lines up with the rails
HOLD_TIME = 20.0

# Corner push: at one corner by a strut, which pushes along the rails and yields otherwise, against a drag in the
# middle. Its damping is near critical for the pallet.
STRUT_STIFFNESS = (5e3, 0.0, 0.0, 0.0, 0.0, 0.0)
STRUT_DAMPING = (5e3, 10.0, 10.0, 0.0, 0.0, 0.0)
CORNER_START_X = 1.530
CORNER_SPEED = 0.010
CORNER_TRAVEL = 0.120
CORNER_Y = 1.100
DRAG = 200.0


def texts():
    return {
        "scene_insertion.ron": insertion(),
        "scene_corner_push.ron": corner_push("corner_push", seized=False),
        "scene_corner_push_seized.ron": corner_push("corner_push_seized", seized=True),
    }


def numbers(values):
    return "(" + ", ".join(repr(round(float(x), 12) + 0.0) for x in values) + ")"


def attitude(yaw_deg, pitch_deg):
    """Quaternion of a yaw about z after a pitch about y."""
    cy, sy = math.cos(math.radians(yaw_deg) / 2), math.sin(math.radians(yaw_deg) / 2)
    cp, sp = math.cos(math.radians(pitch_deg) / 2), math.sin(math.radians(pitch_deg) / 2)
    return (cy * cp, -sy * sp, cy * sp, sy * cp)


# --- bodies ----------------------------------------------------------------------------------------------------------

def pallet(position, orientation):
    bodies = [
        f"(motion: Free, mass: {PALLET_MASS}, inertia: Diagonal{numbers(PALLET_INERTIA)}, "
        f"position: {numbers(position)}, orientation: {numbers(orientation)}),"
    ]
    for name in WHEELS:
        mass, radius = wheel_mass(name), wheel_radius(name)
        inertia = [mass * (3 * radius**2 + (2 * wheel_half_width(name)) ** 2) / 12] * 3  # of a cylinder
        inertia[axle(name)] = mass * radius**2 / 2
        bodies.append(f'(group: "{name}", motion: Free, mass: {mass}, inertia: Diagonal{numbers(inertia)}),')
    return ['(name: "pallet", model: "pallet", bodies: ['] + ["    " + line for line in bodies] + ["]),"]


def arm(rows):
    """The arm's tip through positions at times."""
    lines = [f"(time: {time!r}, position: {numbers(p)}, orientation: {numbers(q)})," for time, p, q in rows]
    head = '(name: "arm", model: "arm", bodies: [(motion: Prescribed(Table(['
    return [head] + ["    " + line for line in lines] + ["])))]),"]


def stroke(place, attitude_, travel, speed, stops=True):
    """Rows along x: at rest for a second, up to speed within two, steady, and with `stops` to rest within two."""
    braking = 2 * speed if stops else 0.0  # m from where it slows down
    even = (travel - braking) / speed - 2.0  # seconds of even motion behind t = 4
    rows = [(0.0, 0.0), (1.0, 0.0), (3.0, speed), (4.0, 2 * speed), (4.0 + even, travel - braking)]
    if stops:
        rows += [(5.0 + even, travel - speed), (7.0 + even, travel), (8.0 + even, travel)]
    return [(round(time, 9), (place[0] + x, place[1], place[2]), attitude_) for time, x in rows]


def line_up(last, pose):
    """Rows from the last one to a pose: at rest for a while, and at rest before and after the move."""
    start = last[0] - 1.0 + PRESS_TIME
    end = start + ALIGN_TIME
    out_of_line = [(time, *last[1:]) for time in (start, start + 1.0)]
    return out_of_line + [(time, *pose) for time in (end - 1.0, end, end + HOLD_TIME)]


# --- springs ---------------------------------------------------------------------------------------------------------

def spring(first, second, stiffness, damping):
    return f"(first: {first}, second: {second}, stiffness: {numbers(stiffness)}, damping: {numbers(damping)}),"


def on(body, position):
    return f'On(body: "{body}", position: {numbers(position)})'


def bearings(name, seized):
    """Two bearings, each a spring along three axes: free to turn about the axle, at any angle."""
    axis = axle(name)
    share = [AXIAL_SHARE if i == axis else 1.0 for i in range(3)]
    stiffness = [BEARING_STIFFNESS * s for s in share] + [0.0, 0.0, 0.0]
    damping = [BEARING_DAMPING * s for s in share] + [0.0, 0.0, 0.0]
    lines = []
    for side in (-1, 1):
        at = [0.0, 0.0, 0.0]
        at[axis] = side * BEARING_HALF_SPAN
        place = [p + d for p, d in zip(WHEELS[name], at)]
        damping[3 + axis] = BEARING_DRAG / 2
        if seized:
            stiffness[3 + axis], damping[3 + axis] = SEIZED_STIFFNESS, SEIZED_DAMPING
        lines.append(spring(on("pallet", place), on(f"pallet/{name}", at), stiffness, damping))
    return lines


def all_bearings(seized=False):
    return [line for name in WHEELS for line in bearings(name, seized and is_roller(name))]


# --- scenes ----------------------------------------------------------------------------------------------------------

def scene(name, about, objects, loads, springs, duration, record_every):
    lines = [f"// {line}" for line in about]
    lines += ["(", '    format: "pong-scene",', "    version: 1,", f'    name: "{name}",']
    lines += ['    models: { "pallet": "pallet.ron", "rails": "rails.ron", "arm": "arm.ron" },']
    lines += ["    objects: ["] + ["        " + line for line in objects] + ["    ],"]
    lines += ['    pairs: [("pallet", "rails")],']
    lines += ["    loads: ["] + ["        " + line for line in loads] + ["    ],"] if loads else []
    lines += ["    springs: ["] + ["        " + line for line in springs] + ["    ],"]
    lines += ["    integrator: RungeKutta4,", "    step: 1e-3,", f"    duration: {duration!r},"]
    lines += [f"    record_every: {record_every},", "    ledger: true,", ")"]
    return "\n".join(lines) + "\n"


RAILS = '(name: "rails", model: "rails", bodies: [(motion: Fixed)]),'


def insertion():
    q = attitude(YAW_DEG, PITCH_DEG)
    start = (START_X, OFFSET_Y, OFFSET_Z)
    grip = [p + d for p, d in zip(start, turned(q, FIXTURE))]
    travel = SEATED_X - START_X + OVERTRAVEL
    rows = stroke(grip, q, travel, SPEED)
    rows += line_up(rows[-1], ((SEATED_X + OVERTRAVEL + FIXTURE[0], 0.0, 0.0), (1.0, 0.0, 0.0, 0.0)))
    about = [
        "The pallet is pushed into its rails at 20 mm/s by an arm that holds it 15 mm and 8 mm off-centre, yawed by",
        "-0.5 and pitched by 0.2 degrees, until it presses against the stops; then the arm lines up.",
        "Written by build.py.",
    ]
    objects = [RAILS, *pallet(start, q), *arm(rows)]
    push = spring('On(body: "arm")', on("pallet", FIXTURE), ARM_STIFFNESS, ARM_DAMPING)
    return scene("insertion", about, objects, [], [*all_bearings(), push], rows[-1][0], 500)


def corner_push(name, seized):
    q = (1.0, 0.0, 0.0, 0.0)
    start = (CORNER_START_X, 0.0, 0.0)
    corner = (FIXTURE[0], CORNER_Y, 0.0)
    grip = [p + d for p, d in zip(start, corner)]
    rows = stroke(grip, q, CORNER_TRAVEL, CORNER_SPEED, stops=False)
    about = [
        "With all wheels in the rails, a strut pushes the pallet at its left corner, against a drag of 200 N in the",
        "middle: the side rollers load one rail in front and the other behind. "
        + ("They are seized. " if seized else "") + "Written by build.py.",
    ]
    push = spring('On(body: "arm")', on("pallet", corner), STRUT_STIFFNESS, STRUT_DAMPING)
    drag = f'(body: "pallet", table: [(time: 1.0), (time: 5.0, force: {numbers((-DRAG, 0.0, 0.0))})]),'
    objects = [RAILS, *pallet(start, q), *arm(rows)]
    return scene(name, about, objects, [drag], [*all_bearings(seized), push], rows[-1][0], 50)

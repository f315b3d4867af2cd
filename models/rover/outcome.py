"""Outcomes of the rover's scenes: closed forms, or bounds without one. Run by models/outcomes.py."""

import math

import tyre
from dimensions import *  # noqa: F403
from outcomes import force, norm, orientation, position, speed, turned
from scenes import *  # noqa: F403

WEIGHT = GROSS_MASS * GRAVITY
UNSPRUNG = (HUB_MASS + WHEEL_MASS) * GRAVITY


# --- readings ----------------------------------------------------------------------------------------------------------

def mean(values):
    values = list(values)
    return sum(values) / len(values)


def within(rows, start, end=math.inf):
    return [row for row in rows if start <= row["time_s"] <= end]


def trend(rows, key):
    """Slope over time of a straight line through a column."""
    middle, level = mean(row["time_s"] for row in rows), mean(row[key] for row in rows)
    top = sum((row["time_s"] - middle) * (row[key] - level) for row in rows)
    return top / sum((row["time_s"] - middle) ** 2 for row in rows)


def wheel_rows(run, table, name):
    return run.of(table, f"rover/wheel_{name}")


def carried(run, name, start):
    """Mean upward force of the ground on a wheel from a time on."""
    return mean(row["fz_n"] for row in within(wheel_rows(run, "wrenches", name), start))


def tilt_deg(row):
    return math.degrees(math.acos(min(1.0, turned(orientation(row), (0.0, 0.0, 1.0))[2])))


def touched(run, name):
    """Elements of the ground with `name` in their names that wheels touched."""
    rows = run.table("contacts")
    return {row["b"] for row in rows if row["a"].startswith("rover/rover/wheel") and name in row["b"]}


def frame_contacts(run):
    """Contacts of other parts than wheels: frame and hubs."""
    return sum(1 for row in run.table("contacts") if "/wheel_" not in row["a"])


# --- the rover at rest -------------------------------------------------------------------------------------------------

def static_loads():
    """Wheel loads, N: four equal springs under a body with an off-centre mass centre, which moves as it tilts."""
    rate = 1e-4  # of the tyre about its mean load, by differences
    grown = tyre.height_under(tyre.CORNER_WEIGHT * (1 - rate)) - tyre.height_under(tyre.CORNER_WEIGHT * (1 + rate))
    tyre_stiffness = 2 * rate * tyre.CORNER_WEIGHT / grown
    stiffness = SUSPENSION_STIFFNESS * tyre_stiffness / (SUSPENSION_STIFFNESS + tyre_stiffness)
    weight = CHASSIS_MASS * GRAVITY
    shares = []
    for offset, half in zip(MASS_CENTER, (WHEELBASE / 2, TRACK / 2)):
        upset = weight * MASS_CENTER[2] / (4 * stiffness * half**2)
        shares.append(weight * offset / (1 - upset) / (4 * half))
    return {
        name: weight / 4 + UNSPRUNG + shares[0] * (1 if x > 0 else -1) + shares[1] * (1 if y > 0 else -1)
        for name, (x, y, _) in WHEELS.items()
    }


def stand(run):
    expected = static_loads()
    total = -run.of("wrenches", "ground")[-1]["fz_n"]
    yield "weight on the ground over that of the rover", total / WEIGHT, 0.9999, 1.0001
    for name in WHEELS:
        load = carried(run, name, 11.0)
        yield f"load of {name} over its share", load / expected[name], 0.995, 1.005
        axle = run.last(f"rover/wheel_{name}")["z_m"]
        sag = (WHEEL_RADIUS - axle) / (WHEEL_RADIUS - tyre.height_under(load, phase=0.0))
        yield f"sag of the tyre {name} over load by stiffness", sag, 0.995, 1.005
        corner = position(run.last("rover"))[2] + turned(orientation(run.last("rover")), WHEELS[name])[2]
        travel = run.last(f"rover/hub_{name}")["z_m"] - corner
        law = (load - UNSPRUNG - CHASSIS_MASS * GRAVITY / 4) / SUSPENSION_STIFFNESS
        yield f"travel of the suspension {name} off load by stiffness, mm", (travel - law) * 1e3, -0.1, 0.1
    yield "speed at the end, mm/s", speed(run.last("rover")) * 1e3, 0.0, 0.2


# --- slopes ------------------------------------------------------------------------------------------------------------

def hold(run):
    rows = run.of("states", "rover")
    yield "friction used, of what there is", grip(run), share_of_limit(HOLD_DEG) - 0.002, share_of_limit(HOLD_DEG) + 0.002
    yield "way downhill in the last three seconds, mm", (within(rows, 9.0)[0]["x_m"] - rows[-1]["x_m"]) * 1e3, -0.05, 0.05
    yield "speed at the end, mm/s", speed(rows[-1]) * 1e3, 0.0, 0.1


def share_of_limit(degrees):
    return math.tan(math.radians(degrees)) / FRICTION


def grip(run):
    """Forces of the wheels along the slope, relative to μ times the normal ones, at the end."""
    rows = [wheel_rows(run, "wrenches", name)[-1] for name in WHEELS]
    return sum(row["fx_n"] for row in rows) / (FRICTION * sum(row["fz_n"] for row in rows))


def slide(run):
    angle = math.radians(SLIDE_DEG)
    expected = -GRAVITY * (math.sin(angle) - FRICTION * math.cos(angle))
    rows = within(run.of("states", "rover"), 2.0)
    yield "acceleration over -g(sin - μ·cos)", trend(rows, "vx_m_per_s") / expected, 0.99, 1.01
    yield "friction used, of what there is", grip(run), 0.999999, 1.000001


def rolling(load, spin):
    """Height of a wheel's axle, and the force at the axle for rolling."""
    height = tyre.height_under(load, spin)
    return height, tyre.rolling_moment(height, spin) / height


def climb(run):
    angle = math.radians(CLIMB_DEG)
    spin = mean(row["wy_rad_per_s"] for row in within(wheel_rows(run, "states", "front_left"), 2.0))
    height, drag = rolling(WEIGHT * math.cos(angle) / 4, spin)
    force_ = 4 * (CLIMB_TORQUE / height - drag) - WEIGHT * math.sin(angle)
    expected = force_ / (GROSS_MASS + 4 * WHEEL_SPIN_INERTIA / height**2)
    rows = within(run.of("states", "rover"), 2.0)
    yield "acceleration over the closed form", trend(rows, "vx_m_per_s") / expected, 0.98, 1.02
    traction = (WEIGHT * math.sin(angle) + GROSS_MASS * expected) / 4
    yield "slip of the wheels over that of brushes", slips(run) / brush_slip(traction, height), 0.8, 1.2


def slip(run, name):
    """Relative slip of a wheel over the last second: the speed lost against rolling."""
    rows = within(wheel_rows(run, "states", name), run.times()[-1] - 1.0)
    return 1 - mean(row["vx_m_per_s"] for row in rows) / mean(row["wy_rad_per_s"] * row["z_m"] for row in rows)


def slips(run):
    return mean(slip(run, name) for name in WHEELS)


def brush_slip(traction, height):
    """Spheres enter the contact ahead with straight bristles, which bend by the slip times their distance since."""
    phases = 8
    ways = 0.0
    for i in range(phases):
        aheads = [ahead for ahead, _ in tyre.balls(height, phase=i / phases)]
        entry = math.sqrt(RING_RADIUS**2 - (height - BALL_RADIUS) ** 2)
        ways += sum(entry - ahead for ahead in aheads) / phases
    return traction / (BALL_BRISTLE * ways)


def coast(run):
    rows = within(run.of("states", "rover"), 1.0)
    height, drag = rolling(WEIGHT / 4, mean(row["vx_m_per_s"] for row in rows) / tyre.STATIC_HEIGHT)
    expected = -4 * drag / (GROSS_MASS + 4 * WHEEL_SPIN_INERTIA / height**2)
    yield "deceleration over that of the tyres' damping", trend(rows, "vx_m_per_s") / expected, 0.97, 1.03
    yield "rolling resistance over weight", -trend(rows, "vx_m_per_s") / GRAVITY, 0.005, 0.05
    # Steps of 1 ms to 0.125 ms all give 0.774: the brush model neglects friction in a sphere's first and last path
    # under little load.
    yield "slip of the wheels over that of brushes", slips(run) / brush_slip(expected * GROSS_MASS / 4, height), 0.7, 1.2


# --- obstacles ---------------------------------------------------------------------------------------------------------

def rise(rows):
    return max(row["z_m"] for row in rows) - rows[0]["z_m"]


def stone(run):
    for where in ("front", "rear"):
        left, right = (rise(wheel_rows(run, "states", f"{where}_{label}")) for _, label in SIDES)
        yield f"rise of the {where} left wheel over the stone's height", left / STONE, 0.6, 1.1
        yield f"rise of the {where} right wheel, mm", right * 1e3, 0.0, 40.0
    yield "way, m", run.last("rover")["x_m"] - run.of("states", "rover")[0]["x_m"], 5.0, DRIVE_SPEED * 6.0
    yield "greatest tilt, degrees", max(map(tilt_deg, run.of("states", "rover"))), 1.0, 6.0
    yield "off its line at the end, mm", abs(run.last("rover")["y_m"]) * 1e3, 0.0, 100.0
    yield "contacts of hubs and frame", frame_contacts(run), 0, 0


def step_short(run):
    """A rigid wheel rises over the edge if its torque is above weight times the axle's distance behind the edge."""
    rows = run.of("states", "rig_rigid")
    yield "rise of the axle at most, mm", rise(rows) * 1e3, -1.0, 4.0
    yield "way towards the step, mm", (rows[-1]["x_m"] - rows[0]["x_m"]) * 1e3, -1.0, 4.0
    yield "speed at the end, mm/s", speed(rows[-1]) * 1e3, 0.0, 1.0


def step_over(run):
    rows = run.of("states", "rig_rigid")
    above = min(row["z_m"] for row in rows if row["x_m"] > 0.3) - WHEEL_RADIUS
    yield "height of the axle above that on the ground, mm", above * 1e3, (STEP - 0.005) * 1e3, STEP * 1e3
    yield "way past the step's edge, m", rows[-1]["x_m"], 0.5, 2.9


def roll(run, kind):
    """Load of one wheel on level triangles, beside the stone, and on the bar."""
    loads = [row["fz_n"] for row in within(run.of("wrenches", f"rig_{kind}/wheel"), 1.0) if row["time_s"] < 1.9]
    heights = [(row["x_m"], row["z_m"] - tyre.STATIC_HEIGHT) for row in run.of("states", f"rig_{kind}")]
    ripple = (max(loads) - min(loads)) / 2 / mean(loads)
    beside = max(z for x, z in heights if 1.5 < x < 2.5)
    bar = max(z for x, z in heights if 3.5 < x < 4.5)
    return mean(loads) / tyre.CORNER_WEIGHT, ripple, beside, bar


def roll_balls(run):
    level, ripple, beside, bar = roll(run, "balls")
    yield "load on the level over weight", level, 0.995, 1.005
    yield "ripple of the load, of its mean", ripple, 0.0, 0.035
    yield "rise beside the stone, mm", beside * 1e3, -2.0, 2.0
    yield "rise over the bar, of its height", bar / BAR, 0.5, 2.5


def roll_one_spring(run, kind):
    level, ripple, beside, bar = roll(run, kind)
    yield "load on the level over weight", level, 0.995, 1.005
    yield "ripple of the load, of its mean", ripple, 0.0, 0.02
    yield "rise beside the stone, mm", beside * 1e3, -2.0, 2.0
    yield "rise over the bar, of its height", bar / BAR, 0.5, 2.5


def roll_ellipsoid(run):
    return roll_one_spring(run, "ellipsoid")


def roll_cylinder(run):
    return roll_one_spring(run, "cylinder")


def roll_sphere(run):
    """Defect of a sphere as large as the wheel: it climbs objects beside its path."""
    level, ripple, beside, _ = roll(run, "sphere")
    yield "load on the level over weight", level, 0.995, 1.005
    yield "ripple of the load, of its mean", ripple, 0.0, 0.02
    yield "rise beside the stone, mm", beside * 1e3, 100.0, 300.0


# --- terrain -----------------------------------------------------------------------------------------------------------

def traverse(run):
    rows = run.of("states", "rover")
    yield "way, m", rows[-1]["x_m"] - rows[0]["x_m"], 0.9 * DRIVE_SPEED * TRAVERSE_TIME, DRIVE_SPEED * TRAVERSE_TIME
    yield "greatest tilt, degrees", max(map(tilt_deg, rows)), 2.0, 15.0
    yield "rocks that wheels rolled over", len(touched(run, "/rock_")), 5, ROCKS
    yield "boulders that wheels rolled over", len(touched(run, "/boulder_")), 1, BOULDERS
    for name in WHEELS:
        forces = [norm(force(row)) for row in wheel_rows(run, "wrenches", name)]
        yield f"mean force on {name}, of a quarter of the weight", mean(forces) / tyre.CORNER_WEIGHT, 0.75, 1.25
        yield f"greatest force on {name}, of a quarter of the weight", max(forces) / tyre.CORNER_WEIGHT, 1.0, 4.0
    yield "contacts of hubs and frame", frame_contacts(run), 0, 0


OUTCOMES = {
    "scene_stand.ron": stand,
    "scene_hold.ron": hold,
    "scene_slide.ron": slide,
    "scene_climb.ron": climb,
    "scene_coast.ron": coast,
    "scene_stone.ron": stone,
    "scene_step_short.ron": step_short,
    "scene_step_over.ron": step_over,
    "scene_roll_balls.ron": roll_balls,
    "scene_roll_ellipsoid.ron": roll_ellipsoid,
    "scene_roll_sphere.ron": roll_sphere,
    "scene_roll_cylinder.ron": roll_cylinder,
    "scene_traverse.ron": traverse,
}

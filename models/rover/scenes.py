"""Scenes of the rover and of one wheel on a rig (docs/scene_format.md)."""

import math

import tyre
from dimensions import *  # noqa: F403

STEP = 0.050  # height of the step that one wheel climbs, m
STONE = 0.150  # height of the stone under the left wheels
BAR = 0.060  # height of the bar on the track
HOLD_DEG, SLIDE_DEG, CLIMB_DEG = 25.0, 35.0, 12.0
CLIMB_TORQUE = 35.0  # of each motor, N·m
COAST_SPEED = 1.5
DRIVE_SPEED = 1.2  # that the motors are told, m/s
DRIVE_GAIN = 40.0  # torque of a motor over what its wheel is too slow by, N·m·s/rad
STEP_DRAG = 200.0  # of the rig, so that the wheel does not rock between ground and edge, N·s/m
STEP_TORQUES = {"short": 0.97, "over": 1.03}  # of what the step takes
TRAVERSE_TIME = 12.0
RIG_SPEED = 1.0
RIG_START = -0.5
SPRUNG = CHASSIS_MASS / 4 + HUB_MASS  # on the axle of the rig


def texts():
    level = slope(0.0)
    made = {
        "stand": rover_scene(
            "stand", "The rover is set down on level ground and comes to rest.", "ground", level, 0.0, brake, 12.0
        ),
        "hold": rover_scene(
            "hold", f"Braked on a slope of {HOLD_DEG:g} degrees, facing up: it stays.",
            "ground", slope(HOLD_DEG), 0.0, brake, 12.0,
        ),
        "slide": rover_scene(
            "slide", f"Braked on a slope of {SLIDE_DEG:g} degrees, facing up: it slides.",
            "ground", slope(SLIDE_DEG), 0.0, brake, 4.0,
        ),
        "climb": rover_scene(
            "climb", f"Four motors of {CLIMB_TORQUE:g} N·m drive up a slope of {CLIMB_DEG:g} degrees.",
            "ground", slope(CLIMB_DEG), 0.0, torque, 5.0,
        ),
        "coast": rover_scene(
            "coast", f"Rolls freely on level ground, at first at {COAST_SPEED:g} m/s.",
            "ground", level, COAST_SPEED, free, 4.0,
        ),
        "stone": rover_scene(
            "stone", f"Drives with its left wheels over a stone of {STONE:g} m.",
            "stone", level, DRIVE_SPEED, drive, 6.0, at=-2.5,
        ),
        "traverse": rover_scene(
            "traverse", "Drives over the relief and its rocks.",
            "terrain", level, DRIVE_SPEED, drive, TRAVERSE_TIME, at=-2.3,
        ),
    }
    for name in STEP_TORQUES:
        made[f"step_{name}"] = step_scene(name)
    for kind in ("balls", "ellipsoid", "sphere", "cylinder"):
        made[f"roll_{kind}"] = roll_scene(kind)
    return {f"scene_{name}.ron": text for name, text in made.items()}


def numbers(values):
    return "(" + ", ".join(repr(round(float(x), 12) + 0.0) for x in values) + ")"


def slope(degrees):
    """Gravity along and across a slope that rises ahead; the ground stays in the plane z = 0."""
    angle = math.radians(degrees)
    return (-GRAVITY * math.sin(angle), 0.0, -GRAVITY * math.cos(angle))


# --- springs -----------------------------------------------------------------------------------------------------------

def on(body, position):
    return f'On(body: "{body}", position: {numbers(position)})'


def spring(first, second, stiffness, damping, preload=None):
    text = f"(first: {first}, second: {second}, stiffness: {numbers(stiffness)}, damping: {numbers(damping)}"
    return text + (")," if preload is None else f", preload: {numbers(preload)}),")


def suspension(name):
    """Stiff except vertically, and preloaded so that it is in its middle under the mean weight."""
    stiffness = (ARM_STIFFNESS, ARM_STIFFNESS, SUSPENSION_STIFFNESS, *ARM_TURNING)
    damping = (ARM_DAMPING, ARM_DAMPING, SUSPENSION_DAMPING, *ARM_TURNING_DAMPING)
    preload = (0.0, 0.0, -CHASSIS_MASS * GRAVITY / 4, 0.0, 0.0, 0.0)
    return spring(on("rover", WHEELS[name]), f'On(body: "rover/hub_{name}")', stiffness, damping, preload)


def bearings(hub, wheel):
    """Two bearings, each a spring along three axes: the wheel is free to turn about its axle, at any angle."""
    stiffness = (BEARING_STIFFNESS,) * 3 + (0.0, 0.0, 0.0)
    damping = (BEARING_DAMPING,) * 3 + (0.0, 0.0, 0.0)
    ends = [(0.0, side * BEARING_HALF_SPAN, 0.0) for side in (1, -1)]
    return [spring(on(hub, end), on(wheel, end), stiffness, damping) for end in ends]


def about_axle(hub, wheel, stiffness=0.0, damping=0.0):
    axle = [(0.0, 0.0, 0.0, 0.0, value, 0.0) for value in (stiffness, damping)]
    return spring(f'On(body: "{hub}")', f'On(body: "{wheel}")', *axle)


# --- what turns or holds a wheel: springs and loads ------------------------------------------------------------------

def moments(hub, wheel, moment, rise=0.0):
    """Moments of a motor, on the wheel and back on the hub, which grow to their full value within `rise`, s.

    Loads, not a preload of a spring about the axle: a preload's energy would jump at every half turn.
    """
    lines = []
    for body, value in ((wheel, moment), (hub, -moment)):
        full = f"moment: {numbers((0.0, value, 0.0))}"
        told = f"table: [(time: 0.0), (time: {rise!r}, {full})]" if rise else full
        lines.append(f'(body: "{body}", axes: Body, {told}),')
    return lines


def free(hub, wheel):
    return [], []


def brake(hub, wheel):
    return [about_axle(hub, wheel, BRAKE_STIFFNESS, BRAKE_DAMPING)], []


def torque(hub, wheel, moment=CLIMB_TORQUE, rise=0.0):
    return [], moments(hub, wheel, moment, rise)


def drive(hub, wheel, speed=DRIVE_SPEED):
    """A motor with a torque of DRIVE_GAIN times the speed error of its wheel."""
    moment = DRIVE_GAIN * speed / tyre.STATIC_HEIGHT
    return [about_axle(hub, wheel, damping=DRIVE_GAIN)], moments(hub, wheel, moment)


# --- bodies ------------------------------------------------------------------------------------------------------------

def free_body(group, mass, inertia, velocity=0.0, spin=0.0, extra=""):
    text = f"(motion: Free, mass: {mass!r}, inertia: Diagonal{numbers(inertia)}{extra}"
    text = text if not group else f'(group: "{group}", ' + text[1:]
    text += f", linear_velocity: {numbers((velocity, 0.0, 0.0))}" if velocity else ""
    text += f", angular_velocity: {numbers((0.0, spin, 0.0))}" if spin else ""
    return text + "),"


WHEEL_INERTIA = (WHEEL_CROSS_INERTIA, WHEEL_SPIN_INERTIA, WHEEL_CROSS_INERTIA)


def rover_bodies(x, speed):
    spin = speed / tyre.STATIC_HEIGHT
    place = f", mass_center: {numbers(MASS_CENTER)}, position: {numbers((x, 0.0, tyre.STATIC_HEIGHT))}"
    lines = [free_body("", CHASSIS_MASS, CHASSIS_INERTIA, speed, extra=place)]
    for name in WHEELS:
        lines.append(free_body(f"hub_{name}", HUB_MASS, HUB_INERTIA, speed))
        lines.append(free_body(f"wheel_{name}", WHEEL_MASS, WHEEL_INERTIA, speed, spin))
    return lines


def rig_bodies(x, z, speed):
    place = f", position: {numbers((x, 0.0, z))}"
    return [
        free_body("", SPRUNG, (10.0, 10.0, 10.0), speed, extra=place),
        free_body("wheel", WHEEL_MASS, WHEEL_INERTIA, speed, speed / tyre.STATIC_HEIGHT),
    ]


# --- scenes ------------------------------------------------------------------------------------------------------------

def scene(name, about, moving, bodies, ground, gravity, springs, loads, duration, record_every=20):
    lines = [f"// {about} Written by build.py.", "("]
    lines += ['    format: "pong-scene",', "    version: 1,", f'    name: "{name}",']
    lines += [f'    models: {{ "{moving}": "{moving}.ron", "{ground}": "{ground}.ron" }},', "    objects: ["]
    lines += [f'        (name: "{moving}", model: "{moving}", bodies: [']
    lines += ["            " + line for line in bodies] + ["        ]),"]
    lines += [f'        (name: "{ground}", model: "{ground}", bodies: [(motion: Fixed)]),', "    ],"]
    lines += [f'    pairs: [("{moving}", "{ground}")],', f"    gravity: {numbers(gravity)},", "    springs: ["]
    lines += ["        " + line for line in springs] + ["    ],"]
    lines += ["    loads: ["] + ["        " + line for line in loads] + ["    ],"] if loads else []
    lines += ["    integrator: RungeKutta4,", "    step: 1e-3,", f"    duration: {duration!r},"]
    lines += [f"    record_every: {record_every},", "    ledger: true,", ")"]
    return "\n".join(lines) + "\n"


def rover_scene(name, about, ground, gravity, speed, motor, duration, at=0.0):
    springs, loads = [], []
    for wheel in WHEELS:
        hub, turning = f"rover/hub_{wheel}", f"rover/wheel_{wheel}"
        held, driven = motor(hub, turning)
        springs += [suspension(wheel), *bearings(hub, turning), *held]
        loads += driven
    return scene(name, about, "rover", rover_bodies(at, speed), ground, gravity, springs, loads, duration)


def guide(rig, drag):
    """Holds the carriage of the rig upright and on its line; it may move ahead and up, with a drag in N·s/m."""
    stiffness, damping = (0.0, 1e5, 0.0, 1e5, 1e5, 1e5), (drag, 1e3, drag, 500.0, 500.0, 500.0)
    return spring("Ground()", f'On(body: "{rig}")', stiffness, damping)


def rig_scene(name, about, rig, ground, x, z, speed, motor, duration, drag=0.0):
    held, driven = motor
    springs = [guide(rig, drag), *bearings(rig, f"{rig}/wheel"), *held]
    level = (0.0, 0.0, -GRAVITY)
    return scene(name, about, rig, rig_bodies(x, z, speed), ground, level, springs, driven, duration)


def step_lever(height=STEP):
    """Distance of a rigid wheel's axle behind the edge of a step against which it rests, m."""
    return math.sqrt(WHEEL_RADIUS**2 - (WHEEL_RADIUS - height) ** 2)


def step_torque():
    return (SPRUNG + WHEEL_MASS) * GRAVITY * step_lever()


def step_scene(name):
    share = STEP_TORQUES[name]
    about = f"A rigid wheel against a step of {STEP:g} m, with {share:g} of the torque that climbing takes."
    motor = torque("rig_rigid", "rig_rigid/wheel", share * step_torque(), rise=2.0)
    return rig_scene(
        f"step_{name}", about, "rig_rigid", "step", -step_lever(), WHEEL_RADIUS, 0.0, motor, 6.0, drag=STEP_DRAG
    )


def roll_scene(kind):
    rig = f"rig_{kind}"
    about = f"One wheel ({kind}) past a stone beside its way and over a bar of {BAR:g} m."
    motor = drive(rig, f"{rig}/wheel", RIG_SPEED)
    text = rig_scene(
        f"roll_{kind}", about, rig, "track", RIG_START, tyre.STATIC_HEIGHT, RIG_SPEED, motor, 6.0
    )
    return with_alternatives(text, rig, ("ellipsoid", "sphere")) if kind == "balls" else text


def with_alternatives(text, rig, kinds):
    """A scene that names other wheels, for `pong trade`."""
    others = ", ".join(f'(name: "{kind}", models: {{ "{rig}": "rig_{kind}.ron" }})' for kind in kinds)
    return text.removesuffix(")\n") + f"    alternatives: [{others}],\n)\n"

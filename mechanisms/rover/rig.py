"""A six-wheeled rover with rocker-bogie suspension on a ground, as MJCF."""

import math

import dimensions as d
from dimensions import model
from kit import mjcf
from kit.machine import Machine

WHEELS = [f"{where}_{side}" for side in d.SIDES for where in d.AXLE_X]
CORNERS = [name for name in WHEELS if not name.startswith("middle")]
BLUE, STEEL, DARK = "0.3 0.45 0.65 1", "0.55 0.57 0.6 1", "0.35 0.33 0.3 1"


def rod(length, mass):
    return f'diaginertia="{0.01 * mass:.6g} {mass * length**2 / 12:.6g} {mass * length**2 / 12:.6g}"'


def wheel(name, locked):
    inertia = mjcf.numbers((model.WHEEL_CROSS_INERTIA, model.WHEEL_SPIN_INERTIA, model.WHEEL_CROSS_INERTIA))
    joint = f'<joint name="drive_{name}" axis="0 1 0" armature="{d.ROTOR_INERTIA}"/>'
    half = model.WHEEL_WIDTH / 2
    return (
        f'<body name="wheel_{name}">{"" if locked else joint}<inertial pos="0 0 0" mass="{model.WHEEL_MASS}" '
        f'diaginertia="{inertia}"/><geom type="cylinder" fromto="0 {-half} 0 0 {half} 0" size="{model.WHEEL_RADIUS}" '
        f'rgba="{DARK}"/><geom type="box" size="{0.9 * model.WHEEL_RADIUS} {half * 1.02} 0.02" rgba="{STEEL}"/></body>'
    )


def hub(name, x, z, locked):
    """Hub of a wheel; those at the corners turn about the upright to steer."""
    steer = f'<joint name="steer_{name}" axis="0 0 1" armature="1"/>' if name in CORNERS and not locked else ""
    return (
        f'<body name="hub_{name}" pos="{x:.12g} 0 {z:.12g}">{steer}<inertial pos="0 0 0" mass="{d.STEER_MASS}" '
        f'diaginertia="{mjcf.numbers(model.HUB_INERTIA)}"/>{wheel(name, locked)}</body>'
    )


def pivot(name):
    return f'<joint name="{name}" axis="0 1 0" damping="{d.PIVOT_DAMPING}"/>'


def bogie(side, locked):
    half = d.AXLE_X["middle"] - d.BOGIE_X
    inside = hub(f"middle_{side}", half, -d.BOGIE_Z, locked) + hub(f"rear_{side}", -half, -d.BOGIE_Z, locked)
    return (
        f'<body name="bogie_{side}" pos="{d.BOGIE_X:.12g} 0 {d.BOGIE_Z - d.ROCKER_Z:.12g}">{pivot(f"bogie_{side}")}'
        f'<inertial pos="0 0 0" mass="{d.BOGIE_MASS}" {rod(2 * half, d.BOGIE_MASS)}/>'
        f'<geom type="capsule" fromto="{-half} 0 0 {half} 0 0" size="0.03" rgba="{STEEL}"/>{inside}</body>'
    )


def rocker(side, locked):
    front = d.AXLE_X["front"]
    drawn = (
        f'<geom type="capsule" fromto="{front} 0 {-d.ROCKER_Z} 0 0 0" size="0.035" rgba="{STEEL}"/>'
        f'<geom type="capsule" fromto="{d.BOGIE_X} 0 {d.BOGIE_Z - d.ROCKER_Z} 0 0 0" size="0.035" rgba="{STEEL}"/>'
    )
    return (
        f'<body name="rocker_{side}" pos="0 {d.SIDES[side] * d.HALF_TRACK} {d.ROCKER_Z}">{pivot(f"rocker_{side}")}'
        f'<inertial pos="0 0 0" mass="{d.ROCKER_MASS}" {rod(2 * front, d.ROCKER_MASS)}/>{drawn}'
        f"{hub(f'front_{side}', front, -d.ROCKER_Z, locked)}{bogie(side, locked)}</body>"
    )


def chassis(place, locked):
    return (
        f'<body name="chassis" pos="{mjcf.numbers(place)}"><freejoint name="chassis"/>'
        f'<inertial pos="0 0 {d.CHASSIS_Z}" mass="{d.CHASSIS_MASS:.12g}" diaginertia="{mjcf.numbers(d.CHASSIS_INERTIA)}"/>'
        f'<geom type="box" pos="0 0 {d.CHASSIS_Z}" size="1.1 0.6 0.15" rgba="{BLUE}"/>'
        f"{''.join(rocker(side, locked) for side in d.SIDES)}</body>"
    )


# The chassis turns by the mean of both rockers: one rocker's rise is the other's descent.
DIFFERENTIAL = (
    '<equality><joint joint1="rocker_left" joint2="rocker_right" polycoef="0 -1 0 0 0" solref="0.01 1" '
    'solimp="0.999 0.9999 0.001"/></equality>'
)


def steering(name):
    return (
        f'<general name="steer_{name}" joint="steer_{name}" gainprm="{d.STEER_STIFFNESS}" biastype="affine" '
        f'biasprm="0 {-d.STEER_STIFFNESS} {-d.STEER_DAMPING}" forcelimited="true" '
        f'forcerange="{-d.STEER_TORQUE} {d.STEER_TORQUE}"/>'
    )


def slope(angle):
    """Gravity along and across a slope that rises ahead; the ground stays in the plane z = 0."""
    return (-model.GRAVITY * math.sin(angle), 0.0, -model.GRAVITY * math.cos(angle))


def machine(
    level, ground="floor", angle=0.0, x=0.0, more_ground="", locked=False, step=None, height=0.0, friction=None
):
    """Rover on the floor, with rigid wheels, or on a ground of models/rover. `more_ground`: height of a step up at x =
    0, m, if any.

    `angle`: of a slope that rises ahead. `locked`: wheels and steering do not turn. `friction`: of all surfaces.
    """
    tyre = d.TYRES[level.tyre]
    objects = {"ground": "floor.ron" if ground == "floor" else f"{d.OF_MODEL}{ground}.ron"}
    bodies, carriers, world = {"ground": "world"}, ["world"], ""
    if more_ground:
        objects["step"], bodies["step"] = "step.ron", "step"
        carriers.append("step")
        world = (
            f'<body name="step" pos="0 0 {more_ground:.12g}"><geom type="box" pos="2 0 -0.25" size="2 2 0.25" '
            'rgba="0.6 0.55 0.5 1"/></body>'
        )
    for name in WHEELS:
        objects[name] = tyre
        bodies |= {name: f"hub_{name}", f"{name}/wheel": f"wheel_{name}"}
        carriers += [f"hub_{name}", f"wheel_{name}"]
    under = ["ground", "step"] if more_ground else ["ground"]
    pairs = [(name, other) for name in WHEELS for other in under]
    extension = mjcf.contact_instance(objects, pairs, bodies, folder=str(d.HERE), capacity=256, friction=friction)
    motors = "".join(mjcf.motor(f"drive_{n}", f"drive_{n}", d.STALL_TORQUE, d.FREE_SPEED) for n in WHEELS)
    motors += "".join(steering(name) for name in CORNERS)
    actuators = "" if locked else f"<actuator>{motors}</actuator>"
    floor = '<geom type="plane" size="20 20 1" rgba="0.7 0.66 0.6 1"/>' if ground == "floor" else ""
    place = (x, 0.0, d.AXLE_HEIGHT[level.tyre] + height)
    text = mjcf.model(
        "rover",
        extension,
        world + floor + chassis(place, locked),
        DIFFERENTIAL + actuators,
        step or level.step,
        gravity=slope(angle),
    )
    return Machine(text, carriers)


def voltages(machine, value):
    """Sets one voltage for all drive motors; `value` may be a dict by wheel."""
    for name in WHEELS:
        machine.data.ctrl[machine.model.actuator(f"drive_{name}").id] = (
            value[name] if isinstance(value, dict) else value
        )


def rolling(machine, level, speed):
    """Sets the rover in motion with rolling wheels."""
    machine.data.qvel[0] = speed
    for name in WHEELS:
        machine.data.qvel[machine.model.joint(f"drive_{name}").dofadr[0]] = speed / d.AXLE_HEIGHT[level.tyre]
    machine.start()

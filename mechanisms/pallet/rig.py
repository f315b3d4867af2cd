"""Pallet, rails and tie-downs as MJCF."""

import dimensions as d
from dimensions import model
from kit import mjcf
from kit.machine import Machine

RAILS, PALLET = "../../models/htv_pallet/rails.ron", "../../models/htv_pallet/pallet.ron"
OBJECTS = {"rails": RAILS, "pallet": PALLET, "tie_downs": "tie_downs.ron", "pins": "pins.ron"}
PAIRS = [("rails", "pallet"), ("tie_downs", "pins")]
HOOKS = [f"hook_{name}" for name in d.SIDES]
STEEL, BLUE, GOLD = "0.55 0.57 0.6 1", "0.3 0.45 0.65 0.5", "0.75 0.6 0.3 1"


def wheel(name, base, seized):
    """Wheel on a hinge with the drag of its bearings; a seized roller has none. `base`: along x between the side rollers."""
    mass, radius, half = model.wheel_mass(name), model.wheel_radius(name), model.wheel_half_width(name)
    inertia = [mass * (3 * radius**2 + (2 * half) ** 2) / 12] * 3
    inertia[model.axle(name)] = mass * radius**2 / 2
    axis = [float(i == model.axle(name)) for i in range(3)]
    place = list(model.WHEELS[name])
    if model.is_roller(name):
        place[0] *= base / (2 * model.SIDE_ROLLER_X)
    stuck = seized and model.is_roller(name)
    joint = f'<joint name="{name}" axis="{mjcf.numbers(axis)}" damping="{model.BEARING_DRAG:g}"/>'
    ends = [s * half * a for s in (-1, 1) for a in axis]
    return (
        f'<body name="{name}" pos="{mjcf.numbers(place)}">{"" if stuck else joint}'
        f'<inertial pos="0 0 0" mass="{mass:g}" diaginertia="{mjcf.numbers(inertia)}"/>'
        f'<geom type="cylinder" fromto="{mjcf.numbers(ends)}" size="{radius:g}" rgba="{GOLD}"/></body>'
    )


def pallet(x, base, seized):
    wheels = "".join(wheel(name, base, seized) for name in model.WHEELS)
    drawn = (
        f'<geom type="box" size="{model.PALLET_LENGTH / 2} {model.CHASSIS_HALF_WIDTH} {model.CHASSIS_HALF_HEIGHT}" rgba="{BLUE}"/>'
        + "".join(
            f'<geom type="sphere" pos="{d.PIN_X} {side * d.PIN_Y} 0" size="{d.PIN_RADIUS}" rgba="{GOLD}"/>'
            for side in d.SIDES.values()
        )
    )
    return (
        f'<body name="pallet" pos="{x:.12g} 0 0"><freejoint/><inertial pos="0 0 0" mass="{model.PALLET_MASS}" '
        f'diaginertia="{mjcf.numbers(model.PALLET_INERTIA)}"/>{drawn}{wheels}</body>'
    )


def hook(name, side):
    """Hook, with angle 0 across the direction of entry and a positive angle when closing."""
    place = (d.FACE_X, side * (d.PIN_Y + d.LEVER), 0.0)
    length = d.LEVER + d.HOOK_BEYOND
    inertia = d.HOOK_MASS * length**2 / 12
    return (
        f'<body name="hook_{name}" pos="{mjcf.numbers(place)}"><joint name="hook_{name}" axis="0 0 {side}" '
        f'armature="{d.HOOK_ARMATURE}" limited="true" range="{d.HOOK_OPEN} {d.HOOK_MOST}"/>'
        f'<inertial pos="0 {-side * length / 2} 0" mass="{d.HOOK_MASS}" diaginertia="{inertia:.6g} 0.002 {inertia:.6g}"/>'
        f'<geom type="box" pos="{-d.HOOK_THICKNESS / 2} {-side * length / 2} 0" size="{d.HOOK_THICKNESS / 2} {length / 2} '
        f'{d.HOOK_HALF_HEIGHT}" rgba="{STEEL}"/></body>'
    )


def drawn_rails():
    """Visual geoms of the webs."""
    middle, half = (model.STOP_X - model.FLARE_LENGTH) / 2, (model.STOP_X + model.FLARE_LENGTH) / 2
    return "".join(
        f'<geom type="box" pos="{middle} {side * (model.WEB_Y + model.WEB_THICKNESS / 2)} 0" '
        f'size="{half} {model.WEB_THICKNESS / 2} {model.WEB_HALF_HEIGHT}" rgba="0.7 0.7 0.72 0.3"/>'
        for side in d.SIDES.values()
    )


def carriers():
    """Bodies of the movable groups, in the order of the sensor."""
    return ["world", "pallet", *model.WHEELS, "world", *HOOKS, "pallet"]


def carried():
    wheels = {f"pallet/{name}": name for name in model.WHEELS}
    hooks = {f"tie_downs/{name}": name for name in HOOKS}
    return {"rails": "world", "pallet": "pallet", **wheels, "tie_downs": "world", **hooks, "pins": "pallet"}


def machine(x, level, base=2 * model.SIDE_ROLLER_X, seized=False, step=None, friction=None, kind=Machine):
    """A pallet with its origin at `x`, its hooks open. `base`: see `wheel`; `friction`: of all surfaces.

    `kind`: of machine, for other contacts.
    """
    extension = mjcf.contact_instance(OBJECTS, PAIRS, carried(), folder=str(d.HERE), friction=friction)
    hooks = "".join(hook(*entry) for entry in d.SIDES.items())
    motors = "".join(mjcf.motor(name, name, d.HOOK_STALL, d.HOOK_FREE_SPEED) for name in HOOKS)
    world = drawn_rails() + pallet(x, base, seized) + hooks
    more = f"<actuator>{motors}</actuator>"
    made = kind(mjcf.model("pallet", extension, world, more, step or level.step), carriers())
    for name in HOOKS:
        made.data.qpos[made.model.joint(name).qposadr[0]] = d.HOOK_OPEN
    made.start()
    return made


def stops(machine):
    """Force of pallet and wheels on the rails along x, N."""
    return float(machine.data.sensordata[machine.sensed][3])

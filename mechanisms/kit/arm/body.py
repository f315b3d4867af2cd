"""MJCF of the arm: seven links, each on a motor hinge and a gear hinge about the same axis."""

from dataclasses import dataclass

from kit import mjcf

from . import dimensions as d


@dataclass(frozen=True)
class Body:
    world: str  # goes into <worldbody>, or into the body that carries the arm
    more: str  # actuators and sensors: beside <worldbody>
    tip: str  # name of the body at the tip; its origin is the tip, its tool points along −z


def body(prefix="", place=(0, 0, 0), quaternion=(1, 0, 0, 0), payload="", rgba="0.85 0.85 0.82 1"):
    """An arm with its base at a pose in the frame of its parent.

    `payload`: text of what the body at the tip carries (geoms, bodies). All names begin with `prefix`.
    """
    inside = _tip(prefix, payload, rgba)
    for number in reversed(range(len(d.LINKS))):
        inside = _link(prefix, number, inside, rgba)
    world = (
        f'<body name="{prefix}base" pos="{mjcf.numbers(place)}" quat="{mjcf.numbers(quaternion)}">'
        f'<geom type="cylinder" size="0.2 0.4" pos="0 0 0.5" mass="0" rgba="{rgba}"/>{inside}</body>'
    )
    motors = "".join(f'<motor name="{prefix}{link.name}" joint="{prefix}{link.name}"/>' for link in d.LINKS)
    sensors = (
        f'<force name="{prefix}force" site="{prefix}sensor"/><torque name="{prefix}moment" site="{prefix}sensor"/>'
    )
    return Body(world, f"<actuator>{motors}</actuator><sensor>{sensors}</sensor>", f"{prefix}tip")


def _link(prefix, number, inside, rgba):
    """Motor and gear hinge of a joint: the former has the rotor's inertia, the latter is the spring between motor and
    link."""
    link = d.LINKS[number]
    axis = mjcf.numbers(link.axis)
    return (
        f'<body name="{prefix}link_{number + 1}" pos="{mjcf.numbers(link.offset)}">'
        f'<joint name="{prefix}{link.name}" axis="{axis}" armature="{d.ROTOR:g}"/>'
        f'<joint name="{prefix}{link.name}_gear" axis="{axis}" stiffness="{d.GEAR_STIFFNESS[number]:g}" '
        f'damping="{d.GEAR_DAMPING[number]:g}"/>'
        f'<inertial pos="{mjcf.numbers(link.center)}" mass="{link.mass:g}" diaginertia="{mjcf.numbers(link.inertia)}"/>'
        f"{_shape(number, rgba)}{inside}</body>"
    )


def _shape(number, rgba):
    """Visual geoms: a tube to the next joint and a drum at this one."""
    link = d.LINKS[number]
    end = d.LINKS[number + 1].offset if number + 1 < len(d.LINKS) else d.TIP
    drum = [0.2 * component for component in link.axis]
    return (
        f'<geom type="capsule" size="0.14" fromto="0 0 0 {mjcf.numbers(end)}" mass="0" rgba="{rgba}"/>'
        f'<geom type="cylinder" size="0.19" fromto="{mjcf.numbers([-c for c in drum])} {mjcf.numbers(drum)}" mass="0" '
        f'rgba="0.5 0.5 0.52 1"/>'
    )


def _tip(prefix, payload, rgba):
    return (
        f'<body name="{prefix}tip" pos="{mjcf.numbers(d.TIP)}"><site name="{prefix}sensor"/>'
        f'<inertial pos="0 0 0" mass="{d.TIP_MASS:g}" diaginertia="0.5 0.5 0.5"/>{payload}</body>'
    )

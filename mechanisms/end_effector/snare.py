"""The snare: a turning ring, and three cables from it to a fixed ring, which close around a shaft.

Each cable is a chain of rigid links on pairs of hinges; its last link is a tendon that pulls only. The ring's angle
`turn` is that from the fixed to the turning end of a cable: at `open_turn` the cables lie round the ring's wall.
"""

import math

import models
from kit import mjcf
from kit.machine import Machine

CABLES = 3


def pitch(snare):
    return snare.length / snare.links


def bend(snare):
    """Angle between links that lie along the ring."""
    return 2.0 * math.asin(pitch(snare) / (2.0 * snare.ring_radius))


def open_turn(snare):
    return snare.links * bend(snare)


def straight_turn(snare):
    """Ring angle at which a cable without contact is straight."""
    return 2.0 * math.asin(snare.length / (2.0 * snare.ring_radius))


def aperture(snare, turn):
    """Distance of a straight cable from the axis."""
    return snare.ring_radius * math.cos(turn / 2.0)


def height(snare, cable):
    return snare.plane_gap * (cable - (CABLES - 1) / 2.0)


def _link(snare, cable, index):
    """A link and all that follow it."""
    length, mass = pitch(snare), snare.mass / snare.links
    if index == 0:
        azimuth = 2.0 * math.pi * cable / CABLES
        place = (snare.ring_radius * math.cos(azimuth), snare.ring_radius * math.sin(azimuth), height(snare, cable))
        turn = azimuth + 0.5 * (math.pi + bend(snare))
    else:
        place, turn = (length, 0.0, 0.0), bend(snare)
    last = index == snare.links - 2
    inside = f'<site name="end_{cable}" pos="{length:.12g} 0 0"/>' if last else _link(snare, cable, index + 1)
    across, along = mass * length**2 / 12.0, 0.5 * mass * snare.radius**2
    hinges = "".join(
        f'<joint name="{axis}_{cable}_{index}" axis="{vector}" armature="{snare.armature:g}" damping="{snare.hinge_damping:g}"/>'
        for axis, vector in (("z", "0 0 1"), ("y", "0 1 0"))
    )
    return (
        f'<body name="cable_{cable}/link_{index:02}" pos="{mjcf.numbers(place)}" '
        f'quat="{mjcf.numbers(mjcf.quaternion_about_z(turn))}">{hinges}'
        f'<inertial pos="{length / 2:.12g} 0 0" mass="{mass:.12g}" diaginertia="{along:.6g} {across:.12g} {across:.12g}"/>'
        f'<geom type="capsule" fromto="0 0 0 {length:.12g} 0 0" size="{snare.radius:g}" rgba="0.75 0.75 0.7 1"/>'
        f"{inside}</body>"
    )


def _ring(snare):
    turn = open_turn(snare)
    sites = "".join(
        f'<site name="ring_{i}" pos="{mjcf.numbers((snare.ring_radius * math.cos(a), snare.ring_radius * math.sin(a), height(snare, i)))}"/>'
        for i in range(CABLES)
        for a in [2.0 * math.pi * i / CABLES]
    )
    return (
        f'<body name="ring" quat="{mjcf.numbers(mjcf.quaternion_about_z(turn))}">'
        f'<joint name="turn" axis="0 0 1" ref="{turn:.12g}" armature="{snare.ring_inertia:g}" damping="{snare.gear_damping:g}" '
        'solreffriction="0.004 1" solimpfriction="0.999 0.9999 0.001"/>'
        f'<inertial pos="0 0 0" mass="2" diaginertia="0.01 0.01 0.02"/>'
        f"{sites}{_drawn_circle(snare.ring_radius + 0.006, 0.005, '0.85 0.7 0.35 1')}</body>"
    )


def _drawn_circle(radius, thickness, colour, height=0.0, pieces=36):
    """Visual ring of short capsules."""
    angles = [2.0 * math.pi * i / pieces for i in range(pieces + 1)]
    places = [(radius * math.cos(a), radius * math.sin(a), height) for a in angles]
    return "".join(
        f'<geom type="capsule" fromto="{mjcf.numbers(a + b)}" size="{thickness:g}" rgba="{colour}"/>'
        for a, b in zip(places, places[1:])
    )


def bodies(snare):
    """Bodies of the ring and the cables, fixed to their parent frame."""
    return _ring(snare) + "".join(_link(snare, cable, 0) for cable in range(CABLES))


def tendons(snare, slack=0.0):
    """Last link of each cable, which only pulls; its stiffness is that of the whole cable. Cable 0 is longer by `slack`."""
    return (
        "<tendon>"
        + "".join(
            f'<spatial name="cable_{i}" springlength="0 {pitch(snare) + (slack if i == 0 else 0.0):.12g}" stiffness="{snare.tension_stiffness:g}" '
            f'damping="{snare.tension_damping:g}"><site site="end_{i}"/><site site="ring_{i}"/></spatial>'
            for i in range(CABLES)
        )
        + "</tendon>"
    )


def tension(machine, snare, cable):
    """Tension at a cable's end at the ring, N, from its spring."""
    length = machine.data.ten_length[machine.model.tendon(f"cable_{cable}").id]
    return max(0.0, snare.tension_stiffness * (float(length) - pitch(snare)))


def objects(snare):
    """(Objects, pairs, group → body, carriers) of the cables for the plugin; text1 is the model of a cable."""
    names = [f"cable_{i}" for i in range(CABLES)]
    pairs = [(a, b) for k, a in enumerate(names) for b in names[:k]]
    carriers = []
    for name in names:
        carriers += ["world"] + [f"{name}/link_{i:02}" for i in range(snare.links - 1)]
    return {name: "text1" for name in names}, pairs, {name: "world" for name in names}, carriers


def rig(snare, fixture=None, payload="", more="", integrator="RK4", step=None, friction=None, capacity=128):
    """The snare alone, its ring driven by a motor `ring`, around a fixture on a body `payload` given as text."""
    things, pairs, carried, carriers = objects(snare)
    texts = [models.cable(snare).text()]
    if fixture is not None:
        pairs = pairs + [(name, "fixture") for name in things]
        things, carried = {**things, "fixture": "text2"}, {**carried, "fixture": "payload"}
        carriers = carriers + ["payload"]
        texts.append(models.fixture(fixture, snare.friction if friction is None else friction).text())
    text = mjcf.model(
        "snare",
        mjcf.contact_instance(things, pairs, carried, texts, capacity=capacity),
        bodies(snare) + payload,
        tendons(snare)
        + f"<actuator>{mjcf.motor('ring', 'turn', snare.stall_torque, snare.free_speed)}</actuator>"
        + more,
        step or snare.step,
        integrator,
    )
    return Machine(text, carriers)

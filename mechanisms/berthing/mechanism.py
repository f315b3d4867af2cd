"""The berthing mechanism as MJCF: four driven four-bar latches, four indicators, the module and its holder.

`training_mjcf()` gives the text of level training without running it, for hosts in other languages.
"""

import math
from dataclasses import dataclass

import arm
import linkage
import dimensions as d
from dimensions import HERE, START_GAP, TRAINING, Level, common
from kit import mjcf

LATCHES = range(4)
PASSIVE_MODEL = "../../models/common_berthing/passive.ron"
CAPACITY = 128
DECK = -0.2  # height of what carries the latches, drawn only
STEEL, BRASS, BLUE = "0.55 0.57 0.6 1", "0.75 0.6 0.3 1", "0.3 0.45 0.65 1"


@dataclass(frozen=True)
class Load:
    """The berthed body: mass, inertia about its centre along its axes, position of the centre in the passive frame."""

    mass: float = common.MODULE_MASS
    inertia: tuple = common.MODULE_INERTIA
    center: tuple = common.MODULE_CENTER


@dataclass(frozen=True)
class Start:
    """Initial pose of the passive frame: x and y, rotation vector, gap; and its closing speed."""

    offset: tuple = (0.0, 0.0)
    turn: tuple = (0.0, 0.0, 0.0)
    gap: float = START_GAP
    speed: float = 0.0


@dataclass(frozen=True)
class Scene:
    """`station`: mass of an active half that flies freely, kg, or None where it stands still. `guided`: the module slides
    along z and does nothing else.
    """

    level: Level = TRAINING
    load: Load = Load()
    start: Start = Start()
    station: float | None = None
    guided: bool = False


def about_y(angle):
    """Rotation about y that raises x toward z."""
    return mjcf.numbers((math.cos(angle / 2), 0.0, -math.sin(angle / 2), 0.0))


def link(name, length, mass, place, angle, armature, more="", limits=""):
    """A bar along x from its pin, at its joint's angle above x of the parent."""
    rod = (1e-4, mass * length**2 / 12, mass * length**2 / 12)
    return (
        f'<body name="{name}" pos="{mjcf.numbers(place)}" quat="{about_y(angle)}">'
        f'<joint name="{name}" type="hinge" axis="0 -1 0" ref="{angle:.12g}" armature="{armature:.12g}"{limits}/>'
        f'<inertial pos="{length / 2:.12g} 0 0" mass="{mass:g}" diaginertia="{mjcf.numbers(rod)}"/>'
        f'<geom type="capsule" fromto="0 0 0 {length:.12g} 0 0" size="0.008" rgba="{STEEL}"/>{more}</body>'
    )


def latch(i, level):
    """Crank with coupler, and follower; `closure` joins the loop. Joint angles: crank and follower from outwards."""
    pose = linkage.pose(d.STOWED)
    u, v = d.ROLLER_AT
    roller = (
        f'<site name="joint_{i}" pos="{d.COUPLER} 0 0"/><site name="roller_{i}" pos="{u} 0 {v}"/>'
        f'<geom type="capsule" fromto="{d.COUPLER} 0 0 {u} 0 {v}" size="0.007" rgba="{STEEL}"/>'
        f'<geom type="capsule" fromto="{u} {-d.ROLLER_HALF_WIDTH} {v} {u} {d.ROLLER_HALF_WIDTH} {v}" size="{d.ROLLER_RADIUS}" rgba="{BRASS}"/>'
    )
    relative = pose.coupler - pose.crank
    coupler = link(f"coupler_{i}", u, d.COUPLER_MASS, (d.CRANK, 0, 0), relative, level.armature, roller)
    pivot = (d.FOLLOWER_PIVOT[0], 0.0, d.FOLLOWER_PIVOT[1])
    end = f'<site name="end_{i}" pos="{d.FOLLOWER} 0 0"/>'
    follower = link(f"follower_{i}", d.FOLLOWER, d.FOLLOWER_MASS, pivot, pose.follower, level.armature, end)
    limits = f' limited="true" range="{d.STOWED - 0.02:.12g} {d.CRANK_MOST:.12g}"'
    base = (d.CRANK_PIVOT[0], 0.0, d.CRANK_PIVOT[1])
    return link(f"crank_{i}", d.CRANK, d.CRANK_MASS, base, d.STOWED, d.ROTOR_INERTIA, coupler, limits) + follower


def closure(i, level):
    return (
        f'<connect name="closure_{i}" site1="joint_{i}" site2="end_{i}" solref="{level.closure:.12g} 1" '
        'solimp="0.9999 0.9999 0.001"/>'
    )


def plunger(i):
    return (
        f'<body name="plunger_{i}" pos="{common.PLUNGER_RADIUS} 0 {common.PLUNGER_TIP_Z}"><joint name="plunger_{i}" type="slide" '
        f'axis="0 0 -1" stiffness="{d.PLUNGER_SPRING}" damping="{d.PLUNGER_SLIDE_DAMPING}"/>'
        f'<inertial pos="0 0 -0.05" mass="{d.PLUNGER_MASS}" diaginertia="1e-3 1e-3 1e-4"/>'
        f'<geom type="capsule" fromto="0 0 -0.1 0 0 {-d.PLUNGER_TIP_RADIUS}" size="{d.PLUNGER_TIP_RADIUS}" rgba="{BLUE}"/></body>'
    )


def paddle(i):
    length, half, mass = common.PADDLE_LENGTH, common.PADDLE_HALF_WIDTH, common.PADDLE_MASS
    raised = math.radians(common.PADDLE_DEG)
    inertia = (mass * (2 * half) ** 2 / 12, mass * length**2 / 12, mass * (length**2 + (2 * half) ** 2) / 12)
    return (
        f'<body name="paddle_{i}" pos="{mjcf.numbers(common.HINGE)}" quat="{about_y(raised)}"><joint name="paddle_{i}" '
        f'type="hinge" axis="0 1 0" stiffness="{common.PADDLE_SPRING}" damping="{d.PADDLE_HINGE_DAMPING}"/>'
        f'<inertial pos="{length / 2} 0 0" mass="{mass}" diaginertia="{mjcf.numbers(inertia)}"/>'
        f'<geom type="box" pos="{length / 2} 0 0" size="{length / 2} {half} 0.002" rgba="{BLUE}"/></body>'
    )


def quadrant(i, level):
    turned = mjcf.quaternion_about_z(math.radians(common.LATCH_AZIMUTHS[i]))
    inside = latch(i, level) + plunger(i) + paddle(i) + drawn_pedestals()
    return f'<body name="azimuth_{i}" quat="{mjcf.numbers(turned)}">{inside}</body>'


def module(scene):
    start, load = scene.start, scene.load
    place = mjcf.numbers((*start.offset, start.gap))
    joint = '<joint name="module" type="slide" axis="0 0 1"/>' if scene.guided else '<freejoint name="module"/>'
    return (
        f'<body name="passive" pos="{place}" quat="{mjcf.numbers(arm.quaternion(start.turn))}">{joint}'
        f'<inertial pos="{mjcf.numbers(load.center)}" mass="{load.mass:.12g}" diaginertia="{mjcf.numbers(load.inertia)}"/>'
        f"{arm.on_module()}{drawn_passive()}</body>"
    )


def station(scene):
    """The active half: part of the world, or a free-flying ring."""
    inside = "".join(quadrant(i, scene.level) for i in LATCHES)
    if scene.station is None:
        return inside
    hung = 4 * (d.CRANK_MASS + d.COUPLER_MASS + d.FOLLOWER_MASS + d.PLUNGER_MASS + common.PADDLE_MASS)
    ring = mjcf.numbers([share * (scene.station - hung) / common.RING_MASS for share in common.RING_INERTIA])
    return (
        f'<body name="station"><freejoint name="station"/><inertial pos="0 0 0" mass="{scene.station - hung:.12g}" '
        f'diaginertia="{ring}"/>{inside}</body>'
    )


def drawn_pedestals():
    """Visual geoms of the pivots' pedestals."""
    return "".join(
        f'<geom type="capsule" fromto="{x} {y} {DECK} {x} {y} {z}" size="0.007" rgba="0.3 0.3 0.32 1"/>'
        for x, z in (d.CRANK_PIVOT, d.FOLLOWER_PIVOT, (common.HINGE[0], common.HINGE[2]))
        for y in (-0.012, 0.012)
    )


def drawn_passive():
    """Visual geoms of the passive half."""
    fittings = []
    for azimuth in common.LATCH_AZIMUTHS:
        place = common.radial((common.FITTING_INNER + common.FITTING_OUTER) / 2, azimuth, -0.0175)
        turned = mjcf.numbers(mjcf.quaternion_about_z(math.radians(azimuth)))
        fittings.append(
            f'<geom type="box" pos="{mjcf.numbers(place)}" quat="{turned}" size="0.055 0.04 0.0125" rgba="0.6 0.35 0.3 0.6"/>'
        )
    ring = '<geom type="cylinder" fromto="0 0 0.02 0 0 0.03" size="0.9" rgba="0.8 0.8 0.85 0.15"/>'
    return ring + "".join(fittings)


OBJECTS = {"active": "active.ron", "passive": PASSIVE_MODEL, **{f"indicator_{i}": "indicator.ron" for i in LATCHES}}
PAIRS = [(name, "passive") for name in OBJECTS if name != "passive"]


def carried(scene):
    """Carrier body of each movable group, in the order of the sensor."""
    base = "world" if scene.station is None else "station"
    bodies = {
        "active": base,
        **{f"active/quadrant_{i}/latch_{i}": f"coupler_{i}" for i in LATCHES},
        "passive": "passive",
    }
    for i in LATCHES:
        bodies |= {f"indicator_{i}": base}
        bodies |= {f"indicator_{i}/{part}": f"{part}_{i}" for part in ("plunger", "paddle")}
    return bodies


def _sensors():
    of_latch = "".join(
        f'<jointpos name="crank_{i}" joint="crank_{i}"/><jointvel name="crank_speed_{i}" joint="crank_{i}"/>'
        for i in LATCHES
    )
    of_indicator = "".join(
        f'<jointpos name="stroke_{i}" joint="plunger_{i}"/><jointpos name="turn_{i}" joint="paddle_{i}"/>'
        for i in LATCHES
    )
    return f"<sensor>{of_latch}{of_indicator}</sensor>"


def text(scene, folder=HERE):
    """The whole machine. `folder` holds active.ron and indicator.ron, as this folder does."""
    extension = mjcf.contact_instance(OBJECTS, PAIRS, carried(scene), folder=str(folder), capacity=CAPACITY)
    deck = f'<geom type="cylinder" fromto="0 0 {DECK} 0 0 {DECK + 0.01}" size="0.9" rgba="0.85 0.85 0.87 1"/>'
    world = deck + arm.in_world() + station(scene) + module(scene)
    motors = "".join(mjcf.motor(f"latch_{i}", f"crank_{i}", d.STALL_TORQUE, d.FREE_SPEED) for i in LATCHES)
    to = "" if scene.station is None else 'body2="station"'
    bolts = (
        f'<weld name="bolts" body1="passive" {to} active="false" relpose="0 0 0 1 0 0 0" solref="0.1 1" '
        'solimp="0.9999 0.9999 0.001"/>'
    )
    joined = "".join(closure(i, scene.level) for i in LATCHES)
    more = f"<equality>{joined}{bolts}</equality><actuator>{motors}{arm.actuators()}</actuator>{_sensors()}"
    return mjcf.model("berthing", extension, world, more, scene.level.step, "RK4")


def training_mjcf(load=Load(), start=Start(), folder=HERE):
    """Level training as text: step 1 ms, integrator RK4."""
    return text(Scene(TRAINING, load, start), folder)

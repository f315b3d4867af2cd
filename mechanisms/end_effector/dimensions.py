"""Dimensions of the end effector, the grapple fixture and the payload, in SI units. Their sources: README.md.

Public numbers are few. What is chosen is marked so; checks in outcome.py that name a closed form hold for any choice.
"""

from dataclasses import dataclass, replace


@dataclass(frozen=True)
class Snare:
    """Three cables between a fixed ring and a turning one. Level *analysis* unless replaced, see `training`."""

    ring_radius: float = 0.100  # of both rings, to where cables are fastened; chosen
    length: float = 0.200  # of a cable; chosen: a cable of 1.5 ring radii cannot grip
    radius: float = 0.002  # of a cable; chosen
    links: int = 16  # of a cable; the last of them is a tendon
    mass: float = 0.05  # of a cable; chosen
    armature: float = 1e-5  # of each hinge of a link, kg·m²: inertia that only slows how links turn against each other
    hinge_damping: float = 1e-4  # N·m·s
    tension_stiffness: float = 1e6  # of a whole cable along itself, N/m; chosen
    tension_damping: float = 30.0  # N·s/m
    plane_gap: float = 0.0048  # between the planes of the cables: they pass each other; chosen
    contact_stiffness: float = 5e6  # of cable on steel, N/m; chosen
    contact_damping: float = 30.0  # N·s/m
    friction: float = 0.2  # steel cable on steel; chosen
    ring_inertia: float = 5.0  # of the ring and of the rotor through its gear (1e-5 kg·m² at 700 : 1), kg·m²; chosen
    gear_damping: float = 15.0  # of the ring's gear, N·m·s; chosen
    stall_torque: float = 300.0  # of the snare motor at the ring, N·m; chosen
    snare_torque: float = 40.0  # to which its current is limited while it snares, N·m; chosen
    brake_torque: float = 600.0  # at which the ring's brake slips, N·m; chosen so that it holds the preload
    free_speed: float = 1.2  # of the ring without load, rad/s: closes in about 1 s; chosen
    step: float = 1e-4  # s


def training(snare):
    """Heavy cables of few links: a step ten times longer, for a trainer at 1 kHz."""
    return replace(
        snare,
        links=8,
        mass=1.0,
        armature=4e-4,
        hinge_damping=1e-2,
        contact_stiffness=1e6,
        contact_damping=200.0,
        tension_damping=200.0,
        step=1e-3,
    )


@dataclass(frozen=True)
class Fixture:
    """The grapple shaft, along −z from the payload's face: a shaft, a cone and a knob at its tip."""

    shaft_radius: float = 0.010  # chosen
    shaft_length: float = (
        0.175  # from the payload to the cone; chosen: with cone and knob shorter than the probe's 0.2734 m
    )
    cone_length: float = 0.012  # chosen: about 51 degrees
    knob_radius: float = 0.025  # chosen
    knob_length: float = 0.020  # chosen


LARGE_FIXTURE = Fixture(shaft_radius=0.015, knob_radius=0.031, cone_length=0.013)


# --- shell and payload -------------------------------------------------------------------------------------------------
# Heights of the shell are above the plane of the open snare; the payload's origin is the centre of its plate.

SEAT = 0.060  # height of the pads' tops, on which the payload's plate sits; chosen
FRICTION = 0.2  # steel on steel, lubricated; chosen


@dataclass(frozen=True)
class Pads:
    """Balls on the shell that meet the plate of the payload and take the preload."""

    count: int = 12  # chosen
    circle: float = 0.150  # radius on which they lie; chosen
    radius: float = 0.010  # chosen
    stiffness: float = 4e6  # of one pad, N/m; chosen
    damping: float = 2e4  # N·s/m


@dataclass(frozen=True)
class Teeth:
    """Curvic teeth: wedges on the shell, and between them the crowned flanks of the payload's teeth, as balls."""

    count: int = 12  # chosen
    circle: float = 0.125  # pitch radius; chosen: outside of the mouth, inside of the pads
    flank_deg: float = 30.0  # of a flank from the axis; chosen
    depth: float = 0.006  # above and below the pitch plane; chosen
    half_width: float = 0.016  # of a tooth at the pitch plane: teeth as wide as gaps; chosen
    half_length: float = 0.010  # of a tooth along the radius; chosen
    crown: float = 0.002  # radius of the balls; chosen
    stiffness: float = 2e6  # of one ball on its flank, N/m; chosen
    damping: float = 1e3  # N·s/m


@dataclass(frozen=True)
class Cams:
    """Three wedges on the payload's plate, each between two rollers on the shell; they turn the payload upright."""

    count: int = 3  # public: three, 120 degrees apart
    first_deg: float = 15.0  # azimuth of the first: between two pads
    circle: float = 0.172  # chosen: outside of the pads
    half_length: float = 0.012  # of a cam along the radius; chosen
    height: float = 0.045  # of a cam below the plate; chosen
    half_root: float = 0.034  # its half width at the plate; chosen
    flank_deg: float = 30.0  # of its sides from the axis; chosen
    roller: float = 0.006  # radius of a roller; chosen
    sunk: float = 0.012  # axes of the rollers below the seat; chosen
    clearance: float = 0.001  # between roller and side of a seated cam: the teeth align what the cams leave; chosen
    stiffness: float = 1e6  # of a roller on a cam, N/m; chosen
    damping: float = 1e3  # N·s/m


@dataclass(frozen=True)
class Lip:
    """Rounded edge of the shell's mouth, through which the knob enters."""

    pieces: int = 24
    aperture: float = 0.100  # from the axis to the lip's inner edge: the radius of the open snare
    radius: float = 0.004  # of the rounding; chosen
    height: float = 0.016  # of the middle of the rounding; chosen: the topmost cable passes below
    stiffness: float = 1e6  # N/m; chosen
    damping: float = 1e3  # N·s/m


@dataclass(frozen=True)
class Plungers:
    """Spring-loaded plungers that push the payload off; a latch holds them back until the snare is open."""

    count: int = 3  # chosen
    first_deg: float = 45.0  # azimuth of the first: between two pads
    circle: float = 0.150  # chosen
    spring: float = 3000.0  # of all together, N/m; chosen
    stroke: float = 0.015  # chosen: 0.34 J, which gives 1 t 26 mm/s
    mass: float = 0.5  # of all together, kg; chosen
    losses: float = 0.5  # N·s/m, of the plungers in their guides; chosen
    length: float = 0.060  # of a plunger; chosen
    stiffness: float = 2e5  # of one tip on the plate, N/m; chosen
    damping: float = 200.0  # N·s/m


@dataclass(frozen=True)
class Screw:
    """Motor and ball screw of the carriage."""

    stall_torque: float = 4.8  # at the screw, N·m; chosen: presses with 6.4 kN
    lead: float = 4.0e-3  # m a turn; chosen
    efficiency: float = 0.85  # chosen
    free_speed: float = 80.0  # rad/s at the screw; chosen
    inertia: float = 2e-4  # of the rotor at the screw, kg·m²; chosen
    stroke: float = 0.150  # of the carriage, m; chosen
    carriage: float = 20.0  # mass, kg; chosen


@dataclass(frozen=True)
class Arm:
    """Holder of the shell: springs and dampers along and about three axes at the arm's tip."""

    behind: float = 0.6  # of the tip behind the plane of the snare, m; chosen
    stiffness: float = 2e4  # N/m; chosen: a shell that sways at 1.6 Hz
    turning_stiffness: float = 2e4  # N·m/rad; chosen
    damping: float = 400.0  # N·s/m; chosen: a tenth of critical
    turning_damping: float = 300.0  # N·m·s; chosen
    shell_mass: float = 170.0  # kg; with the carriage the public 190 kg of the end effector
    shell_inertia: float = 8.0  # about each axis, kg·m²; chosen


PADS, TEETH, CAMS, LIP, PLUNGERS, SCREW, ARM = Pads(), Teeth(), Cams(), Lip(), Plungers(), Screw(), Arm()

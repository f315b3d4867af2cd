"""Dimensions of the end effector and the grapple fixture. SI units. Where each comes from: README.md.

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
    """Heavy cables of few links: a step ten times as long, for a trainer at 1 kHz."""
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

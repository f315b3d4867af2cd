"""The whole end effector and a free-flying payload: snare, retract, rigidize, release.

Frames: the shell stands still, z points out of it to the payload. The ring and the cables ride on a carriage that a ball
screw pulls inwards; pads on the shell meet the payload's plate. The payload's origin is the centre of its plate, the
grapple shaft goes along −z from it.
"""

import copy
import math
from dataclasses import dataclass, field

import numpy as np

import models
import rig_preload
import snare as s
from dimensions import Fixture, Snare
from kit import mjcf
from kit.machine import Machine

PADS = 12
PADS_HEIGHT = 0.060  # of the pads' tops above the plane of the open snare, m
PLATE_HEIGHT = 0.145  # of the payload's plate there when capture begins, m
STROKE = 0.150  # of the carriage, m
EXTENDED = 0.012  # m: how far the carriage goes back before the snare opens
HELD_FOR = 0.3  # s of a pressed joint before release
PAYLOADS = {1000.0: 400.0, 16000.0: 60000.0}  # mass, kg: inertia about each axis, kg·m²


@dataclass(frozen=True)
class Case:
    """A capture: how the payload comes, and what fails."""

    mass: float = 1000.0
    offset: tuple = (0.030, 0.0)  # of the shaft from the axis, m
    tilt_deg: float = 1.0  # of the shaft, about the y axis
    drift: tuple = (0.0, 0.01, 0.0)  # m/s
    snare: Snare = field(default_factory=Snare)
    fixture: Fixture = field(default_factory=Fixture)
    slack: float = 0.0  # m by which cable 0 is longer
    motor_share: float = 1.0  # of the stall torque that the snare motor has
    step: float | None = None


class Sequencer:
    """Snare, retract, rigidize, hold, release, open, done: each begins when the one before is finished, or has had its time.

    What it remembers is all in its attributes, so `copy.deepcopy` saves it beside the state of the machine.
    """

    LIMITS = {"snare": 6.0, "retract": 15.0, "rigidize": 4.0, "hold": HELD_FOR, "release": 4.0, "open": 6.0}
    # Ring: voltage and brake; screw: voltage. Slow while the payload is pulled in, so that a heavy one follows.
    MOTORS = {
        "snare": (1, False, 0.0),
        "retract": (0, True, 0.3),
        "rigidize": (0, True, 1.0),
        "hold": (0, True, 1.0),
        "release": (0, True, -0.6),
        "open": (-1, False, 0.0),
        "done": (0, True, 0.0),
    }
    # What has come to rest ends a phase: the joint, below which speed (rad/s or m/s), for how long, s.
    CALM = {"snare": ("turn", 0.02, 0.5), "retract": ("retract", 1e-3, 0.3), "rigidize": ("retract", 3e-4, 0.3)}

    def __init__(self, snare):
        self.snare, self.phase, self.since, self.calm, self.carriage = snare, "snare", 0.0, 0.0, 0.0
        self.peaks, self.ends = dict.fromkeys(self.MOTORS, 0.0), {}

    def __call__(self, machine):
        self.peaks[self.phase] = max(self.peaks[self.phase], float(np.linalg.norm(machine.wrench("payload")[:3])))
        if self.phase != "done" and self._finished(machine):
            self.ends[self.phase] = machine.time
            phases = list(self.MOTORS)
            self.phase, self.since = phases[phases.index(self.phase) + 1], machine.time
            self.calm = self.since
            self.carriage = machine.joint("retract")
        ring, brake, screw = self.MOTORS[self.phase]
        limit, turning = (
            self.snare.snare_torque / self.snare.stall_torque,
            machine.speed("turn") / self.snare.free_speed,
        )
        machine.data.ctrl[machine.model.actuator("ring").id] = min(limit + turning, max(turning - limit, ring))
        machine.data.ctrl[machine.model.actuator("screw").id] = screw
        machine.model.dof_frictionloss[machine.model.joint("turn").dofadr[0]] = (
            self.snare.brake_torque if brake else 0.0
        )

    def _finished(self, machine):
        waited = machine.time - self.since
        if waited >= self.LIMITS[self.phase]:
            return True
        if self.phase in self.CALM:
            joint, speed, lasting = self.CALM[self.phase]
            if abs(machine.speed(joint)) > speed:
                self.calm = machine.time
            return machine.time - self.calm > lasting
        if self.phase == "release":
            return machine.joint("retract") < self.carriage - EXTENDED
        if self.phase == "open":
            return machine.joint("turn") <= s.open_turn(self.snare)
        return False


def _world(case):
    screw, reflected = rig_preload.screw("retract")
    carriage = (
        f'<body name="carriage"><joint name="retract" type="slide" axis="0 0 -1" armature="{reflected:.12g}" limited="true" '
        f'range="0 {STROKE:g}"/><inertial pos="0 0 -0.05" mass="20" diaginertia="0.2 0.2 0.2"/>{s.bodies(case.snare)}</body>'
    )
    half = math.radians(case.tilt_deg) / 2
    place = (case.offset[0], case.offset[1], PLATE_HEIGHT)
    inertia = mjcf.numbers([PAYLOADS[case.mass]] * 3)
    payload = (
        f'<body name="payload" pos="{mjcf.numbers(place)}" quat="{mjcf.numbers((math.cos(half), 0, math.sin(half), 0))}"><freejoint/>'
        f'<inertial pos="0 0 1" mass="{case.mass:g}" diaginertia="{inertia}"/>{_drawn_fixture(case.fixture)}</body>'
    )
    return _drawn_pads() + carriage + payload, screw


def _drawn_fixture(fixture):
    """Shown only; the cone as short cylinders."""
    top, bottom = -fixture.shaft_length, -fixture.shaft_length - fixture.cone_length
    slices = 8
    levels = [top + (bottom - top) * i / slices for i in range(slices + 1)]
    radii = [
        fixture.shaft_radius + (fixture.knob_radius - fixture.shaft_radius) * (i + 0.5) / slices for i in range(slices)
    ]
    parts = [
        (0.0, top, fixture.shaft_radius),
        (bottom, bottom - fixture.knob_length, fixture.knob_radius),
        *zip(levels, levels[1:], radii),
    ]
    return '<geom type="cylinder" fromto="0 0 0 0 0 0.012" size="0.19" rgba="0.75 0.75 0.8 0.35"/>' + "".join(
        f'<geom type="cylinder" fromto="0 0 {a:.6g} 0 0 {b:.6g}" size="{r:.6g}" rgba="0.4 0.5 0.65 1"/>'
        for a, b, r in parts
    )


def _drawn_pads():
    size = rig_preload.PAD_RADIUS
    return "".join(
        f'<geom type="sphere" pos="{x:.6g} {y:.6g} {PADS_HEIGHT - size:g}" size="{size:g}" rgba="0.6 0.3 0.25 1"/>'
        for x, y in rig_preload.around(PADS, rig_preload.PAD_CIRCLE)
    )


def machine(case):
    snare = case.snare
    things, pairs, carried, carriers = s.objects(snare)
    carried = {name: "carriage" for name in carried}
    carriers = ["carriage" if name == "world" else name for name in carriers] + ["payload", "world", "payload"]
    pairs = pairs + [(name, "fixture") for name in things] + [("pads", "plate")]
    things = {**things, "fixture": "text2", "pads": "text3", "plate": "text4"}
    carried = {**carried, "fixture": "payload", "pads": "world", "plate": "payload"}
    texts = [
        models.cable(snare),
        models.fixture(case.fixture, snare.friction),
        rig_preload.pads(PADS, height=PADS_HEIGHT, friction=snare.friction),
        rig_preload.plate(snare.friction),
    ]
    world, screw = _world(case)
    ring = mjcf.motor("ring", "turn", snare.stall_torque * case.motor_share, snare.free_speed)
    text = mjcf.model(
        "end_effector",
        mjcf.contact_instance(things, pairs, carried, texts, capacity=256),
        world,
        f"{s.tendons(snare, case.slack)}<actuator>{ring}{screw}</actuator>",
        case.step or snare.step,
    )
    made = Machine(text, carriers)
    freedom = made.model.body("payload").dofadr[0]
    made.data.qvel[freedom : freedom + 3] = case.drift
    made.start()
    return made


@dataclass
class Result:
    """What a capture came to; forces in N."""

    captured: bool  # the joint was pressed with more than half of the preload
    preload: float  # on the pads when the hold ends
    peaks: dict  # greatest force on the payload in each phase
    ends: dict  # time at which each phase ended, s
    away: float  # speed of the payload at the end, m/s
    machine: Machine


def run(case, until="done", watch=None, prepare=None):
    """`watch(machine, sequencer)` sees every step, `prepare(machine)` what it begins with."""
    made, sequencer = machine(case), Sequencer(case.snare)
    if prepare is not None:
        prepare(made)
    pressed = 0.0
    while sequencer.phase != until:
        made.advance(sequencer)
        if sequencer.phase == "hold":
            pressed = -float(made.wrench("world")[2])
        if watch is not None:
            watch(made, sequencer)
    if until == "done":
        made.run(0.5, sequencer)
    away = float(np.linalg.norm(velocity(made)))
    return Result(pressed > 0.5 * rig_preload.preload(), pressed, sequencer.peaks, sequencer.ends, away, made)


def velocity(made):
    """Of the payload's origin, m/s."""
    first = made.model.body("payload").dofadr[0]
    return made.data.qvel[first : first + 3]


def same_bits_after_restart(case, before, after):
    """Runs for `before` s, then for `after` s; goes back in another machine, and compares the bits of both ends."""
    first, one = machine(case), Sequencer(case.snare)
    first.run(before, one)
    middle, other = first.save(), copy.deepcopy(one)
    first.run(after, one)
    second = machine(case)
    second.restore(middle)
    # The brake belongs to the model, not to the state: the sequencer sets it before the first step.
    second.run(after, other)
    return first.save().tobytes() == second.save().tobytes()

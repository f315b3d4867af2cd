"""A docking from the approach to the push-off: cases, runs, and results."""

import math
from dataclasses import dataclass, field

import dimensions as d
import mujoco
import numpy as np
import stewart
import vehicles
from kit import mjcf
from kit.machine import Machine
from kit.restart import same_bits
from sequence import Sequencer

GAP = 0.21  # m between the ring faces when a run begins; petals meet at about 0.17
MEETING = 0.17


@dataclass(frozen=True)
class Case:
    """State of the chaser when the petals meet, and failures. SI units, angles in rad."""

    speed: float = 0.10
    lateral: tuple = (0.05, 0.0)
    lateral_rate: tuple = (0.0, 0.0)
    tilt: tuple = (math.radians(1.0), 0.0)  # about x and y
    roll: float = math.radians(2.0)
    rates: tuple = (0.0, 0.0, 0.0)  # rad/s, about the chaser's axes
    dead_latch: int | None = None
    stuck_leg: int | None = None
    level: d.Level = field(default=d.TRAINING)
    give_up: float = 8.0
    gap: float = GAP


def approach(case, hard=True, drawn=None, assets="", kind=Machine):
    """The machine before the first contact."""
    return placed(vehicles.machine(case.level, hard, drawn, assets, kind=kind), case, hard)


def placed(made, case, hard):
    """Places both vehicles at the start of the case. Lateral offset and speed refer to the middle of the ring's face."""
    ahead = max(case.gap - MEETING, 0.0) / case.speed
    angles = [angle - rate * ahead for angle, rate in zip((*case.tilt, case.roll), case.rates)]
    frame = vehicles.about("z", angles[2]) @ vehicles.about("y", angles[1]) @ vehicles.about("x", angles[0])
    face = np.array([*(p - v * ahead for p, v in zip(case.lateral, case.lateral_rate)), -case.gap])
    arm = frame @ stewart.NEUTRAL
    spin = frame @ np.array(case.rates)
    velocity = np.array([*case.lateral_rate, case.speed]) - np.cross(spin, arm)
    vehicles.set_vehicle(made, "chaser", face - arm, frame, velocity, case.rates)
    vehicles.set_vehicle(made, "target", (0, 0, 0), vehicles.flipped())
    _open_hooks(made, hard)
    made.start()
    return made


def turn(made, frame, shift):
    """Rotates and moves both vehicles together, which must not change the result."""
    for name in ("chaser", "target"):
        joint = made.model.joint(made.model.body(name).jntadr[0])
        place, rate = joint.qposadr[0], joint.dofadr[0]
        position, quaternion, velocity = (
            made.data.qpos[place : place + 3],
            np.empty(4),
            made.data.qvel[rate : rate + 3],
        )
        mujoco.mju_mulQuat(quaternion, mjcf.quaternion_of(frame), made.data.qpos[place + 3 : place + 7])
        made.data.qpos[place : place + 7] = np.hstack([frame @ position + shift, quaternion])
        made.data.qvel[rate : rate + 3] = frame @ velocity
    made.start()


def captured(height, level):
    """Captured state at rest: the latches behind their strikers, the ring's face at a height above the hard plane."""
    made = vehicles.machine(level)
    stewart.set_pose(made.model, made.data, np.array([0.0, 0.0, height]))
    vehicles.set_vehicle(made, "chaser", (0, 0, -height), np.eye(3))
    return _faced(made)


def mated_and_free(level, petals):
    """Mated state at rest: hard faces in contact, pushers 1 and 2 compressed; ring and latches are retracted and hold
    nothing."""
    made = vehicles.machine(level, dead_pusher=True, petals=petals)
    height = d.MATED - d.PULLED_DEEPER
    stewart.set_pose(made.model, made.data, np.array([0.0, 0.0, height]))
    vehicles.set_vehicle(made, "chaser", (0, 0, -d.MATED), np.eye(3))
    for i in vehicles.LATCHES:
        made.data.qpos[made.model.joint(f"latch_{i}").qposadr[0]] = -d.LATCH_STROKE
    return _faced(made)


def _faced(made):
    vehicles.set_vehicle(made, "target", (0, 0, 0), vehicles.flipped())
    _open_hooks(made, True)
    made.start()
    return made


def _open_hooks(made, hard):
    for i in range(d.HOOKS if hard else 0):
        made.data.qpos[made.model.joint(f"hook_{i}").qposadr[0]] = -d.HOOK_OPEN


class Watch:
    """Recorder of peaks by phase, and of the legs' kinematics at each tenth step."""

    def __init__(self):
        self.force, self.moment, self.leg, self.stroke = {}, {}, {}, 0.0
        self.wrong, self.closure, self.beyond, self.steps = 0.0, 0.0, 0.0, 0

    def __call__(self, made, sequencer):
        phase, wrench = sequencer.phase, made.wrench("target")
        for peaks, value in (
            (self.force, np.linalg.norm(wrench[:3])),
            (self.moment, np.linalg.norm(wrench[3:])),
            (self.leg, np.abs(made.data.actuator_force[stewart.actuator_slice(made.model)]).max()),
        ):
            peaks[phase] = max(peaks.get(phase, 0.0), float(value))
        self.steps += 1
        if self.steps % 10 == 0:
            self._look_at_legs(made)

    def _look_at_legs(self, made):
        self.stroke = max(self.stroke, d.EXTENDED - float(stewart.pose(made.model, made.data)[0][2]))
        wrong, gap = wrong_kinematics(made)
        self.wrong, self.closure, self.beyond = (
            max(self.wrong, wrong),
            max(self.closure, gap),
            max(self.beyond, wrong - gap),
        )


def wrong_kinematics(made):
    """(largest difference of a slide from the closed form of the ring's pose, largest gap of a closure), m."""
    place, turned = stewart.pose(made.model, made.data)
    slides = np.array([made.joint(f"leg_{i}") for i in range(stewart.LEGS)])
    ring = made.data.body("ring")
    tips = ring.xpos + stewart.ON_RING @ ring.xmat.reshape(3, 3).T
    gaps = [np.linalg.norm(tip - made.data.body(f"rod_{i}").xpos) for i, tip in enumerate(tips)]
    return np.abs(slides - stewart.joints(place, turned)[:, 2]).max(), max(gaps)


def motion(made, name):
    """Velocity of the mass centre of a vehicle with all its parts, and its angular velocity, in the world's axes."""
    mujoco.mj_subtreeVel(made.model, made.data)
    spin = np.empty(6)
    mujoco.mj_objectVelocity(made.model, made.data, mujoco.mjtObj.mjOBJ_BODY, made.model.body(name).id, spin, 0)
    return made.data.subtree_linvel[made.model.body(name).id].copy(), spin[:3]


@dataclass
class Result:
    machine: object
    sequencer: Sequencer
    watch: Watch

    @property
    def captured(self):
        return self.sequencer.captured_at is not None

    @property
    def tunnelled(self):
        return self.machine.tunnelled

    def relative_speed(self):
        return motion(self.machine, "chaser")[0] - motion(self.machine, "target")[0]


def run(case, until, limit=60.0, prepare=None, watched=None):
    """Runs until the sequencer enters the phase `until` or aborts, at most `limit` s."""
    made = approach(case)
    sequencer = Sequencer(case.dead_latch, case.stuck_leg, case.give_up)
    return go_on(made, sequencer, until, limit, prepare, watched)


def go_on(made, sequencer, until, limit=60.0, prepare=None, watched=None):
    if prepare is not None:
        prepare(made)
    watch = Watch()
    while made.time < limit and sequencer.phase not in (until, "abort"):
        made.advance(sequencer)
        watch(made, sequencer)
        if watched is not None:
            watched(made, sequencer)
    return Result(made, sequencer, watch)


def same_bits_after_restart(case, before, after):
    return same_bits(lambda: approach(case), Sequencer(case.dead_latch, case.stuck_leg), before, after)


def same_bits_while_hooking(level, before, after):
    return same_bits(lambda: captured(d.MATED, level), Sequencer(from_phase="hook"), before, after)

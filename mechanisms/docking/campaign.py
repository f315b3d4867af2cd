"""Approaches dispersed over the initial contact conditions: probability of capture, and loads.

Level training, without hooks and pads, until AFTER s from capture or until GIVE_UP. The sequencer has a tick of TICK
and holds its commands between; loads are seen in each step. No closed form says which approach is captured.
"""

import math

import dimensions as d
import docking
import mujoco
import numpy as np
import stewart
from kit.campaign import ANY_WAY, OverDisc, Study, Uniform
from sequence import Sequencer

GIVE_UP = 12.0  # s
AFTER = 2.5  # s from capture on: the vehicles have stopped
TICK, SEEN = 5, 100  # steps
DISPERSED = {
    "speed": Uniform(*d.CLOSING),
    "lateral": OverDisc(d.LATERAL),
    "lateral_way": ANY_WAY,
    "lateral_rate": OverDisc(d.LATERAL_RATE),
    "lateral_rate_way": ANY_WAY,
    "tilt": OverDisc(d.TILT),
    "tilt_way": ANY_WAY,
    "roll": Uniform(-d.ROLL, d.ROLL),
    **{f"rate_{axis}": Uniform(-d.RATE, d.RATE) for axis in "xyz"},
}


def polar(values, name):
    length, way = values[name], values[f"{name}_way"]
    return (length * math.cos(way), length * math.sin(way))


def case(values):
    return docking.Case(
        speed=values["speed"],
        lateral=polar(values, "lateral"),
        lateral_rate=polar(values, "lateral_rate"),
        tilt=polar(values, "tilt"),
        roll=values["roll"],
        rates=tuple(values[f"rate_{axis}"] for axis in "xyz"),
        give_up=GIVE_UP,
    )


class Peaks:
    """Cheap recorder of the per-step data for a row of results: many steps are stored, then processed together."""

    def __init__(self, made):
        self.force = self.moment = self.leg = self.stroke = 0.0
        first = 3 + 6 * made.carriers.index(made.model.body("target").id)
        self.force_at, self.moment_at = slice(first, first + 3), slice(first + 3, first + 6)
        # Views of MuJoCo's memory.
        self.sensed, self.qpos = made.data.sensordata[made.sensed], made.data.qpos
        self.legs = made.data.actuator_force[stewart.actuator_slice(made.model)]
        self.slide = made.model.joint("ring_z").qposadr[0]
        self.seen, self.pushed, self.kept = np.empty((SEEN, len(self.sensed))), np.empty((SEEN, stewart.LEGS)), 0

    def go(self, made):
        """Runs one tick."""
        for i in range(self.kept, self.kept + TICK):
            mujoco.mj_step(made.model, made.data)
            self.seen[i], self.pushed[i] = self.sensed, self.legs
        self.kept += TICK
        self.stroke = max(self.stroke, -self.qpos[self.slide])
        if self.kept == SEEN:
            self.look(made)

    def look(self, made):
        seen, pushed, self.kept = self.seen[: self.kept], self.pushed[: self.kept], 0
        if not len(seen):
            return
        made.judge(seen)
        self.force = max(self.force, most(seen[:, self.force_at]))
        self.moment = max(self.moment, most(seen[:, self.moment_at]))
        self.leg = max(self.leg, float(np.abs(pushed).max()))


def most(vectors):
    return math.sqrt((vectors * vectors).sum(axis=1).max())


_made = []  # of this process: compiling the model takes as long as a second of the approach


def begin(values):
    if not _made:
        _made.append(docking.approach(case(values), hard=False))
    made = _made[0]
    mujoco.mj_resetData(made.model, made.data)
    made.flags = 0
    return docking.placed(made, case(values), hard=False)


def attempt(values):
    made = begin(values)
    sequencer, peaks = Sequencer(give_up=GIVE_UP, hard=False), Peaks(made)
    touching = made.contacts()
    while sequencer.phase != "abort" and not ended(made, sequencer):
        sequencer(made)
        peaks.go(made)
    peaks.look(made)
    return {
        "success": int(sequencer.captured_at is not None),
        "peak_force": peaks.force,
        "peak_moment": peaks.moment,
        "peak_leg": peaks.leg,
        "stroke": float(peaks.stroke),
        "time": sequencer.captured_at or made.time,
        "touching": touching,
        "tunnelled": int(made.tunnelled),
    }


def ended(made, sequencer):
    return sequencer.captured_at is not None and made.time > sequencer.captured_at + AFTER


STUDY = Study(
    "docking",
    DISPERSED,
    attempt,
    {
        "peak_force": ("greatest force between the vehicles", "N", 1.0),
        "peak_moment": ("greatest moment about the target's port", "N·m", 1.0),
        "peak_leg": ("greatest force of a leg", "N", 1.0),
        "stroke": ("stroke of the ring", "mm", 1e3),
        "time": ("time of capture", "s", 1.0),
        "touching": ("contacts at the start", "", 1.0),
    },
    success="captured",
    predicts=False,
)

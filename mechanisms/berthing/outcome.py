"""Outcomes of the berthing mechanism and their predictions. Run by mechanisms/run.py: `rows(thorough)` yields (title,
rows)."""

import pathlib
import tempfile
import time

import numpy as np

import berth
import mechanism
import off_nominal
import ready
import rig_bumper
import rig_latch
import rig_push
import sequencer as seq
import statics
from dimensions import ANALYSIS, ROLLER_FRICTION, TRAINING, Level, common
from kit import rules
from kit.rows import Fact, Limit, Row

LATCHES = berth.LATCHES
SEEN = 1.0  # s over which forces are averaged: the module rocks by a tenth of a milliradian
RESTED = 8.0  # s after which it no longer does


class Seen:
    """Mean forces on the module, N, while the latches hold."""

    def __init__(self):
        self.rows = []

    def __call__(self, machine):
        groups = ("coupler", "plunger", "paddle")
        of_each = [sum(machine.wrench(f"{name}_{i}")[2] for i in LATCHES) for name in groups]
        self.rows.append([-machine.wrench("world")[2], *of_each, machine.gap()])

    def mean(self):
        return np.mean(self.rows, axis=0)


def berthed(case, after=0.0):
    """Runs until the latches have stalled, then for `after` s. Returns the machine and the mean forces."""
    machine, seen = berth.Berthing(case), Seen()
    machine.until(seq.HOLD)
    machine.run(after, machine.control)
    machine.watchers.append(seen)
    machine.run(SEEN, machine.control)
    return machine, seen.mean()


def order(machine):
    ends = machine.sequencer.ends[: seq.HOLD]
    yield Fact("approach, capture, limp, pull, hold: in this order", 0.0 < ends[0] and ends == sorted(ends))
    yield Limit("movement of a latch before all indicators are ready", machine.moved_early, 1e-9, "rad")
    yield Fact("all latches have closed", machine.phase() == "hold" and not machine.sequencer.fault)


def held(forces, friction):
    """Forces compared with springs and linkage; friction of the rollers takes a share of the motors' torque."""
    supports, latches, plungers, paddles, _ = forces
    z = statics.rest()[0]
    full = 4 * statics.latch(z, 1.0)
    least = 4 * statics.latch(z, 1.0, friction)
    room = 1.0 - least / full if friction else 2e-3
    yield Row("four latches hold with Στ·dθ/dz", latches, full, room, "N")
    yield Row(
        "stops and standoffs carry what latches pull, less the indicators",
        supports,
        latches + plungers + paddles,
        2e-3,
        "N",
    )
    yield Row(
        "stops and standoffs by their springs", supports, 8 * (statics.stop(z) + statics.standoff(z)), room + 5e-3, "N"
    )
    yield Row("four plungers", -plungers, 4 * statics.plunger(z), 2e-3, "N")
    yield Row("four paddles", -paddles, 4 * statics.paddle(z), 2e-3, "N")


def rested():
    """Forces once the module has stopped rocking."""
    _, forces = berthed(berth.Case(), RESTED)
    yield from held(forces, ROLLER_FRICTION)
    yield Row("the rings are pressed together by", -forces[-1] * 1e6, -statics.rest()[0] * 1e6, 0.03, "µm")


def honest(machine):
    yield from rules.honest(machine)
    yield Limit("what is left of Freudenstein's equation of any latch", machine.off_loop, 1e-6)


def nominal(level):
    machine, forces = berthed(berth.Case(level=level))
    yield from order(machine)
    yield from held(forces, ROLLER_FRICTION)
    x, y, _ = machine.place("passive")
    yield Limit(
        "off-centre, of what the guides leave free", float(np.hypot(x, y)), 2**0.5 * common.GUIDE_CLEARANCE, "m"
    )
    yield from honest(machine)


def restarts(moments):
    for moment in moments:
        same = berth.same_bits_after_restart(berth.Case(), moment, 0.2)
        yield Fact(f"restarted at {moment:g} s: the same bits", same)


def cost():
    """Cost of a step alone, without the energy account."""
    import mujoco

    machine, spent = berth.Berthing(berth.Case()), []
    while machine.sequencer.phase < seq.PULL:
        machine.control()
        began = time.thread_time()
        mujoco.mj_step(machine.model, machine.data)
        spent.append(time.thread_time() - began)
    middle, late = np.quantile(spent, (0.5, 0.99)) * 1e6
    print(f"      processor time of a step of level training: median {middle:.0f} µs, 99 % below {late:.0f} µs")
    yield Limit("median of the processor time of a step", middle, 1e6 * TRAINING.step, "µs")


def halved(level):
    """A berthing at its step and at half of it."""
    finer = Level(f"{level.name}, half the step", level.step / 2, level.armature, level.closure)
    (whole, forces), (half, others) = berthed(berth.Case(level=level)), berthed(berth.Case(level=finer))
    yield from honest(whole)
    yield Fact("berthed at half the step", half.phase() == "hold" and not half.sequencer.fault)
    for phase in (seq.APPROACH, seq.CAPTURE, seq.PULL):
        yield Row(
            f"time at which the phase {seq.PHASES[phase]} ends",
            half.sequencer.ends[phase],
            whole.sequencer.ends[phase],
            0.03,
            "s",
        )
    for name, a, b in zip(("stops and standoffs", "latches"), forces, others):
        yield Row(f"force of {name} at half the step", b, a, 0.02, "N")
    yield from honest(half)


def stalled(thorough):
    with tempfile.TemporaryDirectory() as folder:
        smooth = berth.without_friction(pathlib.Path(folder))
        yield from off_nominal.stalled_latch(rig_push.BARE, "bare ring", smooth, until_stops=thorough)
        if thorough:
            yield from off_nominal.stalled_latch(mechanism.Load(), "module", smooth)


DRAWN = ("world", "passive", "crank_*", "coupler_*", "follower_*")  # bodies that logs and films show beside what touches


def shown(prepare):
    """Run for logs and films: `prepare` receives the machine before it moves."""
    machine = berth.Berthing(berth.Case(unberth=True))
    prepare(machine)
    machine.until(seq.AWAY)
    machine.run(2.0, machine.control)


def rows(thorough):
    yield "berthing, level training", nominal(TRAINING)
    yield "latches, level training", rig_latch.rows([TRAINING])
    yield "bumper", rig_bumper.rows()
    yield "push-off", rig_push.rows(TRAINING, thorough)
    yield "one dead indicator", off_nominal.dead_indicator()
    yield "one stalled latch", stalled(thorough)
    yield "restart", restarts([3.0, 9.5] if thorough else [3.0])
    if thorough:
        yield "at rest", rested()
        yield "cost of a step", cost()
        yield "latches, level analysis", rig_latch.rows([ANALYSIS])
        yield "berthing, level analysis", halved(ANALYSIS)
        yield "ready map", ready.rows()
        yield "unberthing", off_nominal.unberthing(TRAINING)

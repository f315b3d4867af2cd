"""Failures during a berthing, and the departure of a module."""

import math

import numpy as np

import berth
import dimensions as d
import rig_push
import sequencer as seq
import statics
from dimensions import common
from kit.rules import honest
from kit.rows import Fact, Limit, Row

STALLED = 3  # the latch without power
SIDE = math.radians(common.LATCH_AZIMUTHS[STALLED])
STOPS_AT = -0.5  # angle of its crank: the roller is on its way up
HELPED = (1.0, 1.0, 1.0, 0.0)
ROCKS_FOR = 2.0  # s that the module rocks hard on the stops; then its tilt is averaged
AVERAGED_FOR = 14.0
ALIGNED = {"offset": (0.0, 0.0), "turn": (0.0, 0.0, 0.0), "gap": 0.075}


def mean_tilt(machine, seconds):
    """Mean tilt toward the side of the latch that does not pull, rad: positive if that side is higher."""
    tilts = []
    machine.run(seconds, machine.control, lambda m: tilts.append(m.tilt()) and False)
    about_x, about_y, _ = np.mean(tilts, axis=0)
    return about_x * math.sin(SIDE) - about_y * math.cos(SIDE)


def predicted_tilt(share, start):
    _, about_x, about_y = statics.rest([share * one for one in HELPED], start)
    return about_x * math.sin(SIDE) - about_y * math.cos(SIDE)


def dead_indicator(seconds=5.5):
    """The nominal case is ready after 4.4 s; this one waits until the timeout."""
    machine = berth.Berthing(berth.Case(dead_indicator=2))
    machine.run(seconds, machine.control)
    told = machine.told()
    others = [told.stroke[i] >= d.READY_STROKE and told.turn[i] >= d.READY_TURN for i in (0, 1, 3)]
    yield Fact("one dead indicator: the other three are ready", all(others))
    yield Fact("no latch is let go", machine.sequencer.phase == seq.APPROACH)
    yield Limit("movement of a crank at the end", max(abs(crank - d.STOWED) for crank in told.crank), 1e-9, "rad")


def stalled_latch(load, name, folder, until_stops=True):
    """Three latches pull; `folder` has the models without friction.

    The bare ring comes to rest. The module does not rest on the standoffs in time; on the stops it rocks about its tilt.
    """
    bare = load.mass < 1e3
    case = berth.Case(load=load, stalled=(STALLED, STOPS_AT), folder=folder, **ALIGNED)
    machine = berth.Berthing(case)
    machine.until(seq.LIMP)
    if bare:
        # Before the current rises: the arm is limp, and three latches hold against the standoffs.
        machine.run(0.8, machine.control)
        tilt = mean_tilt(machine, 0.15)
        yield Row(f"{name}: tilt on the standoffs", tilt, predicted_tilt(d.CAPTURE_SHARE, 0.015), 0.01, "rad")
    if until_stops:
        found = machine.until(seq.HOLD) and machine.sequencer.fault
        yield Fact(f"{name}: the sequence finds that a latch has not closed", found)
        machine.run(ROCKS_FOR, machine.control)
        tilt = mean_tilt(machine, 0.5 if bare else AVERAGED_FOR)
        yield Row(
            f"{name}: tilt on the stops, at full current",
            tilt,
            predicted_tilt(1.0, 1e-3),
            0.02,
            "rad",
        )
    yield Fact("no contact tunnelled, no limit was met", machine.flags == 0)


def unberthing(level):
    """Run from the approach to the departure."""
    machine = berth.Berthing(berth.Case(level=level, unberth=True))
    machine.until(seq.AWAY)
    yield Fact(
        "latches are stowed when the bolts let go", machine.phase() == "away" and seq.all_stowed(machine.told())
    )
    machine.run(10.0, machine.control, rig_push.apart)
    left = rig_push.speed(machine, "module")
    yield Row("speed at which the module leaves", left, rig_push.predicted(machine.case.load.mass), 0.03, "m/s")
    yield Row("½·m·v² over ½·Σk·δ²", 0.5 * machine.case.load.mass * left**2 / statics.stored(0.0), 1.0, 0.08)
    yield from honest(machine)

#!/usr/bin/env python3
"""Capture and release loads of a free flyer of 16 t, the largest in each phase, at both levels: the table of README.md.

python3 mechanisms/end_effector/phase_loads.py [LEVEL…]        with the plugin as for mechanisms/run.py; minutes
"""

import argparse
import pathlib
import sys
from dataclasses import replace

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import capture  # noqa: E402
import numpy as np  # noqa: E402
import snare as s  # noqa: E402
from dimensions import Snare, training  # noqa: E402
from scene import Case  # noqa: E402

HEAVY = Case(snare=training(Snare()), mass=16000.0, roll_deg=0.5, held_for=3.0)
LEVELS = {"analysis": Snare(), "training": HEAVY.snare}
PHASES = ("snare", "retract", "rigidize", "hold", "release", "open", "push")


class Loads:
    """Largest loads of each phase: force along and across the shell's axis, moment about the plate's centre, tension."""

    def __init__(self, snare):
        self.snare, self.most = snare, {}

    def __call__(self, machine, sequencer):
        wrench = machine.wrench("payload")
        axis = machine.data.xmat[machine.model.body("shell").id].reshape(3, 3)[:, 2]
        along = float(axis @ wrench[:3])
        across = float(np.linalg.norm(wrench[:3] - along * axis))
        pull = max(s.tension(machine, self.snare, cable) for cable in range(s.CABLES))
        now = np.array([abs(along), across, np.linalg.norm(wrench[3:]), pull])
        self.most[sequencer.phase] = np.maximum(now, self.most.get(sequencer.phase, np.zeros(4)))


def measured(case):
    loads = Loads(case.snare)
    return loads.most, capture.run(case, watch=loads, accounts=False)


def table(found):
    """Table of `found`: (name of the level, loads, result), with the levels side by side."""
    yield "| phase | along the axis, N | across, N | moment about the plate's centre, N·m | tension of a cable, N |"
    yield "|---|---|---|---|---|"
    for phase in PHASES:
        beside = zip(*(most[phase] for _, most, _ in found))
        yield f"| {phase} | " + " | ".join(" / ".join(f"{value:.0f}" for value in values) for values in beside) + " |"
    for name, _, result in found:
        predicted = capture.push_off_speed(HEAVY.mass, result.gap, result.before)
        yield f"{name}: captured {result.captured}, preload {result.preload:.0f} N, away {1e3 * result.away:.2f} mm/s,"
        yield f"    from energy {1e3 * predicted:.2f} mm/s; phases end at {result.ends}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("levels", nargs="*", choices=[*LEVELS, []], help="all unless given")
    names = parser.parse_args().levels or LEVELS
    print("\n".join(table([(name, *measured(replace(HEAVY, snare=LEVELS[name]))) for name in names])))


if __name__ == "__main__":
    main()

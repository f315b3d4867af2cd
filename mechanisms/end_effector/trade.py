#!/usr/bin/env python3
"""Cost of a step at each level, and error of a capture at that level: prints the table of README.md.

python3 mechanisms/end_effector/trade.py        with the plugin as for mechanisms/run.py; minutes. It is part of
the thorough checks.

The reference is level analysis at half its step. Times are the least of several tries of the same step, in the mean over
moments that are spread over the run; what MuJoCo takes is that of the same machine without the plugin.
"""

import pathlib
import sys
import time
import xml.etree.ElementTree as xml
from dataclasses import dataclass, replace

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import capture  # noqa: E402
import mujoco  # noqa: E402
from dimensions import Snare, training  # noqa: E402
from scene import Case, mjcf_text  # noqa: E402

ANALYSIS, TRAINING = Snare(), training(Snare())
EVERY = 0.1  # s between the moments at which a step is timed
TRIES = 5
LEVELS = (
    ("analysis, half the step (reference)", ANALYSIS, 0.5),
    ("analysis", ANALYSIS, 1.0),
    ("cables of training in 16 links", replace(TRAINING, links=16), 0.2),
    ("training, half the step", TRAINING, 0.5),
    ("training", TRAINING, 1.0),
)


@dataclass
class Level:
    name: str
    step: float
    whole: float  # s of a step
    bare: float  # s of it without the plugin
    result: capture.Result


class Timer:
    """Times steps of a machine, and of the same one without the plugin; restores the machine."""

    def __init__(self, case):
        tree = xml.fromstring(mjcf_text(case))
        for name in ("extension", "sensor"):
            tree.remove(tree.find(name))
        self.model = mujoco.MjModel.from_xml_string(xml.tostring(tree, encoding="unicode"))
        self.data = mujoco.MjData(self.model)
        self.steps, self.times = 0, []

    def __call__(self, machine, _):
        self.steps += 1
        if self.steps % round(EVERY / machine.step) == 0:
            self.times.append((self._whole(machine), self._bare(machine)))

    def _whole(self, machine):
        state = machine.save()
        best = min(self._once(machine.model, machine.data, lambda: self._put(machine, state)) for _ in range(TRIES))
        self._put(machine, state)
        return best

    def _put(self, machine, state):
        mujoco.mj_setState(machine.model, machine.data, state, mujoco.mjtState.mjSTATE_INTEGRATION)
        mujoco.mj_forward(machine.model, machine.data)

    def _bare(self, machine):
        self.model.dof_frictionloss[:] = machine.model.dof_frictionloss
        return min(self._once(self.model, self.data, lambda: self._copy(machine)) for _ in range(TRIES))

    def _copy(self, machine):
        self.data.qpos[:], self.data.qvel[:] = machine.data.qpos, machine.data.qvel
        self.data.ctrl[:] = machine.data.ctrl
        mujoco.mj_forward(self.model, self.data)

    @staticmethod
    def _once(model, data, prepare):
        prepare()
        began = time.perf_counter()
        mujoco.mj_step(model, data)
        return time.perf_counter() - began

    def means(self):
        return tuple(sum(column) / len(self.times) for column in zip(*self.times))


def measured(name, snare, share, until="release", accounts=False):
    case = Case(snare=snare, step=share * snare.step)
    timer = Timer(case)
    result = capture.run(case, until, timer, accounts)
    return Level(name, case.step, *timer.means(), result)


def figures(result):
    """Compared figures: N, N, N, s, s."""
    peaks, ends = result.peaks, result.ends
    return result.preload, peaks["snare"], peaks["retract"], ends["snare"], ends["retract"]


def table(levels):
    """Table of levels, of which the first is the reference."""
    reference = figures(levels[0].result)
    yield "| level | step | µs a step: MuJoCo, contact | s for 1 s | preload | peak, snare | peak, retract | closed | seated |"
    yield "|---|---|---|---|---|---|---|---|---|"
    for level in levels:
        values = figures(level.result)
        shown = [f"{v:.0f} N ({100 * (v / r - 1):+.1f} %)" for v, r in zip(values[:3], reference)]
        shown += [f"{v:.2f} s ({100 * (v / r - 1):+.1f} %)" for v, r in zip(values[3:], reference[3:])]
        times = f"{1e6 * level.bare:.0f}, {1e6 * (level.whole - level.bare):.0f} | {level.whole / level.step:.2f}"
        yield f"| {level.name} | {1e3 * level.step:g} ms | {times} | {' | '.join(shown)} |"


def main():
    print("\n".join(table([measured(*given) for given in LEVELS])))


if __name__ == "__main__":
    main()

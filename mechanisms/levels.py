#!/usr/bin/env python3
"""Cost and error of a mechanism's step: its shown scene at its own step and at a fraction of it.

    python3 mechanisms/levels.py NAME               its step and a quarter of it; with the plugin as for mechanisms/run.py
    python3 mechanisms/levels.py NAME --part 0.5    its step and twice that, where the scene is shown at level analysis

Prints for both the median of the processor time of MuJoCo's step, that of a simulated second, and the greatest force on
any movable group; then the ratios. Nothing else of the scene changes, neither controllers nor integrator. Times are of
the steps alone, without accounts.
"""

import argparse
import contextlib
import pathlib
import sys
import time

import mujoco
import numpy as np
from kit.machine import wrenches

STARTED = 0.01  # s: a scene that begins in contact may begin with a blow, which is not looked at
HERE = pathlib.Path(__file__).resolve().parent


class Timed:
    """Runs the shown scene with its step divided; records the time of each step and the largest load."""

    def __init__(self, shown, part):
        self.part, self.spent, self.peak, self.machine = part, [], 0.0, None
        plain = mujoco.mj_step

        def step(model, data):
            began = time.thread_time_ns()
            plain(model, data)
            self.spent.append(time.thread_time_ns() - began)

        mujoco.mj_step = step
        try:
            shown(self.prepare)
        finally:
            mujoco.mj_step = plain

    def prepare(self, machine):
        self.machine = machine
        machine.model.opt.timestep /= self.part
        machine.step = machine.model.opt.timestep
        # The energy account works within MuJoCo's step.
        machine.ledger = contextlib.nullcontext()
        machine.watchers.append(self.look)

    def look(self, machine):
        if machine.time < STARTED:
            return
        forces = wrenches(machine.data.sensordata[machine.sensed])[:, :3]
        self.peak = max(self.peak, float(np.einsum("ij,ij->i", forces, forces).max()) ** 0.5)

    def step_us(self):
        return float(np.median(self.spent)) * 1e-3

    def second_ms(self):
        return self.step_us() * 1e-3 / self.machine.step

    def line(self):
        return (
            f"step {self.machine.step * 1e3:g} ms: {self.step_us():.0f} µs, {self.second_ms():.0f} ms of a second; "
            f"greatest force {self.peak:.5g} N"
        )


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("name")
    parser.add_argument("--part", type=float, default=4.0, help="by what the step is divided")
    given = parser.parse_args()
    sys.path[:0] = [str(HERE / given.name), str(HERE)]
    import outcome

    coarse, fine = (Timed(outcome.shown, part) for part in sorted((1.0, given.part)))
    print(coarse.line())
    print(fine.line())
    cost, off = fine.second_ms() / coarse.second_ms(), coarse.peak / fine.peak - 1.0
    print(
        f"{given.name}: the finer step takes {cost:.2f} times as long; the greatest force of the other is {off:+.2%} off"
    )


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""A mechanism at the rates of slow hosts: its shown scene at 10, 20, 50 and 100 Hz with copies (docs/slow_hosts.md), with the
wrench held, and alone, without contact, beside its own step. Where it does not run alone, no contact could help.

    python3 mechanisms/slow.py NAME                    with the plugin as for mechanisms/run.py
    python3 mechanisms/slow.py NAME --rates 20 --kinds copies --until 10 --seconds 30

A run ends where the scene ends, at an error, where MuJoCo finds numbers that are not finite, or after a processor time of
--seconds. A line for each run tells how far it came
(time simulated), the largest difference of any body that touches from the run at the scene's own step, at equal times (mean and
end), the greatest force as a multiple of that run's, and the processor time of a simulated second. MuJoCo integrates with
`implicitfast` at these rates; controllers are called once a step.
"""

import argparse
import contextlib
import pathlib
import re
import sys
import time

import mujoco
import numpy as np
from kit.machine import wrenches

HERE = pathlib.Path(__file__).resolve().parent
EVERY = 0.1  # s, of the places that are compared
SUBSTEPS = 20_000
KINDS = ("copies", "held", "alone")


# Warnings after which MuJoCo puts the data back to their start.
UNSTABLE = (mujoco.mjtWarning.mjWARN_BADQPOS, mujoco.mjtWarning.mjWARN_BADQVEL, mujoco.mjtWarning.mjWARN_BADQACC)


class Stopped(Exception):
    pass


class Run:
    """Runs the shown scene; `rate` in Hz, None for its own step."""

    def __init__(self, shown, rate, kind, seconds, until):
        self.rate, self.kind, self.limit, self.until = rate, kind, seconds, until
        self.places, self.peak, self.machine, self.end = {}, 0.0, None, "its end"
        self.reached, self.touched = 0.0, None
        plain = mujoco.MjModel.from_xml_string
        self.began = time.process_time()
        with contextlib.ExitStack() as stack:
            mujoco.MjModel.from_xml_string = lambda text, *rest: plain(self.changed(text), *rest)
            stack.callback(setattr, mujoco.MjModel, "from_xml_string", plain)
            try:
                shown(self.prepare)
            except Stopped as reason:
                self.end = str(reason)
            except Exception as error:  # a scene may raise anything when its motion is wrong
                self.end = f"{type(error).__name__}: {error}".splitlines()[0][:60]
        self.spent = time.process_time() - self.began

    def changed(self, text):
        """The model at this rate."""
        if self.rate is None or "pong.contact" not in text:
            return text
        text = re.sub(r'timestep="[^"]*"', f'timestep="{1.0 / self.rate:.12g}"', text, count=1)
        text = re.sub(r'integrator="[^"]*"', 'integrator="implicitfast"', text, count=1)
        # Without contact: no pair of Objects may touch.
        keys = {"copies": ("substeps_max", SUBSTEPS), "alone": ("filters", re.search(r"key='pairs' value='([^']*)'", text)[1])}
        if self.kind in keys:
            key = "<config key='{}' value='{}'/>".format(*keys[self.kind])
            text = re.sub(r"(<instance name=[^>]*>)", lambda found: found[1] + key, text, count=1)
        return text

    def prepare(self, machine):
        self.machine = machine
        machine.ledger = contextlib.nullcontext()
        machine.watchers.append(self.look)

    def look(self, machine):
        data = machine.data
        if any(data.warning[kind].number for kind in UNSTABLE):
            touched = "before any contact" if self.touched is None else f"first contact at {self.touched:.1f} s"
            raise Stopped(f"not finite, {touched}")
        self.reached = data.time
        if self.touched is None and machine.contacts() > 0:
            self.touched = data.time
        number = round(data.time / EVERY)
        if abs(data.time - number * EVERY) < 0.5 * machine.step:
            self.places[number] = data.xpos[machine.carriers].copy()
        if data.time > 2.0 * EVERY:  # a scene that begins in contact may begin with a blow
            forces = wrenches(data.sensordata[machine.sensed])[:, :3]
            self.peak = max(self.peak, float(np.linalg.norm(forces, axis=1).max(initial=0.0)))
        if data.time >= self.until:
            raise Stopped("as far as asked")
        if time.process_time() - self.began > self.limit:
            raise Stopped("out of processor time")

    def line(self, exact):
        common = sorted(self.places.keys() & exact.places.keys())
        off = [float(np.linalg.norm(self.places[at] - exact.places[at], axis=1).max()) * 1e3 for at in common]
        mean, end = (np.mean(off), off[-1]) if off else (np.nan, np.nan)
        how = "own step" if self.rate is None else f"{self.rate:g} Hz {self.kind}"
        cost = 1e3 * self.spent / max(self.reached, 1e-9)
        return (
            f"| {how} | {self.reached:.1f} s, {self.end} | {mean:.3g} / {end:.3g} mm | "
            f"{self.peak / max(exact.peak, 1e-9):.3g} | {cost:.0f} ms |"
        )


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("name")
    parser.add_argument("--rates", type=float, nargs="*", default=[10.0, 20.0, 50.0, 100.0], help="Hz")
    parser.add_argument("--kinds", nargs="*", choices=KINDS, default=KINDS)
    parser.add_argument("--until", type=float, default=float("inf"), help="time simulated, s")
    parser.add_argument("--seconds", type=float, default=120.0, help="processor time of a run")
    given = parser.parse_args()
    sys.path[:0] = [str(HERE / given.name), str(HERE)]
    import outcome

    exact = Run(outcome.shown, None, "held", 10.0 * given.seconds, given.until)
    print(f"{given.name}\n| run | came to | off, mean / at the end | greatest force | of a second |\n|---|---|---|---|---|")
    print(exact.line(exact), flush=True)
    for rate in given.rates:
        for kind in given.kinds:
            print(Run(outcome.shown, rate, kind, given.seconds, given.until).line(exact), flush=True)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Dispersed approaches within the initial contact conditions: how often is the target captured, and with which loads?

    python3 mechanisms/docking/campaign.py OUT --runs 10000 --workers 2       with the plugin as for mechanisms/run.py
    python3 mechanisms/docking/campaign.py OUT --runs 300 --keep              the worst case goes to worst_case.json

Level training, without hooks and pads, until capture or GIVE_UP. Run i draws from a generator of its own, so it is the
same whatever the number of runs and workers. Rows go to OUT/approaches.csv as they come; what is there is not run again.
"""

import argparse
import csv
import json
import math
import multiprocessing
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [path for path in (str(HERE), str(HERE.parent)) if path not in sys.path]
import dimensions as d  # noqa: E402
import docking  # noqa: E402
import mujoco  # noqa: E402
import numpy as np  # noqa: E402
import stewart  # noqa: E402
from kit.machine import TUNNELLED  # noqa: E402
from sequence import Sequencer  # noqa: E402

WORST = HERE / "worst_case.json"
GIVE_UP = 12.0  # s
AFTER = 2.5  # s from capture on: the vehicles have stopped
SCALE = 1.0  # of the standard's limits
QUANTILES = (0.5, 0.95, 0.99)
COLUMNS = ("run", "captured", "time", "peak_force", "peak_moment", "peak_leg", "stroke", "touching", "tunnelled")


def drawn(run, seed=1):
    """Eleven numbers from 0 to 1: speed, lateral (2), lateral rate (2), tilt (2), roll, rates (3)."""
    return np.random.default_rng([seed, run]).uniform(size=11)


def within_disc(radius, a, b):
    """Even over a disc."""
    r, angle = radius * math.sqrt(a), 2 * math.pi * b
    return (r * math.cos(angle), r * math.sin(angle))


def both_ways(limit, value):
    """Even from −limit to limit."""
    return limit * (2 * value - 1)


def case(u, scale=SCALE):
    return docking.Case(
        speed=d.CLOSING[0] + (d.CLOSING[1] - d.CLOSING[0]) * u[0],
        lateral=within_disc(scale * d.LATERAL, u[1], u[2]),
        lateral_rate=within_disc(scale * d.LATERAL_RATE, u[3], u[4]),
        tilt=within_disc(scale * d.TILT, u[5], u[6]),
        roll=scale * both_ways(d.ROLL, u[7]),
        rates=tuple(scale * both_ways(d.RATE, value) for value in u[8:11]),
        give_up=GIVE_UP,
        gap=docking.GAP + 0.1 * max(scale - 1.0, 0.0),  # m: no approach may begin in contact
    )


class Peaks:
    """What a row of results needs of each step, with little work."""

    def __init__(self, made):
        self.legs = stewart.actuator_slice(made.model)
        self.force = self.moment = self.leg = self.stroke = 0.0
        first = made.sensed.start + 3 + 6 * made.carriers.index(made.model.body("target").id)
        self.wrench, self.slide = slice(first, first + 6), made.model.joint("ring_z").qposadr[0]
        self.flags, self.status = made.sensed.start + 1, made.sensed.start + 2

    def look(self, made):
        wrench = made.data.sensordata[self.wrench]
        self.force = max(self.force, math.sqrt(wrench[:3] @ wrench[:3]))
        self.moment = max(self.moment, math.sqrt(wrench[3:] @ wrench[3:]))
        self.leg = max(self.leg, float(np.abs(made.data.actuator_force[self.legs]).max()))
        self.stroke = max(self.stroke, -float(made.data.qpos[self.slide]))
        made.flags |= int(made.data.sensordata[self.flags])
        if made.data.sensordata[self.status] != 0:
            raise RuntimeError(f"at {made.time:.6f} s a step could not be computed")


def attempt(u, scale=SCALE):
    """One approach: a row of results without its number."""
    made = docking.approach(case(u, scale), hard=False)
    sequencer, peaks = Sequencer(give_up=GIVE_UP, hard=False), Peaks(made)
    touching = made.contacts()
    while sequencer.phase != "abort" and not ended(made, sequencer):
        sequencer(made)
        mujoco.mj_step(made.model, made.data)
        peaks.look(made)
    return {
        "captured": int(sequencer.captured_at is not None),
        "time": sequencer.captured_at or made.time,
        "peak_force": peaks.force,
        "peak_moment": peaks.moment,
        "peak_leg": peaks.leg,
        "stroke": peaks.stroke,
        "touching": touching,
        "tunnelled": int(bool(made.flags & TUNNELLED)),
    }


def ended(made, sequencer):
    return sequencer.captured_at is not None and made.time > sequencer.captured_at + AFTER


def kept():
    return json.loads(WORST.read_text(encoding="utf-8"))


def job(task):
    run, seed, scale = task
    return {"run": run, **attempt(drawn(run, seed), scale)}


def done(path):
    """Rows that are there; one that was cut off when a campaign was stopped does not count."""
    if not path.exists():
        return {}
    with path.open(newline="", encoding="utf-8") as file:
        whole = [row for row in csv.DictReader(file) if row[COLUMNS[-1]]]
    return {int(row["run"]): {key: float(value) for key, value in row.items()} for row in whole}


def same_plan(folder, given):
    """A folder holds one campaign: its rows are those of one seed and scale."""
    plan, path = {"seed": given.seed, "scale": given.scale}, folder / "plan.json"
    if path.exists() and json.loads(path.read_text(encoding="utf-8")) != plan:
        sys.exit(f"{folder} has rows of another seed or scale; name another folder")
    path.write_text(json.dumps(plan), encoding="utf-8")


def run_all(path, tasks, workers):
    """Writes each row when it comes."""
    fresh = not path.exists()
    with (
        path.open("a", newline="", encoding="utf-8") as file,
        multiprocessing.get_context("spawn").Pool(workers) as pool,
    ):
        writer = csv.DictWriter(file, COLUMNS)
        if fresh:
            writer.writeheader()
        for row in pool.imap_unordered(job, tasks):
            writer.writerow(row)
            file.flush()


def conclude(rows):
    from pong.campaign import quantile_interval, wilson

    captured = int(sum(row["captured"] for row in rows))
    low, high = wilson(captured, len(rows), 0.95)
    print(
        f"{len(rows)} approaches, {captured} captured: {captured / len(rows):.4f}, with 95 % confidence {low:.4f} to {high:.4f}"
    )
    print(
        f"{sum(row['tunnelled'] for row in rows):.0f} tunnelled, {sum(row['touching'] > 0 for row in rows)} began in contact"
    )
    for name, unit in (("peak_force", "N"), ("peak_moment", "N·m"), ("peak_leg", "N"), ("stroke", "m"), ("time", "s")):
        values = np.array([row[name] for row in rows])
        for share in QUANTILES:
            bounds = [f"{bound:.5g}" if bound is not None else "?" for bound in quantile_interval(values, share, 0.95)]
            print(f"{name} {share:.0%}: {np.quantile(values, share):.5g} {unit} ({bounds[0]} to {bounds[1]})")


def worst_of(rows):
    """A lost approach if there is one, else the one with the greatest force."""
    return max(rows, key=lambda row: (not row["captured"], row["peak_force"]))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=10000)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--scale", type=float, default=SCALE, help="of the standard's limits")
    parser.add_argument("--keep", action="store_true", help="writes the worst case beside this file")
    given = parser.parse_args()
    given.out.mkdir(parents=True, exist_ok=True)
    same_plan(given.out, given)
    path = given.out / "approaches.csv"
    before = done(path)
    run_all(path, [(i, given.seed, given.scale) for i in range(given.runs) if i not in before], given.workers)
    rows = [row for i, row in sorted(done(path).items()) if i < given.runs]
    conclude(rows)
    worst = worst_of(rows)
    print(f"worst: run {worst['run']:.0f}, {'captured' if worst['captured'] else 'lost'}, {worst['peak_force']:.1f} N")
    if given.keep:
        found = {
            "run": int(worst["run"]),
            "seed": given.seed,
            "scale": given.scale,
            "drawn": drawn(int(worst["run"]), given.seed).tolist(),
        }
        WORST.write_text(
            json.dumps({**found, "peak_force": worst["peak_force"], "captured": worst["captured"]}, indent=1) + "\n",
            encoding="utf-8",
        )


if __name__ == "__main__":
    main()

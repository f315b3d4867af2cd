"""A campaign of a mechanism: many runs with dispersed values, a row of results for each (mechanisms/README.md).

`mechanisms/NAME/campaign.py` has a `STUDY`: what is dispersed, a run, and what counts as success. This file draws the
values, runs what is not in the folder yet, and keeps the rows; conclusion.py says what they come to. `pong.campaign`
runs scenes of the built-in executive; what moves here is moved by MuJoCo. Values are drawn as its method `random` does.
"""

import csv
import functools
import json
import math
import multiprocessing
import sys
from collections.abc import Callable
from dataclasses import dataclass
from statistics import NormalDist

import numpy as np

from kit import parameters

CHUNK = 4  # runs that a worker takes at once


@dataclass(frozen=True)
class Uniform:
    low: float
    high: float

    def at(self, share):
        """Quantile function: the value below which lies a share of all values."""
        return self.low + (self.high - self.low) * share


@dataclass(frozen=True)
class Normal:
    mean: float
    deviation: float

    def at(self, share):
        return NormalDist(self.mean, self.deviation).inv_cdf(share)


@dataclass(frozen=True)
class OverDisc:
    """Radius of points uniform over a disc; use with a uniform direction."""

    radius: float

    def at(self, share):
        return self.radius * math.sqrt(share)


ANY_WAY = Uniform(0.0, 2.0 * math.pi)  # direction, rad


@dataclass(frozen=True)
class Study:
    """Definition of a mechanism's campaign.

    `attempt(values)` runs a case: a dict with `success` (0 or 1), the quantities, and `tunnelled` (0 or 1). If a closed
    form says what must come out, the dict has `margin` as well: how far the case lies within the limit of success (above
    zero) or beyond (below), as a share of the limit. Within `band` of the limit cases are counted apart.
    """

    name: str
    dispersed: dict  # name → distribution
    attempt: Callable
    quantities: dict  # name → (what it is, unit, factor to the unit)
    success: str = "succeeded"
    band: float = 0.0
    predicts: bool = True
    worst: Callable | None = None  # a row's badness; without, failures first, then by the first quantity

    @property
    def columns(self):
        told = ("success", *(("margin",) if self.predicts else ()), *self.quantities, "tunnelled", "failed")
        return ("run", *self.dispersed, *told)


def drawn(study, run, seed):
    """Values of a run, which depend only on seed, run and index of the dispersion in the list."""
    shares = np.random.default_rng([seed, run]).random(len(study.dispersed))
    return {name: float(spread.at(share)) for (name, spread), share in zip(study.dispersed.items(), shares)}


def row_of(study, seed, run):
    """Runs a case; one that MuJoCo or Pong refuses to compute has failed: it is no success, and has no loads."""
    values = drawn(study, run, seed)
    try:
        came = {**study.attempt(values), "failed": 0}
    except RuntimeError as error:
        print(f"run {run} failed: {error}", file=sys.stderr)
        came = {**dict.fromkeys(study.quantities, math.nan), "margin": math.nan, "success": 0, "tunnelled": 0}
        came["failed"] = 1
    row = {"run": run, **values, **came}
    return {name: row[name] for name in study.columns}


def read(study, path):
    """Complete rows by run number; one cut off when a campaign was stopped does not count."""
    if not path.exists():
        return {}
    with path.open(newline="", encoding="utf-8") as file:
        whole = [row for row in csv.DictReader(file) if row[study.columns[-1]]]
    return {int(row["run"]): {name: float(value) for name, value in row.items()} for row in whole}


def same_plan(study, folder, seed):
    """Checks that the folder belongs to this campaign: its rows are those of one study, one seed, and the same parameters."""
    dispersed = {name: repr(spread) for name, spread in study.dispersed.items()}
    plan, path = {"mechanism": study.name, "seed": seed, "dispersed": dispersed}, folder / "plan.json"
    changed = parameters.installed()[1]
    if changed:
        plan["parameters"] = changed
    if path.exists() and json.loads(path.read_text(encoding="utf-8")) != plan:
        sys.exit(f"{folder} has rows of another campaign; name another folder")
    path.write_text(json.dumps(plan, indent=1) + "\n", encoding="utf-8")


def go_on(study, folder, runs, seed=1, workers=1):
    """Computes the missing runs of the folder; each row is on the disk when its run has ended. Returns all rows, in order."""
    folder.mkdir(parents=True, exist_ok=True)
    same_plan(study, folder, seed)
    path = folder / "rows.csv"
    before = read(study, path)
    _mend(study, path, before)
    left = [run for run in range(runs) if run not in before]
    with path.open("a", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, study.columns)
        for row in _computed(functools.partial(row_of, study, seed), left, workers):
            writer.writerow(row)
            file.flush()
    return [row for run, row in sorted(read(study, path).items()) if run < runs]


def _mend(study, path, rows):
    """Rewrites the file without an incomplete row, so that the next one begins on a new line."""
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, study.columns)
        writer.writeheader()
        writer.writerows({**row, "run": run} for run, row in rows.items())


def _computed(job, runs, workers):
    if workers == 1:
        yield from map(job, runs)
        return
    with multiprocessing.get_context("spawn").Pool(workers, parameters.again, parameters.installed()) as pool:
        yield from pool.imap_unordered(job, runs, CHUNK)

"""An interval of a load in three parts: numerical, input and model (docs/sensitivity.md).

The first half computes with numbers alone, whatever made them; the second runs the scene of a plan."""

import contextlib
import math
import pathlib
from dataclasses import dataclass, replace

import numpy as np

import pong

from . import _alternatives
from ._dispersions import number
from ._errors import CampaignError
from ._plan import Plan
from ._run import client, perform
from ._store import Store
from ._summary import binomial_cumulative, check_share

# Observed orders are limited to these, as in `pong trade`.
ORDERS = (0.5, 4.0)
# Values below this share of the median say nothing about a factor.
NEGLIGIBLE = 0.01


@dataclass(frozen=True)
class Variant:
    """Values of a quantity in runs that differ in one setting from the same runs of the plan.

    Attributes
    ----------
    name : str
        Name of the variant.
    folder : str
        Folder of its campaign; empty if the values were given.
    runs : int
        Number of runs that came to their end in both.
    left_out : int
        Number of ranks that say nothing about a factor, because the value of the plan is nearly zero.
    low, high : float
        Smallest and largest factor between values of the same rank.
    single : float
        Factor of the single run that changes most.
    single_run : int
        Number of that run.
    """

    name: str
    folder: str
    runs: int
    left_out: int
    low: float
    high: float
    single: float
    single_run: int


@dataclass(frozen=True)
class Part:
    """One of the three parts of an interval.

    Attributes
    ----------
    name : str
        `input`, `numerical` or `model`.
    low, high : float
        Ends: of `input` in the unit of the quantity, of the others as factors.
    basis : str
        Origin of the ends, in words.
    variants : list of Variant
        Variants that show it.
    """

    name: str
    low: float
    high: float
    basis: str
    variants: list


@dataclass(frozen=True)
class Interval:
    """Interval of a load. `print` shows it as text.

    Attributes
    ----------
    quantity : str
        Name of the quantity.
    median : float
        Median over the runs of the plan.
    low, high : float
        Ends: those of the input part, times the factors of the others.
    input, numerical, model : Part
        The three parts.
    """

    quantity: str
    median: float
    low: float
    high: float
    input: Part
    numerical: Part
    model: Part

    def __str__(self):
        head = f"{self.quantity}: median {self.median:.4g}, from {self.low:.4g} to {self.high:.4g} with all three parts"
        lines = [head, f"input: from {self.input.low:.4g} to {self.input.high:.4g}; {self.input.basis}"]
        for part in (self.numerical, self.model):
            lines.append(f"{part.name}: {percent(part.low)} to {percent(part.high)}; {part.basis}")
            for one in part.variants:
                text = f"   {one.name}: {percent(one.low)} to {percent(one.high)} in {one.runs} runs"
                text += f", a single run up to {percent(one.single)} (run {one.single_run})"
                text += f"; {one.left_out} values near zero left out" if one.left_out else ""
                lines.append(text + (f"; {one.folder}" if one.folder else ""))
        return "\n".join(lines)

    def markdown(self, unit=""):
        """Returns the interval as a table for a page.

        Parameters
        ----------
        unit : str, optional
            Unit of the quantity.

        Returns
        -------
        str
        """
        unit = f" {unit}" if unit else ""
        rows = [f"| {self.quantity} | from | to | shown by |", "|---|---|---|---|"]
        rows.append(f"| input | {self.input.low:.4g}{unit} | {self.input.high:.4g}{unit} | {self.input.basis} |")
        for part in (self.numerical, self.model):
            rows.append(f"| {part.name} | {percent(part.low)} | {percent(part.high)} | {part.basis} |")
            for one in part.variants:
                shown = f"{one.runs} runs; a single run up to {percent(one.single)}"
                rows.append(f"| – {one.name} | {percent(one.low)} | {percent(one.high)} | {shown} |")
        rows.append(f"| **together** | **{self.low:.4g}{unit}** | **{self.high:.4g}{unit}** | median {self.median:.4g}{unit} |")
        return "\n".join(rows)


def percent(factor):
    return f"{100.0 * (factor - 1.0):+.2g} %"


# --- from numbers


def tolerance(values, coverage=0.95, confidence=0.95):
    """Returns a distribution-free tolerance interval: with the confidence, at least `coverage` of all values are inside.

    Parameters
    ----------
    values : array_like, shape (n,)
        Values of independent runs.
    coverage : float, default 0.95
        Share of all values that is to be inside.
    confidence : float, default 0.95
        Confidence of that.

    Returns
    -------
    tuple[float, float, float]
        Ends, and the share that is inside with the confidence: less than `coverage` if there are too few values, whose
        least and largest are the ends then.
    """
    check_share("coverage", coverage)
    check_share("confidence", confidence)
    ordered = np.sort(np.asarray(values, dtype=float))
    n = len(ordered)
    if n < 2:
        raise CampaignError(f"tolerance: there are {n} values; give at least 2")
    # The share between the order statistics t and n + 1 − t exceeds β with P(X ≤ n − 2t), X binomial with n and β (Wilks).
    cumulative = binomial_cumulative(n, coverage)
    inside = [t for t in range(1, (n - 1) // 2 + 1) if cumulative[n - 2 * t] >= confidence]
    if inside:
        return float(ordered[inside[-1] - 1]), float(ordered[n - inside[-1]]), coverage
    return float(ordered[0]), float(ordered[-1]), covered(n, confidence)


def covered(n, confidence):
    """Share that is between the least and the largest of n values, with a confidence: 1 − n·β^(n − 1) + (n − 1)·β^n."""
    low, high = 0.0, 1.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        if 1.0 - n * middle ** (n - 1) + (n - 1) * middle**n >= confidence:
            low = middle
        else:
            high = middle
    return low


def three_parts(quantity, base, steps, models, *, coverage=0.95, confidence=0.95, folders=None):
    """Computes an interval in three parts from values that were made by any means.

    Parameters
    ----------
    quantity : str
        Name of the quantity.
    base : array_like, shape (n,)
        Values of the runs of the plan; not-a-number for runs that failed.
    steps : sequence of array_like
        Values of the first of these runs with half the step, and with a quarter of it.
    models : Mapping[str, array_like]
        Values of the first of these runs, for each alternative of the model.
    coverage : float, default 0.95
        Share of all runs that is to be inside the input part.
    confidence : float, default 0.95
        Confidence of that.
    folders : Mapping[str, str], optional
        Folders of the variants, by their names.

    Returns
    -------
    Interval

    Raises
    ------
    CampaignError
        There are too few values, or none of them is above zero.
    """
    base, folders = np.asarray(base, dtype=float), folders or {}
    good = base[np.isfinite(base)]
    low, high, reached = tolerance(good, coverage, confidence)
    share = f"with {100 * confidence:g} % confidence at least {100 * math.floor(1e3 * reached) / 1e3:g} % of all runs are inside"
    basis = f"{len(good)} runs; {share}" + ("" if reached >= coverage else ", which more runs raise")
    inputs = Part("input", low, high, basis, [])
    names = ("half the step", "a quarter of the step")
    variants = [variant(name, base, values, folders) for name, values in zip(names, steps)]
    numerical = numerical_part(base, steps, variants)
    variants = [variant(name, base, values, folders) for name, values in models.items()]
    basis = f"{len(variants)} alternatives" if variants else "no alternative was run"
    model = Part("model", *hull(variants), basis, variants)
    ends = (low * numerical.low * model.low, high * numerical.high * model.high)
    return Interval(quantity, float(np.median(good)), *ends, inputs, numerical, model)


def variant(name, base, values, folders):
    """Compares values rank by rank: the distribution of the variant is that of the plan, scaled by its factors."""
    values = np.asarray(values, dtype=float)
    before = base[: len(values)]
    both = np.flatnonzero(np.isfinite(before) & np.isfinite(values))
    if not len(both):
        raise CampaignError(f"variant `{name}`: no run came to its end in both; look at the failures")
    before, values = before[both], values[both]
    floor = NEGLIGIBLE * float(np.median(before))
    if not floor > 0.0:
        raise CampaignError(f"variant `{name}`: half of the values or more are not above zero; take a quantity that is")
    loaded = np.sort(before) > floor
    factors = np.sort(values)[loaded] / np.sort(before)[loaded]
    single = values[before > floor] / before[before > floor]
    most = int(np.argmax(np.abs(np.log(np.maximum(single, 1e-300)))))
    run = int(both[before > floor][most])
    ends = float(factors.min()), float(factors.max())
    return Variant(name, str(folders.get(name, "")), len(both), int((~loaded).sum()), *ends, float(single[most]), run)


def hull(variants):
    """Smallest and largest factor, with the plan itself."""
    return min([1.0, *(one.low for one in variants)]), max([1.0, *(one.high for one in variants)])


def numerical_part(base, steps, variants):
    """Factors of the finer steps, and the error that the finest one still has."""
    low, high = hull(variants)
    if len(steps) < 2:
        basis = "half the step" if steps else "no finer step was run"
        return Part("numerical", low, high, basis, variants)
    h, half, quarter = (np.sort(values) for values in paired(base, *steps))
    coarse, fine = float(np.abs(half - h).mean()), float(np.abs(quarter - half).mean())
    if fine == 0.0:
        return Part("numerical", low, high, "step halved twice; the finer two agree", variants)
    order = math.log2(coarse / fine) if coarse > 0.0 else -math.inf
    used = min(max(order, ORDERS[0]), ORDERS[1])
    left = fine / (2.0**used - 1.0) / float(np.abs(quarter).mean())
    converges = f"order {order:.2g}" if order >= ORDERS[0] else "no convergence at these steps"
    basis = f"step halved twice, {converges}; {100 * left:.2g} % left at the finest step"
    return Part("numerical", max(low - left, 0.0), high + left, basis, variants)


def paired(base, *others):
    """Values of the runs that came to their end in all of several arrays."""
    count = min(len(values) for values in (base, *others))
    rows = np.array([np.asarray(values, dtype=float)[:count] for values in (base, *others)])
    return rows[:, np.isfinite(rows).all(axis=0)]


# --- from a scene


def interval(plan, quantity, folder, *, alternatives=(), pairs=10, halvings=2, coverage=0.95, confidence=0.95,
             workers=None, scheduler=None, runs_per_task=1, progress=True):  # fmt: skip
    """Runs a plan, and its first runs with finer steps and with other models, and gives the interval of a load.

    Parameters
    ----------
    plan : Plan
        Plan of independent runs: its method is `random`.
    quantity : str
        Column of the results, such as `peak_force.target`.
    folder : path_like
        Folder of the campaigns: `plan`, `half_step`, `quarter_step` and one for each alternative. A second call does
        what is left.
    alternatives : sequence of OtherLaws, OtherModels or OtherScene, optional
        Alternatives of the model.
    pairs : int, default 10
        Number of runs that are run again with each finer step and each alternative.
    halvings : int, default 2
        Number of halvings of the step: 0, 1 or 2.
    coverage : float, default 0.95
        Share of all runs that is to be inside the input part.
    confidence : float, default 0.95
        Confidence of that.
    workers, scheduler, runs_per_task, progress : optional
        As in `run`.

    Returns
    -------
    Interval

    Raises
    ------
    CampaignError
        The plan, an alternative or the folder cannot be used, or the results have no such column.
    """
    pairs, halvings, workers = map(number, (pairs, halvings, workers))
    check(plan, alternatives, pairs, halvings)
    folder = pathlib.Path(folder)
    step = plan.step if plan.step is not None else pong.Scene.load(plan.scene).step
    wanted = [("plan", folder / "plan", plan, plan.runs)]
    halved = [("half the step", "half_step"), ("a quarter of the step", "quarter_step")][:halvings]
    for halving, (name, where) in enumerate(halved, 1):
        wanted.append((name, folder / where, replace(plan, step=step / 2**halving), pairs))
    for one in alternatives:
        wanted.append((one.name, folder / one.name, _alternatives.plan_with(plan, one, folder / one.name / "models"), pairs))
    found = {}
    with contextlib.ExitStack() as stack:
        connected = []

        def connect():
            # One set of workers for all campaigns, started when the first of them has runs left.
            if not connected:
                connected.append(stack.enter_context(client(workers, scheduler)))
            return connected[0]

        for name, where, planned, count in wanted:
            store = Store(where)
            perform(planned, store, count, connect, runs_per_task, progress)
            found[name] = column(store, quantity, count)
    models = {one.name: found[one.name] for one in alternatives}
    folders = {name: str(where) for name, where, _, _ in wanted}
    steps = [found[name] for name, _ in halved]
    return three_parts(quantity, found["plan"], steps, models, coverage=coverage, confidence=confidence, folders=folders)


def check(plan, alternatives, pairs, halvings):
    """Checks the arguments of an interval."""
    if not isinstance(plan, Plan):
        raise CampaignError(f"plan: it is {type(plan).__name__}; give a pong.campaign.Plan")
    if plan.method != "random":
        raise CampaignError(f"plan: its runs are not independent with the method `{plan.method}`; give the method random")
    if not (isinstance(pairs, int) and 1 <= pairs <= plan.runs):
        raise CampaignError(f"pairs: it is {pairs!r}; give a whole number from 1 to {plan.runs}, the runs of the plan")
    if halvings not in (0, 1, 2):
        raise CampaignError(f"halvings: it is {halvings!r}; give 0, 1 or 2")
    taken = ["plan", "half_step", "quarter_step", "half the step", "a quarter of the step"]
    for one in alternatives:
        if not isinstance(one, _alternatives.KINDS):
            raise CampaignError(f"alternatives: `{one!r}` is none; give an OtherLaws, OtherModels or OtherScene")
        if one.name in taken or not one.name or "/" in one.name or one.name.startswith("."):
            raise CampaignError(f"alternative `{one.name}`: its name is that of a folder, once; give another")
        taken.append(one.name)


def column(store, quantity, count):
    """Values of a quantity by the number of the run; not-a-number for those that failed."""
    table = store.table()
    if table.num_rows and quantity not in table.column_names:
        raise CampaignError(f"quantity `{quantity}`: the results have no such column; they have: {', '.join(table.column_names)}")
    values = np.full(count, np.nan)
    if table.num_rows:
        runs = table["run"].to_numpy()
        inside = runs < count
        values[runs[inside]] = table[quantity].to_numpy(zero_copy_only=False).astype(float)[inside]
    return values

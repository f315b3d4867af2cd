"""Sensitivity indices of Sobol and of Morris, with confidence intervals (docs/sensitivity.md).

The analysis takes numbers alone: it is the same for runs of a scene and for values of any function.
"""

import warnings
from dataclasses import dataclass

import numpy as np

from . import _samplers
from ._dispersions import Normal, Uniform, number, scaled
from ._errors import CampaignError
from ._store import Store
from ._summary import check_share

# Bootstrap resamples; fewer where their memory would exceed 40 MB.
RESAMPLES, MOST_RESAMPLED = 1000, 5_000_000
METHODS = ("sobol", "morris")


@dataclass(frozen=True)
class SobolIndex:
    """Indices of Sobol: shares of the variance of a quantity that a parameter causes.

    Attributes
    ----------
    quantity : str
        Name of the quantity.
    parameter : str
        Address of the parameter.
    first, first_low, first_high : float
        First-order index, and its interval: the share by the parameter alone.
    total, total_low, total_high : float
        Total index, and its interval: the share by the parameter and its interactions with others.
    """

    quantity: str
    parameter: str
    first: float
    first_low: float
    first_high: float
    total: float
    total_low: float
    total_high: float


@dataclass(frozen=True)
class MorrisIndex:
    """Elementary effects of Morris: changes of a quantity over the whole range of a parameter, in the unit of the quantity.

    Attributes
    ----------
    quantity : str
        Name of the quantity.
    parameter : str
        Address of the parameter.
    mean : float
        Mean of the effects.
    size, size_low, size_high : float
        Mean of their magnitudes (μ*), and its interval.
    deviation : float
        Standard deviation of the effects: it is zero if the quantity is linear in the parameter and others do not matter.
    """

    quantity: str
    parameter: str
    mean: float
    size: float
    size_low: float
    size_high: float
    deviation: float


@dataclass(frozen=True)
class Sensitivity:
    """Sensitivity of quantities to dispersed parameters. `print` shows a table.

    Attributes
    ----------
    method : str
        `sobol` or `morris`.
    runs, used : int
        Number of runs of the plan, and of those that the indices are computed from.
    confidence : float
        Confidence of the intervals.
    indices : list of SobolIndex or MorrisIndex
        Indices, by quantity, the most important parameter first.
    constant : list of str
        Quantities that are the same in all runs.
    """

    method: str
    runs: int
    used: int
    confidence: float
    indices: list
    constant: list

    def __str__(self):
        lines = [f"{self.used} of {self.runs} runs used; intervals of {100 * self.confidence:g} % confidence"]
        lines += [f"{name}: the same in all runs" for name in self.constant]
        width = max([len(index.parameter) for index in self.indices], default=0)
        quantity = None
        for index in self.indices:
            if index.quantity != quantity:
                quantity = index.quantity
                lines.append(f"{quantity}")
            lines.append(f"  {index.parameter:{width}}  {text_of(index)}")
        return "\n".join(lines)


def text_of(index):
    """An index as text."""
    if isinstance(index, SobolIndex):
        first = f"alone {index.first:.3f} ({index.first_low:.3f} to {index.first_high:.3f})"
        return f"{first}, in total {index.total:.3f} ({index.total_low:.3f} to {index.total_high:.3f})"
    size = f"effect {index.size:.4g} ({index.size_low:.4g} to {index.size_high:.4g})"
    return f"{size}, mean {index.mean:.4g}, deviation {index.deviation:.4g}"


def checked(dispersions, method, samples):
    """Checks the arguments of a design."""
    samples = number(samples)
    if method not in METHODS:
        raise CampaignError(f"method: there is no design `{method}`; give one of {', '.join(METHODS)}")
    for dispersion in dispersions:
        if not isinstance(dispersion, Uniform | Normal):
            raise CampaignError(f"dispersions: `{dispersion!r}` is none; give a Uniform or Normal")
    if not dispersions:
        raise CampaignError("dispersions: there are none; give at least one")
    fault = _samplers.fault(method, samples, len(dispersions))
    if fault:
        raise CampaignError(f"samples: {fault}")
    return samples


def design(dispersions, *, method="sobol", samples, seed=0):
    """Draws the values at which a function is to be evaluated for its indices.

    Parameters
    ----------
    dispersions : sequence of Uniform or Normal
        Parameters, in the order of the columns.
    method : {"sobol", "morris"}, default "sobol"
        Indices that are wanted.
    samples : int
        Number of base points of `sobol`, a power of two, or of trajectories of `morris`.
    seed : int, default 0
        Seed of the values.

    Returns
    -------
    numpy.ndarray, shape (n, parameters)
        Values: n is samples · (parameters + 2) for `sobol`, samples · (parameters + 1) for `morris`.

    Raises
    ------
    CampaignError
        An argument cannot be used, or SALib is missing.
    """
    samples = checked(dispersions, method, samples)
    return scaled(dispersions, method, _samplers.shares(method, len(dispersions), samples, seed))


def indices_of(outputs, dispersions, *, method="sobol", samples, seed=0, confidence=0.95, quantity="output"):
    """Computes the indices of a function from its values at a design.

    Parameters
    ----------
    outputs : array_like, shape (n,)
        Values of the function at the rows of `design` with the same arguments; not-a-number where there is none.
    dispersions : sequence of Uniform or Normal
        Parameters.
    method : {"sobol", "morris"}, default "sobol"
        Method of the design.
    samples : int
        Number of base points or trajectories of the design.
    seed : int, default 0
        Seed of the design.
    confidence : float, default 0.95
        Confidence of the intervals.
    quantity : str, default "output"
        Name of the quantity in the indices.

    Returns
    -------
    list of SobolIndex or MorrisIndex
        In the order of the dispersions. Blocks with a missing value are left out.

    Raises
    ------
    CampaignError
        There are not as many values as rows, or fewer than two whole blocks.
    """
    samples = checked(dispersions, method, samples)
    check_share("confidence", confidence)
    shares = _samplers.shares(method, len(dispersions), samples, seed)
    outputs = np.asarray(outputs, dtype=float)
    if outputs.shape != (len(shares),):
        raise CampaignError(f"outputs: they are {outputs.shape}; give one for each of the {len(shares)} rows of the design")
    kept = whole(outputs, _samplers.block(method, len(dispersions)))
    return estimated(outputs[kept], shares[kept], [d.parameter for d in dispersions], method, seed, confidence, quantity)


def whole(outputs, block):
    """Rows of the blocks without a missing value."""
    kept = np.isfinite(outputs.reshape(-1, block)).all(axis=1)
    if kept.sum() < 2:
        cure = "look at the failures first, or give more samples"
        raise CampaignError(f"outputs: {kept.sum()} of {len(kept)} blocks of {block} runs are whole; {cure}")
    return np.repeat(kept, block)


def estimated(outputs, shares, parameters, method, seed, confidence, quantity):
    """Indices from whole blocks."""
    salib = _samplers.library(method)
    width = len(parameters)
    count = len(outputs) // _samplers.block(method, width)
    options = {"num_resamples": max(100, min(RESAMPLES, MOST_RESAMPLED // count)), "conf_level": confidence, "seed": seed + 1}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        if method == "sobol":
            found = salib.analyze.sobol.analyze(_samplers.problem(width), outputs, calc_second_order=False, **options)
            rows = zip(parameters, *(map(float, found[key]) for key in ("S1", "S1_conf", "ST", "ST_conf")))
            return [SobolIndex(quantity, p, s, s - ds, s + ds, t, t - dt, t + dt) for p, s, ds, t, dt in rows]
        found = salib.analyze.morris.analyze(_samplers.problem(width), shares, outputs, num_levels=_samplers.LEVELS, **options)
        rows = zip(parameters, *(map(float, found[key]) for key in ("mu", "mu_star", "mu_star_conf", "sigma")))
        return [MorrisIndex(quantity, p, mean, size, size - ds, size + ds, sigma) for p, mean, size, ds, sigma in rows]


def indices(folder, *, quantities=None, confidence=0.95):
    """Computes the sensitivity indices of a campaign whose plan has the method `sobol` or `morris`.

    Parameters
    ----------
    folder : path_like
        Folder of the campaign.
    quantities : sequence of str, optional
        Columns of the results; without it, all peak loads.
    confidence : float, default 0.95
        Confidence of the intervals.

    Returns
    -------
    Sensitivity

    Raises
    ------
    CampaignError
        The plan has another method, the results have no such column, or too few runs came to their end.
    """
    check_share("confidence", confidence)
    store = Store(folder)
    plan, table = store.plan(), store.table()
    if plan.method not in METHODS:
        cure = "plan it with the method `sobol` or `morris`"
        raise CampaignError(f"campaign `{folder}`: its method is `{plan.method}`, which has no indices; {cure}")
    columns = table.column_names
    if quantities is None:
        quantities = [name for name in columns if name.startswith(("peak_force.", "peak_moment.", "peak_depth."))]
    missing = [name for name in quantities if name not in columns]
    if missing:
        raise CampaignError(f"quantity `{missing[0]}`: the results have no such column; they have: {', '.join(columns)}")
    shares = _samplers.shares(plan.method, len(plan.dispersions), plan.samples, plan.seed)
    runs = table["run"].to_numpy()
    drawn = scaled(plan.dispersions, plan.method, shares)[runs]
    given = np.column_stack([table[name].to_numpy() for name in plan.parameters])
    if not np.array_equal(drawn, given):
        cure = "use the versions of SALib and SciPy that the campaign ran with"
        raise CampaignError(f"campaign `{folder}`: its values are not those that SALib draws here; {cure}")
    outputs = np.full((len(quantities), plan.runs), np.nan)
    for row, name in zip(outputs, quantities):
        row[runs] = table[name].to_numpy(zero_copy_only=False).astype(float)
    kept = whole(outputs.sum(axis=0), _samplers.block(plan.method, len(plan.dispersions)))
    found, constant = [], []
    for row, name in zip(outputs[:, kept], quantities):
        if np.ptp(row) == 0.0:
            constant.append(name)
            continue
        ones = estimated(row, shares[kept], plan.parameters, plan.method, plan.seed, confidence, name)
        found += sorted(ones, key=lambda one: -(one.total if plan.method == "sobol" else one.size))
    return Sensitivity(plan.method, plan.runs, int(kept.sum()), confidence, found, constant)

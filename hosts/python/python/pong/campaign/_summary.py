"""Statistics of a campaign: shares and quantiles, each with a confidence interval."""

import math
from dataclasses import dataclass
from statistics import NormalDist

import numpy as np

from ._errors import CampaignError
from ._store import Store

# Default quantiles of a load: the median, and the values that 95 and 99 of 100 runs do not exceed.
QUANTILES = (0.5, 0.95, 0.99)


def check_share(name, share):
    if not 0.0 < share < 1.0:
        raise CampaignError(f"{name}: it is {share}; give a share between 0 and 1")


def wilson(count, of, confidence=0.95):
    """Returns Wilson's interval of a probability: all p that differ from the observed share by no more than the normal
    approximation at p allows.

    Parameters
    ----------
    count, of : int
        Number of successes, and of runs.
    confidence : float, default 0.95
        Confidence of the interval.

    Returns
    -------
    tuple[float, float]
        Ends of the interval.
    """
    check_share("confidence", confidence)
    if not 0 <= count <= of or of < 1:
        raise CampaignError(f"share: {count} of {of} runs is none; give at least one run and no more successes than runs")
    z = NormalDist().inv_cdf(0.5 + 0.5 * confidence)
    share, spread = count / of, z * z / of
    middle = share + 0.5 * spread
    half = math.sqrt(spread * share * (1.0 - share) + 0.25 * spread * spread)
    # At zero and full counts the interval ends there exactly, without a rounding error.
    low = 0.0 if count == 0 else (middle - half) / (1.0 + spread)
    high = 1.0 if count == of else (middle + half) / (1.0 + spread)
    return low, high


def binomial_cumulative(of, share):
    """P(X ≤ k) for k from 0 to `of`."""
    k = np.arange(of + 1)
    log_factorial = np.concatenate([[0.0], np.cumsum(np.log(np.arange(1, of + 1)))])
    terms = log_factorial[of] - log_factorial[k] - log_factorial[of - k] + k * math.log(share) + (of - k) * math.log1p(-share)
    return np.minimum(np.cumsum(np.exp(terms)), 1.0)


def quantile_interval(values, share, confidence=0.95):
    """Returns a distribution-free interval of a quantile, between two order statistics.

    Parameters
    ----------
    values : array_like, shape (n,)
        Values of the runs.
    share : float
        Share of the values below the quantile.
    confidence : float, default 0.95
        Confidence of the interval; each side is missed with at most half of 1 − confidence.

    Returns
    -------
    tuple[float, float]
        Ends of the interval; infinite on a side for which there are too few runs.
    """
    check_share("quantile", share)
    check_share("confidence", confidence)
    ordered = np.sort(np.asarray(values, dtype=float))
    if not len(ordered):
        raise CampaignError("quantile: there are no values; it needs at least one run that came to its end")
    miss = 0.5 * (1.0 - confidence)
    # Of `of` values, X lie below the quantile: X is binomial. The l-th value is above it if X < l, the u-th below it if
    # X ≥ u.
    cumulative = binomial_cumulative(len(ordered), share)
    below = np.nonzero(cumulative <= miss)[0]
    above = np.nonzero(cumulative >= 1.0 - miss)[0]
    low = ordered[below[-1]] if len(below) else -math.inf
    high = ordered[above[0]] if len(above) and above[0] < len(ordered) else math.inf
    return float(low), float(high)


@dataclass(frozen=True)
class Proportion:
    """Share of the runs that met a criterion, with Wilson's interval.

    Attributes
    ----------
    name : str
        Name of the criterion.
    count, of : int
        Number of runs that met it, and of all finished ones.
    share : float
        Their ratio.
    low, high : float
        Ends of the interval.
    """

    name: str
    count: int
    of: int
    share: float
    low: float
    high: float


@dataclass(frozen=True)
class Quantile:
    """Quantile of a quantity over all runs, with the interval between two order statistics.

    Attributes
    ----------
    name : str
        Name of the column.
    share : float
        Share of the runs below it.
    value : float
        Value, in the unit of the column.
    low, high : float
        Ends of the interval.
    """

    name: str
    share: float
    value: float
    low: float
    high: float


@dataclass(frozen=True)
class Summary:
    """Statistics of a campaign. `print` shows them as a table.

    Attributes
    ----------
    runs, finished, failed : int
        Number of runs of the plan, and of those that were finished and that failed.
    tunnelled : int
        Runs in which something was passed through.
    touching_at_start : int
        Runs that began in contact.
    confidence : float
        Confidence of the intervals.
    proportions : list of Proportion
        Shares of the criteria.
    quantiles : list of Quantile
        Quantiles of the quantities.
    """

    runs: int
    finished: int
    failed: int
    tunnelled: int
    touching_at_start: int
    confidence: float
    proportions: list
    quantiles: list

    def __str__(self):
        percent = f"{100 * self.confidence:g} %"
        lines = [f"{self.finished} of {self.runs} runs came to their end, {self.failed} failed; intervals of {percent} confidence"]
        if self.tunnelled:
            lines.append(f"in {self.tunnelled} runs something went right through something else: make the step shorter")
        for p in self.proportions:
            lines.append(f"{p.name}: {p.count} of {p.of}, {p.share:.4f}, between {p.low:.4f} and {p.high:.4f}")
        if self.touching_at_start:
            lines.append(f"in {self.touching_at_start} runs bodies touch at the start already: if they should not, start farther away")
        width = max([len(q.name) for q in self.quantiles], default=0)
        for q in self.quantiles:
            low, high = (f"{x:.4g}" if math.isfinite(x) else "unknown: too few runs" for x in (q.low, q.high))
            lines.append(f"{q.name:{width}}  {100 * q.share:g} %: {q.value:.4g}, between {low} and {high}")
        return "\n".join(lines)


def summary(folder, *, quantiles=QUANTILES, quantities=None, confidence=0.95):
    """Computes shares of the criteria and quantiles. Failed runs are in none of them; their number is given.

    Parameters
    ----------
    folder : path_like
        Folder of the campaign.
    quantiles : sequence of float, optional
        Shares of the quantiles; without it, 0.5, 0.95 and 0.99.
    quantities : sequence of str, optional
        Columns of the results; without it, all peak loads.
    confidence : float, default 0.95
        Confidence of the intervals.

    Returns
    -------
    Summary

    Raises
    ------
    CampaignError
        The results have no such column.
    """
    store = Store(folder)
    plan, table, failed = store.plan(), store.table(), store.failures()
    columns = table.column_names
    if quantities is None:
        quantities = [name for name in columns if name.startswith(("peak_force.", "peak_moment.", "peak_depth."))]
    missing = [name for name in quantities if name not in columns]
    if missing:
        raise CampaignError(f"quantity `{missing[0]}`: the results have no such column; they have: {', '.join(columns)}")
    proportions, told = [], []
    if table.num_rows:
        for criterion in plan.criteria:
            count = sum(table[criterion.name].to_pylist())
            low, high = wilson(count, table.num_rows, confidence)
            proportions.append(Proportion(criterion.name, count, table.num_rows, count / table.num_rows, low, high))
        for name in quantities:
            values = table[name].to_numpy()
            for share in quantiles:
                low, high = quantile_interval(values, share, confidence)
                # The value is an order statistic too, without interpolation between two runs.
                value = float(np.quantile(values, share, method="inverted_cdf"))
                told.append(Quantile(name, share, value, low, high))
    tunnelled, touching = (
        int(np.count_nonzero(table[name].to_numpy())) if table.num_rows else 0 for name in ("tunnelled", "contacts_at_start")
    )
    return Summary(plan.runs, table.num_rows, len(failed), tunnelled, touching, confidence, proportions, told)

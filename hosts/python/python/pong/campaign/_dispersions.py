"""Dispersions: parameters with their distributions, and the values of every run.

The values of a run depend on the seed, the number of the run and the place of the dispersion in the list; for
`latin_hypercube`, `sobol` and `morris` also on how many runs there are. They do not depend on workers or on the order of
runs.
"""

import itertools
import math
from dataclasses import dataclass
from statistics import NormalDist

import numpy as np

from . import _samplers
from ._errors import CampaignError


def number(given):
    """A number as in JSON: a NumPy number, or an array of one, becomes a Python number. Other values stay, to be
    reported."""
    if isinstance(given, np.generic | np.ndarray) and np.ndim(given) == 0 and np.asarray(given).dtype.kind in "fiu":
        return given.item()
    return given


def take_numbers(entry, *names):
    """Converts fields of a frozen dataclass to Python numbers."""
    for name in names:
        object.__setattr__(entry, name, number(getattr(entry, name)))

METHODS = ("random", "latin_hypercube", "corners", "sobol", "morris")


@dataclass(frozen=True)
class Uniform:
    """Uniform distribution of a parameter.

    Parameters
    ----------
    parameter : str
        Address of the parameter, such as `chaser.position.x` (docs/campaigns.md).
    low, high : float
        Ends of the interval, in the unit of the parameter.
    """

    parameter: str
    low: float
    high: float

    def __post_init__(self):
        take_numbers(self, "low", "high")

    def fault(self):
        """The fault of the parameters, or None."""
        if not (math.isfinite(self.low) and math.isfinite(self.high) and self.low < self.high):
            return f"low is {self.low} and high is {self.high}; give finite numbers, the lower first"
        return None

    def at(self, share):
        """Returns a quantile: the value below which lies a share of all values.

        Parameters
        ----------
        share : float
            Share, from 0 to 1.

        Returns
        -------
        float
        """
        return self.low + (self.high - self.low) * share

    def ends(self):
        """Returns the values at the corners: both ends of the interval."""
        return self.low, self.high

    def level(self, share):
        """Returns the value at a level of the grid of Morris, from the lower end to the upper one.

        Parameters
        ----------
        share : float
            Place on the grid, from 0 to 1.

        Returns
        -------
        float
        """
        return self.at(share)


@dataclass(frozen=True)
class Normal:
    """Normal distribution of a parameter.

    Parameters
    ----------
    parameter : str
        Address of the parameter, such as `chaser.velocity.z` (docs/campaigns.md).
    mean, deviation : float
        Mean and standard deviation, in the unit of the parameter.
    """

    parameter: str
    mean: float
    deviation: float

    def __post_init__(self):
        take_numbers(self, "mean", "deviation")

    def fault(self):
        """The fault of the parameters, or None."""
        if not (math.isfinite(self.mean) and math.isfinite(self.deviation) and self.deviation > 0):
            return f"mean is {self.mean} and deviation is {self.deviation}; give finite numbers, the deviation above zero"
        return None

    def at(self, share):
        """Returns a quantile: the value below which lies a share of all values.

        Parameters
        ----------
        share : float
            Share, from 0 to 1.

        Returns
        -------
        float
        """
        return NormalDist(self.mean, self.deviation).inv_cdf(share)

    def ends(self):
        """Returns the values at the corners, three standard deviations from the mean."""
        return self.mean - 3 * self.deviation, self.mean + 3 * self.deviation

    def level(self, share):
        """Returns the value at a level of the grid of Morris, which is that of a uniform distribution of the same deviation.

        Parameters
        ----------
        share : float
            Place on the grid, from 0 to 1.

        Returns
        -------
        float
        """
        return self.mean + math.sqrt(3.0) * self.deviation * (2.0 * share - 1.0)


def kind_of(dispersion):
    return type(dispersion).__name__


def from_json(entry):
    """A dispersion from its entry in campaign.json."""
    kinds = {"Uniform": Uniform, "Normal": Normal}
    entry = dict(entry)
    return kinds[entry.pop("kind")](**entry)


# Shares lie in the middle of 2⁵³ steps: never 0 or 1, where the normal distribution has no quantile.
_STEPS = 2.0**53


def values(plan):
    """Values of every run: runs × dispersions."""
    count, width = plan.runs, len(plan.dispersions)
    if plan.method == "corners":
        ends = [dispersion.ends() for dispersion in plan.dispersions]
        return np.array(list(itertools.product(*ends)), dtype=float).reshape(count, width)
    if plan.method in ("sobol", "morris"):
        return scaled(plan.dispersions, plan.method, _samplers.shares(plan.method, width, plan.samples, plan.seed))
    if plan.method == "latin_hypercube":
        shares = np.empty((count, width))
        for place in range(width):
            rng = np.random.Generator(np.random.PCG64([plan.seed, place]))
            # One value in each of as many equal shares as there are runs (Latin hypercube), in random order.
            shares[:, place] = (rng.permutation(count) + rng.random(count)) / count
    else:
        shares = np.array([np.random.Generator(np.random.PCG64([plan.seed, run])).random(width) for run in range(count)])
    return scaled(plan.dispersions, plan.method, shares.reshape(count, width))


def scaled(dispersions, method, shares):
    """Values of the dispersions at points of the unit cube."""
    if method != "morris":
        shares = np.minimum((np.floor(shares * _STEPS) + 0.5) / _STEPS, 1.0 - 0.5**53)
    values = np.empty(shares.shape)
    for j, dispersion in enumerate(dispersions):
        quantile = dispersion.level if method == "morris" else dispersion.at
        column = shares[:, j]
        # The quantile function of a uniform distribution takes arrays, that of a normal one single numbers.
        values[:, j] = quantile(column) if isinstance(dispersion, Uniform) else [quantile(share) for share in column]
    return values


def corner_count(dispersions):
    """Number of runs of the corners."""
    if len(dispersions) > 20:
        raise CampaignError(
            f"corners: {len(dispersions)} dispersions have 2^{len(dispersions)} corners; take a Latin hypercube"
        )
    return 2 ** len(dispersions)

"""Means with intervals from resampling, for samples whose distribution is not known."""

from dataclasses import dataclass

import numpy as np

RESAMPLES = 10_000
SEED = 20_260_101
LEVEL = 0.95


@dataclass(frozen=True)
class Interval:
    """Mean of a sample and its bootstrap interval (percentiles, 95 %)."""

    value: float
    low: float
    high: float

    def text(self, digits=4, scale=1.0, sign=False):
        """The mean with its interval in brackets, each times `scale`."""
        form = f"{'+' if sign else ''}.{digits}f"
        mean, low, high = (format(scale * number, form) for number in (self.value, self.low, self.high))
        return f"{mean} [{low}, {high}]"


def resampled(sample, statistic=np.mean):
    """Values of the statistic on resamples of the rows, drawn with replacement from a fixed seed."""
    sample = np.asarray(sample)
    generator = np.random.default_rng(SEED)
    blocks = []
    # Blocks keep the table of indices small.
    for _ in range(10):
        rows = generator.integers(0, len(sample), size=(RESAMPLES // 10, len(sample)))
        blocks.append(statistic(sample[rows], axis=1))
    return np.concatenate(blocks)


def interval(sample, statistic=np.mean):
    """Value of the statistic with its 95 % bootstrap interval."""
    low, high = np.quantile(resampled(sample, statistic), [(1 - LEVEL) / 2, (1 + LEVEL) / 2])
    return Interval(float(statistic(np.asarray(sample), axis=0)), float(low), float(high))


def paired(sample, reference):
    """Interval of the mean difference of two samples of the same tests."""
    return interval(np.asarray(sample) - np.asarray(reference))


def standard_error(sample):
    """Standard error of the mean."""
    return float(np.std(sample, ddof=1) / np.sqrt(len(sample)))

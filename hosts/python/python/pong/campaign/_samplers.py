"""Points of the unit cube for sensitivity indices: designs of Sobol and of Morris, drawn by the package SALib."""

import warnings

import numpy as np

from ._errors import CampaignError

# Levels of the grid of Morris: 0, 1/3, 2/3 and 1. A step of a trajectory is two thirds long.
LEVELS = 4
# Most points of one design.
MOST = 2**24


def library(name):
    """The package SALib, or an error that says how to install it."""
    try:
        import SALib.analyze.morris
        import SALib.analyze.sobol
        import SALib.sample.morris
        import SALib.sample.sobol
    except ImportError as reason:
        cure = "install it: pip install SALib, or the wheel with [sensitivity]"
        raise CampaignError(f"method `{name}`: it needs the package SALib ({reason}); {cure}") from None
    return SALib


def problem(width):
    """The unit cube, as SALib wants it."""
    return {"num_vars": width, "names": [str(column) for column in range(width)], "bounds": [[0.0, 1.0]] * width}


def block(method, width):
    """Number of runs that belong together: of a point of Sobol, or of a trajectory of Morris."""
    return width + 2 if method == "sobol" else width + 1


def fault(method, samples, width):
    """The fault of a number of samples, or None."""
    if isinstance(samples, bool) or not isinstance(samples, int):
        return f"it is {samples!r}; give a whole number"
    if method == "sobol" and (samples < 2 or samples & (samples - 1)):
        return f"it is {samples}; a Sobol sequence is balanced for powers of two: give one, such as 256"
    if method == "morris" and samples < 2:
        return f"it is {samples}; give at least 2 trajectories, usually 10 to 50"
    if samples * block(method, width) > MOST:
        return f"it is {samples}: with {width} dispersions these are {samples * block(method, width)} runs; give less"
    return None


def shares(method, width, samples, seed):
    """Points of a design: (samples · block) × width, from 0 to 1."""
    salib = library(method)
    with warnings.catch_warnings():
        # Warnings of SALib about names of its own arguments.
        warnings.simplefilter("ignore")
        if method == "sobol":
            rng = np.random.Generator(np.random.PCG64([seed, 0]))
            return salib.sample.sobol.sample(problem(width), samples, calc_second_order=False, seed=rng)
        rng = np.random.Generator(np.random.PCG64([seed, 1]))
        return salib.sample.morris.sample(problem(width), samples, num_levels=LEVELS, seed=rng)

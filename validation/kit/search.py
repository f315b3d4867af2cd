"""Minimisation of a measured error over few parameters within bounds, with a limit of evaluations."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Free:
    """Free parameter: start and bounds. A parameter whose lower bound is above zero is searched by its logarithm."""

    start: float
    low: float
    high: float

    def to_unit(self, value):
        """Number from 0 to 1 of a value within the bounds."""
        low, high, value = (
            (np.log(number) for number in (self.low, self.high, value))
            if self.low > 0
            else (self.low, self.high, value)
        )
        return (value - low) / (high - low)

    def of_unit(self, unit):
        """Value of a number from 0 to 1; numbers beyond count as the bound."""
        unit = min(max(float(unit), 0.0), 1.0)
        if self.low > 0:
            return float(np.exp(np.log(self.low) + unit * (np.log(self.high) - np.log(self.low))))
        return self.low + unit * (self.high - self.low)


@dataclass(frozen=True)
class Found:
    """Result of a search: parameters, error, number of evaluations, and parameters that ended at a bound."""

    values: dict
    error: float
    evaluations: int
    at_bound: list
    tried: list  # (values, error) of each evaluation


def minimise(error, free, evaluations, note=lambda values, error: None):
    """Nelder–Mead simplex search of the function `error(values)` over the parameters `free`, a dictionary."""
    from scipy.optimize import minimize

    names = list(free)
    tried = []

    def of_units(units):
        values = {name: free[name].of_unit(unit) for name, unit in zip(names, units)}
        # Beyond a bound the error grows, so that the simplex turns back.
        outside = sum(max(0.0, -unit, unit - 1.0) for unit in units)
        found = float(error(values)) * (1.0 + outside)
        tried.append((values, found))
        note(values, found)
        return found

    start = np.array([free[name].to_unit(free[name].start) for name in names])
    simplex = [start]
    for number in range(len(names)):
        corner = start.copy()
        corner[number] += 0.12 if corner[number] < 0.5 else -0.12
        simplex.append(corner)
    minimize(
        of_units,
        start,
        method="Nelder-Mead",
        options={"maxfev": evaluations, "initial_simplex": np.array(simplex), "xatol": 1e-3, "fatol": 1e-7},
    )
    values, least = min(tried, key=lambda one: one[1])
    at_bound = [name for name in names if not 0.01 < free[name].to_unit(values[name]) < 0.99]
    return Found(values, least, len(tried), at_bound, tried)

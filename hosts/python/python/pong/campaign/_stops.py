"""Conditions that end a run early, because its outcome is decided."""

import math
from dataclasses import dataclass

import numpy as np

from ._criteria import met
from ._dispersions import take_numbers
from ._errors import CampaignError


def positive(thing, unit, given):
    """A finite positive number, or an error that names the thing."""
    if isinstance(given, bool) or not isinstance(given, int | float) or not (0.0 < given < math.inf):
        raise CampaignError(f"{thing}: it is {given!r}; give a finite number above zero, {unit}")


@dataclass(frozen=True)
class Held:
    """Stop: a criterion has been met at every check for some time.

    Parameters
    ----------
    name : str
        Name of the stop, for the column `ended_by`.
    criterion : str
        Name of a criterion of the plan.
    time : float
        Time for which it is met, s.
    """

    name: str
    criterion: str
    time: float

    def __post_init__(self):
        take_numbers(self, "time")
        positive(f"stop `{self.name}`, time", "s", self.time)


@dataclass(frozen=True)
class Beyond:
    """Stop: two bodies are far apart, and farther than at the check before.

    Parameters
    ----------
    name : str
        Name of the stop, for the column `ended_by`.
    body, of : str
        Names of the two bodies.
    distance : float
        Distance of their origins, m.
    """

    name: str
    body: str
    of: str
    distance: float

    def __post_init__(self):
        take_numbers(self, "distance")
        positive(f"stop `{self.name}`, distance", "m", self.distance)


def from_json(entry):
    """A stop from its entry in campaign.json."""
    entry = dict(entry)
    return {"Held": Held, "Beyond": Beyond}[entry.pop("kind")](**entry)


class Watch:
    """Checks a run against the stops of a job; `ended_by` is the name of the one that ended it."""

    def __init__(self, job, bodies):
        criteria = {criterion["name"]: criterion for criterion in job["criteria"]}
        kinds = {"Held": lambda stop: Holding(stop, criteria[stop["criterion"]], bodies, job["look_every"]), "Beyond": lambda stop: Parting(stop, bodies)}
        self.stops = [(stop["name"], kinds[stop["kind"]](stop)) for stop in job["stops"]]
        self.ended_by = None

    def __call__(self, time, states):
        # Each stop has its own memory: all of them are checked, even if one has decided.
        decided = [name for name, stop in self.stops if stop.looks(time, states)]
        if decided:
            self.ended_by = decided[0]
        return bool(decided)


class Holding:
    def __init__(self, stop, criterion, bodies, look_every):
        self.criterion, self.bodies, self.since = criterion, bodies, None
        # Minus half an interval, so that the rounding of times decides nothing.
        self.time = stop["time"] - 0.5 * look_every

    def looks(self, time, states):
        if not met(self.criterion, self.bodies, states):
            self.since = None
            return False
        if self.since is None:
            self.since = time
        return time - self.since >= self.time


class Parting:
    def __init__(self, stop, bodies):
        self.distance = stop["distance"]
        self.rows = [bodies.index(stop["body"]), bodies.index(stop["of"])]
        self.before = math.inf

    def looks(self, time, states):
        own, other = states[self.rows, :3]
        apart, before = float(np.linalg.norm(own - other)), self.before
        self.before = apart
        return apart > self.distance and apart > before

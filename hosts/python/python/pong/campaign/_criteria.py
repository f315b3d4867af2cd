"""Criteria of success, and their evaluation on states."""

import math
from dataclasses import dataclass

import numpy as np

from ._dispersions import take_numbers
from ._errors import CampaignError
from ._rigid import in_frame_of


def triple(thing, unit, given):
    """Three numbers, or an error that names the thing."""
    try:
        values = tuple(float(x) for x in given)
    except (TypeError, ValueError):
        values = ()
    if len(values) != 3 or any(map(math.isnan, values)):
        raise CampaignError(f"{thing}: it is {given!r}; give three numbers (x, y, z), {unit}")
    return values


@dataclass(frozen=True)
class Within:
    """Criterion of success: at the end of a run, the origin of a body is within a box that is fixed to another body.

    Parameters
    ----------
    name : str
        Name of the criterion, and of its column in the results.
    body : str
        Name of the body.
    of : str
        Name of the body that the box is fixed to.
    low, high : array_like, shape (3,)
        Corners of the box, m, from the origin of `of` along its axes. The border is inside.
    speed : float, optional
        Largest speed of the origin relative to the body `of`, m/s, also in its rotation; any without it.
    """

    name: str
    body: str
    of: str
    low: tuple
    high: tuple
    speed: float = math.inf

    def __post_init__(self):
        take_numbers(self, "speed")
        for end in ("low", "high"):
            object.__setattr__(self, end, triple(f"criterion `{self.name}`, {end}", "m", getattr(self, end)))
        for axis, low, high in zip("xyz", self.low, self.high):
            if low > high:
                cure = "give the lower end first"
                raise CampaignError(f"criterion `{self.name}`: along {axis}, low is {low} and high is {high}; {cure}")


def met(criterion, bodies, states):
    """True if states meet a criterion."""
    own, other = (states[bodies.index(name)] for name in (criterion["body"], criterion["of"]))
    apart = in_frame_of(other, own[:3] - other[:3])
    # Velocity of the other body's material point at that origin.
    speed = np.linalg.norm(own[7:10] - other[7:10] - np.cross(other[10:], own[:3] - other[:3]))
    inside = all(low <= x <= high for low, x, high in zip(criterion["low"], apart, criterion["high"]))
    return bool(inside and speed <= (np.inf if criterion["speed"] is None else criterion["speed"]))

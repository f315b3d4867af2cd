"""What a campaign is: scene, dispersions, criteria. All of it stands in campaign.json."""

import math
import os
from dataclasses import asdict, dataclass, field

from . import _dispersions as dispersions_of
from ._errors import CampaignError


def triple(thing, unit, given):
    """Three numbers, or an error that names the thing."""
    try:
        values = tuple(float(x) for x in given)
    except (TypeError, ValueError):
        values = ()
    if len(values) != 3 or any(map(math.isnan, values)):
        raise CampaignError(f"{thing}: it is {given!r}; give three numbers (x, y, z), {unit}")
    return values


def listed(thing, kinds, given):
    """A list of dispersions or criteria, or an error that names what is none."""
    names = " or ".join(kind.__name__ for kind in kinds)
    if not isinstance(given, list | tuple):
        raise CampaignError(f"{thing}: they are {given!r}; give a list, each entry a {names}")
    for entry in given:
        if not isinstance(entry, kinds):
            raise CampaignError(f"{thing}: `{entry!r}` is none; give a {names}")
    return list(given)


@dataclass(frozen=True)
class Within:
    """At the end of a run, the origin of `body`, seen in the frame of the body `of`, lies between `low` and `high` (m),
    and moves no faster against it than `speed` (m/s)."""

    name: str
    body: str
    of: str
    low: tuple
    high: tuple
    speed: float = math.inf

    def __post_init__(self):
        for end in ("low", "high"):
            object.__setattr__(self, end, triple(f"criterion `{self.name}`, {end}", "m", getattr(self, end)))
        for axis, low, high in zip("xyz", self.low, self.high):
            if low > high:
                cure = "give the lower end first"
                raise CampaignError(f"criterion `{self.name}`: along {axis}, low is {low} and high is {high}; {cure}")


@dataclass(frozen=True)
class Plan:
    """A scene, what is dispersed, and what counts as a success.

    `method` is "random", "latin_hypercube" or "corners" (every combination of both ends; `runs` is then left out).
    `pivots` names, for an Object, the point in the frame of its root group about which its rotation is dispersed.
    """

    scene: str
    dispersions: list
    runs: int = 0
    seed: int = 0
    method: str = "random"
    criteria: list = field(default_factory=list)
    pivots: dict = field(default_factory=dict)
    duration: float | None = None
    step: float | None = None

    def __post_init__(self):
        # Where symbolic links lead is the worker's affair: the path is kept as it was given.
        object.__setattr__(self, "scene", os.path.abspath(self.scene))
        kinds = (dispersions_of.Uniform, dispersions_of.Normal)
        object.__setattr__(self, "dispersions", listed("dispersions", kinds, self.dispersions))
        object.__setattr__(self, "criteria", listed("criteria", (Within,), self.criteria))
        pivots = {name: triple(f"pivot of `{name}`", "m", at) for name, at in self.pivots.items()}
        object.__setattr__(self, "pivots", pivots)
        self._check()
        if self.method == "corners":
            object.__setattr__(self, "runs", dispersions_of.corner_count(self.dispersions))

    def _check(self):
        problems = []
        if not isinstance(self.runs, int):
            raise CampaignError(f"runs: it is {self.runs!r}; give a whole number")
        if self.method not in dispersions_of.METHODS:
            problems.append(f"method: there is no `{self.method}`; give one of {', '.join(dispersions_of.METHODS)}")
        elif self.method == "corners" and self.runs not in (0, 2 ** len(self.dispersions)):
            problems.append(f"runs: corners of {len(self.dispersions)} dispersions are no {self.runs} runs; leave it out")
        elif self.method != "corners" and self.runs < 1:
            problems.append(f"runs: it is {self.runs}; give at least 1")
        if not (isinstance(self.seed, int) and self.seed >= 0):
            problems.append(f"seed: it is {self.seed!r}; give a whole number from 0 up")
        names = [dispersion.parameter for dispersion in self.dispersions]
        if not names:
            problems.append("dispersions: there are none; give at least one")
        for dispersion in self.dispersions:
            if dispersion.fault():
                problems.append(f"dispersion of `{dispersion.parameter}`: {dispersion.fault()}")
        criteria = [criterion.name for criterion in self.criteria]
        for what, given in (("dispersion", names), ("criterion", criteria)):
            problems += [f"{what} `{name}`: it is given twice; keep one" for name in sorted({n for n in given if given.count(n) > 1})]
        if problems:
            raise CampaignError("the plan cannot be used:\n  " + "\n  ".join(problems))

    @property
    def parameters(self):
        return [dispersion.parameter for dispersion in self.dispersions]

    def to_json(self):
        entry = asdict(self)
        entry["dispersions"] = [{"kind": dispersions_of.kind_of(d), **asdict(d)} for d in self.dispersions]
        # JSON has no infinity.
        for criterion in entry["criteria"]:
            criterion["speed"] = None if math.isinf(criterion["speed"]) else criterion["speed"]
        return entry

    @classmethod
    def from_json(cls, entry):
        entry = dict(entry)
        entry["dispersions"] = [dispersions_of.from_json(d) for d in entry["dispersions"]]
        entry["criteria"] = [
            Within(**c | {"speed": math.inf if c["speed"] is None else c["speed"]}) for c in entry["criteria"]
        ]
        if entry["method"] == "corners":
            entry["runs"] = 0
        return cls(**entry)

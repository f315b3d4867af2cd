"""Plan of a campaign: scene, dispersions, criteria, stops. It is stored completely in campaign.json."""

import math
import os
from dataclasses import asdict, dataclass, field

from . import _dispersions as dispersions_of
from . import _samplers
from . import _stops as stops_of
from ._criteria import Within, triple
from ._errors import CampaignError


INTEGRATORS = ("SemiImplicitEuler", "RungeKutta4", "ZeroOrderHold")

# Columns of the results of every campaign.
COLUMNS = ("run", "time_at_end", "ended_by", "contacts_at_start", "contacts_at_end", "tunnelled", "warnings", "error", "message")


def listed(thing, kinds, given):
    """A list of dispersions, criteria or stops, or an error that names an invalid element."""
    names = " or ".join(kind.__name__ for kind in kinds)
    if not isinstance(given, list | tuple):
        raise CampaignError(f"{thing}: they are {given!r}; give a list, each entry a {names}")
    for entry in given:
        if not isinstance(entry, kinds):
            raise CampaignError(f"{thing}: `{entry!r}` is none; give a {names}")
    return list(given)


@dataclass(frozen=True)
class Plan:
    """Plan of a campaign: a scene, its dispersions, and its criteria of success.

    Parameters
    ----------
    scene : path_like
        Scene file.
    dispersions : list of Uniform or Normal
        Parameters that differ from run to run.
    runs : int
        Number of runs; left out for `corners`, `sobol` and `morris`.
    seed : int, default 0
        Seed of the values.
    method : {"random", "latin_hypercube", "corners", "sobol", "morris"}, default "random"
        Method that draws the values; `corners` takes every combination of both ends, `sobol` and `morris` are for
        sensitivity indices.
    samples : int, optional
        Number of base points of `sobol`, a power of two, or of trajectories of `morris`.
    criteria : list of Within, optional
        Criteria of success.
    pivots : dict, optional
        Points about which Objects are rotated: for the name of an Object (x, y, z) in m, in the frame of its root
        group. Without it, the origin of the group.
    duration : float, optional
        Length of a run, s, instead of the scene's.
    step : float, optional
        Step of the integrator, s, instead of the scene's.
    integrator : {"SemiImplicitEuler", "RungeKutta4", "ZeroOrderHold"}, optional
        Integrator instead of the scene's.
    stops : list of Held or Beyond, optional
        Conditions that end a run before its duration is over.
    look_every : float, default 0.1
        Interval of their checks, s.
    alternative : str, optional
        Name of one of the scene's `alternatives`: other files for some of its models.

    Raises
    ------
    CampaignError
        The plan cannot be used; the message has every reason.
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
    integrator: str | None = None
    stops: list = field(default_factory=list)
    look_every: float = 0.1
    samples: int = 0
    alternative: str | None = None

    def __post_init__(self):
        # The path is kept as given: the worker resolves symbolic links.
        dispersions_of.take_numbers(self, "runs", "seed", "duration", "step", "look_every", "samples")
        object.__setattr__(self, "scene", os.path.abspath(self.scene))
        kinds = (dispersions_of.Uniform, dispersions_of.Normal)
        object.__setattr__(self, "dispersions", listed("dispersions", kinds, self.dispersions))
        object.__setattr__(self, "criteria", listed("criteria", (Within,), self.criteria))
        object.__setattr__(self, "stops", listed("stops", (stops_of.Held, stops_of.Beyond), self.stops))
        stops_of.positive("look_every", "s", self.look_every)
        pivots = {name: triple(f"pivot of `{name}`", "m", at) for name, at in self.pivots.items()}
        object.__setattr__(self, "pivots", pivots)
        self._check()
        if self.method == "corners":
            object.__setattr__(self, "runs", dispersions_of.corner_count(self.dispersions))
        elif self.method in ("sobol", "morris"):
            object.__setattr__(self, "runs", self.samples * _samplers.block(self.method, len(self.dispersions)))

    def _check(self):
        problems = []
        if not isinstance(self.runs, int):
            raise CampaignError(f"runs: it is {self.runs!r}; give a whole number")
        if self.method not in dispersions_of.METHODS:
            problems.append(f"method: there is no `{self.method}`; give one of {', '.join(dispersions_of.METHODS)}")
        elif self.method == "corners" and self.runs not in (0, 2 ** len(self.dispersions)):
            problems.append(f"runs: corners of {len(self.dispersions)} dispersions are no {self.runs} runs; leave it out")
        elif self.method in ("sobol", "morris"):
            fault = _samplers.fault(self.method, self.samples, len(self.dispersions))
            if fault:
                problems.append(f"samples: {fault}")
            elif self.runs not in (0, self.samples * _samplers.block(self.method, len(self.dispersions))):
                problems.append(f"runs: they follow from samples for the method `{self.method}`; leave them out")
        elif self.method != "corners" and self.runs < 1:
            problems.append(f"runs: it is {self.runs}; give at least 1")
        if self.method not in ("sobol", "morris") and self.samples != 0:
            problems.append(f"samples: the method `{self.method}` has none; leave it out, or give the method sobol or morris")
        if not (isinstance(self.seed, int) and self.seed >= 0):
            problems.append(f"seed: it is {self.seed!r}; give a whole number from 0 up")
        names = [dispersion.parameter for dispersion in self.dispersions]
        if not names:
            problems.append("dispersions: there are none; give at least one")
        for dispersion in self.dispersions:
            if dispersion.fault():
                problems.append(f"dispersion of `{dispersion.parameter}`: {dispersion.fault()}")
        if self.integrator not in (None, *INTEGRATORS):
            problems.append(f"integrator: there is no `{self.integrator}`; give one of {', '.join(INTEGRATORS)}")
        criteria = [criterion.name for criterion in self.criteria]
        stops = [stop.name for stop in self.stops]
        problems += [f"criterion `{name}`: the results have a column of this name; give another" for name in criteria if name in COLUMNS]
        for stop in self.stops:
            if isinstance(stop, stops_of.Held) and stop.criterion not in criteria:
                problems.append(f"stop `{stop.name}`: there is no criterion `{stop.criterion}`; add it to `criteria`")
            if stop.name == "duration":
                problems.append("stop `duration`: runs that no stop ends are told by this name; give another")
        for what, given in (("dispersion", names), ("criterion", criteria), ("stop", stops)):
            problems += [f"{what} `{name}`: it is given twice; keep one" for name in sorted({n for n in given if given.count(n) > 1})]
        if problems:
            raise CampaignError("the plan cannot be used:\n  " + "\n  ".join(problems))

    @property
    def parameters(self):
        """list of str : Addresses of the dispersed parameters."""
        return [dispersion.parameter for dispersion in self.dispersions]

    def to_json(self):
        """Returns the plan as it is stored in campaign.json."""
        entry = asdict(self)
        entry["dispersions"] = [{"kind": dispersions_of.kind_of(d), **asdict(d)} for d in self.dispersions]
        entry["stops"] = [{"kind": type(stop).__name__, **asdict(stop)} for stop in self.stops]
        # Plans of earlier versions have neither.
        for name, value in (("samples", 0), ("alternative", None)):
            if entry[name] == value:
                del entry[name]
        # JSON has no infinity.
        for criterion in entry["criteria"]:
            criterion["speed"] = None if math.isinf(criterion["speed"]) else criterion["speed"]
        return entry

    @classmethod
    def from_json(cls, entry):
        """Makes a plan from what `to_json` returned.

        Parameters
        ----------
        entry : dict
            Plan as it is stored in campaign.json.

        Returns
        -------
        Plan
        """
        entry = dict(entry)
        entry["dispersions"] = [dispersions_of.from_json(d) for d in entry["dispersions"]]
        entry["criteria"] = [
            Within(**c | {"speed": math.inf if c["speed"] is None else c["speed"]}) for c in entry["criteria"]
        ]
        entry["stops"] = [stops_of.from_json(stop) for stop in entry["stops"]]
        if entry["method"] in ("corners", "sobol", "morris"):
            entry["runs"] = 0
        return cls(**entry)

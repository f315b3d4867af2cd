"""Parameters from training tosses, and what was found: found.json, which names the command that finds it again."""

import json
from dataclasses import asdict, dataclass, field
from pathlib import Path

import numpy as np

from validation.cube_tosses import protocol
from validation.cube_tosses.data import PUBLISHED_BODY, Body
from validation.cube_tosses.engines.table import ENGINES, make
from validation.kit.search import Free, minimise
from validation.kit.statistics import standard_error

FOUND = Path(__file__).with_name("found.json")
EVALUATIONS = 80
# At rest the centre is that much lower than half an edge (`data.table_height`).
TABLE = -0.00117  # m

# Bodies by name: parameters of the body that are free beside those of the law, and the height of the table.
BODIES = {
    "published": ({}, 0.0),
    "inertia": ({"inertia": Free(0.0012, 0.0005, 0.0025)}, 0.0),
    "round": ({"inertia": Free(0.0012, 0.0005, 0.0025), "corner_radius": Free(0.003, 0.0003, 0.01)}, TABLE),
}
WINDOWS = {"whole": protocol.whole_tosses, "touch": protocol.after_touch}


@dataclass
class Entry:
    """Parameters of one engine that were found on training tosses."""

    engine: str
    body: str  # a name of BODIES
    window: str  # a name of WINDOWS
    values: dict
    inertia: float  # kg·m²
    corner_radius: float  # m
    table: float  # m
    error: float  # e_q of the training tosses
    evaluations: int
    at_bound: list = field(default_factory=list)
    # Range of each parameter, and of the median peak force in N, over the evaluations within a standard error of the best.
    within_error: dict = field(default_factory=dict)

    def made(self, substeps=protocol.SUBSTEPS):
        """Engine with these parameters."""
        engine = make(self.engine)
        engine.configure(
            self.values, Body(inertia=self.inertia, corner_radius=self.corner_radius), self.table, substeps
        )
        return engine


def identify(
    tosses, engine_name, body_name, window, evaluations=EVALUATIONS, start=None, count=150, note=lambda *_: None
):
    """Searches the parameters of an engine; `start` has values to begin with."""
    extra, table = BODIES[body_name]
    engine = make(engine_name)
    free = {name: _from(one, (start or {}).get(name)) for name, one in {**engine.free, **extra}.items()}
    cases = WINDOWS[window](tosses, protocol.training(count))
    forces, spread = [], []

    def error(values):
        body = Body(
            inertia=values.get("inertia", PUBLISHED_BODY.inertia), corner_radius=values.get("corner_radius", 0.0)
        )
        engine.configure({name: values[name] for name in engine.free}, body, table)
        found, peaks = [], []
        for case in cases:
            found.append(protocol.errors(case, engine.poses(case)).e_q)
            peaks.append(engine.peak_force())
        forces.append(None if None in peaks else float(np.median(peaks)))
        spread.append(standard_error(found))
        return np.mean(found)

    result = minimise(error, free, evaluations, note)
    best = min(range(len(result.tried)), key=lambda one: result.tried[one][1])
    near = [one for one, (_, value) in enumerate(result.tried) if value <= result.error + spread[best]]
    within = {
        name: [min(result.tried[one][0][name] for one in near), max(result.tried[one][0][name] for one in near)]
        for name in free
    }
    if forces[best] is not None:
        within["peak_force"] = [min(forces[one] for one in near), max(forces[one] for one in near)]
    values = result.values
    return Entry(
        engine_name,
        body_name,
        window,
        {name: values[name] for name in engine.free},
        values.get("inertia", PUBLISHED_BODY.inertia),
        values.get("corner_radius", 0.0),
        table,
        result.error,
        result.evaluations,
        result.at_bound,
        within,
    )


def _from(free, start):
    """Free parameter that starts elsewhere, within its bounds."""
    return free if start is None else Free(min(max(start, free.low), free.high), free.low, free.high)


def load(path=FOUND):
    """Entries of a file of found parameters."""
    entries = [Entry(**one) for one in json.loads(Path(path).read_text())["entries"]]
    unknown = [entry.engine for entry in entries if entry.engine not in ENGINES]
    if unknown:
        raise ValueError(f"{path}: there is no engine `{unknown[0]}`; there are {', '.join(ENGINES)}")
    return entries


def known(engine, body, window, path=FOUND):
    """Values to begin a search with: of the same engine with the simpler body, else with the same body in the other window."""
    simpler = {"inertia": "published", "round": "inertia"}.get(body)
    for place in ((engine, simpler, window), (engine, body, "touch")):
        for entry in load(path) if Path(path).exists() else []:
            if (entry.engine, entry.body, entry.window) == place and place != (engine, body, window):
                own = {"inertia": entry.inertia} if entry.body != "published" else {}
                return {**entry.values, **own}
    return None


def save(entries, path=FOUND):
    """Writes entries; those of the same engine, body and window replace what is in the file."""
    path = Path(path)
    kept = {(one.engine, one.body, one.window): one for one in (load(path) if path.exists() else [])}
    kept.update({(one.engine, one.body, one.window): one for one in entries})
    order = list(ENGINES)
    rows = sorted(kept.values(), key=lambda one: (one.window, order.index(one.engine), list(BODIES).index(one.body)))
    text = {
        "command": "python3 -m validation.cube_tosses --identify ENGINE/BODY/WINDOW",
        "training": "the first 150 even tosses",
        "entries": [_rounded(asdict(one)) for one in rows],
    }
    path.write_text(json.dumps(text, indent=1, ensure_ascii=False) + "\n")


def _rounded(thing):
    """Returns the data with numbers of six significant digits."""
    if isinstance(thing, dict):
        return {name: _rounded(one) for name, one in thing.items()}
    if isinstance(thing, list):
        return [_rounded(one) for one in thing]
    return float(f"{thing:.6g}") if isinstance(thing, float) else thing

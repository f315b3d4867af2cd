"""Loads of the cases of a mechanism: histories, plots, and a table of peaks with time, phase and contact, as CSV and Parquet.

`mechanisms/NAME/loads.py` has

* `Case`, a dataclass: its fields, all with defaults, are what `[cases.NAME]` of a loads-case file may give;
* `LOADED`, the bodies whose loads are wanted;
* `run_case(case, watch)`, which makes a machine, calls `watch(machine, phase)` before it moves, and runs it;
  `phase()` gives the name of the present phase;
* `LEVELS`, where `Case` has a field `level`: its values by name;
* `predicted(case)`, where there is a closed form: (body, quantity) → load at the end of the case;
* `CHECKED`, the case of `loads_case.toml` that `--loads-check` runs (kit/loads_check.py).
"""

import csv
import dataclasses
import pathlib
import sys

import mujoco
import numpy as np

from kit import loads_plot, record

ROWS = 100  # of a history, a second
QUANTILES = (0.5, 0.95, 0.99)
QUANTITIES = (("force", "N"), ("moment", "N·m"))
QUANTILE_NAMES = tuple(f"q{100 * q:g}" for q in QUANTILES)
TABLE = ("case", "body", "quantity", "unit", "peak", "time", "phase", "contact", *QUANTILE_NAMES, "last", "predicted")


class History:
    """Magnitudes of force and moment on some bodies in each step of a run.

    Moments are about the origin of the body. A row of the history is the greatest of the steps since the row before.
    """

    def __init__(self, bodies):
        self.bodies, self.machine, self.phase = bodies, None, None
        self.values, self.times, self.phases = [], [], []
        self.peaks = {}  # (body, quantity) → (value, number of the step)
        self.states = {}  # number of a step with a peak → state of MuJoCo

    def watch(self, machine, phase=lambda: ""):
        """Begins with a machine, whose steps it sees from now on. `phase()`: name of the present phase."""
        self.machine, self.phase = machine, phase
        machine.watchers.append(self.look)

    def look(self, machine):
        now = np.array([np.linalg.norm(machine.wrench(body).reshape(2, 3), axis=1) for body in self.bodies])
        step = len(self.times)
        self.values.append(now)
        self.times.append(machine.time)
        self.phases.append(self.phase())
        risen = [key for key in np.ndindex(now.shape) if now[key] > self.peaks.get(key, (0.0, 0))[0]]
        for key in risen:
            self.peaks[key] = (float(now[key]), step)
        if risen:
            self.states[step] = machine.save()
            kept = {at for _, at in self.peaks.values()}
            self.states = {at: state for at, state in self.states.items() if at in kept}

    def rows(self):
        """Rows of the history: time, phase, and each magnitude."""
        every = max(1, round(1.0 / (ROWS * self.machine.step)))
        for first in range(0, len(self.times), every):
            last = min(first + every, len(self.times)) - 1
            greatest = np.max(self.values[first : last + 1], axis=0)
            yield (self.times[last], self.phases[last], *map(float, greatest.ravel()))

    @property
    def columns(self):
        return ("time", "phase", *(f"{quantity}.{body}" for body in self.bodies for quantity, _ in QUANTITIES))

    def last(self, body, quantity):
        """Load at the end: in the last step of a phase, where the run ends with the first step of the next one."""
        entered = len(self.phases) > 1 and self.phases[-1] != self.phases[-2]
        column = [name for name, _ in QUANTITIES].index(quantity)
        return float(self.values[-2 if entered else -1][self.bodies.index(body), column])

    def table(self, case, predicted):
        """Rows of the table: a peak each, quantiles over the time in which something touches the body, and the end.

        `predicted`: (body, quantity) → load at the end.
        """
        contacts = Contacts(self.machine)
        values = np.array(self.values)
        for i, body in enumerate(self.bodies):
            for j, (quantity, unit) in enumerate(QUANTITIES):
                touching = values[values[:, i, j] > 0.0, i, j]
                end = (self.last(body, quantity), predicted.get((body, quantity)))
                if not len(touching):
                    yield (case, body, quantity, unit, 0.0, None, "", "", *(0.0,) * len(QUANTILES), *end)
                    continue
                peak, step = self.peaks[i, j]
                contact = contacts.hardest(self.states[step], body)
                spread = np.quantile(touching, QUANTILES, method="inverted_cdf")
                at = (peak, self.times[step], self.phases[step], contact)
                yield (case, body, quantity, unit, *at, *map(float, spread), *end)


class Contacts:
    """Names of contacts in a saved state, from a contact world of the wheel `pong` with the plugin's Objects and pairs."""

    def __init__(self, machine):
        self.machine = machine
        self.recorded = record.World(machine)

    def hardest(self, state, body):
        """Contact on a body with the greatest normal force: the names of its two primitives."""
        self.machine.restore(state)
        mujoco.mj_forward(self.machine.model, self.machine.data)
        world, number = self.recorded.at(), self.machine.model.body(body).id
        own = [i for i, carrier in enumerate(self.recorded.bodies) if carrier == number]
        seen = world.contacts()
        seen = seen[np.isin(seen["interface_a"], own) | np.isin(seen["interface_b"], own)]
        if not len(seen):
            return ""
        one = seen[np.argmax(seen["normal_force"])]
        return " on ".join(
            world.primitive_path(int(one[f"interface_{side}"]), int(one[f"primitive_{side}"])) for side in "ab"
        )


def case_of(mechanism, name, fields):
    """The case of a mechanism with these fields of a loads-case file: lists become tuples, names of levels levels."""
    known, levels = {field.name for field in dataclasses.fields(mechanism.Case)}, getattr(mechanism, "LEVELS", {})
    given = {}
    for field, value in fields.items():
        if field not in known:
            sys.exit(f"case `{name}`: there is no field `{field}`; give one of {', '.join(sorted(known))}")
        if field == "level" and value not in levels:
            sys.exit(f"case `{name}`: there is no level `{value}`; give one of {', '.join(levels)}")
        given[field] = levels[value] if field == "level" else tuple(value) if isinstance(value, list) else value
    return mechanism.Case(**given)


def history_of(mechanism, case):
    """Runs a case and returns its history."""
    history = History(mechanism.LOADED)
    mechanism.run_case(case, history.watch)
    return history


def predicted(mechanism, case):
    """Closed forms of loads at the end of a case, by body and quantity; empty where a mechanism has none."""
    return mechanism.predicted(case) if hasattr(mechanism, "predicted") else {}


def run(mechanism, cases, folder):
    """Runs cases, writes their histories, their plots and the table of all into a folder, and returns the table's rows."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    found = []
    for name, fields in (cases or {"nominal": {}}).items():
        case = case_of(mechanism, name, fields)
        history = history_of(mechanism, case)
        rows = list(history.rows())
        write(folder / name, history.columns, rows)
        loads_plot.write(folder / f"{name}.png", name, history.columns, rows)
        found += history.table(name, predicted(mechanism, case))
    write(folder / "loads", TABLE, found)
    return found


def write(path, columns, rows):
    """Writes a table as CSV, and as Parquet where PyArrow is installed."""
    with open(f"{path}.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(columns)
        writer.writerows(rows)
    try:
        import pyarrow
        import pyarrow.parquet
    except ImportError:
        print(f"{path}.parquet is not written: PyArrow is missing")
        return
    table = pyarrow.table({name: pyarrow.array(column) for name, column in zip(columns, zip(*rows))})
    pyarrow.parquet.write_table(table, f"{path}.parquet")


def shown(rows):
    """The table as Markdown."""
    yield "| case | on | load | peak | at | in phase | hardest contact | 50, 95, 99 % of the time in contact | end | predicted |"
    yield "|---|---|---|---|---|---|---|---|---|---|"
    for case, body, quantity, unit, peak, time, phase, contact, *spread, last, closed in rows:
        at = f"{time:.3f} s" if time is not None else ""
        quantiles = ", ".join(f"{value:.4g}" for value in spread)
        end = f"{last:.4g} {unit} | {'' if closed is None else f'{closed:.4g} {unit}'}"
        yield f"| {case} | {body} | {quantity} | {peak:.4g} {unit} | {at} | {phase} | {contact} | {quantiles} {unit} | {end} |"

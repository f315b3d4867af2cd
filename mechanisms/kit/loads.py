"""Loads of the cases of a mechanism: histories, and a table of peaks with time, phase and contact, as CSV and Parquet.

`mechanisms/NAME/loads.py` has `LOADED`, the bodies whose loads are wanted, and `run_case(fields, prepare, watched)`, which
runs a case until its end and calls `watched(machine, sequencer)` at every step.
"""

import csv
import pathlib

import mujoco
import numpy as np

from kit import record

ROWS = 100  # of a history, a second
QUANTILES = (0.5, 0.95, 0.99)
QUANTITIES = (("force", "N"), ("moment", "N·m"))
TABLE = ("case", "body", "quantity", "unit", "peak", "time", "phase", "contact", *(f"q{100 * q:g}" for q in QUANTILES))


class History:
    """Watcher of a run: magnitudes of force and moment on some bodies in each step.

    Moments are about the origin of the body. A row of the history is the greatest of the steps since the row before.
    """

    def __init__(self, bodies):
        self.bodies, self.machine = bodies, None
        self.values, self.times, self.phases = [], [], []
        self.peaks = {}  # (body, quantity) → (value, number of the step)
        self.states = {}  # number of a step with a peak → state of MuJoCo

    def prepare(self, machine):
        self.machine = machine

    def __call__(self, machine, sequencer):
        now = np.array([np.linalg.norm(machine.wrench(body).reshape(2, 3), axis=1) for body in self.bodies])
        step = len(self.times)
        self.values.append(now)
        self.times.append(machine.time)
        self.phases.append(sequencer.phase)
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

    def table(self, case):
        """Rows of the table: a peak each, and quantiles over the time in which something touches the body."""
        contacts = Contacts(self.machine)
        values = np.array(self.values)
        for i, body in enumerate(self.bodies):
            for j, (quantity, unit) in enumerate(QUANTITIES):
                touching = values[values[:, i, j] > 0.0, i, j]
                if not len(touching):
                    yield (case, body, quantity, unit, 0.0, None, "", "", *(0.0,) * len(QUANTILES))
                    continue
                peak, step = self.peaks[i, j]
                contact = contacts.hardest(self.states[step], body)
                spread = np.quantile(touching, QUANTILES, method="inverted_cdf")
                yield (case, body, quantity, unit, peak, self.times[step], self.phases[step], contact, *map(float, spread))


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


def run(mechanism, cases, folder):
    """Runs cases, writes their histories and the table of all into a folder, and returns the rows of the table."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    found = []
    for name, fields in (cases or {"nominal": {}}).items():
        history = History(mechanism.LOADED)
        mechanism.run_case(fields, history.prepare, history)
        write(folder / name, history.columns, list(history.rows()))
        found += history.table(name)
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
    yield "| case | on | load | peak | at | in phase | hardest contact | 50, 95, 99 % of the time in contact |"
    yield "|---|---|---|---|---|---|---|---|"
    for case, body, quantity, unit, peak, time, phase, contact, *spread in rows:
        at = f"{time:.3f} s" if time is not None else ""
        quantiles = ", ".join(f"{value:.4g}" for value in spread)
        yield f"| {case} | {body} | {quantity} | {peak:.4g} {unit} | {at} | {phase} | {contact} | {quantiles} {unit} |"

#!/usr/bin/env python3
"""Runs the scenes of a model and compares the results with its outcome.py; standard library only.

    python3 outcomes.py PONG FOLDER [SCENE…]

FOLDER/outcome.py has a table OUTCOMES: name of a scene file -> function of a `Run` that yields (what, value, least,
most). Every scene_*.ron of the folder must have one. A scene must also run without a warning, and the balance of its
energies must close, so it needs `ledger: true`. Exit code 1 if anything is off.
"""

import argparse
import csv
import pathlib
import runpy
import subprocess
import sys
import tempfile
import time

BALANCE = 0.01  # of the greatest change of any of the energies in a run


class Run:
    """CSV tables of a run, read on demand."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.tables = {}

    def table(self, name):
        """All rows of a table as dictionaries, with numbers converted."""
        if name not in self.tables:
            with open(self.folder / f"{name}.csv", newline="", encoding="utf-8") as file:
                self.tables[name] = [{key: _value(text) for key, text in row.items()} for row in csv.DictReader(file)]
        return self.tables[name]

    def of(self, table, body):
        """The rows of one body."""
        return [row for row in self.table(table) if row["body"] == body]

    def last(self, body):
        """Final state of a body."""
        return self.of("states", body)[-1]

    def times(self):
        return sorted({row["time_s"] for row in self.table("states")})


def _value(text):
    try:
        return float(text)
    except ValueError:
        return text


def position(row):
    return (row["x_m"], row["y_m"], row["z_m"])


def orientation(row):
    return (row["qw"], row["qx"], row["qy"], row["qz"])


def norm(values):
    return sum(x * x for x in values) ** 0.5


def turned(q, v):
    """A vector from the axes of a body to the common ones."""
    w, x, y, z = q
    t = (2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0]))
    return (
        v[0] + w * t[0] + y * t[2] - z * t[1],
        v[1] + w * t[1] + z * t[0] - x * t[2],
        v[2] + w * t[2] + x * t[1] - y * t[0],
    )


def place(row, point):
    """Position of a body's point."""
    return tuple(p + d for p, d in zip(position(row), turned(orientation(row), point)))


def force(row):
    return (row["fx_n"], row["fy_n"], row["fz_n"])


def speed(row):
    return norm((row["vx_m_per_s"], row["vy_m_per_s"], row["vz_m_per_s"]))


def turn_rate(row):
    return norm((row["wx_rad_per_s"], row["wy_rad_per_s"], row["wz_rad_per_s"]))


def balance(run):
    """Imbalance of the energy account, relative to the energy involved."""
    rows = run.table("energies")
    keys = ("kinetic_j", "potential_j", "springs_j", "contacts_j", "contact_loss_j", "spring_loss_j", "work_in_j")
    moved = max(max(abs(row[key] - rows[0][key]) for row in rows) for key in keys)
    worst = max(abs(row["balance_j"] - rows[0]["balance_j"]) for row in rows)
    return ("energy that the account misses, of what was moved", worst / moved if moved else 0.0, 0.0, BALANCE)


def run_scene(pong, scene, out, accepted):
    """True if a scene runs without output except for accepted lines; prints other lines."""
    done = subprocess.run([pong, "run", "--quiet", "--csv", "-o", out, scene], capture_output=True, text=True)
    lines = (done.stderr + done.stdout).strip().splitlines()
    told = "\n".join(line for line in lines if not any(text in line for text in accepted))
    if told:
        print(told)
    if done.returncode == 0 and not pathlib.Path(out, "energies.csv").exists():
        told = "no account of energies: give the scene `ledger: true`"
        print(f"  OFF {told}")
    return done.returncode == 0 and not told


def check(pong, scene, outcome, accepted):
    """Runs a scene and prints every value; returns whether all are as predicted."""
    with tempfile.TemporaryDirectory() as out:
        print(f"{scene.parent.name}/{scene.name}", end=": ", flush=True)
        started = time.monotonic()
        good = run_scene(pong, str(scene), out, accepted)
        print(f"{time.monotonic() - started:.1f} s")
        return good and tell([balance(run := Run(out)), *outcome(run)])


def tell(values):
    good = True
    for what, value, least, most in values:
        held = least <= value <= most  # no value that is not a number holds
        good = good and held
        print(f"  {'   ' if held else 'OFF'} {what}: {value:.6g} ({least:g} to {most:g})")
    return good


def unmatched(folder, outcomes, wanted):
    """Scenes without an outcome, outcomes without a scene, and requested ones that are neither."""
    scenes = {path.name for path in folder.glob("scene_*.ron")}
    for name in sorted(scenes - set(outcomes)):
        yield f"{folder.name}/outcome.py does not say what {name} must come to"
    for name in sorted((set(outcomes) | set(wanted)) - scenes):
        yield f"{folder.name} has no {name}"


def main():
    parser = argparse.ArgumentParser(description="Runs the scenes of a model and checks what comes out.")
    parser.add_argument("pong", help="the program that runs scenes")
    parser.add_argument("folder", type=pathlib.Path, help="of the model")
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help="names of scene files; all unless given")
    options = parser.parse_args()
    folder = options.folder.resolve()
    sys.path[:0] = [str(folder), str(folder.parent)]
    said = runpy.run_path(str(folder / "outcome.py"))
    outcomes, warnings = said["OUTCOMES"], said.get("WARNINGS", {})
    faults = list(unmatched(folder, outcomes, options.scenes))
    if faults:
        sys.exit("\n".join(faults))
    results = [
        check(options.pong, folder / name, outcomes[name], warnings.get(name, ())) for name in options.scenes or outcomes
    ]
    sys.exit(0 if results and all(results) else 1)


if __name__ == "__main__":
    main()

"""Runs `pong trade` on the scenes of docs/accuracy.md and writes what it finds into that page: everything between two
`measured` marks, and the figures. Run from the root of the repository, on a quiet machine; it takes some minutes:

    python3 docs/figures/make_accuracy.py target/release/pong [SCENE…]

What was finished is kept in target/accuracy, so that a run that was stopped goes on; `--fresh` before the names begins anew.
"""

import csv
import pathlib
import re
import shutil
import subprocess
import sys
import textwrap

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
PAGE = ROOT / "docs/accuracy.md"
KEPT = ROOT / "target/accuracy"

# name -> (heading of a column, scene, options)
SCENES = {
    "peg": ("peg in a hole", "peg_in_hole/scene_shallow.ron", []),
    "tripod": ("tripod", "tripod/scene_drop.ron", []),
    "pallet": ("pallet", "htv_pallet/scene_corner_push.ron", ["--duration", "5", "--refinements", "1"]),
    "wheel": ("wheel", "rover/scene_roll_balls.ron", ["--refinements", "1"]),
    "berthing": ("berthing", "common_berthing/scene_berthing.ron",
                 ["--duration", "19", "--refinements", "1", "--within", "3%", "--of", "wrench,impulse,energy,pose"]),
    "docking": ("docking", "idss_docking/scene_soft_capture.ron",
                ["--refinements", "1", "--within", "3%", "--of", "impulse,peak,energy,pose"]),
}


# --- a study ---------------------------------------------------------------------------------------------------------

def study(pong, name, fresh):
    _, scene, options = SCENES[name]
    out = KEPT / name
    command = [pong, "trade", f"models/{scene}", "-o", str(out), "--quiet", "--rounds", "5", *options]
    subprocess.run([*command, *(["--fresh"] if fresh else [])], cwd=ROOT, check=True)
    shutil.copyfile(out / "trade.svg", HERE / f"trade_{name}.svg")


def section(page, heading):
    """Lines below a heading, up to the next."""
    lines = page.splitlines()
    start = next(i for i, line in enumerate(lines) if line.startswith("## ") and heading in line)
    end = next((i for i in range(start + 1, len(lines)) if lines[i].startswith("## ")), len(lines))
    return [line for line in lines[start + 1 : end]]


def rows(lines):
    return [line for line in lines if line.startswith("|")]


def found(name):
    """Part of the page on one scene: the reference, the verdict, the levels of the front."""
    page = (KEPT / name / "trade.md").read_text(encoding="utf-8")
    told = [part for line in section(page, "The reference") for part in wrapped(line)]
    levels = rows(section(page, "Levels"))
    wanted = [line for line in levels[2:] if "front" in line or "as written" in line]
    return "\n".join(["", *blank_around_tables(told), "", *levels[:2], *wanted, ""])


def wrapped(line):
    """Lines of the page's width; table rows stay whole."""
    return [line] if line.startswith("|") else textwrap.wrap(line, 118, break_long_words=False, break_on_hyphens=False)


def blank_around_tables(lines):
    shown = []
    for line in lines:
        if shown and line.startswith("|") != shown[-1].startswith("|"):
            shown.append("")
        shown.append(line)
    return shown


# --- all levers of all scenes ----------------------------------------------------------------------------------------

UNITS = {"µs": 1e-6, "ms": 1e-3, "s": 1.0}


def seconds(text):
    number, unit = text.split()
    return float(number) * UNITS[unit]


def levers(name):
    """(lever, to) -> (time, error, whether the bits are the same) relative to the scene as written."""
    page = (KEPT / name / "trade.md").read_text(encoding="utf-8")
    cells = [[cell.strip() for cell in row.strip("|").split("|")] for row in rows(section(page, "from the scene as written"))[2:]]
    return {(lever, to): (time, error, bits == "same") for lever, to, time, error, bits in cells}


def written_step(name):
    with open(KEPT / name / "trade.csv", newline="", encoding="utf-8") as file:
        levels = {row["level"]: row for row in csv.DictReader(file)}
    page = (KEPT / name / "trade.md").read_text(encoding="utf-8")
    written = next(row for row in rows(section(page, "Levels")) if "as written" in row)
    return float(levels[written.split("|")[1].strip()]["step_s"])


def cell(pair):
    if pair is None:
        return ""
    time, error, same = pair
    if error == "diverges":
        return "diverges"
    return time if same else f"{time}, {error} %"


def fastest(table, lever):
    """Fastest level of a lever, by name."""
    of = [(to, pair) for (name, to), pair in table.items() if name == lever and pair[0] != "–"]
    if not of:
        return ""
    to, pair = min(of, key=lambda entry: float(entry[1][0]))
    return f"{cell(pair)} ({re.sub(' bounds|leaves of ', '', to)})"


def summary(names):
    tables = {name: levers(name) for name in names}
    steps = {name: written_step(name) for name in names}

    def stepped(factor):
        def of(name):
            near = lambda to: abs(seconds(to) / steps[name] / factor - 1) < 0.01
            return cell(next((pair for (lever, to), pair in tables[name].items() if lever == "step" and near(to)), None))

        return of

    kinds = [
        ("step twice as long", stepped(2)),
        ("step four times as long", stepped(4)),
        ("step eight times as long", stepped(8)),
        ("step half as long", stepped(0.5)),
        ("semi-implicit Euler", lambda name: cell(tables[name].get(("integrator", "Euler")))),
        ("wrench held over the step", lambda name: cell(tables[name].get(("integrator", "hold/1")))),
        ("no friction", lambda name: cell(tables[name].get(("friction", "no friction")))),
        ("ellipsoid for 54 spheres", lambda name: cell(tables[name].get(("alternatives", "`ellipsoid`")))),
        ("sphere for 54 spheres", lambda name: cell(tables[name].get(("alternatives", "`sphere`")))),
        ("best kind of bounds, same bits", lambda name: fastest(tables[name], "bounds")),
        ("best size of leaves, same bits", lambda name: fastest(tables[name], "leaves")),
        ("one worker, same bits", lambda name: cell(tables[name].get(("workers", "1 worker")))),
    ]
    lines = ["| lever | " + " | ".join(SCENES[name][0] for name in names) + " |", "|---|" + "---|" * len(names)]
    lines += [f"| {what} | " + " | ".join(of(name) for name in names) + " |" for what, of in kinds]
    return "\n".join(["", *lines, ""])


# --- the page --------------------------------------------------------------------------------------------------------

def put(page, mark, text):
    begin, end = f"<!-- measured: {mark} -->\n", f"<!-- end: {mark} -->"
    before, rest = page.split(begin)
    return before + begin + text + "\n" + end + rest.split(end, 1)[1]


def main():
    pong, *names = sys.argv[1:] or sys.exit(__doc__)
    fresh = "--fresh" in names
    names = [name for name in names if name != "--fresh"] or list(SCENES)
    for name in names:
        print(name, flush=True)
        study(str(pathlib.Path(pong).resolve()), name, fresh)
    page = PAGE.read_text(encoding="utf-8")
    for name in names:
        page = put(page, name, found(name))
    if all((KEPT / name / "trade.md").exists() for name in SCENES):
        page = put(page, "levers", summary(list(SCENES)))
    PAGE.write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main()

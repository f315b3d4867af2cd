"""Results of ci/mutants: counts, and surviving mutants that docs/mutants.md does not judge.

    python3 ci/mutants.py rest FOLDER      a pattern of those that have lived so far
    python3 ci/mutants.py report FOLDER    FOLDER holds what cargo-mutants wrote: in quick/, rest/, again_1/, …
"""

import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
JUDGED = ROOT / "docs" / "mutants.md"


def outcomes(folder):
    """(mutant, verdict) of every mutant of one run."""
    entries = json.loads((folder / "mutants.out" / "outcomes.json").read_text())["outcomes"]
    return [(entry["scenario"]["Mutant"], entry["summary"]) for entry in entries if entry["scenario"] != "Baseline"]


def verdicts(folder):
    """(mutant, verdict) of every mutant of a group; a later run covers those that survived until then."""
    runs = [folder / "quick", folder / "rest", *sorted(folder.glob("again_*"))]
    told = {}
    for run in (run for run in runs if (run / "mutants.out" / "outcomes.json").exists()):
        for mutant, verdict in outcomes(run):
            # A pattern of names does not keep cargo-mutants from deleting fields elsewhere as well; that is harmless.
            if run.name == "quick" or told.get(mutant["name"], (None, ""))[1] == "MissedMutant":
                told[mutant["name"]] = (mutant, verdict)
    return list(told.values())


def row(mutant, tree):
    """Name of a mutant in docs/mutants.md: file, line of code, change."""
    path = mutant["file"]
    code = (tree / path).read_text().splitlines()[mutant["span"]["start"]["line"] - 1].strip()
    change = re.sub(r"^\S+:\d+:\d+: ", "", mutant["name"])
    file = re.sub(r"^crates/pong-[a-z]+/src/", "", path)
    return tuple(text.replace("|", "\\|") for text in (file, code, change))


def judged():
    """Mutants judged in docs/mutants.md; a row may name several changes of one line."""
    rows = set()
    for line in JUDGED.read_text().splitlines() if JUDGED.exists() else []:
        cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
        if len(cells) == 4 and cells[3]:
            file, code, changes, _ = cells
            rows.update((file.strip("`"), code.strip("`"), change) for change in re.findall("`([^`]*)`", changes))
    return rows


def print_rest(folder):
    names = [mutant["name"] for mutant, verdict in verdicts(folder) if verdict == "MissedMutant"]
    if names:
        print("^(" + "|".join(map(re.escape, names)) + ")$")


def report(folder):
    told = verdicts(folder)
    count = lambda verdict: sum(1 for _, other in told if other == verdict)
    print(
        f"{folder.name}: {len(told)} mutants, {count('CaughtMutant')} caught, {count('Timeout')} ran too long, "
        f"{count('Unviable')} do not build, {count('MissedMutant')} missed"
    )
    known = judged()
    new = {}
    for file, code, change in (row(mutant, folder.parent / "tree") for mutant, verdict in told if verdict == "MissedMutant"):
        if (file, code, change) not in known:
            # Equal changes at two positions of a line count as one.
            new.setdefault((file, code), {})[f"`{change}`"] = None
    for (file, code), changes in new.items():
        print(f"| `{file}` | `{code}` | {', '.join(changes)} | |")
    sys.exit(1 if new else 0)


{"rest": print_rest, "report": report}[sys.argv[1]](pathlib.Path(sys.argv[2]))

"""What a run of ci/mutants found: numbers, and the mutants that no test saw and docs/mutants.md does not judge.

    python3 ci/mutants.py rest FOLDER      a pattern of those that lived through the quick tests
    python3 ci/mutants.py report FOLDER    FOLDER holds what cargo-mutants wrote, in quick/ and rest/
"""

import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
JUDGED = ROOT / "docs" / "mutants.md"


def outcomes(folder):
    """(mutant, verdict) of every mutant of one run; none if there was no such run."""
    path = folder / "mutants.out" / "outcomes.json"
    entries = json.loads(path.read_text())["outcomes"] if path.exists() else []
    return [(entry["scenario"]["Mutant"], entry["summary"]) for entry in entries if entry["scenario"] != "Baseline"]


def row(mutant):
    """A mutant as docs/mutants.md names it: file, line of code, change."""
    path = mutant["file"]
    code = (ROOT / path).read_text().splitlines()[mutant["span"]["start"]["line"] - 1].strip()
    change = re.sub(r"^\S+:\d+:\d+: ", "", mutant["name"])
    file = re.sub(r"^crates/pong-[a-z]+/src/", "", path)
    return tuple(text.replace("|", "\\|") for text in (file, code, change))


def judged():
    """What docs/mutants.md has judged; a row may name several changes of one line."""
    rows = set()
    for line in JUDGED.read_text().splitlines() if JUDGED.exists() else []:
        cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
        if len(cells) == 4 and cells[3]:
            file, code, changes, _ = cells
            rows.update((file.strip("`"), code.strip("`"), change) for change in re.findall("`([^`]*)`", changes))
    return rows


def lived(quick):
    """Names of those that the quick tests let live."""
    return [mutant["name"] for mutant, verdict in quick if verdict == "MissedMutant"]


def print_rest(folder):
    names = lived(outcomes(folder / "quick"))
    if names:
        print("^(" + "|".join(map(re.escape, names)) + ")$")


def report(folder):
    quick = outcomes(folder / "quick")
    # A pattern of names does not keep cargo-mutants from deleting fields elsewhere as well: those are not asked for.
    rest = {mutant["name"]: verdict for mutant, verdict in outcomes(folder / "rest")}
    told = [(mutant, rest.get(mutant["name"], verdict) if verdict == "MissedMutant" else verdict) for mutant, verdict in quick]
    count = lambda verdict: sum(1 for _, other in told if other == verdict)
    print(
        f"{folder.name}: {len(quick)} mutants, {count('CaughtMutant')} caught, {count('Timeout')} ran too long, "
        f"{count('Unviable')} do not build, {count('MissedMutant')} missed"
    )
    known = judged()
    new = {}
    for file, code, change in (row(mutant) for mutant, verdict in told if verdict == "MissedMutant"):
        if (file, code, change) not in known:
            # At two places of a line it is the same change.
            new.setdefault((file, code), {})[f"`{change}`"] = None
    for (file, code), changes in new.items():
        print(f"| `{file}` | `{code}` | {', '.join(changes)} | |")
    sys.exit(1 if new else 0)


{"rest": print_rest, "report": report}[sys.argv[1]](pathlib.Path(sys.argv[2]))

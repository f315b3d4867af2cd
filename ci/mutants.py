"""What a run of ci/mutants found: numbers, and the mutants that no test saw and docs/mutants.md does not judge.

    python3 ci/mutants.py GROUP FOLDER    FOLDER holds what cargo-mutants wrote
"""

import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
JUDGED = ROOT / "docs" / "mutants.md"
# Their numbers stay those of the run with the quick tests: the second run leaves them out.
FIRST_RUN = ("CaughtMutant", "Unviable")


def outcomes(path):
    """(mutant, verdict) of every mutant of one run."""
    for outcome in json.loads(path.read_text())["outcomes"]:
        if outcome["scenario"] != "Baseline":
            yield outcome["scenario"]["Mutant"], outcome["summary"]


def row(mutant):
    """A mutant as docs/mutants.md names it: file, line of code, change."""
    path = mutant["file"]
    code = (ROOT / path).read_text().splitlines()[mutant["span"]["start"]["line"] - 1].strip()
    change = re.sub(r"^\S+:\d+:\d+: ", "", mutant["name"])
    file = re.sub(r"^crates/pong-[a-z]+/src/", "", path)
    return tuple(text.replace("|", "\\|") for text in (file, code, change))


def judged():
    """The rows of docs/mutants.md that have a judgement."""
    rows = set()
    for line in JUDGED.read_text().splitlines() if JUDGED.exists() else []:
        cells = [cell.strip().strip("`") for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
        if len(cells) == 4 and cells[3]:
            rows.add(tuple(cells[:3]))
    return rows


def main(group, folder):
    folder = pathlib.Path(folder)
    quick = list(outcomes(folder / "quick.json"))
    rest = list(outcomes(folder / "mutants.out" / "outcomes.json"))
    told = [entry for entry in quick if entry[1] in FIRST_RUN] + [entry for entry in rest if entry[1] != "Unviable"]
    count = lambda verdict: sum(1 for _, other in told if other == verdict)
    print(
        f"{group}: {len(quick)} mutants, {count('CaughtMutant')} caught, {count('Timeout')} ran too long, "
        f"{count('Unviable')} do not build, {count('MissedMutant')} missed"
    )
    known = judged()
    new = [row(mutant) for mutant, verdict in told if verdict == "MissedMutant" and row(mutant) not in known]
    for file, code, change in new:
        print(f"| `{file}` | `{code}` | `{change}` | |")
    sys.exit(1 if new else 0)


main(*sys.argv[1:])

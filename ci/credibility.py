#!/usr/bin/env python3
"""Counts what docs/credibility.md tells of the tree, and writes it between the marks of that page.

    python3 ci/credibility.py            writes the page anew
    python3 ci/credibility.py --check    prints what is out of date; `ci/tidy` does it, too

Numbers that grow with every change are rounded down, so that the page does not change with every test.
"""

import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/credibility.md"
BLOCK = re.compile(r"(<!-- counted: ([a-z]+) -->\n).*?(<!-- end: \2 -->)", re.S)


def tracked(root, *patterns):
    listed = subprocess.run(["git", "ls-files", "-z", "--", *patterns], cwd=root, capture_output=True, check=True, text=True).stdout
    return [root / name for name in sorted(filter(None, listed.split("\0")))]


def text(path):
    return path.read_text(encoding="utf-8")


def matches(pattern, paths):
    return sum(len(re.findall(pattern, text(path), re.M)) for path in paths)


def at_least(number, step):
    return f"at least {number // step * step:,}"


def verification(root):
    passed, of, quantities = re.search(r"(\d+) of (\d+) cases pass \((\d+) quantities\)", text(root / "docs/verification.md")).groups()
    rust = matches(r"^\s*#\[test\]", tracked(root, "crates/**/*.rs"))
    python = matches(r"^def test_", tracked(root, "hosts/python/tests/*.py"))
    faults = matches(r"^\[\[fault\]\]", tracked(root, "ci/planted/*.toml"))
    targets = len(tracked(root, "fuzz/targets/*.rs"))
    table = text(root / "docs/invariances.md").split("## What is compared")[1].split("\n## ")[0]
    twins = len(re.findall(r"^\| `", table, re.M))
    yield "| what | number | shown by |"
    yield "|---|---|---|"
    yield f"| cases with a known answer that pass, of all | {passed} of {of} | `pong verify` |"
    yield f"| quantities compared in them | {quantities} | `pong verify` |"
    yield f"| kinds of twins of random scenes | {twins} | `bash ci/invariances` |"
    yield f"| Rust tests | {at_least(rust, 100)} | `bash ci/unit` |"
    yield f"| Python tests of the wheel | {at_least(python, 50)} | `bash ci/python` |"
    yield f"| faults that are planted to see that a test fails | {at_least(faults, 50)} | `bash ci/planted_faults --all` |"
    yield f"| targets of the fuzzer | {targets} | `bash ci/fuzz` |"


def validation(root):
    studies = [path for path in tracked(root, "validation/*/README.md")]
    yield "| study | page |"
    yield "|---|---|"
    for path in studies:
        title = re.search(r"^# (.+)$", text(path), re.M)[1]
        yield f"| {title} | [{path.parent.name}](../{path.relative_to(root)}) |"
    if not studies:
        yield "| none is in this tree: no measurement has been compared with Pong here | |"


def sections(root):
    """Tables of sources of dimensions, by page."""
    titles = ("Where dimensions come from", "Where the numbers come from", "Assumptions", "Figures of the standard")
    for path in tracked(root, "mechanisms/*/README.md", "models/*/README.md"):
        rows = []
        for title in titles:
            _, found, rest = text(path).partition(f"\n## {title}\n")
            if found:
                lines = [line for line in rest.split("\n## ")[0].splitlines() if line.startswith("|")]
                # Without the head of the table and the line below it.
                rows += [line for i, line in enumerate(lines) if "---" not in line and not (i + 1 < len(lines) and "---" in lines[i + 1])]
        if rows:
            yield path, rows


def pedigree(root):
    yield "| model | dimensions and other numbers with a source or a reason, rows |"
    yield "|---|---|"
    for path, rows in sections(root):
        name = path.relative_to(root).parent
        yield f"| [{name}](../{name}/README.md) | {len(rows)} |"


def uncertainty(root):
    campaigns = [path for path in tracked(root, "mechanisms/*/campaign.py") if path.parent.name != "kit"]
    kept = tracked(root, "mechanisms/*/worst_case.json")
    methods = re.search(r"^METHODS = \((.+)\)$", text(root / "hosts/python/python/pong/campaign/_dispersions.py"), re.M)[1]
    yield "| what | number | shown by |"
    yield "|---|---|---|"
    yield f"| ways to draw the inputs of a campaign | {methods.count(',') + 1} | `bash ci/python test_campaign test_sensitivity` |"
    yield f"| mechanisms with a campaign of their own | {len(campaigns)} | `python3 mechanisms/run.py NAME --campaign DIR` |"
    yield f"| worst cases that are kept and run again | {len(kept)} | `bash ci/mechanisms NAME` |"


def management(root):
    pages = len(tracked(root, "docs/decisions/0*.md"))
    entries = len(re.findall(r"^\* ", text(root / "CHANGELOG.md"), re.M))
    released = len(re.findall(r"^## (?!Unreleased)", text(root / "CHANGELOG.md"), re.M))
    yield "| what | number | where |"
    yield "|---|---|---|"
    yield f"| changes that users see | {at_least(entries, 50)} | [CHANGELOG](../CHANGELOG.md) |"
    yield f"| versions released before this one | {released} | [CHANGELOG](../CHANGELOG.md) |"
    yield f"| decisions with their reasons | {pages} | [decisions](decisions/README.md) |"


BLOCKS = {
    "verification": verification,
    "validation": validation,
    "pedigree": pedigree,
    "uncertainty": uncertainty,
    "management": management,
}


def fresh(root):
    """The page with what is counted now."""
    page = text(root / "docs/credibility.md")
    return BLOCK.sub(lambda found: found[1] + "\n" + "\n".join(BLOCKS[found[2]](root)) + "\n\n" + found[3], page)


def check(root):
    """Problems of the page: blocks that are missing or out of date, and commands that lead nowhere."""
    page = text(root / "docs/credibility.md")
    there = [name for _, name, _ in BLOCK.findall(page)]
    for name in BLOCKS:
        if there.count(name) != 1:
            yield f"docs/credibility.md: the block `{name}` is there {there.count(name)} times; keep one"
    if fresh(root) != page:
        yield "docs/credibility.md: its counts are out of date; run python3 ci/credibility.py"
    for path in ("docs/credibility.md", "docs/credibility_template.md"):
        for program in re.findall(r"`(?:bash|python3) ([a-z_]+/[\w/.]+)", text(root / path)):
            if not (root / program).exists():
                yield f"{path}: there is no {program}"


def main():
    if "--check" in sys.argv[1:]:
        problems = list(check(ROOT))
        print("\n".join(problems), end="\n" if problems else "")
        sys.exit(1 if problems else 0)
    PAGE.write_text(fresh(ROOT), encoding="utf-8")


if __name__ == "__main__":
    main()

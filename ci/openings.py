#!/usr/bin/env python3
"""Doc comments whose first word makes a relative clause (CONTRIBUTING.md, Words): one line each, or counts by folder.

    python3 ci/openings.py              counts
    python3 ci/openings.py PATH...      lines below these paths
"""

import re
import subprocess
import sys
from collections import Counter

OPENING = re.compile(r"(What|Which|Whether|Of|Those|Whose|That of|The one|The ones|The same|So many|As many)\b(?! it is\b)")
RUST = re.compile(r"^\s*//[/!] ?(.*)")
PYTHON = re.compile(r'^\s*(?:[rRuU]?)"""(.+)')
C = re.compile(r"^\s*(?:///|/\*\*) ?(.*)")


def tracked():
    names = subprocess.run(["git", "ls-files"], check=True, capture_output=True, text=True).stdout.split("\n")
    return [name for name in names if name.endswith((".rs", ".py", ".pyi", ".h", ".hpp", ".c", ".cc", ".cpp", ".js"))]


def comments(name):
    """Line number and first line of each doc comment of a file."""
    kind = RUST if name.endswith(".rs") else PYTHON if name.endswith((".py", ".pyi")) else C
    inside = False
    with open(name, encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            found = kind.match(line)
            if found and not inside and found[1].strip():
                yield number, found[1].strip()
            # A docstring is one line here; other blocks end with the first line that is none.
            inside = bool(found) and kind is not PYTHON and bool(found[1].strip())


def main():
    paths = sys.argv[1:]
    total, odd = 0, []
    for name in tracked():
        if paths and not name.startswith(tuple(paths)):
            continue
        for number, text in comments(name):
            total += 1
            if OPENING.match(text):
                odd.append((name, number, text))
    if paths:
        for name, number, text in odd:
            print(f"{name}:{number}: {text}")
    else:
        folders = Counter("/".join(name.split("/")[:2]) for name, _, _ in odd)
        for folder, count in folders.most_common():
            print(f"{count:6} {folder}")
    print(f"{len(odd)} of {total} doc comments ({100 * len(odd) / max(total, 1):.1f} %)")


if __name__ == "__main__":
    main()

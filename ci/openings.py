#!/usr/bin/env python3
"""Doc comments that open with a relative clause (CONTRIBUTING.md, Comments): one line each, or counts by folder.

    python3 ci/openings.py              counts
    python3 ci/openings.py PATH...      lines below these paths

`ci/tidy` refuses them. Plain comments are not counted, except blocks `/* ... */` of C, which document functions there.
"""

import os
import re
import subprocess
import sys
from collections import Counter

OPENING = re.compile(r"(What|Which|Whether|How|Why|Of|Those|Whose|That of|The one|The ones|The same|So many|As many)\b(?! it is\b)")
RUST = re.compile(r"^\s*//[/!] ?(.*)")
PYTHON = re.compile(r'^\s*(?:[rRuU]?)"""(.+)')
C = re.compile(r"^\s*(?:///|/\*\*?)(?!-) ?(.*)")


def tracked(root="."):
    names = subprocess.run(["git", "ls-files"], cwd=root, check=True, capture_output=True, text=True).stdout.split("\n")
    return [name for name in names if name.endswith((".rs", ".py", ".pyi", ".h", ".hpp", ".c", ".cc", ".cpp", ".js"))]


def comments(name, root="."):
    """Line number and first line of each doc comment of a file."""
    kind = RUST if name.endswith(".rs") else PYTHON if name.endswith((".py", ".pyi")) else C
    inside = False
    with open(os.path.join(root, name), encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            found = kind.match(line)
            if found and not inside and found[1].strip():
                yield number, found[1].strip()
            # A docstring is one line here; other blocks end with the first line that is none.
            inside = bool(found) and kind is not PYTHON and bool(found[1].strip())


def find(paths=(), root="."):
    """Number of doc comments below the paths (all if empty), and (file, line, text) of those with a wrong opening."""
    total, odd = 0, []
    for name in tracked(root):
        if paths and not name.startswith(tuple(paths)):
            continue
        for number, text in comments(name, root):
            total += 1
            if OPENING.match(text):
                odd.append((name, number, text))
    return total, odd


def check(root):
    """A line for each doc comment with a wrong opening."""
    for name, number, text in find(root=root)[1]:
        yield f"{name}:{number}: begin with a noun phrase or a verb in the third person, not `{OPENING.match(text)[1]}`: {text}"


def main():
    paths = sys.argv[1:]
    total, odd = find(paths)
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

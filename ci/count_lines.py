"""Lines of product code in Rust, by crate: every `src` folder under crates/ and hosts/, without tests, comments and
blank lines.

    python3 ci/count_lines.py               of the working tree
    python3 ci/count_lines.py REVISION      of a commit

Tests are what stands behind `#[cfg(test)]`, and the files that such a line names (`mod tests;`). A line within a string counts.
"""

import collections
import io
import pathlib
import re
import subprocess
import sys
import tarfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
SOURCE = re.compile(r"((?:crates|hosts)/[^/]+)/(?:.*/)?src/.*\.rs$")
# Tokens that may contain something like a comment or a brace, and comments themselves.
TOKEN = re.compile(
    r"""(?P<comment>//[^\n]*|/\*.*?\*/)
    |b?r(?P<hashes>\#*)".*?"(?P=hashes)
    |b?"(?:\\.|[^"\\])*"
    |b?'(?:\\[^u]|\\u\{[^}]*\}|[^'\\\n])'""",
    re.DOTALL | re.VERBOSE,
)
TEST = re.compile(r"#\[cfg\((?:all\()?(?:\w+, )*test(?:, \w+)*\)?\)\]\s*(?:#\[[^\]]*\]\s*)*")
TEST_FILE = re.compile(r"(?:pub(?:\([a-z]+\))?\s+)?mod\s+(\w+)\s*;")


def files(revision):
    """Path and text of every file."""
    if revision is None:
        listing = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=ROOT, check=True, capture_output=True, text=True)
        paths = [path for path in listing.stdout.splitlines() if SOURCE.match(path) and (ROOT / path).exists()]
        return {path: (ROOT / path).read_text() for path in paths}
    packed = subprocess.run(["git", "archive", revision, "crates", "hosts"], cwd=ROOT, check=True, capture_output=True).stdout
    with tarfile.open(fileobj=io.BytesIO(packed)) as tree:
        return {file.name: tree.extractfile(file).read().decode() for file in tree if file.isfile() and SOURCE.match(file.name)}


def without_comments(text):
    return TOKEN.sub(lambda token: "" if token["comment"] else token[0], text)


def end_of_item(text, begin):
    """End of the item that begins at `begin`: its `;`, or its closing brace."""
    depth, at = 0, begin
    while at < len(text):
        token = TOKEN.match(text, at)
        if token:
            at = token.end()
            continue
        depth += {"{": 1, "(": 1, "[": 1, "}": -1, ")": -1, "]": -1}.get(text[at], 0)
        at += 1
        if depth == 0 and text[at - 1] in ";}":
            break
    return at


def without_tests(text):
    """The text without test-only items, and the names of test files."""
    names, at = set(), 0
    while found := TEST.search(text, at):
        named = TEST_FILE.match(text, found.end())
        names |= {named[1]} if named else set()
        text = text[: found.start()] + text[end_of_item(text, found.end()) :]
        at = found.start()
    return text, names


def folder_of_children(path):
    return path.parent if path.name in ("lib.rs", "main.rs", "mod.rs") else path.parent / path.stem


def count(tree):
    product, tests = {}, set()
    for path, text in tree.items():
        text, names = without_tests(without_comments(text))
        product[path] = sum(1 for line in text.splitlines() if line.strip())
        children = folder_of_children(pathlib.PurePosixPath(path))
        tests |= {str(children / name) for name in names}
    crates = collections.Counter()
    for path, lines in product.items():
        if not any(path == f"{test}.rs" or path.startswith(f"{test}/") for test in tests):
            crates[SOURCE.match(path)[1]] += lines
    return crates


def main():
    crates = count(files(sys.argv[1] if len(sys.argv) > 1 else None))
    for crate, lines in sorted(crates.items(), key=lambda row: -row[1]):
        print(f"{lines:7} {crate}")
    print(f"{sum(crates.values()):7} in all")


main()

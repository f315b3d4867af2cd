"""Circles of files: within a crate or a Python tree no file may use, by whatever detour, a file that uses it.

The nodes are the files of a crate, tests aside. The arrows are the paths that begin with `crate::`, `self::`, `super::` or the
name of a child module: from the file that names something to the file that defines it. A name that a module only passes on
(`pub use`) leads to the file that defines it, and passing it on is no arrow; nor is a line `mod name;`.
"""

import pathlib
import re

import python_circles

IDENTIFIER = r"[A-Za-z_][A-Za-z0-9_]*"
STRING = re.compile(r'"(?:\\.|[^"\\])*"', re.DOTALL)
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
TEST_FILE = re.compile(r"#\[cfg\(test\)\]\s*(?:#\[[^\]]*\]\s*)*(?:pub(?:\([a-z]+\))?\s+)?mod\s+(" + IDENTIFIER + r")\s*;")
TEST_ITEM = re.compile(r"#\[cfg\(test\)\]\s*(?:#\[[^\]]*\]\s*)*(?:pub(?:\([a-z]+\))?\s+)?(?:mod|fn|impl|use)\b[^;{]*")
CHILD = re.compile(r"\bmod\s+(" + IDENTIFIER + r")\s*;")
USE = re.compile(r"(\bpub(?:\([a-z]+\))?\s+)?\buse\s+([^;]+);", re.DOTALL)
ITEM = re.compile(r"\b(?:fn|struct|enum|union|trait|type|const|static|macro_rules!)\s+(" + IDENTIFIER + ")")
PATH = re.compile(r"(?<![A-Za-z0-9_:$])(" + IDENTIFIER + r"(?:\s*::\s*" + IDENTIFIER + r")+)")


def without_tests(text):
    """Product code alone: no comments, no strings, no test-only items; and the names of test files."""
    text = STRING.sub('""', COMMENT.sub("", text))
    test_files = set(TEST_FILE.findall(text))
    while found := TEST_ITEM.search(text):
        end = found.end()
        if text[end : end + 1] == "{":
            depth = 0
            while True:
                depth += {"{": 1, "}": -1}.get(text[end], 0)
                end += 1
                if depth == 0:
                    break
        else:
            end += 1
        text = text[: found.start()] + text[end:]
    return text, test_files


def use_tree(tree):
    """Names of a `use`, each with its path, with braces expanded."""
    tree = tree.strip()
    if "{" not in tree:
        path, _, alias = re.sub(r"\s+", " ", tree).partition(" as ")
        path = path.replace(" ", "")
        if path.endswith("::self"):
            path = path.removesuffix("::self")
        yield alias or path.split("::")[-1], path
        return
    head, body = tree.split("{", 1)
    body = body[: body.rindex("}")]
    depth, start = 0, 0
    for at, letter in enumerate(body + ","):
        depth += {"{": 1, "}": -1}.get(letter, 0)
        if letter == "," and depth == 0:
            if body[start:at].strip():
                for name, path in use_tree(body[start:at]):
                    path = re.sub(r"\s", "", head) + path
                    yield name, path.removesuffix("::self")
            start = at + 1


class Crate:
    """Modules of one crate: path of a module -> its file."""

    def __init__(self, source):
        self.files, self.texts, self.uses, self.items = {}, {}, {}, {}
        self.read((), source / "lib.rs" if (source / "lib.rs").exists() else source / "main.rs")

    def read(self, module, path):
        text, test_files = without_tests(path.read_text())
        self.files[module] = path
        self.uses[module] = [
            (bool(passes_on), name, used) for passes_on, tree in USE.findall(text) for name, used in use_tree(tree)
        ]
        self.texts[module] = USE.sub("", text)
        self.items[module] = set(ITEM.findall(text))
        folder = path.parent if path.name in ("lib.rs", "main.rs", "mod.rs") else path.parent / path.stem
        for child in CHILD.findall(text):
            if child in test_files:
                continue
            places = [folder / f"{child}.rs", folder / child / "mod.rs"]
            for place in filter(pathlib.Path.exists, places):
                self.read((*module, child), place)

    def names(self, module):
        """Imports and re-exports of a module: name -> path; and the paths of glob imports."""
        named, globs = {}, []
        for _, name, path in self.uses[module]:
            if name == "*":
                globs.append(path.removesuffix("::*"))
            else:
                named[name] = path
        return named, globs

    def owner(self, module, path, seen=()):
        """Module that defines the end of a path, or None outside of this crate."""
        if (module, path) in seen:
            return module
        parts = [part for part in path.split("::") if part and part != "*"]
        first = parts.pop(0)
        named, _ = self.names(module)
        if first == "crate":
            at = ()
        elif first == "self":
            at = module
        elif first == "super":
            at = module[:-1]
        elif (*module, first) in self.files:
            at = (*module, first)
        elif first in named and named[first] != path and parts:
            # A module imported as a whole.
            return self.owner(module, "::".join([named[first], *parts]), (*seen, (module, path)))
        else:
            return None
        while parts and parts[0] == "super":
            parts.pop(0)
            at = at[:-1]
        while parts and (*at, parts[0]) in self.files:
            at = (*at, parts.pop(0))
        if not parts:
            return at
        name = parts[0]
        if self.defines(at, name):
            return at
        named, globs = self.names(at)
        if name in named:
            return self.owner(at, named[name], (*seen, (module, path)))
        for glob in globs:
            owner = self.owner(at, f"{glob}::{name}", (*seen, (module, path)))
            if owner is not None and self.defines(owner, name):
                return owner
        return at

    def defines(self, module, name):
        """True if the module's own file defines an item of this name."""
        return name in self.items[module]

    def arrows(self):
        """Module -> modules that it uses."""
        arrows = {}
        for module, text in self.texts.items():
            words = set(re.findall(IDENTIFIER, text))
            # A re-export is an arrow if the module's own code uses it too.
            paths = {path for passes_on, name, path in self.uses[module] if not passes_on or name in words}
            paths |= {re.sub(r"\s", "", path) for path in PATH.findall(text)}
            owners = {self.owner(module, path) for path in paths}
            arrows[module] = owners - {None, module}
        return arrows


def circles(arrows):
    """Strongly connected sets of modules (Tarjan's algorithm)."""
    order, low, stack, found = {}, {}, [], []

    def visit(module):
        order[module] = low[module] = len(order)
        stack.append(module)
        for target in sorted(arrows[module]):
            if target not in order:
                visit(target)
                low[module] = min(low[module], low[target])
            elif target in stack:
                low[module] = min(low[module], order[target])
        if low[module] == order[module]:
            members = []
            while True:
                members.append(stack.pop())
                if members[-1] == module:
                    break
            if len(members) > 1:
                found.append(members)

    for module in sorted(arrows):
        if module not in order:
            visit(module)
    return found


def shortest_circle(arrows, members):
    """Shortest cycle through a set of modules."""
    best = None
    for start in sorted(members):
        ways = [[start]]
        seen = set()
        while ways:
            way = ways.pop(0)
            if best and len(way) >= len(best):
                break
            for target in sorted(arrows[way[-1]] & set(members)):
                if target == start:
                    best = [*way, start]
                    ways = []
                    break
                if target not in seen:
                    seen.add(target)
                    ways.append([*way, target])
    return best


# Programs in Rust outside of the crates.
PROGRAMS = ("bench/src", "fuzz/src", "hosts/python/src")


def check(root):
    """A line for each circle of files, in Rust and in Python."""
    graphs = []
    for source in [*sorted((root / "crates").glob("*/src")), *(root / program for program in PROGRAMS)]:
        crate = Crate(source)
        graphs.append({crate.files[module]: {crate.files[to] for to in used} for module, used in crate.arrows().items()})
    graphs.append(python_circles.Tree(root).arrows())
    for arrows in graphs:
        for members in circles(arrows):
            name = lambda file: str(file.relative_to(root))
            way = " -> ".join(name(file) for file in shortest_circle(arrows, members))
            yield f"{name(sorted(members)[0])}: in a circle of {len(members)} files, e.g. {way}"

"""Circles of files in the Python trees: as ci/circles.py, the arrows are imports, those in functions too.

A name that an `__init__.py` only passes on leads to the file that defines it, and passing it on is no arrow; nor is an import
below `if TYPE_CHECKING`. An absolute import is looked up beside the file, and in every folder above it up to the root.
"""

import ast
import subprocess

TREES = ("blender", "bench", "ci", "fuzz", "hosts", "mechanisms", "models", "packaging", "validation")


class Tree:
    """Python files of the repository and their imports."""

    def __init__(self, root):
        listed = subprocess.run(["git", "ls-files", *(f"{tree}/*.py" for tree in TREES)], cwd=root, check=True, capture_output=True, text=True)
        self.root = root
        self.files = {root / name for name in listed.stdout.splitlines() if (root / name).is_file()}
        self.imports = {path: list(self.of_file(path)) for path in self.files}

    def of_file(self, path):
        """Name, module and level of each import: `from .a import b as c` gives (c, a, b, 1)."""
        tree = ast.parse(path.read_text(encoding="utf-8"))
        checked = {id(inner) for node in ast.walk(tree) if is_type_checking(node) for inner in ast.walk(node)}
        used = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
        for node in ast.walk(tree):
            if id(node) in checked:
                continue
            if isinstance(node, ast.ImportFrom):
                for alias in node.names:
                    name = alias.asname or alias.name
                    yield name, node.module or "", alias.name, node.level, name in used
            elif isinstance(node, ast.Import):
                for alias in node.names:
                    yield alias.asname or alias.name.split(".")[0], alias.name, None, 0, True

    def module(self, folder, dotted):
        """File of a module below a folder, or None."""
        place = folder.joinpath(*dotted.split(".")) if dotted else folder
        for path in (place.with_suffix(".py"), place / "__init__.py"):
            if path in self.files:
                return path
        return None

    def target(self, path, module, name, level, seen=()):
        """File that an import leads to, or None outside of the tree."""
        if level:
            folders = [path.parents[level - 1]]
        else:
            folders = [folder for folder in path.parents if folder == self.root or self.root in folder.parents]
        for folder in folders:
            found = self.module(folder, f"{module}.{name}" if module and name else module or name or "")
            if name and found is None:
                found = self.module(folder, module)
                if found is not None and found.name == "__init__.py" and found not in seen:
                    for given, *passed_on in self.imports[found]:
                        if given == name:
                            return self.target(found, *passed_on[:3], (*seen, found)) or found
            if found is not None:
                return found
        return None

    def arrows(self):
        """File -> files that it imports."""
        arrows = {}
        for path in self.files:
            own = [entry for entry in self.imports[path] if entry[4] or path.name != "__init__.py"]
            targets = {self.target(path, module, name, level) for _, module, name, level, _ in own}
            arrows[path] = targets - {None, path}
        return arrows


def is_type_checking(node):
    return isinstance(node, ast.If) and "TYPE_CHECKING" in ast.dump(node.test)

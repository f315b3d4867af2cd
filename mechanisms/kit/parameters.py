"""Numbers of a mechanism changed in one place: a loads-case file or the command line replaces constants of dimensions.py.

    [parameters]                          # constants of dimensions.py, SI units
    CHASER_MASS = 13e3
    "CAPTURING.stiffness" = 500.0         # a field of a constant

    [cases.fast]                          # fields of the mechanism's Case, for loads (kit/loads.py)
    speed = 0.12

A constant is replaced where dimensions.py sets it, so that all that follows from it follows: models, controllers,
predictions and checks import the same module. What only a model file holds is refused, unless `ON_SURFACES` of
dimensions.py says which value of which surface it is; such a file is written anew for the run.
"""

import ast
import atexit
import dataclasses
import os
import pathlib
import re
import shutil
import sys
import tempfile
import tomllib
import types

_changed = {}  # constants of dimensions.py that were replaced: name → value
_installed = [None, {}]  # folder of the mechanism, and parameters as given


def fail(cause, cure):
    sys.exit(f"{cause}; {cure}")


def read(path):
    """(parameters, cases) of a loads-case file."""
    if path is None:
        return {}, {}
    try:
        with open(path, "rb") as file:
            tables = tomllib.load(file)
    except (OSError, tomllib.TOMLDecodeError) as reason:
        fail(f"loads case {path}: {reason}", "give a TOML file with [parameters] and [cases.NAME]")
    unknown = sorted(tables.keys() - {"parameters", "cases"})
    if unknown:
        fail(f"loads case {path}: there is no table `{unknown[0]}`", "it has [parameters] and [cases.NAME]")
    return tables.get("parameters", {}), tables.get("cases", {})


def settings(texts):
    """Parameters of the command line: NAME=VALUE, a value as in the file."""
    found = {}
    for text in texts:
        name, equal, value = text.partition("=")
        try:
            found[name.strip()] = tomllib.loads(f"value = {value}")["value"]
        except tomllib.TOMLDecodeError:
            fail(f"--set {text}: it is no NAME=VALUE", "write --set CHASER_MASS=13e3")
        if not equal:
            fail(f"--set {text}: it has no value", "write --set CHASER_MASS=13e3")
    return found


def install(home, parameters):
    """Makes the module `dimensions` of a mechanism, with these constants replaced, before anything imports it."""
    _installed[:] = [str(home), dict(parameters)]
    path = pathlib.Path(home) / "dimensions.py"
    tree = ast.parse(path.read_text(encoding="utf-8"))
    by_constant = {}
    for name, value in parameters.items():
        constant, _, field = name.partition(".")
        by_constant.setdefault(constant, []).append((name, field, value))
    there = {name for node in tree.body for name in constants(node)}
    for constant, given in by_constant.items():
        if constant not in there:
            fail(f"parameter `{given[0][0]}`: {path} has no such constant", f"give one of {', '.join(sorted(there))}")
    body = []
    for node in tree.body:
        body.append(node)
        for name in constants(node):
            if name in by_constant:
                body += ast.parse(f"{name} = _given({name!r}, {name})").body
    tree.body = body

    def given(constant, value):
        for name, field, wanted in by_constant[constant]:
            value = replaced(name, value, field, wanted)
        _changed[constant] = value
        return value

    module = types.ModuleType("dimensions")
    module.__file__, module._given = str(path), given
    sys.modules["dimensions"] = module
    exec(compile(ast.fix_missing_locations(tree), str(path), "exec"), module.__dict__)
    refuse_what_models_hold(home, module)


def installed():
    """(folder of the mechanism, parameters) of this process, for `again` in its workers."""
    return tuple(_installed)


def again(home, parameters):
    """Replaces the same constants in a worker, which is a new process."""
    if parameters:
        install(home, parameters)


def constants(node):
    """Names of the constants that a statement sets."""
    if not isinstance(node, ast.Assign):
        return []
    targets = [one for target in node.targets for one in (target.elts if isinstance(target, ast.Tuple) else [target])]
    return [one.id for one in targets if isinstance(one, ast.Name) and one.id.isupper()]


def replaced(name, value, field, wanted):
    """A constant with a new value, of the same kind."""
    if field:
        fields = {one.name for one in dataclasses.fields(value)} if dataclasses.is_dataclass(value) else set()
        if field not in fields:
            fail(f"parameter `{name}`: there is no such field", f"give one of {', '.join(sorted(fields)) or 'none'}")
        return dataclasses.replace(value, **{field: replaced(name, getattr(value, field), "", wanted)})
    if isinstance(value, tuple) and isinstance(wanted, list) and len(wanted) == len(value):
        return tuple(replaced(name, one, "", other) for one, other in zip(value, wanted))
    number = isinstance(wanted, int | float) and not isinstance(wanted, bool)
    if number and isinstance(value, float):
        return float(wanted)
    if type(wanted) is type(value) and isinstance(value, int | str):
        return wanted
    fail(f"parameter `{name}`: {wanted!r} cannot replace {value!r}", "give a value of the same kind")


def refuse_what_models_hold(home, module):
    """Refuses constants that build.py writes into model files, unless they are values of surfaces."""
    build = pathlib.Path(home) / "build.py"
    text = build.read_text(encoding="utf-8") if build.exists() else ""
    imported = re.findall(r"^from dimensions import (\([^)]*\)|[^(#\n]*)", text, re.MULTILINE)
    used = set(re.findall(r"\bd\.([A-Z_]+)\b", text)) | set(re.findall(r"\b[A-Z_]+\b", " ".join(imported)))
    for name in sorted(used & _changed.keys() - getattr(module, "ON_SURFACES", {}).keys()):
        cure = "change it in dimensions.py and run build.py with Blender"
        fail(f"parameter `{name}`: it is a shape in the model files of {pathlib.Path(home).name}", cure)


_folder = []


def with_surfaces(objects, folder):
    """Objects of the plugin (name → model file in a folder), with files written anew where a surface was changed."""
    places = getattr(sys.modules["dimensions"], "ON_SURFACES", {})
    changes = {}
    for constant in _changed.keys() & places.keys():
        for file, surface, *path in places[constant]:
            changes.setdefault(file, []).append((surface, path, _changed[constant]))
    return {name: _written(file, changes[file], folder) if file in changes else file for name, file in objects.items()}


def _written(file, changes, folder):
    from pong import model as models

    if not _folder:
        _folder.append(tempfile.mkdtemp())
        atexit.register(shutil.rmtree, _folder[0], True)
    data = models.read(pathlib.Path(folder) / file)
    for surface, path, value in changes:
        place = data["surfaces"][surface]
        for key in path[:-1]:
            place = place[key]
        place[path[-1]] = value
    changed = pathlib.Path(_folder[0]) / pathlib.Path(file).name
    changed.write_text(models.write(data), encoding="utf-8")
    return os.path.relpath(changed, folder)

"""Type stubs of `pong._pong`, from the text signatures and NumPy-style docstrings of the built module.

    python hosts/python/stubs.py > hosts/python/python/pong/_pong.pyi

`ci/python` compares its output with the file in the tree. A parameter that its docstring leaves out, or gives
without a type, is an error. Types of the docstrings are those of Python, and the words of `WORDS`.
"""

import inspect
import re
import sys
import types

import pong._pong as module

HEAD = """\
# Written by hosts/python/stubs.py from the docstrings of the module.
import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, final

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = [
{names}
]

__version__: str
CONTACT_DTYPE: np.dtype[np.void]

_Path = str | os.PathLike[str]
_Array = NDArray[np.float64]

"""
WORDS = {
    "array_like": "ArrayLike",
    "structured ndarray": "NDArray[np.void]",
    "ndarray": "_Array",
    "path_like": "_Path",
}
WIDTH = 120
COMPARISONS = {
    "__eq__": "def __eq__(self, other: object, /) -> bool: ...",
    "__hash__": "def __hash__(self) -> int: ...",
    "__ne__": "def __ne__(self, other: object, /) -> bool: ...",
}


def of_python(text):
    """Type of Python for one of a docstring: `sequence of str or None, shape (n,), default x` without its remarks."""
    depth = 0
    for place, letter in enumerate(text):
        depth += (letter in "[{(") - (letter in ")}]")
        if letter == "," and depth == 0:
            text = text[:place]
            break
    return " | ".join(map(of_one, text.strip().split(" or ")))


def of_one(text):
    if text.startswith("{"):
        return "str"
    for word, kind in (("sequence of ", "Sequence"), ("list of ", "list")):
        if text.startswith(word):
            return f"{kind}[{of_one(text.removeprefix(word))}]"
    if text == "dict":
        return "dict[str, Any]"
    for word, kind in WORDS.items():
        text = re.sub(rf"\b{word}\b", kind, text)
    return text


def section(thing, name):
    """Unindented lines of a section of a docstring."""
    found = re.search(rf"^{name}\n-+\n(.*?)(?=^\w[^\n]*\n---|\Z)", thing.__doc__ or "", re.M | re.S)
    return [line for line in found[1].splitlines() if line[:1].strip()] if found else []


def parameters(thing):
    """Types of the parameters by name."""
    types_of = {}
    for line in section(thing, "Parameters"):
        names, _, kind = line.partition(" : ")
        types_of |= dict.fromkeys(names.split(", "), of_python(kind))
    return types_of


def function(name, thing, first=(), result=None, documented=None):
    """Lines of a function, method or constructor."""
    kinds, arguments, named = parameters(documented or thing), list(first), False
    for argument in inspect.signature(thing).parameters.values():
        if argument.name in ("self", "$self"):
            continue
        if argument.name not in kinds or not kinds[argument.name]:
            sys.exit(f"{name}: the docstring gives no type of `{argument.name}`; add it to Parameters")
        kind = kinds.pop(argument.name)
        if argument.kind is argument.KEYWORD_ONLY and not named:
            arguments.append("*")
            named = True
        if argument.default is argument.empty:
            arguments.append(f"{argument.name}: {kind}")
            continue
        kind += " | None" if argument.default is None and "None" not in kind else ""
        default = "..." if argument.default is ... else repr(argument.default).replace("'", '"')
        arguments.append(f"{argument.name}: {kind} = {default}")
    if kinds:
        sys.exit(f"{name}: the docstring has `{', '.join(kinds)}`, the signature has not; take it out of Parameters")
    returned = section(thing, "Returns")
    result = result or (of_python(returned[0]) if returned else "None")
    line = f"def {name}({', '.join(arguments)}) -> {result}: ..."
    if len(line) <= WIDTH - 4:
        return [line]
    return [f"def {name}(", *(f"    {argument}," for argument in arguments), f") -> {result}: ..."]


def members(kind):
    """Lines of the body of a class."""
    for line in section(kind, "Attributes"):
        name, _, of = line.partition(" : ")
        yield f"{name}: {of_python(of)}"
    if "__new__" in vars(kind) and not issubclass(kind, Exception):
        yield from function("__new__", kind, ["cls"], kind.__name__)
    descriptors = (types.GetSetDescriptorType, types.MemberDescriptorType)
    # Properties first, by name: their order in the module differs from build to build.
    in_order = sorted(vars(kind).items(), key=lambda entry: (not isinstance(entry[1], descriptors), entry[0]))
    for name, member in in_order:
        if name in COMPARISONS:
            yield COMPARISONS[name] if member is not None else f"{name} = None  # type: ignore[assignment]"
        elif name.startswith("_"):
            continue
        elif isinstance(member, descriptors):
            yield from ("@property", f"def {name}(self) -> {of_python(member.__doc__.split(' : ')[0])}: ...")
        elif isinstance(member, staticmethod):
            yield from ("@staticmethod", *function(name, member.__func__))
        else:
            yield from function(name, member, ["self"])


def main():
    public = {name: thing for name, thing in vars(module).items() if name == "__version__" or not name.startswith("_")}
    print(HEAD.format(names="\n".join(f'    "{name}",' for name in sorted(public))), end="")
    for name, thing in public.items():
        if isinstance(thing, type):
            body = [f"    {line}" for line in members(thing)]
            if issubclass(thing, Exception):
                print(f"class {name}({thing.__base__.__name__}):{'' if body else ' ...'}", *body, sep="\n")
            else:
                print(f"\n@final\nclass {name}:", *body, sep="\n")
        elif callable(thing):
            print("", *function(name, thing), sep="\n")


main()

"""The reason why the library of the package cannot be loaded: it is for another platform, or for a newer Python."""

import pathlib
import sys
import sysconfig


def another_platform(fault: ImportError) -> str:
    """A sentence for an `ImportError` of `pong._pong`: what is there, what this Python is, the cause and the cure."""
    folder = pathlib.Path(__file__).parent
    there = ", ".join(sorted(file.name for file in folder.glob("_pong.*") if file.suffix != ".pyi")) or "no library"
    python = f"{sys.implementation.name} {sys.version_info[0]}.{sys.version_info[1]} on {sysconfig.get_platform()}"
    return (
        f"pong cannot be imported: {folder} has {there}, which {python} does not load ({fault}); remove it and install the wheel for "
        f"this platform and CPython 3.10 or newer: python -m pip install --force-reinstall PATH-OF-THE-WHEEL"
    )

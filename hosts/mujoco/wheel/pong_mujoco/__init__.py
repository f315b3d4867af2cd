"""Loads the engine plugin `pong.contact` into MuJoCo: `import pong_mujoco` is all, before a model that uses it is compiled.

The layout of MuJoCo's structures changes with each version, so there is one binary for each; what is installed here says
`versions()`.
"""

import ctypes
import pathlib
import sys
import sysconfig

import mujoco

_BINARIES = pathlib.Path(__file__).parent / "binaries"
_NAMES = {"win32": ("pong_contact.dll", "pong.dll"), "darwin": ("libpong_contact.dylib", "libpong.dylib")}
_PLUGIN, _LIBPONG = _NAMES.get(sys.platform, ("libpong_contact.so", "libpong.so.1"))


def versions():
    """Versions of MuJoCo for which this package has a plugin."""
    return sorted(folder.name for folder in _BINARIES.iterdir())


def plugin_path():
    """Path of the plugin for the imported MuJoCo, for `mj_loadPluginLibrary` in another program."""
    path = _BINARIES / mujoco.__version__ / _PLUGIN
    if not path.parent.is_dir():
        raise ImportError(
            f"pong_mujoco has no plugin for MuJoCo {mujoco.__version__}, only for {', '.join(versions())}: install that version of "
            f"mujoco, or build the plugin for yours (docs/mujoco.md)"
        )
    # Libpong first: Windows does not look for it beside the plugin, and MuJoCo does not say why a library is not loaded.
    try:
        ctypes.CDLL(str(path.with_name(_LIBPONG)))
    except OSError as fault:
        there = ", ".join(sorted(file.name for file in path.parent.iterdir()))
        raise ImportError(
            f"pong_mujoco was installed for another platform than {sysconfig.get_platform()}: it has {there} ({fault}); install its "
            f"wheel for this platform, or build the plugin (docs/mujoco.md)"
        ) from None
    return str(path)


mujoco.mj_loadPluginLibrary(plugin_path())

"""Loads the engine plugin `pong.contact` into MuJoCo: `import pong_mujoco` is all, before a model that uses it is compiled.

The layout of MuJoCo's structures changes with each version, so there is one binary for each; what is installed here says
`versions()`.
"""

import pathlib

import mujoco

_BINARIES = pathlib.Path(__file__).parent / "binaries"


def versions():
    """Versions of MuJoCo for which this package has a plugin."""
    return sorted(folder.name for folder in _BINARIES.iterdir())


def plugin_path():
    """Path of the plugin for the imported MuJoCo, for `mj_loadPluginLibrary` in another program."""
    path = _BINARIES / mujoco.__version__ / "libpong_contact.so"
    if not path.is_file():
        raise ImportError(
            f"pong_mujoco has no plugin for MuJoCo {mujoco.__version__}, only for {', '.join(versions())}: install that version of "
            f"mujoco, or build the plugin for yours (docs/mujoco.md)"
        )
    return str(path)


mujoco.mj_loadPluginLibrary(plugin_path())

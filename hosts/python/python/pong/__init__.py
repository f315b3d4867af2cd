"""Contact dynamics: states in, wrenches out.

    builder = pong.WorldBuilder()
    builder.create_object(builder.add_model(pong.load_model("ball.ron")), "ball")
    builder.create_object(builder.add_model(pong.load_model("ground.ron")), "ground")
    builder.pair("ball", "ground")
    world = builder.seal()
    world.set_states(states)            # an array: a row of 13 numbers for each Interface
    world.step()
    wrenches = world.wrenches()         # an array: a row of 6 numbers for each Interface

docs/python.md tells the rest; `pong.campaign` runs a scene thousands of times (docs/campaigns.md).
"""

import os
import warnings
from collections.abc import Sequence
from enum import IntFlag
from importlib import import_module
from typing import TYPE_CHECKING, Any

# The library, before the modules that use it: where it is for another platform, Python's own words do not say so.
try:
    import_module("._pong", __name__)
except ImportError as _fault:
    from ._platform import another_platform

    raise ImportError(another_platform(_fault)) from None

from . import model, types
from ._fit import fit, inertia_from_momentum, plot_fit
from ._log import Log
from ._pong import (
    CONTACT_DTYPE,
    BadValueError,
    Batch,
    ContactStateError,
    DuplicateError,
    EngineError,
    LogError,
    Model,
    ModelError,
    NotFiniteError,
    NotFoundError,
    PhaseError,
    PongError,
    ResourceError,
    RunError,
    Scene,
    SceneError,
    SealError,
    Simulation,
    SlowHost,
    StateError,
    StudyError,
    World,
    WorldBuilder,
    __version__,
    advise_contact,
    replay,
    trade,
    tune,
    verify,
)

__all__ = [
    "CONTACT_DTYPE",
    "BadValueError",
    "Batch",
    "ContactStateError",
    "DuplicateError",
    "EngineError",
    "Log",
    "LogError",
    "Model",
    "ModelError",
    "NotFiniteError",
    "NotFoundError",
    "PhaseError",
    "PongError",
    "ResourceError",
    "RunError",
    "Scene",
    "SceneError",
    "SealError",
    "Simulation",
    "SlowHost",
    "StateError",
    "Status",
    "StudyError",
    "World",
    "WorldBuilder",
    "__version__",
    "advise_contact",
    "fit",
    "inertia_from_momentum",
    "load_model",
    "model",
    "plot_fit",
    "replay",
    "trade",
    "tune",
    "types",
    "verify",
]


class Status(IntFlag):
    """Incomplete or missed parts of a frame: `Status(report.status)`."""

    CONTACT_LIMIT = 1
    LOAD_SHARING_LIMIT = 2
    TUNNELLED = 4
    DEEP_IN_MESH = 8


def load_model(path: str | os.PathLike[str], *, allow_files_below: Sequence[str | os.PathLike[str]] = ()) -> Model:
    """Reads a model file: `Model.load`.

    Parameters
    ----------
    path : path_like
        Model file. Meshes are searched beside it.
    allow_files_below : sequence of path_like, optional
        Further folders from which the model may read meshes.

    Returns
    -------
    Model

    Raises
    ------
    ModelError
        The file is at fault: `errors` lists every fault, with line, column, cause and cure.

    Examples
    --------
    >>> pong.load_model("ball.ron").groups
    ['ball']
    """
    return Model.load(path, allow_files_below=list(allow_files_below))


if not TYPE_CHECKING:

    def __getattr__(name: str) -> Any:
        """Finds names that were here until 0.1 and are in `pong.types` now."""
        if name in types.__all__:
            warnings.warn(f"pong.{name} is pong.types.{name} now", DeprecationWarning, stacklevel=2)
            return getattr(types, name)
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")

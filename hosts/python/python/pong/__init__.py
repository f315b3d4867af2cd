"""Contact dynamics: states in, wrenches out.

    builder = pong.WorldBuilder()
    builder.create_object(builder.add_model("ball.ron"), "ball")
    builder.create_object(builder.add_model("ground.ron"), "ground")
    builder.pair("ball", "ground")
    world = builder.seal()
    world.set_states(states)            # an array: a row of 13 numbers for each Interface
    world.step()
    wrenches = world.wrenches()         # an array: a row of 6 numbers for each Interface

docs/python.md tells the rest; `pong.campaign` runs a scene thousands of times (docs/campaigns.md).
"""

from enum import IntFlag

from . import model
from ._log import Log
from ._pong import (
    CONTACT_DTYPE,
    AddedModel,
    BadValueError,
    Case,
    ContactChange,
    ContactStateError,
    Distance,
    DuplicateError,
    EngineError,
    FrameReport,
    Interface,
    Level,
    LogError,
    Model,
    ModelError,
    NotFiniteError,
    NotFoundError,
    Object,
    Pair,
    PairPeaks,
    PhaseError,
    PongError,
    Replay,
    ResourceError,
    Row,
    Run,
    RunError,
    Scene,
    SceneError,
    SealError,
    Simulation,
    StateError,
    StudyError,
    Trade,
    Tuned,
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
    "AddedModel",
    "BadValueError",
    "Case",
    "ContactChange",
    "ContactStateError",
    "Distance",
    "DuplicateError",
    "EngineError",
    "FrameReport",
    "Interface",
    "Level",
    "Log",
    "LogError",
    "Model",
    "ModelError",
    "NotFiniteError",
    "NotFoundError",
    "Object",
    "Pair",
    "PairPeaks",
    "PhaseError",
    "PongError",
    "Replay",
    "ResourceError",
    "Row",
    "Run",
    "RunError",
    "Scene",
    "SceneError",
    "SealError",
    "Simulation",
    "StateError",
    "Status",
    "StudyError",
    "Trade",
    "Tuned",
    "World",
    "WorldBuilder",
    "__version__",
    "advise_contact",
    "model",
    "replay",
    "trade",
    "tune",
    "verify",
]


class Status(IntFlag):
    """Incomplete or missed parts of a frame: `Status(report.status)`."""

    CONTACT_LIMIT = 1
    LOAD_SHARING_LIMIT = 2
    TUNNELLED = 4

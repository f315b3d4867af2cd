"""Types of what calls return, for annotations and `isinstance`. No program makes them itself.

| type | returned by |
|---|---|
| `AddedModel`, `Object`, `Pair`, `Interface` | `WorldBuilder`, `World`: what was set up, and its number |
| `FrameReport`, `ContactChange`, `PairPeaks`, `Distance` | `World`: frames |
| `Run` | `Simulation.run` |
| `Replay`, `Trade` with `Level`, `Tuned` | `replay`, `trade`, `tune` |
| `Case` with `Row` | `verify` |
"""

from ._pong import (
    AddedModel,
    Case,
    ContactChange,
    Distance,
    FrameReport,
    Interface,
    Level,
    Object,
    Pair,
    PairPeaks,
    Replay,
    Row,
    Run,
    Trade,
    Tuned,
)

__all__ = [
    "AddedModel",
    "Case",
    "ContactChange",
    "Distance",
    "FrameReport",
    "Interface",
    "Level",
    "Object",
    "Pair",
    "PairPeaks",
    "Replay",
    "Row",
    "Run",
    "Trade",
    "Tuned",
]

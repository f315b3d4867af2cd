"""Types of what calls return, for annotations and `isinstance`. No program makes them itself.

| type | returned by |
|---|---|
| `AddedModel`, `Object`, `Pair`, `Interface` | `WorldBuilder`, `World`: what was set up, and its number |
| `FrameReport`, `ContactChange`, `PairPeaks`, `Distance`, `Tangent`, `Potential`, `SurfaceSlope` | `World`: frames |
| `SlowReport` | `SlowHost`: frames |
| `Run` | `Simulation.run` |
| `Replay`, `Trade` with `Level`, `Tuned` | `replay`, `trade`, `tune` |
| `BatchRuns` | `Batch.run` |
| `Fit` with `FitParameter` | `fit` |
| `MomentumInertia` | `inertia_from_momentum` |
| `Case` with `Row` | `verify` |
"""

from ._pong import (
    AddedModel,
    BatchRuns,
    Case,
    ContactChange,
    Distance,
    Fit,
    FitParameter,
    FrameReport,
    Interface,
    Level,
    MomentumInertia,
    Object,
    Pair,
    PairPeaks,
    Potential,
    Replay,
    Row,
    Run,
    SlowReport,
    SurfaceSlope,
    Tangent,
    Trade,
    Tuned,
)

__all__ = [
    "AddedModel",
    "BatchRuns",
    "Case",
    "ContactChange",
    "Distance",
    "Fit",
    "FitParameter",
    "FrameReport",
    "Interface",
    "Level",
    "MomentumInertia",
    "Object",
    "Pair",
    "PairPeaks",
    "Potential",
    "Replay",
    "Row",
    "Run",
    "SlowReport",
    "SurfaceSlope",
    "Tangent",
    "Trade",
    "Tuned",
]

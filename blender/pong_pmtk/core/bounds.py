# SPDX-License-Identifier: GPL-3.0-or-later
"""Bounding volumes of groups, as the engine has fitted them, for overlays."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np


@dataclass
class Volume:
    """A volume in the frame of its movable group. A Sphere's `half` is its radius thrice."""

    kind: str
    center: np.ndarray = field(default_factory=lambda: np.zeros(3))
    half: np.ndarray = field(default_factory=lambda: np.zeros(3))
    axes: np.ndarray = field(default_factory=lambda: np.eye(3))  # columns


def volumes(loaded) -> dict[str, Volume]:
    """By path of each group: its volume, of a model as the engine has it (`Built.loaded`); those without end are left out."""
    found = loaded.bounds() if loaded is not None else []
    return {
        bound["path"]: Volume(bound["kind"], bound["center"], bound["half"], bound["axes"])
        for bound in found
        if "half" in bound
    }

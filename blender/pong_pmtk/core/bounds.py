# SPDX-License-Identifier: GPL-3.0-or-later
"""Bounding volumes of groups as fitted by the engine, for overlays."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np


@dataclass
class Volume:
    """A volume in the frame of its movable group. A Sphere's `half` is three times its radius."""

    kind: str
    center: np.ndarray = field(default_factory=lambda: np.zeros(3))
    half: np.ndarray = field(default_factory=lambda: np.zeros(3))
    axes: np.ndarray = field(default_factory=lambda: np.eye(3))  # columns


def volumes(loaded) -> dict[str, Volume]:
    """Volume of each group, by path, in a loaded model (`Built.loaded`); unbounded ones are left out."""
    found = loaded.bounds() if loaded is not None else []
    return {
        bound["path"]: Volume(bound["kind"], bound["center"], bound["half"], bound["axes"])
        for bound in found
        if "half" in bound
    }

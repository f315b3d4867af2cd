# SPDX-License-Identifier: GPL-3.0-or-later
"""The engine's own rules, from the wheel `pong` included in the extensions (docs/python.md).

What a model file, a polyhedron and the triangles of a body must be is judged there and nowhere here: what passes loads.
"""

from __future__ import annotations

import numpy as np

PLANE_TOLERANCE = 1e-6  # of the size: how flat the engine's polyhedra are; for what is only proposed or warned of


class WheelMissing(ImportError):
    """The Python package `pong` is missing; the message gives the cure."""


CURE = "install the extension from its zip, which brings it along, or `pip install` the wheel into this Python (blender/README.md)"


def wheel():
    """The package `pong`. Raises `WheelMissing`."""
    try:
        import pong.model
    except ImportError as reason:
        cause = f"it cannot be imported ({reason}), and the rules of models come from it"
        raise WheelMissing(f"the Python package `pong`: {cause}; {CURE}") from None
    return pong


def is_there() -> bool:
    try:
        wheel()
    except WheelMissing:
        return False
    return True


def polyhedron_faults(vertices: np.ndarray, faces, inactive=()) -> list[dict]:
    """Faults of a polyhedron: `rule`, `cause`, `cure`, `face`, `places`, `off`. Raises `WheelMissing`."""
    return wheel().model.check_polyhedron(vertices, faces, inactive)

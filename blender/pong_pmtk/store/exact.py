# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers in full precision, stored as float64 ID properties beside those that Blender rounds to single.

Those of an object are on the object, those of vertices on the mesh, so objects that share a mesh share them. Whether
they still count is the core's to judge (core/exact.py).
"""

import numpy as np

KEY = "pong_exact"


def write(obj, exact):
    """Stores `exact` (name -> array) with an object."""
    own = {name: _flat(values) for name, values in exact.items() if name != "vertices"}
    if own:
        obj[KEY] = own
    if "vertices" in exact and obj.data is not None:
        obj.data[KEY] = _flat(exact["vertices"])


def _flat(values):
    """Value for an ID property; single numbers stay numbers."""
    return np.ascontiguousarray(values, float).ravel() if np.ndim(values) else float(values)


def read(obj):
    """Stored exact numbers of an object; `vertices` as (n, 3), the rest flat."""
    exact = {}
    if KEY in obj:
        exact = {name: _array(values) for name, values in obj[KEY].items()}
    if obj.type == "MESH" and KEY in obj.data:
        exact["vertices"] = np.array(memoryview(obj.data[KEY])).reshape(-1, 3)
    return exact


def _array(values):
    return np.array(values) if isinstance(values, float) else np.array(memoryview(values))

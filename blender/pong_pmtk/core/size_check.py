# SPDX-License-Identifier: GPL-3.0-or-later
"""Size of a displayed sphere, ellipsoid, ray or round part, compared with its mark.

The mark's numbers count, the mesh (or the empty) only shows them. Blender's *Apply Scale* and Edit Mode change what is
shown and know nothing of marks, so the two can come apart.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .propose import CENTER_TOLERANCE, round_fit
from .round_shape import FIT_TOLERANCE, ONE_RADIUS, find, fit, off

if TYPE_CHECKING:
    from .shape import Shape

ROUND_DEPTH = 0.75  # as in propose.py, for coarse balls too: the middles of an icosahedron's faces lie at 0.79
# Relative tolerance. Single precision and the fit's own rounding are far below; smaller scalings are not noticed.
SIZE_TOLERANCE = 1e-5
AXIS_TOLERANCE = 1e-6  # of the cosine: a thousandth of a radian, as much as vertices may lie off


def check_size(shape: Shape, axes) -> None:
    """`axes`: size in the mark, in the object's own coordinates: three semi-axes, or the length of an empty's ray."""
    axes = np.asarray(axes, dtype=np.float64)
    if shape.mesh is not None:
        if len(shape.mesh.vertices):
            _check_mesh(shape, axes)
        return
    seen, largest = shape.place.thing.display_size, float(axes.max())
    if seen is None or abs(seen - largest) <= SIZE_TOLERANCE * largest:
        return
    name = {"Sphere": "radius", "Ray": "length"}.get(shape.kind, "largest semi-axis")
    cause = f"it is shown with a {name} of {_metres(shape, seen)}, its mark says {_metres(shape, largest)}"
    fix = {"Sphere": "fit-sphere", "Ray": "fit-length"}.get(shape.kind, "")
    cure = "what the mark says is exported; take over what is shown" if fix else "give it its semi-axes again"
    shape.warn("size-not-shown", cause, f"{cure} (Apply Scale changes only what is shown)", fix=fix)


def _check_mesh(shape: Shape, axes: np.ndarray) -> None:
    vertices, starts = np.asarray(shape.mesh.vertices, dtype=np.float64), np.asarray(shape.mesh.face_starts)
    # Every face has a corner at this point (shape.ready).
    sums = np.add.reduceat(vertices[shape.mesh.loops], starts[:-1]) if len(starts) > 1 else np.zeros((0, 3))
    fitted = round_fit(vertices, sums / np.diff(starts)[:, None], ROUND_DEPTH)
    if fitted is None:
        cause = f"its mesh is not round: {_of_mark(shape, axes)} is exported"
        shape.findings.hint("mesh-not-round", shape.where, cause, "nothing, if its mesh is only there to be looked at")
        return
    center, found, off = fitted
    if np.sqrt(center @ center) > CENTER_TOLERANCE * found.max():
        place = " ".join(f"{x:.6g}" for x in shape.place.scene.metres(center) + 0.0)
        cause = f"the middle of its mesh is at ({place}) m, and what is exported is around the object's origin"
        shape.warn("center-not-shown", cause, "move its origin into the middle of its mesh", fix="set-origin")
    if (np.abs(found - axes) > max(SIZE_TOLERANCE, 2.0 * off) * axes).any():
        even = np.ptp(found) <= FIT_TOLERANCE * found.max()
        kind = "Sphere" if shape.kind == "Sphere" and even else "Ellipsoid"
        cause = f"its mesh shows {_said(shape, kind, found)}, its mark says {_of_mark(shape, axes)}"
        cure = "what the mark says is exported; fit it to the mesh (Apply Scale and Edit Mode change only the mesh)"
        shape.warn("size-not-shown", cause, cure, fix=f"fit-{kind.lower()}")


def check_round(shape: Shape, radii: tuple[float, float], length: float) -> None:
    """`radii` and `length`: size in the mark, in the object's own coordinates. An empty shows half the length."""
    if shape.mesh is None:
        seen = shape.place.thing.display_size
        if seen is not None and abs(2.0 * seen - length) > SIZE_TOLERANCE * length:
            cause = f"it is shown with half a length of {_metres(shape, seen)}, its mark says {_metres(shape, length / 2)}"
            cure = "what the mark says is exported; take over what is shown (Apply Scale changes only what is shown)"
            shape.warn("size-not-shown", cause, cure, fix="fit-round")
        return
    vertices = np.asarray(shape.mesh.vertices, dtype=np.float64)
    found = fit(vertices, shape.kind)
    if found is None:
        return
    seen_length, seen_radii, middle = found
    size = max(length, 2.0 * max(radii))
    shown = find(vertices, shape.kind)
    if shown is not None and _lies_elsewhere(shape, shown, size):
        return
    if abs(middle) > CENTER_TOLERANCE * size:
        shown = f"{float(shape.place.scene.metres(middle)):.6g}"
        cause = f"the middle of its mesh is at z = {shown} m, and what is exported is around the object's origin"
        shape.warn("center-not-shown", cause, "move its origin into the middle of its mesh", fix="set-origin")
        return
    apart = np.abs(np.subtract((seen_length, *seen_radii), (length, *radii))).max()
    tapered = shape.kind in ONE_RADIUS and np.ptp(seen_radii) > FIT_TOLERANCE * size
    if tapered or apart <= FIT_TOLERANCE * size and off(vertices, shape.kind, length, radii) > FIT_TOLERANCE * size:
        cause = f"its mesh is no {shape.kind}: {_round(shape, length, radii)} is exported"
        shape.findings.hint("mesh-not-round", shape.where, cause, "nothing, if its mesh is only there to be looked at")
    elif apart > SIZE_TOLERANCE * size:
        shown = _round(shape, seen_length, seen_radii)
        cause = f"its mesh shows {shown}, its mark says {_round(shape, length, radii)}"
        cure = "what the mark says is exported; fit it to the mesh (Apply Scale and Edit Mode change only the mesh)"
        shape.warn("size-not-shown", cause, cure, fix="fit-round")


def _lies_elsewhere(shape: Shape, shown, size: float) -> bool:
    """Reports a part whose mesh lies along another axis than that of its mark, or beside it."""
    if abs(shown.axis[2]) < 1.0 - AXIS_TOLERANCE:
        along = ", ".join(f"{x:.4g}" for x in shown.axis + 0.0)
        cause = f"its mesh lies along ({along}), and what is exported lies along the object's z axis"
        shape.error("axis-not-shown", cause, "turn its object so that z is its axis", fix="align-axis")
        return True
    beside = float(np.sqrt(shown.center[:2] @ shown.center[:2]))
    if beside <= CENTER_TOLERANCE * size:
        return False
    shown_at = " ".join(f"{x:.6g}" for x in shape.place.scene.metres(shown.center) + 0.0)
    cause = f"the middle of its mesh is at ({shown_at}) m, and what is exported is around the object's origin"
    shape.warn("center-not-shown", cause, "move its origin into the middle of its mesh", fix="set-origin")
    return True


def _round(shape: Shape, length: float, radii: tuple[float, float]) -> str:
    if shape.kind in ONE_RADIUS:
        return f"a {shape.kind} of length {_metres(shape, length)} and radius {_metres(shape, radii[0])}"
    both = " and ".join(_metres(shape, radius) for radius in radii)
    return f"a {shape.kind} of length {_metres(shape, length)} and radii {both}"


def _of_mark(shape: Shape, axes: np.ndarray) -> str:
    return _said(shape, shape.kind, axes)


def _said(shape: Shape, kind: str, axes: np.ndarray) -> str:
    if kind == "Sphere":
        return f"a Sphere of radius {_metres(shape, float(np.mean(axes)))}"
    return f"an Ellipsoid of semi-axes {', '.join(_metres(shape, float(axis)) for axis in axes)}"


def _metres(shape: Shape, length: float) -> str:
    return f"{float(shape.place.scene.metres(length)):.6g} m"

# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes that show several round bodies: rows and mirror images made by modifiers, and joined pins.

One mark has one size and one place, so each piece is a body as large as it is shown, and where it is shown. A mesh of one
piece only shows what its mark says; so does one of several pieces that are not all round, unless modifiers made them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from . import transforms
from .exact import without_noise
from .pieces import apart, islands
from .propose import CENTER_TOLERANCE, around_axis, round_fit
from .round_shape import ROUND_KINDS, Shown, find, numbers_of, radii_of
from .size_check import SIZE_TOLERANCE
from .snapshot import Mesh, SnapshotObject

if TYPE_CHECKING:
    from .shape import Shape

SINGLE = 2.0**-23  # of the largest coordinate: the rounding of single precision


def pieces_shown(vertices: np.ndarray, mesh: Mesh) -> list[np.ndarray]:
    """Vertices of the pieces that may be bodies."""
    links = mesh.edges if len(mesh.edges) else np.zeros((0, 2), dtype=np.int64)
    return apart(vertices, islands(vertices, links))


def bodies_shown(thing: SnapshotObject, kind: str) -> list[np.ndarray] | None:
    """Pieces of an object's mesh that are bodies of a kind; `None` for one body, empty if undecided."""
    if thing.mesh is None or not len(thing.mesh.vertices):
        return None
    vertices = np.asarray(thing.mesh.vertices, dtype=np.float64)
    pieces, stored = pieces_shown(vertices, thing.mesh), thing.stored_mesh
    if len(pieces) < 2:
        return None
    made = stored is not None and len(pieces_shown(np.asarray(stored.vertices), stored)) < len(pieces)
    if all(_is_body(vertices[piece], kind, strict=not made) for piece in pieces):
        return pieces
    return [] if made else None


def several(shape: Shape) -> list[np.ndarray] | None:
    """Pieces of a mesh that are separate bodies, with a note; the rest as `bodies_shown`."""
    pieces = bodies_shown(shape.place.thing, shape.kind)
    if pieces:
        cause = f"its mesh has {len(pieces)} pieces: each is exported, as it is shown, as a body of its own"
        shape.findings.hint("several-pieces", shape.where, cause, "join them, if they are to be one body")
    elif pieces is not None:
        modifiers = ", ".join(shape.place.thing.modifiers)
        cause = f"its modifiers ({modifiers}) make several pieces of it, not all of them a {shape.kind}"
        cure = "apply the modifiers, separate the pieces (Mesh > Separate > By Loose Parts) and mark each"
        shape.error("pieces-not-round", cause, cure)
    return pieces


def _is_body(vertices: np.ndarray, kind: str, strict: bool) -> bool:
    """True if a piece shows a body of a kind; `strict`: with more corners than a box would have."""
    if kind not in ROUND_KINDS:
        return round_fit(vertices, np.zeros((0, 3)), 0.0) is not None and (not strict or len(vertices) > 8)
    shown = find(vertices, kind)
    return shown is not None and (not strict or around_axis(shown.own, shown.radii))


def round_bodies(shape: Shape, pieces: list[np.ndarray]) -> list[dict]:
    """Fields of a round part for each piece, in metres in the frame of the group."""
    linear = shape.place.affine.linear
    columns = transforms.column_lengths(linear)
    found = [find(shape.vertices[piece], shape.kind, linear / columns) for piece in pieces]
    if any(shown is None or not shown.length > 0.0 for shown in found):
        cause = f"its transform, or its size, leaves pieces of it that are no {shape.kind}"
        shape.error("pieces-not-round", cause, "apply its scale and its modifiers, and separate the pieces")
        return []
    numbers = {name: shape.place.number(name) for name in ("radius", "radii", "length")}
    wanted = (float(numbers["length"]), *radii_of(shape.kind, numbers))
    even = np.ptp(columns) <= transforms.SCALE_TOLERANCE * columns.max()
    sizes = [_agreed((shown.length, *shown.radii), np.multiply(wanted, columns[0]) if even else None) for shown in found]
    _tell_size(shape, sizes, wanted if even and columns[0] == 1.0 else None)
    return [_fields(shape, shown, size) for shown, size in zip(found, sizes)]


def _agreed(found: tuple[float, ...], wanted) -> tuple[float, ...]:
    """Numbers of the mark, with all digits, where the piece matches them; else those of the piece."""
    size = max(found)
    if wanted is not None and np.abs(np.subtract(found, wanted)).max() <= SIZE_TOLERANCE * size:
        return tuple(map(float, wanted))
    return tuple(without_noise(found, SINGLE * size).tolist())


def _fields(shape: Shape, shown: Shown, size: tuple[float, ...]) -> dict:
    length, *radii = size
    half = shown.axis * (length / 2.0)
    noise = SINGLE * float(np.abs(shape.vertices).max())
    ends = [tuple((without_noise(end, noise) + 0.0).tolist()) for end in (shown.center - half, shown.center + half)]
    own = numbers_of(shape.kind, length, tuple(radii))
    return {"ends": tuple(ends), **{name: own[name] for name in ("radius", "radii") if name in own}}


def _tell_size(shape: Shape, sizes: list[tuple[float, ...]], wanted) -> None:
    if wanted is None or all(np.abs(np.subtract(size, wanted)).max() <= SIZE_TOLERANCE * max(size) for size in sizes):
        return
    words = lambda size: f"length {size[0]:.6g} m and radius {max(size[1:]):.6g} m"  # noqa: E731
    cause = f"its first piece is shown with a {words(sizes[0])}, its mark says {words(wanted)}"
    shape.warn("size-not-shown", cause, "what is shown is exported; fit the mark to it", fix="fit-round")


def ball_bodies(shape: Shape, pieces: list[np.ndarray], wanted: np.ndarray) -> list[tuple[np.ndarray, np.ndarray]]:
    """Centre and semi-axes of each piece in the object's own coordinates; `wanted`: semi-axes of the mark."""
    vertices = np.asarray(shape.mesh.vertices, dtype=np.float64)
    noise, found = SINGLE * float(np.abs(vertices).max()), []
    for piece in pieces:
        center, axes, _ = round_fit(vertices[piece], np.zeros((0, 3)), 0.0)
        if np.ptp(axes) <= CENTER_TOLERANCE * axes.max():
            axes = np.full(3, axes.mean())
        near = wanted.shape == axes.shape and np.abs(axes - wanted).max() <= SIZE_TOLERANCE * axes.max()
        found.append((without_noise(center, noise) + 0.0, wanted if near else without_noise(axes, SINGLE * axes.max())))
    first = found[0][1]
    if any(np.abs(axes - wanted).max() > SIZE_TOLERANCE * axes.max() for _, axes in found):
        shown, marked = (", ".join(f"{x:.6g}" for x in axes) for axes in (first, wanted))
        cause = f"its first piece is shown with semi-axes of {shown} m, its mark says {marked} m"
        fix = "fit-sphere" if shape.kind == "Sphere" else "fit-ellipsoid"
        shape.warn("size-not-shown", cause, "what is shown is exported; fit the mark to it", fix=fix)
    return found

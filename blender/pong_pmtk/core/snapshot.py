# SPDX-License-Identifier: GPL-3.0-or-later
"""Snapshots: the facts of a Blender scene as plain data.

The adapter fills one in and judges nothing; everything that can be wrong with a scene is found here in the core, so it
can be tested without Blender. All numbers are float64; those that Blender keeps in single precision are given as they
are, widened.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .marks import Mark, ModelSettings, Part


@dataclass
class Mesh:
    """A mesh in its object's own coordinates."""

    vertices: np.ndarray  # (n, 3)
    edges: np.ndarray  # (m, 2): all edges, of faces too
    loops: np.ndarray  # vertex indices, face after face
    face_starts: np.ndarray  # (f + 1,): face i is loops[face_starts[i]:face_starts[i + 1]]


@dataclass
class Transform:
    """An object's transform as Blender stores it; the matrix to the parent is `local_matrix` of transforms.py."""

    location: tuple[float, float, float] = (0.0, 0.0, 0.0)
    rotation_mode: str = "QUATERNION"  # "XYZ" and its orders, "QUATERNION", "AXIS_ANGLE"
    rotation: tuple[float, ...] = (1.0, 0.0, 0.0, 0.0)  # by mode: 3 angles, (w, x, y, z), (angle, x, y, z)
    scale: tuple[float, float, float] = (1.0, 1.0, 1.0)
    delta_location: tuple[float, float, float] = (0.0, 0.0, 0.0)
    delta_rotation: tuple[float, ...] = (1.0, 0.0, 0.0, 0.0)  # by the same mode; axis-angle has none (identity)
    delta_scale: tuple[float, float, float] = (1.0, 1.0, 1.0)
    parent_inverse: np.ndarray | None = None  # (4, 4); None for identity


@dataclass
class SnapshotObject:
    """One object."""

    name: str  # unique in the snapshot
    type: str  # "EMPTY", "MESH", or what else Blender has
    parent: str | None = None
    parent_type: str = "OBJECT"  # "BONE", "VERTEX", ... are refused
    transform: Transform = field(default_factory=Transform)
    mark: Mark = field(default_factory=Mark)
    settings: ModelSettings | None = None  # of a root
    mesh: Mesh | None = None  # after modifiers, if they are applied
    stored_mesh: Mesh | None = None  # before modifiers, where they change anything
    modifiers: list[str] = field(default_factory=list)
    left_over: list[Part] = field(default_factory=list)  # marked elements of its mesh that no part of it names
    display_size: float | None = None  # of an empty
    shape_keys: int = 0
    constraints: list[str] = field(default_factory=list)  # those that are switched on
    animated: bool = False
    drivers: bool = False
    hidden: bool = False  # in the viewport
    excluded: bool = False  # its collections are left out of the view layer
    instance_of: str = ""  # an empty that shows a collection: the collection's name
    linked_from: str = ""  # a library file
    called: str = ""  # its name in its own file, where an object of another file has taken `name`
    collections: list[str] = field(default_factory=list)  # those it is in, directly or through their parents
    exact: dict[str, np.ndarray] = field(default_factory=dict)
    """Numbers in full precision for what Blender rounds to single. They count as long as rounding them gives what
    Blender has now; see exact.py. "location", "rotation", "scale"; "vertices" (of the stored mesh); "radius", "radii",
    "semi_axes", "length", "reach", "thickness", "file_scale" (of the mark); and what a place only stands for, which
    counts while location and rotation do: "direction" of a Ray, "normal" and "offset" of a Plane, "ends" of a round part."""

    @property
    def model_name(self) -> str:
        """Name in the model."""
        return self.mark.name or self.called or self.name


@dataclass
class Snapshot:
    """One scene at one frame."""

    objects: list[SnapshotObject]
    unit_scale: float = 1.0  # metres in one Blender unit
    frame: int = 1
    source: str = ""  # the .blend file, for messages
    edit_mode: str = ""  # name of the object that is being edited
    instance_offsets: dict[str, tuple[float, float, float]] = field(default_factory=dict)
    """Point of every instanced collection at the instancing empty's origin. The objects of such a collection belong to
    the snapshot even if it is excluded."""

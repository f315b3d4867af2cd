# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks: properties of an object beyond its geometry.

Blender keeps them in a PropertyGroup, glTF files in `extras.pong`, snapshots as the classes here. The field names are
the same in all three (`to_json`, `from_json`); fields at their defaults are left out.
"""

from __future__ import annotations

from dataclasses import dataclass, field

VERSION = 1

ROLES = ("none", "root", "group", "primitive")

KINDS = (
    "Point",
    "LineSegment",
    "Ray",
    "Sphere",
    "Ellipsoid",
    "Plane",
    "Triangle",
    "TriangleMesh",
    "Polyhedron",
    "Capsule",
    "Cylinder",
    "Cone",
    "Bore",
    "Custom",
)

BOUNDS = ("Aabb", "Sphere", "Obb", "Above")

CONTACTS = ("Default", "Solid", "Marked", "Automatic")


@dataclass
class Part:
    """Some vertices, edges or faces of a mesh as primitives of one kind.

    Their indices are those of the mesh as it is stored, before modifiers; a mesh with parts must have none that change
    its topology.
    """

    name: str
    kind: str
    surface: str = ""  # "" for that of the object
    vertices: list[int] = field(default_factory=list)
    edges: list[int] = field(default_factory=list)
    faces: list[int] = field(default_factory=list)


@dataclass
class Mark:
    """Properties of one object for the engine.

    What a kind takes from its object, in the object's own coordinates:

    | kind | an empty | a mesh |
    |---|---|---|
    | Point | its origin | every vertex |
    | LineSegment | – | every edge |
    | Ray | from its origin along +z, `length` long | every edge, from its first vertex to its second |
    | Sphere | centre at its origin, `radius` | the same: the mesh only shows it |
    | Ellipsoid | centre at its origin, `semi_axes` along its axes | the same |
    | Plane | through its origin, normal +z | the plane of its only face |
    | Triangle | – | every face, which must be a triangle |
    | TriangleMesh | – | all faces, cut into triangles |
    | Polyhedron | – | all of it; each connected piece is a polyhedron of its own |
    | Capsule, Cylinder, Cone, Bore | axis along z, its middle at its origin, `length` long | the same: the mesh only shows it |
    | Custom | `custom_kind` and `parameters` alone | the same |

    An object that yields several primitives numbers them: `foot_0`, `foot_1`, …. All lengths are in units of the scene,
    as Blender stores them: metres, unless its unit scale says otherwise.
    """

    role: str = "none"
    version: int = VERSION
    name: str = ""  # in the model; "" for the object's own name
    surface: str = ""  # "" for that of the group above
    order: int = 0  # place among siblings, from 1; those with 0 come last, in the natural order of their names
    # groups
    movable: bool = False
    bound: str = "Default"  # or one of BOUNDS
    custom_bound: str = ""  # name of a registered kind of volume, instead of `bound`
    leaf_size: int = 0  # most elements of a leaf; 0 for no limit
    contact: str = "Default"  # or one of CONTACTS; the default is that of the group above, of a root `Marked`
    # primitives
    kind: str = ""
    radius: float = 0.0  # before the object's scale
    semi_axes: tuple[float, float, float] = (0.0, 0.0, 0.0)  # before the object's scale
    radii: tuple[float, float] = (0.0, 0.0)  # of a Cone or Bore: at -z and at +z; before the object's scale
    length: float = 0.0  # of a Ray, or between the ends of a round part's axis; before the object's scale
    reach: float | None = None
    response: str = "Normal"  # or "Axial"
    thickness: float | None = None
    mouths: tuple[bool, bool] = (True, True)  # of a Bore: whether it ends in an edge that pushes, at -z and at +z
    two_sided: bool = False
    inactive_faces: list[int] = field(default_factory=list)  # of a Polyhedron: faces of the stored mesh
    file: str = ""  # TriangleMesh, Polyhedron: write the mesh to this OBJ or STL file beside the model
    file_scale: float = 1.0  # metres in one unit of that file
    custom_kind: str = ""  # of a Custom primitive: the name it is registered by
    parameters: list[float] = field(default_factory=list)
    parts: list[Part] = field(default_factory=list)  # besides what `kind` makes of the whole object; "" for parts alone


@dataclass
class ModelSettings:
    """Settings of a whole model, stored on its root."""

    name: str = ""  # "" for the root's name
    entry_memory: bool = True
    surfaces: dict[str, dict] = field(default_factory=dict)
    """Name -> fields as in docs/model_format.md; laws are `Tagged` or, in JSON, {"Linear": {"damping": 250.0}}. Numbers
    are used as they are: store them in full precision (as text, or as ID properties)."""
    pairs: list[dict] = field(default_factory=list)
    filters: list[tuple[str, str]] = field(default_factory=list)  # groups that never touch, by path or name

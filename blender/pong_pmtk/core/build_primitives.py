# SPDX-License-Identifier: GPL-3.0-or-later
"""Marked objects -> primitives in the frame of their group."""

from __future__ import annotations

import numpy as np

from . import transforms
from .build_meshes import build_mesh_kind
from .build_round import build_round
from .exact import meant
from .marks import KINDS, Mark
from .model import Primitive
from .parts import part_shapes
from .polygon import plane_of
from .round_pieces import ball_bodies, several
from .round_shape import ROUND_KINDS
from .schema import RESPONSES
from .shape import Origin, Place, Shape, ready
from .size_check import check_size
from .snapshot import Mesh

CURVED_TYPES = ("CURVE", "SURFACE", "FONT", "META", "CURVES")


def build_primitive(place: Place, surface: str | None, files: dict[str, bytes]) -> list[tuple[Primitive, Origin]]:
    """The primitives of an object."""
    made = []
    for shape in _shapes(place, surface):
        build = build_round if shape.kind in ROUND_KINDS else _KINDS.get(shape.kind)
        made += build(shape) if build else build_mesh_kind(shape, files)
    return made


def _shapes(place: Place, surface: str | None) -> list[Shape]:
    thing, mark = place.thing, place.thing.mark
    if not _usable(place):
        return []
    mesh, evaluated = _mesh_of(place)
    name = thing.model_name
    parts: list[Shape] = []
    if mark.parts:
        parts = part_shapes(place, mesh, evaluated, surface)
        if not mark.kind:
            return parts
    if mark.kind not in KINDS:
        rule, cause = ("unknown-kind", f'its kind is "{mark.kind}"') if mark.kind else ("no-kind", "it has no kind")
        cure = f"choose from: {', '.join(KINDS)}"
        place.findings.error(rule, place.where, cause, cure)
        return parts
    _misplaced_fields(place, mark)
    shape = Shape(place, name, mark.kind, surface, mesh, evaluated)
    return [shape, *parts] if ready(shape) else parts


def _usable(place: Place) -> bool:
    thing = place.thing
    if thing.type in ("EMPTY", "MESH"):
        if thing.type == "MESH" and thing.mesh is None:
            cause = "its mesh could not be read"
            place.findings.error("no-mesh", place.where, cause, "show the object and leave edit mode")
            return False
        return True
    fix = "convert-to-mesh" if thing.type in CURVED_TYPES else ""
    cure = "convert it to a mesh (Object > Convert)" if fix else "mark an empty or a mesh"
    cause = f"a {thing.type.lower()} cannot be a primitive"
    place.findings.error("primitive-type", place.where, cause, cure, fix=fix)
    return False


def _mesh_of(place: Place) -> tuple[Mesh | None, bool]:
    thing = place.thing
    changed = thing.stored_mesh is not None and not same_topology(thing.stored_mesh, thing.mesh)
    if thing.modifiers and thing.stored_mesh is not None:
        cause = f"modifiers change its mesh: {', '.join(thing.modifiers)}"
        cure = "the mesh after them is exported; apply them to see it"
        if thing.mark.kind in (*ROUND_KINDS, "Sphere", "Ellipsoid"):
            cure = "its mark says what is exported, and the mesh after them only shows it, unless that has several pieces"
        place.findings.hint("modifiers", place.where, cause, cure)
    if thing.shape_keys and thing.stored_mesh is not None:
        cause = f"{thing.shape_keys} shape keys change its mesh"
        cure = f"its shape at frame {place.scene.snapshot.frame} is exported"
        place.findings.warn("shape-keys", place.where, cause, cure)
    return thing.mesh, changed


def same_topology(a: Mesh, b: Mesh) -> bool:
    return (
        len(a.vertices) == len(b.vertices)
        and np.array_equal(a.edges, b.edges)
        and np.array_equal(a.loops, b.loops)
        and np.array_equal(a.face_starts, b.face_starts)
    )


def _misplaced_fields(place: Place, mark: Mark) -> None:
    """Reports properties of an object that its kind cannot have."""
    if mark.inactive_faces and mark.kind != "Polyhedron":
        cause = f"a {mark.kind} with inactive faces"
        place.findings.error("inactive-faces-kind", place.where, cause, "only a Polyhedron has them; clear them")
    if mark.file and mark.kind not in ("TriangleMesh", "Polyhedron"):
        cause = f"a {mark.kind} in a mesh file"
        place.findings.error("file-kind", place.where, cause, "only a TriangleMesh or a Polyhedron can have one")


# --- kinds ---------------------------------------------------------------------------------------------------------


def _points(shape: Shape):
    if shape.mesh is None:
        return shape.numbered("Point", [{"position": shape.place.origin()}])
    chosen = shape.part.vertices if shape.part else range(len(shape.vertices))
    if not len(chosen):
        shape.error("no-vertices", "a mesh without vertices", "add some, or use an empty")
    return shape.numbered("Point", [{"position": tuple(p)} for p in shape.vertices[list(chosen)].tolist()])


def _edges(shape: Shape) -> np.ndarray:
    """Edges in use, (n, 2); faults are noted."""
    edges = np.asarray(shape.mesh.edges, dtype=np.int64).reshape(-1, 2)
    chosen = np.asarray(shape.part.edges, dtype=np.int64) if shape.part else np.arange(len(edges))
    if not len(chosen):
        shape.error("no-edges", "a mesh without edges", "connect vertices by edges, or choose another kind")
    elif not shape.part:
        loose = np.setdiff1d(np.arange(len(shape.vertices)), edges.ravel())
        if len(loose):
            cause = f"{len(loose)} vertices belong to no edge and are not exported"
            shape.warn("loose-geometry", cause, "delete them", vertices=loose, fix="delete-loose")
        if len(shape.mesh.face_starts) > 1:
            cause = "its faces are not exported, only their edges"
            shape.findings.hint(
                "faces-not-exported", shape.where, cause, "mark it as another kind, or delete its faces only"
            )
    ends = shape.vertices[edges[chosen]]
    zero = (ends[:, 0] == ends[:, 1]).all(axis=1)
    if zero.any():
        cause = "both ends of an edge are the same place"
        shape.error("zero-length", cause, "merge them", edges=chosen[zero], fix="merge-by-distance")
    return edges[chosen]


def _segments(shape: Shape):
    ends = shape.vertices[_edges(shape)].tolist()
    return shape.numbered("LineSegment", [{"ends": (tuple(a), tuple(b))} for a, b in ends])


def _rays(shape: Shape):
    mark, place = shape.mark, shape.place
    options = {"reach": place.number("reach"), "response": mark.response}
    if mark.response not in RESPONSES:
        shape.error("unknown-response", f'its response is "{mark.response}"', f"choose from: {', '.join(RESPONSES)}")
    if options["reach"] is not None:
        options["reach"] = float(options["reach"])
        if not options["reach"] >= 0.0:
            shape.error("negative-reach", f"its reach is {options['reach']}", "it is zero or above")
    if shape.mesh is not None:
        rays = shape.vertices[_edges(shape)]
        lengths = np.sqrt(((rays[:, 1] - rays[:, 0]) ** 2).sum(axis=1))
        fields = [
            {"origin": tuple(o), "direction": tuple(d), "length": length, **options}
            for o, d, length in zip(rays[:, 0].tolist(), (rays[:, 1] - rays[:, 0]).tolist(), lengths.tolist())
        ]
        return shape.numbered("Ray", fields)
    along = place.affine.linear[:, 2]
    stretch = float(np.sqrt(along @ along))
    length = float(place.number("length"))
    if not (np.isfinite(length) and length > 0.0):
        shape.error("no-length", f"its length is {length}", "give it a length above zero")
    else:
        check_size(shape, [shape.mark.length])
    exact = place.unmoved("direction")
    direction = along / stretch if exact is None else np.asarray(exact)
    stretch = 1.0 if abs(stretch - 1.0) <= transforms.SCALE_TOLERANCE else stretch
    fields = {"origin": place.origin(), "direction": tuple((direction + 0.0).tolist()), "length": length * stretch}
    if exact is not None:
        fields["direction"] = tuple(float(x) for x in exact)
    return shape.numbered("Ray", [{**fields, **options}])


def _semi_axes(shape: Shape, along_axes: np.ndarray):
    """Semi-axes and orientation of a sphere or ellipsoid under the object's transform; `None` if it is sheared."""
    linear = shape.place.affine.linear
    if transforms.shear(linear) > transforms.SHEAR_TOLERANCE:
        culprit = shape.place.scaled_parent
        cause = f'it is sheared: it is turned below "{culprit}", which is scaled differently along its axes'
        shape.error(f"sheared-{shape.kind.lower()}", cause, f'apply the scale of "{culprit}"', fix="apply-scale")
        return None
    lengths = transforms.column_lengths(linear)
    near = np.abs(lengths - 1.0) <= transforms.SCALE_TOLERANCE
    axes = along_axes * np.where(near, 1.0, lengths)
    frame = transforms.frame_of(linear, np.ones(3))
    local = shape.place.local
    if local is not None and local.quaternion is not None and (local.scale == 1.0).all():
        return axes, local.quaternion
    return axes, transforms.matrix_quaternion(frame.rotation)


def _sphere(shape: Shape):
    radius = float(shape.place.number("radius"))
    if not (np.isfinite(radius) and radius > 0.0):
        fix = "fit-sphere" if shape.mesh is not None else ""
        shape.error("no-radius", f"its radius is {radius}", "give it a radius above zero", fix=fix)
        return []
    pieces = several(shape)
    if pieces is not None:
        return _balls(shape, pieces, np.full(3, meant(shape.mark.radius, shape.place.thing.exact.get("radius"))))
    check_size(shape, np.full(3, shape.mark.radius))
    found = _semi_axes(shape, np.full(3, radius))
    if found is None:
        return []
    axes, orientation = found
    center = shape.place.origin()
    if np.ptp(axes) <= transforms.SCALE_TOLERANCE * axes.max():
        even = float(axes[0]) if np.ptp(axes) == 0.0 else float(axes.mean())
        return shape.numbered("Sphere", [{"center": center, "radius": even}])
    cause = "its scale differs along its axes: it is exported as an Ellipsoid"
    shape.warn("sphere-to-ellipsoid", cause, "mark it as an Ellipsoid, or make its scale even")
    fields = {"center": center, "semi_axes": tuple(axes.tolist()), "orientation": orientation}
    return shape.numbered("Ellipsoid", [fields])


def _ellipsoid(shape: Shape):
    semi_axes = np.asarray(shape.place.number("semi_axes"), dtype=np.float64)
    if not (np.isfinite(semi_axes).all() and (semi_axes > 0.0).all()):
        fix = "fit-ellipsoid" if shape.mesh is not None else ""
        cause = f"its semi-axes are {tuple(semi_axes.tolist())}"
        shape.error("no-semi-axes", cause, "give it three above zero", fix=fix)
        return []
    pieces = several(shape)
    if pieces is not None:
        return _balls(shape, pieces, meant(shape.mark.semi_axes, shape.place.thing.exact.get("semi_axes")))
    check_size(shape, shape.mark.semi_axes)
    found = _semi_axes(shape, semi_axes)
    if found is None:
        return []
    fields = {"center": shape.place.origin(), "semi_axes": tuple(found[0].tolist()), "orientation": found[1]}
    return shape.numbered("Ellipsoid", [fields])


def _balls(shape: Shape, pieces: list, wanted: np.ndarray):
    """A sphere or ellipsoid for each piece of a mesh."""
    each: dict[str, list] = {"Sphere": [], "Ellipsoid": []}
    for center, own_axes in ball_bodies(shape, pieces, wanted) if pieces else ():
        found = _semi_axes(shape, np.asarray(shape.place.scene.metres(own_axes)))
        if found is None:
            return []
        middle, (axes, orientation) = tuple(shape.place.points(center[None, :])[0].tolist()), found
        if shape.kind == "Sphere" and np.ptp(axes) <= transforms.SCALE_TOLERANCE * axes.max():
            each["Sphere"].append({"center": middle, "radius": float(axes[0])})
        else:
            each["Ellipsoid"].append({"center": middle, "semi_axes": tuple(axes.tolist()), "orientation": orientation})
    if each["Sphere"] and each["Ellipsoid"] or shape.kind == "Sphere" and each["Ellipsoid"]:
        cause = "its scale, or that of its modifiers, differs along its axes: pieces of it are no spheres"
        shape.error("pieces-not-round", cause, "make the scale even, or mark it as an Ellipsoid")
        return []
    return [made for kind, fields in each.items() if fields for made in shape.numbered(kind, fields)]


def _plane(shape: Shape):
    """Normal of a plane under any transform, by the inverse transpose."""
    place = shape.place
    exact = place.unmoved("normal"), place.unmoved("offset")
    if shape.mesh is None and exact[0] is not None and exact[1] is not None:
        normal = tuple(float(x) for x in exact[0])
        return shape.numbered("Plane", [{"normal": normal, "offset": float(np.ravel(exact[1])[0])}])
    if shape.mesh is None:
        inverse = np.linalg.inv(place.affine.linear)
        normal = inverse[2] / np.sqrt(inverse[2] @ inverse[2])
        normal = transforms.cleaned(normal)
        return shape.numbered(
            "Plane", [{"normal": tuple(normal.tolist()), "offset": float(normal @ place.origin()) + 0.0}]
        )
    chosen = shape.part.faces if shape.part else range(len(shape.mesh.face_starts) - 1)
    if len(chosen) != 1:
        cause = f"a plane of {len(chosen)} faces"
        shape.error("plane-faces", cause, "a Plane is the plane of one face: mark one", faces=chosen)
        return []
    starts = shape.mesh.face_starts
    corners = shape.vertices[shape.mesh.loops[starts[chosen[0]] : starts[chosen[0] + 1]]]
    normal, offset = plane_of(corners[::-1] if place.mirrored else corners)
    if not normal.any():
        shape.error("sliver-face", "its face has no area, so it has no plane", "move a vertex", faces=chosen)
        return []
    normal = transforms.cleaned(normal)
    return shape.numbered("Plane", [{"normal": tuple(normal.tolist()), "offset": offset + 0.0}])


def _custom(shape: Shape):
    mark = shape.mark
    if not mark.custom_kind:
        shape.error("no-custom-kind", "a Custom primitive without the name of its kind", "name the registered kind")
    if not shape.place.affine.is_identity():
        cause = "a Custom primitive takes nothing from its object's place, which is not its group's"
        shape.error("custom-place", cause, "clear its location, rotation and scale; its parameters say where it is")
    fields = {"kind": mark.custom_kind, "parameters": tuple(map(float, mark.parameters))}
    return shape.numbered("Custom", [fields])


_KINDS = {
    "Point": _points,
    "LineSegment": _segments,
    "Ray": _rays,
    "Sphere": _sphere,
    "Ellipsoid": _ellipsoid,
    "Plane": _plane,
    "Custom": _custom,
}

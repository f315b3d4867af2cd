# SPDX-License-Identifier: GPL-3.0-or-later
"""Marked meshes -> triangles and polyhedra."""

from __future__ import annotations

import numpy as np

from . import mesh_file
from .engine import PLANE_TOLERANCE, WheelMissing, polyhedron_faults
from .exact import meant, rounded
from .model import Primitive
from .pieces import pieces_of
from .polygon import off_planes, triangulated
from .shape import Origin, Shape, thickness_of

Made = list[tuple[Primitive, Origin]]
CONVEX_FACES = 500  # nobody asks of larger meshes whether they are convex


def build_mesh_kind(shape: Shape, files: dict[str, bytes]) -> Made:
    """Triangle, TriangleMesh or Polyhedron."""
    faces = _faces(shape)
    if not len(faces):
        shape.error("no-faces", f"a {shape.kind} without faces", "fill it with faces, or choose another kind")
        return []
    _tell_loose(shape)
    if shape.kind == "Triangle":
        return _triangles(shape, faces)
    return _triangle_mesh(shape, faces, files) if shape.kind == "TriangleMesh" else _polyhedra(shape, faces, files)


def _faces(shape: Shape) -> np.ndarray:
    """Indices of the faces in use."""
    if shape.part:
        return np.array(sorted(shape.part.faces), dtype=np.int64)
    return np.arange(len(shape.mesh.face_starts) - 1)


def _loops_of(shape: Shape, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Loops and starts of some faces, wound so that fronts stay fronts under a mirroring transform."""
    starts, loops = np.asarray(shape.mesh.face_starts), np.asarray(shape.mesh.loops, dtype=np.int64)
    widths = np.diff(starts)[faces]
    new_starts = np.concatenate([[0], np.cumsum(widths)])
    inside = np.arange(new_starts[-1]) - np.repeat(new_starts[:-1], widths)
    if shape.place.mirrored:
        # The first corner stays the first.
        inside = np.where(inside == 0, 0, np.repeat(widths, widths) - inside)
    return loops[np.repeat(starts[faces], widths) + inside], new_starts


def _tell_loose(shape: Shape) -> None:
    if shape.part:
        return
    loose = np.setdiff1d(np.arange(len(shape.vertices)), shape.mesh.loops)
    if len(loose):
        cause = f"{len(loose)} vertices belong to no face and are not exported"
        shape.warn("loose-geometry", cause, "delete them, or mark them as Points", vertices=loose, fix="delete-loose")


def _sheet(shape: Shape) -> dict:
    return {**thickness_of(shape), "two_sided": bool(shape.mark.two_sided)}


def _triangles(shape: Shape, faces: np.ndarray) -> Made:
    loops, starts = _loops_of(shape, faces)
    wide = faces[np.diff(starts) != 3]
    if len(wide):
        cause = f"{len(wide)} faces are no triangles"
        cure = "cut them into triangles, or mark it as a TriangleMesh"
        shape.error("not-a-triangle", cause, cure, faces=wide, fix="triangulate")
        return []
    options = _sheet(shape)
    corners = shape.vertices[loops.reshape(-1, 3)].tolist()
    each = [{"vertices": tuple(map(tuple, triangle)), **options} for triangle in corners]
    return shape.numbered("Triangle", each, [[face] for face in faces])


def _triangle_mesh(shape: Shape, faces: np.ndarray, files: dict[str, bytes]) -> Made:
    loops, starts = _loops_of(shape, faces)
    _tell_bent(shape, faces, loops, starts)
    triangles, source, crossed = triangulated(shape.vertices, loops, starts)
    if crossed:
        cause = f"the outlines of {len(crossed)} faces cross themselves or have no area"
        cure = "cut them into triangles by hand, or remove them"
        shape.error("self-crossing-face", cause, cure, faces=faces[crossed], fix="triangulate")
        return []
    _tell_convex(shape, faces, loops, starts)
    used, triangles = np.unique(triangles, return_inverse=True)
    fields = {"vertices": shape.vertices[used], "triangles": triangles.reshape(-1, 3), **_sheet(shape)}
    made = shape.numbered("TriangleMesh", [fields], [faces[source]])
    return _to_file(shape, made, "triangles", files)


def _tell_convex(shape: Shape, faces: np.ndarray, loops: np.ndarray, starts: np.ndarray) -> None:
    if shape.part or not 4 <= len(faces) <= CONVEX_FACES:
        return
    try:
        is_convex = not polyhedron_faults(shape.vertices, np.split(loops, starts[1:-1]))
    except WheelMissing:
        return  # told once, of the whole scene
    if is_convex:
        cause = "it is closed and convex: a Polyhedron would do, and costs less"
        shape.findings.hint(
            "convex-mesh", shape.where, cause, "mark it as a Polyhedron, unless only its surface matters"
        )


def _tell_bent(shape: Shape, faces: np.ndarray, loops: np.ndarray, starts: np.ndarray) -> None:
    """Finds non-planar faces of more than three corners: their triangulation changes the surface."""
    bent: list[int] = []
    widths = np.diff(starts)
    for width in np.unique(widths[widths > 3]).tolist():
        alike = np.flatnonzero(widths == width)
        corners = shape.vertices[loops[starts[alike][:, None] + np.arange(width)]]
        sizes = np.ptp(corners, axis=1).max(axis=1)
        bent += faces[alike[off_planes(corners) > np.maximum(shape.noise, PLANE_TOLERANCE * sizes)]].tolist()
    if bent:
        cause = f"{len(bent)} faces are not planar; they are cut into triangles along their shorter diagonals"
        shape.warn("bent-face", cause, "cut them by hand to choose", faces=bent, fix="triangulate")


def _polyhedra(shape: Shape, faces: np.ndarray, files: dict[str, bytes]) -> Made:
    inactive = _inactive(shape)
    loops, starts = _loops_of(shape, faces)
    corners = np.split(loops, starts[1:-1])
    pieces = pieces_of(shape.vertices, corners)
    each, sources = [], []
    for piece in pieces:
        own = [corners[i] for i in piece]
        used, flat = np.unique(np.concatenate(own), return_inverse=True)
        widths = [len(face) for face in own]
        local = np.split(flat, np.cumsum(widths)[:-1])
        walls = tuple(i for i, face in enumerate(faces[piece].tolist()) if face in inactive)
        _check_piece(shape, shape.vertices[used], local, walls, faces[piece], used)
        each.append({"inactive_faces": walls, "vertices": shape.vertices[used], "faces": local})
        sources.append(faces[piece])
    made = shape.numbered("Polyhedron", each, sources)
    if shape.mark.file and len(made) > 1:
        cause = f"{len(made)} pieces cannot be in one mesh file"
        shape.error("file-pieces", cause, "separate them, or keep the mesh in the model file", fix="separate-loose")
        return made
    return _to_file(shape, made, "faces", files)


def _inactive(shape: Shape) -> set[int]:
    inactive = set(shape.mark.inactive_faces)
    if inactive and shape.evaluated:
        cause = "its inactive faces name faces that its modifiers change"
        shape.error("inactive-and-modifiers", cause, "apply the modifiers, then mark the inactive faces anew")
        return set()
    count = len(shape.mesh.face_starts) - 1
    if any(not 0 <= face < count for face in inactive):
        cause = f"it has inactive faces that the mesh no longer has: there are {count}"
        shape.error("inactive-out-of-range", cause, "mark its inactive faces anew")
    return inactive


FIXES = {
    "inside-out": "recalculate-normals",
    "open-polyhedron": "merge-by-distance",
    "zero-length-edge": "merge-by-distance",
    "sliver-face": "dissolve-degenerate",
}


def _check_piece(shape: Shape, vertices, local, walls, faces: np.ndarray, used: np.ndarray) -> None:
    """The loader's checks, reported by faces of the mesh. Effects of 32-bit rounding have their own rule."""
    try:
        problems = polyhedron_faults(vertices, local, walls)
    except WheelMissing:
        return  # told once, of the whole scene
    for rule in dict.fromkeys(problem["rule"] for problem in problems):
        same = [problem for problem in problems if problem["rule"] == rule]
        worst = max(same, key=lambda problem: problem["off"])
        off, told = worst["off"], worst["cause"]
        at = {
            # A finding without a face concerns all faces.
            "faces": faces[np.unique([f["face"] for f in same])] if worst["face"] is not None else faces,
            "vertices": used[_indices(vertices, [place for problem in same for place in problem["places"]])],
        }
        if 0.0 < off <= shape.noise:
            size, away = float(np.ptp(vertices, axis=0).max()), float(np.abs(vertices).max())
            cause = f"32-bit rounding bends it: it is {size:.3g} m large and {away:.3g} m from the origin ({told})"
            cure = "move the origins of its object and its group into it"
            shape.error("rounded-away", cause, cure, fix="set-origin", **at)
            continue
        cause = told if len(same) == 1 else f"{told} (and {len(same) - 1} more)"
        shape.error(rule, cause, worst["cure"], fix=FIXES.get(rule, ""), **at)


def _indices(vertices: np.ndarray, places: list[tuple[float, float, float]]) -> np.ndarray:
    """First vertex at each of these positions."""
    first: dict[tuple, int] = {}
    for index, place in enumerate(map(tuple, (vertices + 0.0).tolist())):
        first.setdefault(place, index)
    return np.unique([first[place] for place in places if place in first]).astype(np.int64)


# --- mesh files ----------------------------------------------------------------------------------------------------


def _to_file(shape: Shape, made: Made, faces: str, files: dict[str, bytes]) -> Made:
    """Moves the lists of the only primitive into a mesh file, if the author wants one."""
    name = shape.mark.file
    if not name or not made:
        return made
    primitive, origin = made[0]
    vertices, lists = primitive.fields["vertices"], primitive.fields[faces]
    scale = float(meant(shape.mark.file_scale, shape.place.thing.exact.get("file_scale")))
    if not _file_allowed(shape, name, scale, lists, files):
        return made
    files[name] = mesh_file.write(name, vertices, lists, scale)
    if (
        mesh_file.kind_of(name) == "stl"
        and (rounded(mesh_file.before_scale(vertices, scale)) * scale != vertices).any()
    ):
        cause = "an STL file holds 32-bit numbers: its vertices are rounded to them"
        shape.warn("stl-rounds", cause, "use an OBJ file to keep them")
    rest = {key: value for key, value in primitive.fields.items() if key not in ("vertices", faces)}
    return [
        (Primitive(primitive.kind, primitive.name, {"file": name, "scale": scale, **rest}, primitive.surface), origin)
    ]


def _file_allowed(shape: Shape, name: str, scale: float, faces, files: dict[str, bytes]) -> bool:
    known = len(shape.findings.errors)
    try:
        mesh_file.check_path(name)
        stl = mesh_file.kind_of(name) == "stl"
    except mesh_file.MeshFileError as fault:
        cure = "name an .obj or .stl file in the model's folder or below it, with `/` alone"
        shape.error(fault.rule, str(fault), cure)
        return False
    if stl and not (isinstance(faces, np.ndarray) and faces.shape[1] == 3 or all(len(f) == 3 for f in faces)):
        shape.error("file-holds-triangles", "an STL file holds triangles alone", "use an OBJ file", fix="triangulate")
    if name in files:
        shape.error("file-twice", f'another object is written to "{name}" as well', "give it a file of its own")
    if not (np.isfinite(scale) and scale > 0.0):
        shape.error("file-scale", f"the scale of its file is {scale}", "it is above zero; 0.001 for millimetres")
    return len(shape.findings.errors) == known

# SPDX-License-Identifier: GPL-3.0-or-later
"""OBJ and STL files: shapes that a model names by `file`."""

from __future__ import annotations

from pathlib import Path, PurePosixPath

import numpy as np

from .canonical import flattened, unflattened

STL_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
STL_HEAD = 84
STL_TITLE = b"pong"  # must not be "solid", the mark of text files


class MeshFileError(ValueError):
    """A mesh file of no use; `rule` as in docs/model_format.md."""

    def __init__(self, rule: str, cause: str):
        super().__init__(cause)
        self.rule = rule


def kind_of(name: str) -> str:
    """ "obj" or "stl"."""
    kind = PurePosixPath(name).suffix.lower()[1:]
    if kind not in ("obj", "stl"):
        raise MeshFileError("mesh-file-kind", f'"{name}" is neither .obj nor .stl')
    return kind


def check_path(name: str) -> None:
    """A mesh file lies in the model's folder or below it."""
    parts = name.split("/")
    if not name or name.startswith("/") or ".." in parts or any(c in name for c in "\\:\0"):
        raise MeshFileError("mesh-file-outside", f'"{name}" leads out of the model\'s folder')
    kind_of(name)


def read(folder, name: str, scale: float = 1.0):
    """Vertices (m) and faces of a mesh file beside a model."""
    check_path(name)
    try:
        data = (Path(folder) / name).read_bytes()
    except OSError as error:
        raise MeshFileError("mesh-file-unreadable", f'"{name}" cannot be read: {error.strerror}') from None
    vertices, faces = (read_obj if kind_of(name) == "obj" else read_stl)(data)
    return (vertices if scale == 1.0 else vertices * scale), faces


def read_stl(data: bytes):
    """Every triangle has vertices of its own, as the file has it."""
    count = int.from_bytes(data[80:84], "little") if len(data) >= STL_HEAD else -1
    if count >= 0 and len(data) == STL_HEAD + count * STL_TRIANGLE.itemsize:
        corners = np.frombuffer(data, STL_TRIANGLE, count, STL_HEAD)["corners"].astype(np.float64)
    elif data.lstrip()[:5] == b"solid":
        corners = _text_stl(data)
    elif count >= 0 and len(data) > STL_HEAD + count * STL_TRIANGLE.itemsize:
        corners = np.frombuffer(data, STL_TRIANGLE, count, STL_HEAD)["corners"].astype(np.float64)
    else:
        raise MeshFileError("mesh-file-damaged", "it ends before its last triangle")
    vertices = corners.reshape(-1, 3)
    return vertices, np.arange(len(vertices)).reshape(-1, 3)


def _text_stl(data: bytes) -> np.ndarray:
    tokens = data.split()
    places = [i for i, token in enumerate(tokens) if token == b"vertex"]
    try:
        numbers = [[np.float32(tokens[i + k]) for k in (1, 2, 3)] for i in places]
    except (ValueError, IndexError):
        raise MeshFileError("mesh-file-damaged", "a vertex has not three numbers") from None
    if len(places) % 3:
        raise MeshFileError("mesh-file-damaged", "a triangle has not three vertices")
    return np.array(numbers, dtype=np.float64).reshape(-1, 3, 3)


def read_obj(data: bytes):
    """Faces of any number of corners; materials, normals and texture coordinates are left aside."""
    places: list[bytes] = []
    widths: list[int] = []
    corners: list[int] = []
    try:
        for line in data.replace(b"\\\n", b" ").splitlines():
            if line.startswith((b"v ", b"v\t")):
                places.append(b" ".join(line.split()[1:4]))
            elif line.startswith((b"f ", b"f\t")):
                face = [int(corner.split(b"/", 1)[0]) for corner in line.split()[1:]]
                if len(face) > 2:
                    widths.append(len(face))
                    corners += [i - 1 if i > 0 else len(places) + i for i in face]
        vertices = np.array(list(map(float, b" ".join(places).split())), dtype=np.float64).reshape(-1, 3)
    except ValueError as error:
        raise MeshFileError("mesh-file-damaged", str(error)) from None
    if len(vertices) != len(places):
        raise MeshFileError("mesh-file-damaged", "a vertex has not three numbers")
    flat = np.array(corners, dtype=np.int64)
    if len(flat) and (flat.min() < 0 or flat.max() >= len(vertices)):
        raise MeshFileError("mesh-file-damaged", "a face names a vertex that does not exist")
    return vertices, unflattened(flat, np.array(widths, dtype=np.int64)) if len(widths) else np.zeros((0, 3), np.int64)


def write(name: str, vertices: np.ndarray, faces, scale: float = 1.0) -> bytes:
    """The bytes of a mesh file whose coordinates times `scale` are the vertices."""
    unscaled = before_scale(np.asarray(vertices, dtype=np.float64), scale)
    return write_obj(unscaled, faces) if kind_of(name) == "obj" else write_stl(unscaled, faces)


def before_scale(values: np.ndarray, scale: float) -> np.ndarray:
    """Numbers that give `values` when they are multiplied by the scale: 32-bit ones, as files have them, if these do.

    What is a product of the scale comes back to the last bit.
    """
    if scale == 1.0:
        return values
    quotient = values / scale
    single = quotient.astype(np.float32).astype(np.float64)
    return np.where(single * scale == values, single, quotient)


def write_obj(vertices: np.ndarray, faces) -> bytes:
    lines = ["# Pong mesh"]
    numbers = list(map(repr, vertices.ravel().tolist()))
    lines += ["v " + " ".join(row) for row in zip(numbers[0::3], numbers[1::3], numbers[2::3])]
    flat, widths = flattened(faces)
    indices = list(map(str, (flat + 1).tolist()))
    here = 0
    for width in widths.tolist():
        lines.append("f " + " ".join(indices[here : here + width]))
        here += width
    return ("\n".join(lines) + "\n").encode("ascii")


def write_stl(vertices: np.ndarray, triangles) -> bytes:
    """A binary file; coordinates are rounded to single precision, as the format has it."""
    triangles = np.asarray(triangles)
    records = np.zeros(len(triangles), dtype=STL_TRIANGLE)
    records["corners"] = vertices[triangles]
    edges = vertices[triangles]
    normal = np.cross(edges[:, 1] - edges[:, 0], edges[:, 2] - edges[:, 0])
    length = np.sqrt((normal * normal).sum(axis=1, keepdims=True))
    records["normal"] = normal / np.where(length > 0.0, length, 1.0)
    return STL_TITLE.ljust(80, b"\0") + len(triangles).to_bytes(4, "little") + records.tobytes()

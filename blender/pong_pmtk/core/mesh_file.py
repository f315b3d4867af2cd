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
    """An unusable mesh file; `rule` as in docs/model_format.md."""

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
    """Checks that a mesh file is in the model's folder or below it."""
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


def damaged(cause: str, line: int = 0) -> MeshFileError:
    return MeshFileError("mesh-file-damaged", f"line {line}: {cause}" if line else cause)


def marked(data: bytes) -> bytes:
    """Content of the file without a UTF-8 byte order mark."""
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        raise damaged("it is text in UTF-16; save it as UTF-8 or ASCII")
    return data.removeprefix(b"\xef\xbb\xbf")


def read_stl(data: bytes):
    """Unshared vertices of every triangle, as the file has them."""
    count = int.from_bytes(data[80:84], "little") if len(data) >= STL_HEAD else -1
    length = STL_HEAD + count * STL_TRIANGLE.itemsize
    # Binary files may begin with "solid": the length decides, or a zero byte, which text does not contain.
    is_text = _is_text_stl(data) and not (count >= 0 and len(data) == length)
    if is_text:
        corners = _text_stl(marked(data))
    elif count >= 0 and len(data) >= length:
        corners = np.frombuffer(data, STL_TRIANGLE, count, STL_HEAD)["corners"].astype(np.float64)
    elif count >= 0:
        there = (len(data) - STL_HEAD) // STL_TRIANGLE.itemsize
        raise damaged(f"it ends before its last triangle: it has {there} of {count}")
    else:
        raise damaged(f"it is neither text nor long enough for a binary file: {len(data)} bytes")
    vertices = corners.reshape(-1, 3)
    return vertices, np.arange(len(vertices)).reshape(-1, 3)


def _is_text_stl(data: bytes) -> bool:
    words = marked(data).split(None, 1)
    first = words[0].lower() if words else b""
    return b"\0" not in data[:STL_HEAD] and first.startswith((b"solid", b"facet", b";", b"#"))


def _text_stl(data: bytes) -> np.ndarray:
    """Triangles of all solids. Normals follow from the corners; some programs write `nan` there."""
    numbers: list[bytes] = []
    facet = corners = 0
    for number, line in enumerate(data.splitlines(), 1):
        words = iter(line.split())
        for word in words:
            keyword = word.lower()
            if keyword == b"end":
                keyword += next(words, b"").lower()
            if keyword == b"vertex":
                if not facet or corners == 3:
                    raise damaged("a fourth vertex in a facet" if facet else "a vertex outside of a facet", number)
                place = [next(words, b"") for _ in range(3)]
                try:
                    numbers += [np.float32(x) for x in place]
                except ValueError:
                    raise damaged("a vertex has not three numbers", number) from None
                corners += 1
            elif keyword == b"facet":
                if facet:
                    raise damaged(f"the facet that begins in line {facet} has no `endfacet`", number)
                facet, corners = number, 0
                for word in words:
                    if word.lower() == b"outer":
                        break
            elif keyword == b"endfacet":
                if corners != 3:
                    raise damaged(f"a facet of {corners} vertices instead of three", number)
                facet = corners = 0
            elif keyword in (b"solid", b"endsolid", b"color") or keyword.startswith((b";", b"#", b"//")):
                if facet and keyword.endswith(b"solid"):
                    raise damaged(f"the facet that begins in line {facet} has no `endfacet`", number)
                break
            elif keyword not in (b"outer", b"loop", b"endloop", b"normal"):
                raise damaged(f"`{word.decode('latin-1')}` is no keyword of a text STL file", number)
    if facet:
        raise damaged("it ends within the facet that begins here", facet)
    return np.array(numbers, dtype=np.float64).reshape(-1, 3, 3)


def _obj_lines(data: bytes):
    """Numbers and words of lines; a backslash at the end continues a line."""
    lines = enumerate(marked(data).splitlines(), 1)
    for number, line in lines:
        words = line.partition(b"#")[0].split()
        while words and words[0] in (b"v", b"f", b"l", b"p") and words[-1].endswith(b"\\"):
            words[-1] = words[-1][:-1]
            words += next(lines, (0, b""))[1].partition(b"#")[0].split()
            words = [word for word in words if word]
        if words:
            yield number, words


def read_obj(data: bytes):
    """Faces of any number of corners; materials, normals and texture coordinates are ignored."""
    places: list[float] = []
    widths: list[int] = []
    corners: list[int] = []
    for number, words in _obj_lines(data):
        try:
            if words[0] == b"v":
                x, y, z = map(float, words[1:4])
                places += (x, y, z)
            elif words[0] == b"f":
                count = len(places) // 3
                face = [int(corner.split(b"/", 1)[0]) for corner in words[1:]]
                face = [i - 1 if i >= 0 else count + i for i in face]
                if face and (min(face) < 0 or max(face) >= count):
                    raise damaged("a face names a vertex that does not exist before this line", number)
                if len(face) > 2:
                    widths.append(len(face))
                    corners += face
        except MeshFileError:
            raise
        except ValueError:
            kind = "a vertex has not three numbers" if words[0] == b"v" else "a face has a corner that is no number"
            raise damaged(kind, number) from None
    vertices = np.array(places, dtype=np.float64).reshape(-1, 3)
    flat = np.array(corners, dtype=np.int64)
    return vertices, unflattened(flat, np.array(widths, dtype=np.int64)) if len(widths) else np.zeros((0, 3), np.int64)


def write(name: str, vertices: np.ndarray, faces, scale: float = 1.0) -> bytes:
    """Bytes of a mesh file whose coordinates times `scale` are the vertices."""
    unscaled = before_scale(np.asarray(vertices, dtype=np.float64), scale)
    return write_obj(unscaled, faces) if kind_of(name) == "obj" else write_stl(unscaled, faces)


def before_scale(values: np.ndarray, scale: float) -> np.ndarray:
    """Numbers whose product with the scale is `values`: 32-bit ones, as in files, if possible.

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
    """A binary file; coordinates are rounded to single precision, as the format requires."""
    triangles = np.asarray(triangles)
    records = np.zeros(len(triangles), dtype=STL_TRIANGLE)
    records["corners"] = vertices[triangles]
    edges = vertices[triangles]
    normal = np.cross(edges[:, 1] - edges[:, 0], edges[:, 2] - edges[:, 0])
    length = np.sqrt((normal * normal).sum(axis=1, keepdims=True))
    records["normal"] = normal / np.where(length > 0.0, length, 1.0)
    return STL_TITLE.ljust(80, b"\0") + len(triangles).to_bytes(4, "little") + records.tobytes()

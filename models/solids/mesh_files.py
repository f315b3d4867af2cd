"""Readers of triangle meshes in OBJ, STL, PLY and OFF files, and a writer of OBJ files."""

import io

import numpy as np

PLY_TYPES = {
    "char": "i1",
    "uchar": "u1",
    "short": "i2",
    "ushort": "u2",
    "int": "i4",
    "uint": "u4",
    "float": "f4",
    "double": "f8",
    "int8": "i1",
    "uint8": "u1",
    "int16": "i2",
    "uint16": "u2",
    "int32": "i4",
    "uint32": "u4",
    "float32": "f4",
    "float64": "f8",
}


class MeshError(Exception):
    """A file that is no mesh that these readers know."""


def read(name, data):
    """Reads a mesh from the bytes of a file; the ending of `name` is the format. Returns vertices (n, 3), in the unit
    of the file, and triangles (m, 3), indices of vertices. Vertices at equal places are one vertex. A triangle with two
    equal vertices is left out."""
    readers = {"obj": read_obj, "stl": read_stl, "ply": read_ply, "off": read_off}
    ending = name.rsplit(".", 1)[-1].lower()
    if ending not in readers:
        raise MeshError(f"{name}: no reader for .{ending}; use one of {', '.join(sorted(readers))}")
    vertices, triangles = readers[ending](data)
    if not len(triangles):
        raise MeshError(f"{name}: holds no triangle")
    if triangles.min() < 0 or triangles.max() >= len(vertices):
        raise MeshError(f"{name}: a triangle names a vertex that is not in the file")
    return weld(vertices, triangles)


def weld(vertices, triangles):
    """Keeps one vertex for each place, in the order of the file, and leaves out triangles with two equal vertices."""
    vertices = np.asarray(vertices, dtype=np.float64) + 0.0  # turns −0 into 0
    _, first, place = np.unique(vertices, axis=0, return_index=True, return_inverse=True)
    triangles = first[place.reshape(-1)[np.asarray(triangles, dtype=np.int64)]]
    a, b, c = triangles.T
    triangles = triangles[(a != b) & (b != c) & (c != a)]
    used, at = np.unique(triangles, return_inverse=True)
    return vertices[used], at.reshape(-1, 3)


def fan(polygons):
    """Triangles of polygons, each as a fan around its first vertex."""
    return np.array([(p[0], p[i], p[i + 1]) for p in polygons for i in range(1, len(p) - 1)], dtype=np.int64).reshape(
        -1, 3
    )


def read_obj(data):
    """Vertices and faces of all objects and groups of an OBJ file; everything else is left out."""
    vertices, polygons = [], []
    for line in data.decode("utf-8", "replace").splitlines():
        words = line.split()
        if not words:
            continue
        if words[0] == "v":
            vertices.append([float(word) for word in words[1:4]])
        elif words[0] == "f":
            indices = [int(word.split("/")[0]) for word in words[1:]]
            polygons.append([index - 1 if index > 0 else len(vertices) + index for index in indices])
    return np.array(vertices).reshape(-1, 3), fan(polygons)


def read_stl(data):
    """Triangles of a binary STL file, or of a text one."""
    count = int.from_bytes(data[80:84], "little")
    if len(data) >= 84 + 50 * count and count:
        facet = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
        corners = np.frombuffer(data, facet, count, 84)["corners"].reshape(-1, 3)
    else:
        rows = [line.split()[1:4] for line in data.decode("ascii", "replace").splitlines() if "vertex" in line]
        corners = np.array(rows, dtype=np.float32).reshape(-1, 3)
    return corners.astype(np.float64), np.arange(len(corners)).reshape(-1, 3)


def read_off(data):
    """Vertices and polygons of a text OFF file."""
    lines = (line.split("#")[0].split() for line in data.decode("ascii", "replace").splitlines())
    words = [word for line in lines for word in line[:256]]
    if not words or words[0] != "OFF":
        raise MeshError("an OFF file starts with the word OFF")
    vertex_count, polygon_count = int(words[1]), int(words[2])
    at = 4 + 3 * vertex_count
    vertices = np.array(words[4:at], dtype=np.float64).reshape(-1, 3)
    polygons = []
    for _ in range(polygon_count):
        corners = int(words[at])
        polygons.append([int(word) for word in words[at + 1 : at + 1 + corners]])
        at += 1 + corners
    return vertices, fan(polygons)


def ply_header(stream):
    """Format of a PLY file and its elements: name, count and properties (name, type, type of a list's count)."""
    if stream.readline().strip() != b"ply":
        raise MeshError("a PLY file starts with the word ply")
    form, elements = None, []
    while True:
        words = stream.readline().decode("ascii", "replace").split()
        if words[:1] == ["format"]:
            form = words[1]
        elif words[:1] == ["element"]:
            elements.append((words[1], int(words[2]), []))
        elif words[:1] == ["property"]:
            of_count = PLY_TYPES[words[2]] if words[1] == "list" else None
            elements[-1][2].append((words[-1], PLY_TYPES[words[-2]], of_count))
        elif words == ["end_header"]:
            return form, elements


def ply_row(next_value, properties):
    """Values of one element by the names of its properties."""
    row = {}
    for name, kind, of_count in properties:
        row[name] = [next_value(kind) for _ in range(int(next_value(of_count)))] if of_count else next_value(kind)
    return row


def read_ply(data):
    """Vertices and polygons of a PLY file, text or binary."""
    stream = io.BytesIO(data)
    form, elements = ply_header(stream)
    if form == "ascii":
        words = iter(stream.read().split())

        def next_value(kind):
            return float(next(words)) if kind[0] == "f" else int(next(words))

    else:
        order = "<" if form == "binary_little_endian" else ">"

        def next_value(kind):
            return np.frombuffer(stream.read(int(kind[1])), order + kind)[0].item()

    vertices, polygons = [], []
    for name, count, properties in elements:
        for _ in range(count):
            row = ply_row(next_value, properties)
            if name == "vertex":
                vertices.append((row["x"], row["y"], row["z"]))
            elif name == "face":
                polygons.append(row.get("vertex_indices") or row.get("vertex_index"))
    return np.array(vertices).reshape(-1, 3), fan(polygons)


def obj_text(comment, vertices, triangles):
    """Text of an OBJ file. Coordinates have the fewest digits from which the same bits are read again."""
    lines = [f"# {comment}"]
    lines += [f"v {x!r} {y!r} {z!r}" for x, y, z in vertices.tolist()]
    lines += [f"f {a} {b} {c}" for a, b, c in (triangles + 1).tolist()]
    return "\n".join(lines) + "\n"

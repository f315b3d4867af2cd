"""Facts of a triangle mesh: edges, volume, components, convexity, and triangles that pierce each other."""

import numpy as np

# Distance of a vertex above the plane of a face up to which a mesh counts as convex, relative to the largest extent of
# the mesh: coordinates in single precision have a relative error of 6e-8, and so have the corners of a flat face.
CONVEX_WITHIN = 1e-6
# Sixfold volume of a tetrahedron below which its corners count as coplanar, relative to the product of the lengths of
# three edges: the error of the determinant in double precision is about 1e-16.
COPLANAR_WITHIN = 1e-13
PAIRS_AT_ONCE = 1 << 20


def facts(vertices, triangles):
    """All facts as a dictionary, in the order of the table."""
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    odd, once = edge_counts(triangles)
    closed = odd == 0
    numbers = components(len(vertices), triangles)
    return {
        "triangles": len(triangles),
        "vertices": len(vertices),
        "closed": closed,
        "bad_edges": odd,
        "border_edges": once,
        "pinched_vertices": pinched_vertices(len(vertices), triangles) if closed else 0,
        "components": int(numbers.max()) + 1,
        "volume": volume(vertices, triangles) if closed else 0.0,
        "area": float(np.linalg.norm(area_vectors(vertices, triangles), axis=1).sum() / 2),
        "extents": (high - low).tolist(),
        "convex": closed and is_convex(vertices, triangles),
        "piercing_pairs": len(piercing_pairs(vertices, triangles)),
        "repeated_triangles": len(triangles) - len(np.unique(np.sort(triangles, axis=1), axis=0)),
    }


def directed_edges(triangles):
    """Edges of all triangles, each in the direction of its triangle."""
    return np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])


def edge_counts(triangles):
    """Number of edges that are not used twice in opposite directions, and the part of them that is used once."""
    edges = directed_edges(triangles)
    forward = edges[:, 0] < edges[:, 1]
    _, at = np.unique(np.sort(edges, axis=1), axis=0, return_inverse=True)
    at = at.reshape(-1)
    along, against = np.bincount(at, forward), np.bincount(at, ~forward)
    return int(((along != 1) | (against != 1)).sum()), int((along + against == 1).sum())


def union(count, pairs):
    """Number of the set of each of `count` things, sets joined by pairs, in the order of their first members."""
    label = np.arange(count)
    while True:
        least = label.copy()
        np.minimum.at(least, pairs[:, 0], label[pairs[:, 1]])
        np.minimum.at(least, pairs[:, 1], label[pairs[:, 0]])
        least = least[least]
        if (least == label).all():
            return np.unique(label, return_inverse=True)[1].reshape(-1)
        label = least


def components(vertex_count, triangles):
    """Component of each triangle: triangles that share a vertex are of one component."""
    of_vertex = union(vertex_count, directed_edges(triangles))
    return np.unique(of_vertex[triangles[:, 0]], return_inverse=True)[1].reshape(-1)


def pinched_vertices(vertex_count, triangles):
    """Number of vertices of a closed mesh whose triangles form more than one fan."""
    corner = np.arange(3 * len(triangles)).reshape(-1, 3)
    ends = {}
    pairs = []
    for (a, b, c), (at_a, at_b, at_c) in zip(triangles.tolist(), corner.tolist()):
        for start, end, at_start, at_end in ((a, b, at_a, at_b), (b, c, at_b, at_c), (c, a, at_c, at_a)):
            other = ends.pop((end, start), None)
            if other is None:
                ends[start, end] = (at_start, at_end)
            else:
                pairs += [(at_start, other[1]), (at_end, other[0])]
    fans = union(corner.size, np.array(pairs))
    return int(fans.max()) + 1 - len(np.unique(triangles))


def area_vectors(vertices, triangles):
    """Normal of each triangle times twice its area."""
    a, b, c = (vertices[triangles[:, i]] for i in range(3))
    return np.cross(b - a, c - a)


def volume(vertices, triangles):
    """Signed volume of a closed mesh: positive if its triangles face outward."""
    a, b, c = (vertices[triangles[:, i]] - vertices.mean(axis=0) for i in range(3))
    return float((np.cross(a, b) * c).sum() / 6)


def is_convex(vertices, triangles):
    """Tests whether no vertex of a closed mesh is above the plane of a triangle."""
    normals = area_vectors(vertices, triangles)
    lengths = np.linalg.norm(normals, axis=1)
    extent = np.ptp(vertices, axis=0).max()
    for start in range(0, len(triangles), 256):
        some = slice(start, start + 256)
        offsets = (normals[some] * vertices[triangles[some, 0]]).sum(axis=1)
        above = vertices @ normals[some].T - offsets
        if (above > CONVEX_WITHIN * extent * lengths[some]).any():
            return False
    return True


def candidate_pairs(vertices, triangles):
    """Pairs of triangles whose bounding boxes overlap, lower index first, found by a sweep along the longest axis."""
    corners = vertices[triangles]
    low, high = corners.min(axis=1), corners.max(axis=1)
    axis = np.argmax(np.ptp(vertices, axis=0))
    order = np.argsort(low[:, axis], kind="stable")
    low, high = low[order], high[order]
    last = np.searchsorted(low[:, axis], high[:, axis], side="right")
    counts = last - np.arange(len(order)) - 1
    ends = np.cumsum(counts)
    start = 0
    while start < len(order):
        before = ends[start - 1] if start else 0
        stop = max(start + 1, int(np.searchsorted(ends, before + PAIRS_AT_ONCE, side="right")))
        some = counts[start:stop]
        first = np.repeat(np.arange(start, stop), some)
        second = first + 1 + np.arange(some.sum()) - np.repeat(np.cumsum(some) - some, some)
        meet = ((low[first] <= high[second]) & (low[second] <= high[first])).all(axis=1)
        yield np.sort(np.stack([order[first[meet]], order[second[meet]]], axis=1), axis=1)
        start = stop


def side(a, b, c, p):
    """Sign of the volume of the tetrahedron a b c p, zero where the four points count as coplanar."""
    u, v, w = b - a, c - a, p - a
    determinant = (np.cross(u, v) * w).sum(axis=1)
    scale = np.linalg.norm(u, axis=1) * np.linalg.norm(v, axis=1) * np.linalg.norm(w, axis=1)
    return np.where(np.abs(determinant) > COPLANAR_WITHIN * scale, np.sign(determinant), 0)


def pierces(start, end, a, b, c):
    """Tests whether the inside of a line segment crosses the inside of a triangle."""
    through = side(a, b, c, start) * side(a, b, c, end) < 0
    turns = side(start, end, a, b), side(start, end, b, c), side(start, end, c, a)
    return through & (turns[0] != 0) & (turns[0] == turns[1]) & (turns[1] == turns[2])


def piercing_pairs(vertices, triangles):
    """Pairs of triangles of which an edge of one crosses the inside of the other. Triangles that only touch, or overlap
    in one plane, do not count."""
    found = [np.empty((0, 2), dtype=np.int64)]
    for pairs in candidate_pairs(vertices, triangles):
        hit = np.zeros(len(pairs), dtype=bool)
        for one, other in ((0, 1), (1, 0)):
            a, b, c = (vertices[triangles[pairs[:, one], i]] for i in range(3))
            edges = [vertices[triangles[pairs[:, other], i]] for i in range(3)]
            for i in range(3):
                hit |= pierces(edges[i], edges[(i + 1) % 3], a, b, c)
        found.append(pairs[hit])
    return np.unique(np.concatenate(found), axis=0)

"""Pairs of convex solids at given poses, for every engine the same. Writes them as JSON:

    python3 solids_cases.py solids_pairs.json

`shapes` holds vertices (m) and triangles (outward), and for a box also its half edges. Each of `cases` names two shapes
and holds poses of both bodies in a common frame: position (m) and quaternion (w, x, y, z) of the first body, then of
the second. `overlap` is true if the bodies overlap at all of these poses. Needs numpy.
"""

import itertools
import json
import sys

import numpy as np

POSES = 32
HALF = 0.1  # of the edge of a box, m
HULL_AXES = (0.12, 0.1, 0.08)  # half axes of the ellipsoid that carries the vertices of a hull, m
HULL_FACES = (12, 32)
DEPTH = 1e-4  # m
GAP = 5e-3  # between separated bodies, m
LATERAL = 0.05  # most offset of a body along the face that it lies on, m
SEED = 12
DIGITS = 13


def turn(axis, angle):
    """Rotation matrix about a unit vector."""
    x, y, z = axis
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


def quaternion(r):
    """Unit quaternion (w, x, y, z) of a rotation matrix, as eigenvector of the largest eigenvalue."""
    k = np.array(
        [
            [r[0, 0] + r[1, 1] + r[2, 2], r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]],
            [0, r[0, 0] - r[1, 1] - r[2, 2], r[0, 1] + r[1, 0], r[0, 2] + r[2, 0]],
            [0, 0, r[1, 1] - r[0, 0] - r[2, 2], r[1, 2] + r[2, 1]],
            [0, 0, 0, r[2, 2] - r[0, 0] - r[1, 1]],
        ]
    )
    q = np.linalg.eigh(k + np.triu(k, 1).T)[1][:, 3]
    return q if q[0] >= 0 else -q


def random_rotation(random):
    """Uniformly distributed rotation."""
    q, r = np.linalg.qr(random.standard_normal((3, 3)))
    q = q * np.sign(np.diag(r))
    return q if np.linalg.det(q) > 0 else -q


def facing(normal, other, random):
    """Rotation that carries the unit vector `normal` to the opposite of `other`, with a random turn about it."""
    axes = [np.linalg.svd(v.reshape(1, 3))[2] for v in (normal, other)]
    base = [np.array([a[1], np.cross(v, a[1]), v]) for a, v in zip(axes, (normal, other))]
    half = np.diag([1, -1, -1]) @ base[0]
    return turn(other, random.uniform(0, 2 * np.pi)) @ base[1].T @ half


def box():
    """Box with its corners and twelve triangles."""
    corners = np.array(list(itertools.product((-HALF, HALF), repeat=3)))
    return {"half": [HALF] * 3, "vertices": corners, "triangles": hull_triangles(corners)}


def hull_triangles(points):
    """Outward triangles of the convex hull of points; a face with more than three corners becomes a fan."""
    center, faces = points.mean(axis=0), {}
    for a, b, c in itertools.combinations(range(len(points)), 3):
        normal = np.cross(points[b] - points[a], points[c] - points[a])
        length = np.linalg.norm(normal)
        if length < 1e-12:
            continue
        normal = normal / length * np.sign(normal @ (points[a] - center))
        heights = points @ normal - points[a] @ normal
        if heights.max() < 1e-12:
            faces[tuple(np.flatnonzero(heights > -1e-12))] = normal
    triangles = []
    for corners, normal in faces.items():
        across = np.linalg.svd(normal.reshape(1, 3))[2][1]
        spokes = points[list(corners)] - points[list(corners)].mean(axis=0)
        ring = np.argsort(np.arctan2(spokes @ np.cross(normal, across), spokes @ across))
        ring = [corners[i] for i in ring]
        triangles += [[ring[0], ring[i], ring[i + 1]] for i in range(1, len(ring) - 1)]
    return np.array(triangles)


def hull(faces, random):
    """Convex hull with `faces` triangles. Its vertices lie on an ellipsoid, far enough from each other that no triangle
    is a sliver."""
    while True:
        unit = random.standard_normal((faces // 2 + 2, 3))
        unit /= np.linalg.norm(unit, axis=1)[:, None]
        for _ in range(60):  # the points repel each other
            away = unit[:, None] - unit[None]
            away /= (np.linalg.norm(away, axis=2) ** 3 + np.eye(len(unit)))[..., None]
            unit += 0.02 * away.sum(axis=1)
            unit /= np.linalg.norm(unit, axis=1)[:, None]
        points = unit * HULL_AXES
        triangles = hull_triangles(points)
        if len(triangles) == faces:
            return {"vertices": points, "triangles": triangles}


def face(shape, index):
    """Centre and outward unit normal of a triangle of a shape."""
    a, b, c = shape["vertices"][shape["triangles"][index]]
    normal = np.cross(b - a, c - a)
    return (a + b + c) / 3, normal / np.linalg.norm(normal)


def box_pose(kind, random):
    """Pose of a box in the frame of an equal one: its lowest feature is `DEPTH` below the upper face, or `GAP` above."""
    z, up = np.array([0.0, 0, 1]), HALF
    rotation = np.eye(3)
    offset = np.append(random.uniform(-LATERAL, LATERAL, 2), 0)
    if kind == "turned":
        rotation = turn(z, random.uniform(0, 2 * np.pi))
    elif kind == "edge on face":
        rotation = turn(z, random.uniform(0, 2 * np.pi)) @ turn((1, 0, 0), np.pi / 4)
    elif kind == "corner on face":
        rotation = turn(z, random.uniform(0, 2 * np.pi)) @ turn((1, 0, 0), np.arctan(np.sqrt(2))) @ turn(z, np.pi / 4)
    elif kind == "apart":
        rotation = random_rotation(random)
    if kind == "edge on edge":
        # The target's edge at y = z = HALF, crossed by the mover's opposite edge.
        normal = np.array([0, 1, 1]) / np.sqrt(2)
        rotation = turn(normal, random.uniform(0.3, np.pi - 0.3))
        offset, up, z = np.array([random.uniform(-LATERAL, LATERAL), 0, 0]), HALF * np.sqrt(2), normal
    lowest = (box()["vertices"] @ rotation.T @ z).min()
    height = up - lowest + (GAP if kind == "apart" else -DEPTH)
    return offset + height * z, rotation


def hull_pose(kind, shape, random):
    """Pose of a hull in the frame of an equal hull, at the middle of one of its triangles."""
    center, normal = face(shape, random.integers(len(shape["triangles"])))
    vertices = shape["vertices"]
    if kind == "face on face":
        own_center, own_normal = face(shape, random.integers(len(shape["triangles"])))
        rotation = facing(own_normal, normal, random)
        return center - DEPTH * normal - rotation @ own_center, rotation
    rotation = random_rotation(random)
    carried = vertices @ rotation.T
    lowest = carried[np.argmin(carried @ normal)]
    return center + (GAP if kind == "apart" else -DEPTH) * normal - lowest, rotation


def case(first, kind, shape, random):
    """Poses of a mover and a target, the target anywhere."""
    poses = []
    for _ in range(POSES):
        position, rotation = box_pose(kind, random) if first == "box" else hull_pose(kind, shape, random)
        frame, origin = random_rotation(random), random.uniform(-1, 1, 3)
        mover = np.concatenate([origin + frame @ position, quaternion(frame @ rotation)])
        target = np.concatenate([origin, quaternion(frame)])
        poses.append([round(float(x), DIGITS) for x in np.concatenate([mover, target])])
    return {"name": f"{first}, {kind}", "first": first, "second": first, "overlap": kind != "apart", "poses": poses}


def everything():
    """Shapes and cases, ready for JSON."""
    random = np.random.Generator(np.random.PCG64(SEED))
    shapes = {"box": box()} | {f"hull {faces}": hull(faces, random) for faces in HULL_FACES}
    box_kinds = ("face on face", "turned", "edge on face", "edge on edge", "corner on face", "apart")
    kinds = {name: box_kinds if name == "box" else ("face on face", "corner on face", "apart") for name in shapes}
    cases = [case(name, kind, shapes[name], random) for name in shapes for kind in kinds[name]]
    for shape in shapes.values():
        shape["vertices"] = np.round(shape["vertices"], DIGITS).tolist()
        shape["triangles"] = shape["triangles"].tolist()
    return {"unit": "m", "shapes": shapes, "cases": cases}


def text(data):
    """JSON with one row of numbers a line."""
    rows = json.dumps(data, indent=1)
    lines, row = [], None
    for line in rows.splitlines():
        bare = line.strip()
        number = bare.rstrip(",").lstrip("-").replace(".", "").replace("e-", "").isdigit()
        if row is None and number and lines[-1].rstrip().endswith("["):
            row = [lines.pop(), bare]
        elif row is not None:
            row.append(bare)
            if bare in ("]", "],"):
                lines.append(row[0] + " ".join(row[1:-1]) + row[-1])
                row = None
        else:
            lines.append(line)
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    with open(sys.argv[1], "w", encoding="utf-8") as out:
        out.write(text(everything()))

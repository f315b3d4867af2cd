# SPDX-License-Identifier: GPL-3.0-or-later
"""The connected pieces of a mesh."""

from __future__ import annotations

import numpy as np


def weld(vertices: np.ndarray) -> np.ndarray:
    """First vertex at the same position for each vertex, to the last bit."""
    _, first, inverse = np.unique(vertices + 0.0, axis=0, return_index=True, return_inverse=True)
    return first[inverse.ravel()]


def edges(face: list[int]) -> list[tuple[int, int]]:
    return list(zip(face, face[1:] + face[:1]))


def pieces_of(vertices: np.ndarray, faces: list[np.ndarray]) -> list[list[int]]:
    """Faces by piece, each in rising order, pieces in the order of their first face.

    Faces that share a vertex belong together. Where that leaves open pieces (every face of some files has vertices of
    its own), vertices at the same place count as one for these; closed pieces may touch each other and stay apart.
    """
    pieces = connected(faces)
    open_ = [piece for piece in pieces if not is_closed([faces[i] for i in piece])]
    if len(open_) > 1:
        welded = weld(vertices)
        loose = sorted(i for piece in open_ for i in piece)
        joined = [[loose[k] for k in piece] for piece in connected([welded[faces[i]] for i in loose])]
        pieces = [piece for piece in pieces if piece not in open_] + joined
    return sorted(pieces)


def is_closed(faces: list[np.ndarray]) -> bool:
    seen: set[tuple[int, int]] = set()
    for face in faces:
        seen.update(edges(face.tolist()))
    return all((b, a) in seen for a, b in seen)


def connected(faces: list[np.ndarray]) -> list[list[int]]:
    leader: dict[int, int] = {}

    def find(vertex: int) -> int:
        while leader.setdefault(vertex, vertex) != vertex:
            leader[vertex] = leader[leader[vertex]]
            vertex = leader[vertex]
        return vertex

    for face in faces:
        first = find(int(face[0]))
        for vertex in face[1:].tolist():
            leader[find(vertex)] = first
    pieces: dict[int, list[int]] = {}
    for index, face in enumerate(faces):
        pieces.setdefault(find(int(face[0])), []).append(index)
    return list(pieces.values())


def islands(vertices: np.ndarray, links: np.ndarray) -> list[np.ndarray]:
    """Vertices by connected piece, in the order of their first ones; coincident vertices count as one.

    `links`: pairs of vertices that are connected, (n, 2). Vertices without any are left out.
    """
    links = weld(vertices)[np.asarray(links, dtype=np.int64).reshape(-1, 2)]
    leader = np.arange(len(vertices))
    while True:
        ends = leader[links]
        lowest = ends.min(axis=1)
        if (ends[:, 0] == ends[:, 1]).all():
            break
        np.minimum.at(leader, ends.ravel(), np.repeat(lowest, 2))
        while (leader[leader] != leader).any():
            leader = leader[leader]
    used = np.unique(links)
    groups = np.unique(leader[used])
    return [used[leader[used] == group] for group in groups]


def apart(vertices: np.ndarray, pieces: list[np.ndarray]) -> list[np.ndarray]:
    """Pieces that do not lie inside the box of another one, unlike the inner wall of a hollow ball."""
    if len(pieces) < 2:
        return pieces
    low = np.array([vertices[piece].min(axis=0) for piece in pieces])
    high = np.array([vertices[piece].max(axis=0) for piece in pieces])
    outer = []
    for index, piece in enumerate(pieces):
        around = (low <= low[index]).all(axis=1) & (high >= high[index]).all(axis=1)
        around[index] = False
        same = around & (low == low[index]).all(axis=1) & (high == high[index]).all(axis=1)
        if not (around & ~same).any() and not same[:index].any():
            outer.append(piece)
    return outer

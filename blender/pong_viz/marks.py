# SPDX-License-Identifier: GPL-3.0-or-later
"""What contacts look like: arrows of force, marks of stick and slip. Numpy only."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .log import Log
from .timeline import Film, View, from_z

STICK = (0.10, 0.75, 0.25, 1.0)  # colour of a contact whose friction sticks
SLIP = (0.95, 0.25, 0.10, 1.0)  # and of one that slips
TOUCHED = (1.0, 0.55, 0.02)  # of a primitive while it touches


@dataclass
class Slots:
    """As many marks as the fullest picture needs; contact k of a picture is shown by slot k. Axes (picture, slot)."""

    shown: np.ndarray  # bool
    points: np.ndarray  # (.., 3)
    turns: np.ndarray  # (.., 4): takes +z to the direction of the force
    forces: np.ndarray  # N
    sticks: np.ndarray  # bool
    left_out: int  # contacts of no slot, over all pictures


def slots(log: Log, film: Film, seen: View, most: int = 64) -> Slots:
    """The contacts of each picture, those with the largest forces first if there are more than `most`.

    The force is that on the first object of the pair; its opposite acts on the second.
    """
    rows, inverse = np.unique(film.rows, return_inverse=True)
    listed = {int(row): _largest(log.contacts_of(int(row)), most) for row in rows}
    most_shown = max((len(contacts) for contacts in listed.values()), default=0)
    count = len(film.rows)
    made = Slots(
        shown=np.zeros((count, most_shown), dtype=bool),
        points=np.zeros((count, most_shown, 3)),
        turns=np.tile([1.0, 0.0, 0.0, 0.0], (count, most_shown, 1)),
        forces=np.zeros((count, most_shown)),
        sticks=np.zeros((count, most_shown), dtype=bool),
        left_out=sum(max(0, int(log.frames["contacts"][rows[i]]) - most) for i in inverse),
    )
    for picture, row in enumerate(film.rows):
        contacts = listed[int(row)]
        forces = _signs(log, contacts)[:, None] * _forces(contacts)
        for slot, contact in enumerate(contacts):
            _fill(made, picture, slot, contact, forces[slot], seen)
    return made


def _fill(made: Slots, picture: int, slot: int, contact, force, seen: View) -> None:
    size = float(np.linalg.norm(force))
    direction = force if size > 0.0 else contact["normal"]
    made.shown[picture, slot] = True
    made.points[picture, slot] = seen.point(contact["point"], picture)
    made.turns[picture, slot] = from_z(seen.direction(direction, picture))
    made.forces[picture, slot] = size
    made.sticks[picture, slot] = bool(contact["sticks"])


def _forces(contacts: np.ndarray) -> np.ndarray:
    return contacts["normal_force"][:, None] * contacts["normal"] + contacts["friction_force"]


def _signs(log: Log, contacts: np.ndarray) -> np.ndarray:
    """1 where A belongs to the first object of the pair, else -1."""
    owner = np.array([log.run["bodies"][p.body]["object"] for p in log.primitives] or [0])
    first = np.array([pair[0] for pair in log.run["pairs"]] or [0])
    return np.where(owner[contacts["primitive_a"]] == first[contacts["pair"]], 1.0, -1.0)


def _largest(contacts: np.ndarray, most: int) -> np.ndarray:
    contacts = np.array(contacts)
    if len(contacts) <= most:
        return contacts
    sizes = np.linalg.norm(_forces(contacts), axis=1)
    return contacts[np.sort(np.argsort(-sizes, kind="stable")[:most])]


def touched(log: Log, film: Film, primitive: int) -> np.ndarray:
    """For each picture: whether a primitive touches."""
    rows, inverse = np.unique(film.rows, return_inverse=True)

    def touches(row: int) -> bool:
        contacts = log.contacts_of(row)
        return bool(np.any(contacts["primitive_a"] == primitive) or np.any(contacts["primitive_b"] == primitive))

    return np.array([touches(int(row)) for row in rows])[inverse]


def largest_force(log: Log) -> float:
    """The largest force of any contact in the run, N."""
    first = int(log.frames["first_contact"][0])
    last = int(log.frames["first_contact"][-1]) + int(log.frames["contacts"][-1])
    largest = 0.0
    for begin in range(first, last, 65536):
        rows = log.contacts[begin:min(begin + 65536, last)]
        largest = max(largest, float(np.linalg.norm(_forces(rows), axis=1).max(initial=0.0)))
    return largest


def arrow(around: int = 12) -> tuple[np.ndarray, list]:
    """An arrow of unit length along +z from the origin; its head starts at 0.75."""
    angles = np.linspace(0.0, 2.0 * np.pi, around, endpoint=False)
    circle = np.stack([np.cos(angles), np.sin(angles), np.zeros(around)], axis=1)
    up = np.array([0.0, 0.0, 1.0])
    rings = [0.03 * circle, 0.03 * circle + 0.75 * up, 0.08 * circle + 0.75 * up]
    vertices = np.concatenate([*rings, [up]])
    faces = [tuple(range(around - 1, -1, -1))]
    for ring in range(2):
        faces += [(ring * around + i, ring * around + (i + 1) % around, (ring + 1) * around + (i + 1) % around,
                   (ring + 1) * around + i) for i in range(around)]
    faces += [(2 * around + i, 2 * around + (i + 1) % around, 3 * around) for i in range(around)]
    return vertices, faces

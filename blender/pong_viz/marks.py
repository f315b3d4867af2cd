# SPDX-License-Identifier: GPL-3.0-or-later
"""Appearance of contacts: arrows of force, marks of stick and slip, patches of solids. Numpy only."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from . import patches
from .log import Log
from .timeline import Film, View, from_z, turned

STICK = (0.10, 0.75, 0.25, 1.0)  # colour of a contact whose friction sticks
SLIP = (0.95, 0.25, 0.10, 1.0)  # and of one that slips
TOUCHED = (1.0, 0.55, 0.02)  # of a primitive while it touches


@dataclass
class Slots:
    """Marks for the picture with the most contacts; slot k shows contact k of a picture. Axes (picture, slot)."""

    shown: np.ndarray  # bool
    points: np.ndarray  # (.., 3)
    turns: np.ndarray  # (.., 4): takes +z to the direction of the force
    tangents: np.ndarray  # (.., 4): takes +z to the normal of the contact
    forces: np.ndarray  # N
    sticks: np.ndarray  # bool
    areas: np.ndarray  # of patches of solids, m²; 0 for other contacts
    left_out: int  # contacts of no slot, over all pictures

    @property
    def pressures(self) -> np.ndarray:
        """Pressure of each patch, Pa; 0 for other contacts."""
        return np.divide(self.forces, self.areas, out=np.zeros_like(self.forces), where=self.areas > 0.0)

    @property
    def pressure_scale(self) -> float:
        """Pressure of the last colour of patches, Pa; 0 without patches."""
        return patches.scale(self.pressures[self.areas > 0.0])

    def tips(self, metres_per_newton: float) -> np.ndarray:
        """Ends of all displayed arrows, (n, 3)."""
        ways = turned(self.turns[self.shown], np.broadcast_to([0.0, 0.0, 1.0], (int(self.shown.sum()), 3)))
        return self.points[self.shown] + metres_per_newton * self.forces[self.shown][:, None] * ways


def slots(log: Log, film: Film, seen: View, most: int = 64) -> Slots:
    """Contacts of each picture, those with the largest forces first if there are more than `most`.

    The force is that on the first object of the pair; its opposite acts on the second.
    """
    in_picture = [patches.merged(log.contacts_of(int(row))) for row in film.rows]
    counts = np.array([len(contacts) for contacts in in_picture], dtype=int)
    made = _hidden(len(film.rows), min(int(counts.max(initial=0)), most))
    made.left_out = int(np.maximum(counts - most, 0).sum())
    owners = _owners(log)
    for picture, merged in enumerate(in_picture):
        contacts = _largest(merged, most)
        if len(contacts):
            _fill(made, picture, contacts, _signs(owners, contacts)[:, None] * contact_forces(contacts), seen)
    return made


def _hidden(pictures: int, count: int) -> Slots:
    no_turn = [1.0, 0.0, 0.0, 0.0]
    return Slots(
        shown=np.zeros((pictures, count), dtype=bool),
        points=np.zeros((pictures, count, 3)),
        turns=np.tile(no_turn, (pictures, count, 1)),
        tangents=np.tile(no_turn, (pictures, count, 1)),
        forces=np.zeros((pictures, count)),
        sticks=np.zeros((pictures, count), dtype=bool),
        areas=np.zeros((pictures, count)),
        left_out=0,
    )


def _fill(made: Slots, picture: int, contacts: np.ndarray, forces: np.ndarray, seen: View) -> None:
    sizes, here = np.linalg.norm(forces, axis=1), (picture, slice(len(contacts)))
    directions = np.where(sizes[:, None] > 0.0, forces, contacts["normal"])
    made.shown[here] = True
    made.points[here] = seen.point(contacts["point"], picture)
    made.turns[here] = from_z(seen.direction(directions, picture))
    made.tangents[here] = from_z(seen.direction(contacts["normal"], picture))
    made.forces[here] = sizes
    made.sticks[here] = contacts["sticks"] != 0
    cells = patches.are_cells(contacts)
    made.areas[here][cells] = contacts["weight"][cells]


def contact_forces(contacts: np.ndarray) -> np.ndarray:
    """Normal force and friction of each contact, N, (n, 3)."""
    return contacts["normal_force"][:, None] * contacts["normal"] + contacts["friction_force"]


def _owners(log: Log) -> tuple[np.ndarray, np.ndarray]:
    """Object of each primitive, and the first object of each pair."""
    objects = [log.run["bodies"][primitive.body]["object"] for primitive in log.primitives]
    return np.array(objects, dtype=int), np.array([first for first, _ in log.pairs], dtype=int)


def _signs(owners: tuple[np.ndarray, np.ndarray], contacts: np.ndarray) -> np.ndarray:
    """1 if A belongs to the first object of the pair, else -1."""
    of_primitive, first = owners
    return np.where(of_primitive[contacts["primitive_a"]] == first[contacts["pair"]], 1.0, -1.0)


def _largest(contacts: np.ndarray, most: int) -> np.ndarray:
    contacts = np.array(contacts)
    if len(contacts) <= most:
        return contacts
    sizes = np.linalg.norm(contact_forces(contacts), axis=1)
    return contacts[np.sort(np.argsort(-sizes, kind="stable")[:most])]


def touched(log: Log, film: Film) -> dict[int, np.ndarray]:
    """Primitive -> contact flag for each picture. Primitives without contact in the film are left out."""
    lit: dict[int, np.ndarray] = {}
    for picture, row in enumerate(film.rows):
        contacts = log.contacts_of(int(row))
        for primitive in np.union1d(contacts["primitive_a"], contacts["primitive_b"]):
            lit.setdefault(int(primitive), np.zeros(len(film.rows), dtype=bool))[picture] = True
    return lit


def largest_force(log: Log) -> float:
    """The largest force of any contact in the run, N."""
    first = int(log.frames["first_contact"][0])
    last = int(log.frames["first_contact"][-1]) + int(log.frames["contacts"][-1])
    largest = 0.0
    for begin in range(first, last, 65536):
        rows = log.contacts[begin:min(begin + 65536, last)]
        largest = max(largest, float(np.linalg.norm(contact_forces(rows), axis=1).max(initial=0.0)))
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

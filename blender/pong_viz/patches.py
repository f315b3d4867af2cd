# SPDX-License-Identifier: GPL-3.0-or-later
"""Patches of solids: cells of one face as one mark, with its area and its pressure. Numpy only."""

from __future__ import annotations

import numpy as np

# Bits 29 to 31 of the `end` of a contact (docs/c_api.md): a cell of B's field, one of A's.
PART_SHIFT, CELLS = 29, (4, 5)
ALIKE = 0.985  # cosine of the largest angle between the normals of cells of one patch
COVERED = 0.98  # share of the patches whose pressure the scale of colours covers
# No pressure to the largest pressure of the scale.
RAMP = np.array([(0.04, 0.03, 0.35, 1.0), (0.27, 0.03, 0.36, 1.0), (0.68, 0.10, 0.15, 1.0), (0.97, 0.38, 0.04, 1.0), (0.9, 0.88, 0.2, 1.0)])


def are_cells(contacts: np.ndarray) -> np.ndarray:
    """True for cells of solids, whose `weight` is an area, m²."""
    if not {"end", "weight"} <= set(contacts.dtype.names or ()):
        return np.zeros(len(contacts), dtype=bool)
    return np.isin(np.asarray(contacts["end"]).astype(np.int64) >> PART_SHIFT, CELLS) & (contacts["weight"] > 0.0)


def merged(contacts: np.ndarray) -> np.ndarray:
    """Contacts with the cells of each patch as one row: of a pair, with normals alike and places nearer than their radii.

    Both solids have cells at one face if both have a field. Areas and forces add; the place is the centre of the forces.
    """
    contacts, cells = np.array(contacts), are_cells(contacts)
    kept: list[int] = []
    for row in np.flatnonzero(cells):
        patch = next((each for each in kept if _is_of(contacts[each], contacts[row])), None)
        if patch is None:
            kept.append(int(row))
        else:
            contacts[patch] = _joined(contacts[patch], contacts[row])
    cells[kept] = False
    return contacts[~cells]


def _is_of(patch, cell) -> bool:
    if patch["pair"] != cell["pair"] or patch["normal"] @ cell["normal"] < ALIKE:
        return False
    return bool(np.linalg.norm(patch["point"] - cell["point"]) <= radii(patch["weight"]) + radii(cell["weight"]))


def _joined(patch, cell):
    patch, force = patch.copy(), patch["normal_force"] + cell["normal_force"]
    shares = (patch["normal_force"] / force, cell["normal_force"] / force) if force > 0.0 else (0.5, 0.5)
    patch["point"] = shares[0] * patch["point"] + shares[1] * cell["point"]
    patch["weight"] += cell["weight"]
    patch["normal_force"] = force
    return patch


def radii(areas) -> np.ndarray:
    """Radii of discs, m."""
    return np.sqrt(np.asarray(areas) / np.pi)


def scale(pressures: np.ndarray) -> float:
    """Pressure of the last colour, Pa; 0 without patches."""
    return float(np.quantile(pressures, COVERED, method="higher")) if len(pressures) else 0.0


def colours(pressures: np.ndarray, largest: float) -> np.ndarray:
    """Colours of pressures on a scale that ends at `largest`, (n, 4)."""
    places = np.clip(np.asarray(pressures) / largest if largest > 0.0 else np.zeros(len(pressures)), 0.0, 1.0) * (len(RAMP) - 1)
    return np.stack([np.interp(places, np.arange(len(RAMP)), RAMP[:, band]) for band in range(4)], axis=-1)

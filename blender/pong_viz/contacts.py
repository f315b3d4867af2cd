# SPDX-License-Identifier: GPL-3.0-or-later
"""Force arrows and contact marks in motion."""

from __future__ import annotations

import numpy as np

from . import marks, shapes
from .animate import action_curves, key
from .bodies import mesh_object

FORCE = (0.75, 0.02, 0.02, 1.0)
MARK_RADIUS, MARK_THICKNESS = 0.045, 0.015  # of a mark, a disc in the tangent plane, as a share of the extent


def show_contacts(stage, shown) -> marks.Slots:
    """Adds arrows and marks for the largest number of simultaneous contacts."""
    largest = marks.largest_force(stage.log)
    length = stage.options.arrow_length or 0.5 * stage.extent
    shown.metres_per_newton = length / largest if largest > 0.0 else 0.0
    made = marks.slots(stage.log, shown.film, shown.seen, stage.options.most_contacts)
    if made.left_out:
        shown.notes.append(f"{made.left_out} contacts are not shown, those with the largest forces are; "
                           f"show more than {stage.options.most_contacts} at once with --most-contacts (Contacts)")
    arrow_mesh = mark_mesh = None
    for slot in range(made.shown.shape[1]):
        arrow = mesh_object(stage, f"force {slot}", *marks.arrow(), FORCE, arrow_mesh, see_through=False)
        mark = mesh_object(stage, f"contact {slot}", *shapes.ball(16, 6), marks.STICK, mark_mesh, see_through=False)
        arrow_mesh, mark_mesh = arrow.data, mark.data
        # Forces point into the bodies on which they act.
        arrow.show_in_front = mark.show_in_front = True
        _key_arrow(_key_place(arrow, made, slot, stage.unit), made, slot, shown.metres_per_newton / stage.unit)
        _key_mark(_key_place(mark, made, slot, stage.unit), made, slot)
        mark.rotation_mode = arrow.rotation_mode = "QUATERNION"
        wide, thick = (share * stage.extent / stage.unit for share in (MARK_RADIUS, MARK_THICKNESS))
        mark.scale = (wide, wide, thick)
        shown.arrows.append(arrow)
        shown.marks.append(mark)
    return made


def _key_place(item, made, slot, unit):
    curves, hidden = action_curves(item, f"{item.name} response"), ~made.shown[:, slot]
    key(curves, "location", made.points[:, slot] / unit, constant=True)
    key(curves, "hide_render", hidden, constant=True)
    key(curves, "hide_viewport", hidden, constant=True)
    return curves


def _key_arrow(curves, made, slot, units_per_newton) -> None:
    lengths = made.forces[:, slot] * units_per_newton
    # Thickness grows less than length: small forces stay visible.
    widths = np.sqrt(lengths * lengths.max(initial=0.0))
    key(curves, "rotation_quaternion", made.turns[:, slot], constant=True)
    key(curves, "scale", np.stack([widths, widths, lengths], axis=1), constant=True)


def _key_mark(curves, made, slot) -> None:
    key(curves, "rotation_quaternion", made.tangents[:, slot], constant=True)
    key(curves, "color", np.where(made.sticks[:, slot, None], marks.STICK, marks.SLIP), constant=True)

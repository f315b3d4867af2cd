# SPDX-License-Identifier: GPL-3.0-or-later
"""Force arrows and contact marks in motion."""

from __future__ import annotations

import numpy as np

from . import marks, patches, shapes
from .animate import action_curves, key
from .bodies import mesh_object

FORCE = (0.75, 0.02, 0.02, 1.0)
MARK_RADIUS = 0.045  # of a mark, a disc in the tangent plane, as a share of the extent
MARK_THICKNESS = 1.0 / 3.0  # of a mark, as a share of its radius


def show_contacts(stage, shown) -> marks.Slots:
    """Adds arrows and marks for the largest number of simultaneous contacts."""
    made = marks.slots(stage.log, shown.film, shown.seen, stage.options.most_contacts)
    # The force of a patch may be larger than that of any of its cells.
    largest = max(marks.largest_force(stage.log), float(made.forces.max(initial=0.0)))
    length = stage.options.arrow_length or 0.5 * stage.extent
    shown.metres_per_newton = length / largest if largest > 0.0 else 0.0
    shown.pressure_scale = made.pressure_scale
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
        curves = _key_place(mark, made, slot, stage.unit)
        _key_mark(curves, made, slot, shown.pressure_scale)
        mark.rotation_mode = arrow.rotation_mode = "QUATERNION"
        wide = (stage.options.mark_radius or MARK_RADIUS * stage.extent) / stage.unit
        thick = MARK_THICKNESS * wide
        mark.scale = (wide, wide, thick)
        if made.areas[:, slot].any():
            _key_patch(curves, made, slot, (wide, thick), stage.unit)
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


def _key_mark(curves, made, slot, pressure_scale) -> None:
    key(curves, "rotation_quaternion", made.tangents[:, slot], constant=True)
    friction = np.where(made.sticks[:, slot, None], marks.STICK, marks.SLIP)
    pressure = patches.colours(made.pressures[:, slot], pressure_scale)
    key(curves, "color", np.where(made.areas[:, slot, None] > 0.0, pressure, friction), constant=True)


def _key_patch(curves, made, slot, mark_size, unit) -> None:
    """The size of a slot that holds patches: a disc of the effective area, in other pictures that of a mark."""
    wide, thick = mark_size
    areas = made.areas[:, slot]
    radii = patches.radii(areas) / unit
    sizes = np.stack([radii, radii, np.minimum(thick, 0.1 * radii)], axis=1)
    key(curves, "scale", np.where(areas[:, None] > 0.0, sizes, (wide, wide, thick)), constant=True)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Marked objects -> capsules, cylinders, cones and bores: along the z axis of their object, around its origin."""

from __future__ import annotations

import numpy as np

from . import transforms
from .exact import meant
from .round_pieces import round_bodies, several
from .round_shape import ONE_RADIUS, fault_of, numbers_of, radii_of
from .shape import Shape, thickness_of
from .size_check import check_round

WITHOUT_LENGTH = {"Capsule": "mark it as a Sphere or a Cylinder, make it longer than wide, or give it a length above zero"}
SAME = 1e-14  # of a length: a number that follows from exact ends by other roundings


def build_round(shape: Shape):
    """The only primitive of an object of a round kind."""
    kind, place = shape.kind, shape.place
    numbers = {name: place.number(name) for name in ("radius", "radii", "length")}
    length, radii = float(numbers["length"]), radii_of(kind, numbers)
    pieces = several(shape)
    if pieces is not None:
        options = _options(shape)
        return shape.numbered(kind, [{**fields, **options} for fields in round_bodies(shape, pieces)] if pieces else [])
    sound = _sound(shape, length, radii)
    options = _options(shape)
    if not sound:
        return []
    check_round(shape, radii_of(kind, {"radius": shape.mark.radius, "radii": shape.mark.radii}), shape.mark.length)
    scale = _scale(shape)
    if scale is None:
        return []
    across, along = scale
    radii = (radii[0] * across, radii[1] * across)
    ends = _exact_ends(shape, length) if across == along == 1.0 else None
    fields = {"ends": _ends(shape) if ends is None else ends}
    own = numbers_of(kind, length * along, radii)
    fields |= {name: own[name] for name in ("radius", "radii") if name in own}
    return shape.numbered(kind, [{**fields, **options}])


def _sound(shape: Shape, length: float, radii: tuple[float, float]) -> bool:
    """Checks that the numbers form a valid part."""
    fault = fault_of(shape.mesh.vertices, shape.kind) if shape.mesh is not None else ""
    fix = "fit-round" if shape.mesh is not None and not fault else ""
    lengthy = bool(np.isfinite(length) and length > 0.0)
    if not lengthy:
        cause = f"its length is {length}" + (f": {fault}" if fault else "")
        shape.error("no-length", cause, WITHOUT_LENGTH.get(shape.kind, "give it a length above zero"), fix=fix)
    wide = bool(np.isfinite(radii).all() and min(radii) >= 0.0 and max(radii) > 0.0)
    if not wide and shape.kind in ONE_RADIUS:
        shape.error("no-radius", f"its radius is {radii[0]}", "give it a radius above zero", fix=fix)
    elif not wide:
        cure = "give one end a radius above zero, and the other one zero or more"
        shape.error("no-radius", f"its radii are {radii[0]} and {radii[1]}", cure, fix=fix)
    return lengthy and wide


def _options(shape: Shape) -> dict:
    """Fields that only a bore has."""
    if shape.kind != "Bore":
        return {}
    mouths = tuple(map(bool, shape.mark.mouths))
    return {**thickness_of(shape), **({} if mouths == (True, True) else {"mouths": mouths})}


def _scale(shape: Shape) -> tuple[float, float] | None:
    """Scales of the object's transform across the axis and along it; `None` if the result is not round."""
    linear, kind = shape.place.affine.linear, shape.kind
    if transforms.shear(linear) > transforms.SHEAR_TOLERANCE:
        culprit = shape.place.scaled_parent
        cause = f'it is sheared: it is turned below "{culprit}", which is scaled differently along its axes'
        shape.error("sheared-round", cause, f'apply the scale of "{culprit}"', fix="apply-scale")
        return None
    lengths = transforms.column_lengths(linear)
    lengths = np.where(np.abs(lengths - 1.0) <= transforms.SCALE_TOLERANCE, 1.0, lengths)
    even = lengths if kind == "Capsule" else lengths[:2]
    if np.ptp(even) > transforms.SCALE_TOLERANCE * even.max():
        axes = "x, y and z" if kind == "Capsule" else "x and y"
        shown = ", ".join(f"{s:.6g}" for s in lengths)
        cause = f"its scale is ({shown}), and a {kind} that is scaled differently along {axes} is none"
        shape.error("uneven-round", cause, f"make its scale along {axes} the same, or change the numbers of its mark")
        return None
    return float(lengths[0]), float(lengths[2])


def _ends(shape: Shape):
    """Both ends of the axis in the frame of the group, m."""
    thing = shape.place.thing
    half = float(meant(thing.mark.length, thing.exact.get("length"))) / 2.0
    low, high = (shape.place.points(np.array([[0.0, 0.0, -half], [0.0, 0.0, half]])) + 0.0).tolist()
    return tuple(low), tuple(high)


def _exact_ends(shape: Shape, length: float):
    """Ends as read from a model file, as long as the object is unmoved and of the same length."""
    exact = shape.place.unmoved("ends")
    if exact is None:
        return None
    low, high = np.asarray(exact, dtype=np.float64).reshape(2, 3)
    apart = float(np.sqrt(((high - low) ** 2).sum()))
    if abs(apart - length) > SAME * apart:
        return None
    return tuple(low.tolist()), tuple(high.tolist())

# SPDX-License-Identifier: GPL-3.0-or-later
"""Full precision beside Blender's single precision.

Blender rounds coordinates to 32 bits. Three rules give the number that was meant, in this order:
a stored number that is no 32-bit number is meant as it is; one that is the rounding of an exact number kept beside it
means that one; else it means the shortest decimal that rounds to it: 0.30000001192092896 is 0.3.
"""

from __future__ import annotations

import math

import numpy as np

EXACT_POWER = 22  # powers of ten up to this one are numbers without rounding
ROUNDING = 8 * 2.0**-53  # of the largest number: what a few sums and products in double precision are off


def is_single(x) -> np.ndarray:
    """True for numbers that are exact in 32 bits."""
    x = np.asarray(x, dtype=np.float64)
    return (rounded(x) == x) | np.isnan(x)


def rounded(x) -> np.ndarray:
    """Numbers as stored by Blender."""
    with np.errstate(over="ignore"):
        return np.asarray(x, dtype=np.float64).astype(np.float32).astype(np.float64)


def typed(x) -> np.ndarray:
    """Shortest decimals that round to 32-bit numbers, like float(str(np.float32(x))) for each."""
    x = np.asarray(x, dtype=np.float64)
    flat = x.ravel()
    result = flat.copy()
    open_ = np.flatnonzero(np.isfinite(flat) & (flat != 0.0))
    exponent = np.floor(np.log10(np.abs(flat[open_])))
    # Powers of ten beyond 1e22 are inexact: such numbers take the slow path.
    quick = (exponent <= 22) & (exponent >= -14)
    slow, open_, exponent = open_[~quick], open_[quick], exponent[quick]
    for digits in range(1, 10):
        # An integer below 2^53 over (or times) a power of ten up to 1e22 is rounded once: it is the decimal itself.
        places = digits - 1 - exponent
        scale = 10.0 ** np.abs(places)
        value = flat[open_]
        whole = np.rint(np.where(places >= 0, value * scale, value / scale))
        decimal = np.where(places >= 0, whole / scale, whole * scale)
        found = rounded(decimal) == value
        result[open_[found]] = decimal[found]
        open_, exponent = open_[~found], exponent[~found]
    for index in np.concatenate([open_, slow]):
        result[index] = float(str(np.float32(flat[index])))
    return result.reshape(x.shape)


def meant(stored, exact=None) -> np.ndarray:
    """Exact numbers for stored ones, element by element; `exact` is used where it has the same shape."""
    stored = np.asarray(stored, dtype=np.float64)
    single = is_single(stored)
    result = np.where(single, typed(np.where(single, stored, 0.0)), stored)
    if exact is not None and np.shape(exact) == stored.shape:
        exact = np.asarray(exact, dtype=np.float64)
        fresh = single & (rounded(exact) == stored)
        result = np.where(fresh, exact, result)
    return result


def meant_rows(stored: np.ndarray, exact: np.ndarray | None) -> np.ndarray:
    """Exact vertices, found by index and, after vertices were added, deleted or moved, by value."""
    stored = np.asarray(stored, dtype=np.float64).reshape(-1, 3)
    if exact is None or not len(exact):
        return meant(stored)
    exact = np.asarray(exact, dtype=np.float64).reshape(-1, 3)
    singles = rounded(exact)
    result = meant(stored)
    count = min(len(stored), len(exact))
    same = np.zeros(len(stored), dtype=bool)
    same[:count] = (singles[:count] == stored[:count]).all(axis=1)
    result[same] = exact[: len(stored)][same[:count]] if count < len(stored) else exact[:count][same]
    left = np.flatnonzero(~same)
    if len(left) and len(stored) != len(exact):
        places = {key: row for row, key in reversed(list(enumerate(map(bytes, singles + 0.0))))}
        for index in left:
            row = places.get(bytes(stored[index] + 0.0))
            if row is not None:
                result[index] = exact[row]
    elif len(left):
        result[left] = meant(stored[left], exact[left])
    return result


def without_noise(x, noise: float, spare: int = 1) -> np.ndarray:
    """Decimals that are as near to numbers as `noise`, and the numbers themselves where no short one is.

    A short one has `spare` decimal places less than there is room for above the noise, or fewer. With 3, a number that is
    no decimal is taken for one in a case of a thousand, and moves by no more than the noise.
    """
    x = np.asarray(x, dtype=np.float64)
    result = x.copy()
    if not 0.0 < noise < np.inf:
        return result
    most, open_ = math.ceil(-math.log10(2.0 * noise)) - spare, np.isfinite(x)
    for places in range(most - 2, most + 1):
        if abs(places) > EXACT_POWER:
            continue
        power = 10.0 ** abs(places)
        near = np.rint(x * power) / power if places >= 0 else np.rint(x / power) * power
        found = open_ & (np.abs(near - x) <= noise)
        result[found] = near[found] + 0.0
        open_ &= ~found
    return result


def without_rounding(x, size: float) -> np.ndarray:
    """Results of a few sums and products of numbers up to `size`, rounded to their accuracy: 0.04, not
    0.039999999999999994."""
    return without_noise(x, ROUNDING * size, 3)


def is_fresh(stored, exact) -> bool:
    """True if all exact numbers still belong to the stored ones."""
    if exact is None or np.shape(exact) != np.shape(stored):
        return False
    return bool((rounded(exact) == np.asarray(stored, dtype=np.float64)).all() or np.array_equal(exact, stored))


def needed(values) -> bool:
    """True if numbers must be stored beside Blender's: they are not the shortest decimals of their rounding."""
    values = np.asarray(values, dtype=np.float64)
    return not np.array_equal(typed(rounded(values)), values)


def typed_angle(stored: float) -> float:
    """The typed angle, rad: the shorter of the decimals in radians and in degrees."""
    if not bool(is_single(stored)) or stored == 0.0:
        return float(stored)
    radians = float(typed(stored))
    for digits in range(1, 8):
        degrees = float(f"{np.degrees(stored):.{digits - 1}e}")
        if rounded(np.radians(degrees)) == stored:
            return float(np.radians(degrees)) if digits < _digits(radians) else radians
    return radians


def _digits(x: float) -> int:
    return len(f"{x!r}".split("e")[0].replace("-", "").replace(".", "").strip("0"))

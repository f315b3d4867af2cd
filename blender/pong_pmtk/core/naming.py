# SPDX-License-Identifier: GPL-3.0-or-later
"""Names: their natural order, and unique ones for Blender."""

from __future__ import annotations

import re

_DIGITS = re.compile(r"(\d+)")
RESPONSE = "Pong response"  # begins the names of constraints by which playback moves objects
NAME_BYTES = 63  # what every supported version of Blender keeps of a name


def natural(name: str) -> tuple:
    """Sort key: foot_2 before foot_10, ignoring letter case; different names have different keys."""
    parts = _DIGITS.split(name.casefold())
    return tuple((0, int(part), "") if part.isdecimal() else (1, 0, part) for part in parts), name


class UniqueNames:
    """Allocator of names that Blender keeps: unique, and short enough."""

    def __init__(self):
        self.taken: set[str] = set()

    def take(self, wanted: str) -> str:
        base = shortened(wanted or "object", NAME_BYTES)
        name, count = base, 0
        while name in self.taken:
            count += 1
            suffix = f".{count:03d}"
            name = shortened(base, NAME_BYTES - len(suffix)) + suffix
        self.taken.add(name)
        return name


def shortened(name: str, size: int) -> str:
    return name.encode("utf-8")[:size].decode("utf-8", errors="ignore")

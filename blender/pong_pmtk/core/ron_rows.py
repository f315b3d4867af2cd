# SPDX-License-Identifier: GPL-3.0-or-later
"""Long lists of number tuples, `[(1, 2), (3, 4)]` or `[[0, 1, 2], [3, 4]]`, read at once into flat arrays."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

_LAST_OF_BRACKETED = re.compile(r"\]\s*,?\s*\]")
_NOT_STRUCTURE = b" \t\r\n\x0b\x0c0123456789.+-eE"
_OPEN_TO_BLANK = bytes.maketrans(b"()[]", b"    ")


@dataclass
class Rows:
    """All numbers of the rows, and where each row ends among them."""

    numbers: np.ndarray
    ends: np.ndarray
    text: str
    start: int
    end: int  # index of the character behind the list

    def __len__(self) -> int:
        return len(self.ends)

    def width(self) -> int | None:
        """How many numbers every row has; `None` if they differ."""
        count = len(self.ends)
        if count and len(self.numbers) % count == 0:
            width = len(self.numbers) // count
            if np.array_equal(self.ends, np.arange(1, count + 1) * width):
                return width
        return None

    def row(self, index: int) -> np.ndarray:
        start = self.ends[index - 1] if index else 0
        return self.numbers[start : self.ends[index]]

    def row_at(self, index: int) -> int:
        """Index of the character at which a row begins."""
        opening = self.text[self.start]
        here = self.start
        for _ in range(index):
            here = self.text.index(opening, here + 1)
        return here


def read_rows(text: str, start: int) -> Rows | None:
    """The rows of the list whose first item begins at `start`, or `None` if it holds anything else."""
    opening = text[start : start + 1]
    if opening == "(":
        close = text.find("]", start)
    elif opening == "[":
        match = _LAST_OF_BRACKETED.search(text, start)
        close = match.end() - 1 if match else -1
    else:
        return None
    if close < 0:
        return None
    body = text[start:close]
    if not body.isascii():
        return None
    raw = body.encode("ascii")
    widths = _widths(raw.translate(None, _NOT_STRUCTURE), opening.encode("ascii"))
    if widths is None:
        return None
    numbers = _numbers(raw)
    ends = np.cumsum(widths)
    if numbers is None or len(numbers) != ends[-1]:
        return None
    return Rows(numbers, ends, text, start, close + 1)


def _widths(skeleton: bytes, opening: bytes) -> np.ndarray | None:
    """How many numbers each row has, from the brackets and commas alone; `None` if they do not fit together."""
    closing = b")" if opening == b"(" else b"]"
    skeleton = skeleton[:-1] if skeleton.endswith(b",") else skeleton
    first = skeleton[: skeleton.find(closing) + 1]
    count = skeleton.count(closing)
    if skeleton + b"," == (first + b",") * count and re.fullmatch(re.escape(opening) + b",*.", first):
        return np.full(count, len(first) - 1)
    row = re.escape(opening) + b",*" + re.escape(closing)
    if not re.fullmatch(row + b"(?:," + row + b")*", skeleton):
        return None
    marks = np.frombuffer(skeleton, dtype=np.uint8)
    return np.flatnonzero(marks == closing[0]) - np.flatnonzero(marks == opening[0])


def _numbers(raw: bytes) -> np.ndarray | None:
    tokens = raw.translate(_OPEN_TO_BLANK).rstrip()
    tokens = tokens[:-1] if tokens.endswith(b",") else tokens
    try:
        return np.array(list(map(float, tokens.split(b","))))
    except ValueError:
        return None

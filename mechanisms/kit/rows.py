"""Table of measured values beside closed-form predictions; the program fails if one is off."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Row:
    what: str
    measured: float
    predicted: float
    within: float  # of the predicted value, or absolute where that is zero
    unit: str = ""

    @property
    def holds(self):
        room = self.within * (abs(self.predicted) or 1.0)
        return abs(self.measured - self.predicted) <= room


@dataclass(frozen=True)
class Limit:
    """An upper limit or, with `least`, a lower limit."""

    what: str
    measured: float
    limit: float
    unit: str = ""
    least: bool = False

    @property
    def holds(self):
        return self.measured >= self.limit if self.least else self.measured <= self.limit


@dataclass(frozen=True)
class Fact:
    what: str
    holds: bool


def line(row):
    mark = "ok " if row.holds else "OFF"
    if isinstance(row, Fact):
        return f"{mark}  {row.what}: {'yes' if row.holds else 'no'}"
    if isinstance(row, Limit):
        relation = ">=" if row.least else "<="
        return f"{mark}  {row.what}: {row.measured:.6g} {relation} {row.limit:.6g} {row.unit}".rstrip()
    return f"{mark}  {row.what}: {row.measured:.6g} for {row.predicted:.6g} {row.unit} (within {row.within:g})"


def show(title, rows):
    """Prints the rows; returns the number of failures."""
    off = 0
    print(f"== {title}")
    for row in rows:
        print("   " + line(row), flush=True)
        off += not row.holds
    return off

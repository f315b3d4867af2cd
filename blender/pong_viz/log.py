# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads response logs (docs/response_logs.md). Numpy only; tables are mapped, not loaded."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

FORMAT, VERSIONS = "pong-log", (1, 2)  # What is read here has the same names in both.
# Columns of each table that playback needs.
FIELDS = {
    "frames": {"frame", "time", "first_contact", "contacts"},
    "states": {"position", "orientation"},
    "contacts": {"pair", "primitive_a", "primitive_b", "sticks", "point", "normal", "normal_force", "friction_force"},
}


class LogError(Exception):
    """A log that cannot be played; the text names the file, the cause and the cure."""


@dataclass(frozen=True)
class Body:
    """A movable group of an object."""

    name: str  # `object`, or `object/path below the root`
    object: str
    model: int  # index in Log.models
    path: str  # of the group in its model
    parent: int | None


@dataclass(frozen=True)
class Primitive:
    body: int
    path: str
    kind: str


class Log:
    """One log folder. All arrays have one row for each complete frame."""

    def __init__(self, folder: str | Path):
        """`folder` may also be the run.json in it."""
        given = Path(folder)
        self.folder = given.parent if given.name == "run.json" else given
        self.notes: list[str] = []  # what is missing though the log can be played
        self.run = _read_run(self.folder)
        try:
            self.models = [self.folder / entry["file"] for entry in self.run["models"]]
            self.bodies = [self._body(entry) for entry in self.run["bodies"]]
            self.primitives = [Primitive(p["body"], p["path"], p["kind"]) for p in self.run["primitives"]]
            self.pairs = [(int(first), int(second)) for first, second in self.run["pairs"]]
        except (KeyError, IndexError, TypeError, ValueError) as reason:
            raise LogError(f"{self.folder / 'run.json'}: it is damaged ({reason!r}); record the run again") from None
        frames = self._table("frames")
        self.states = self._table("states")
        self.contacts = self._table("contacts")
        self.frames = frames[:self._complete(frames)]
        self.times = np.asarray(self.frames["time"])
        if self.states.shape[1:] != (len(self.bodies),):
            raise LogError(f"{self.folder}/states.npy: it has {self.states.shape[1:]} columns for {len(self.bodies)} bodies; "
                           "the table is of another run: restore the folder")
        self._tell_what_is_missing(len(frames))

    def _complete(self, frames: np.ndarray) -> int:
        """Number of frames that are complete in all tables; some tables of an interrupted run may have more rows."""
        ends = frames["first_contact"].astype(np.int64) + frames["contacts"]
        complete = min(len(frames), len(self.states), int(np.searchsorted(ends, len(self.contacts), side="right")))
        if complete == 0:
            raise LogError(f"{self.folder}: the log has no complete frame; record for longer, or close the log")
        return complete

    def _tell_what_is_missing(self, frames: int) -> None:
        if len(self.frames) < frames:
            self.notes.append(f"{frames - len(self.frames)} frames at the end are not whole and are left out")
        if not self.run.get("finished", False):
            self.notes.append(f"the run was cut off, or still goes on; it is shown until t = {self.times[-1]:.6g} s")
        if self.run.get("lost"):
            self.notes.append(f"the writer lost {self.run['lost']} frames; motion is straight across the gaps")

    def contacts_of(self, row: int) -> np.ndarray:
        """Rows of the contact table for a row of `frames`."""
        first = int(self.frames["first_contact"][row])
        return self.contacts[first:first + int(self.frames["contacts"][row])]

    def pairs_that_touch(self) -> list[tuple[int, int]]:
        """The two objects of each pair with a contact in the run."""
        first = int(self.frames["first_contact"][0])
        last = int(self.frames["first_contact"][-1]) + int(self.frames["contacts"][-1])
        return [self.pairs[number] for number in np.unique(self.contacts["pair"][first:last])]

    def _body(self, entry: dict) -> Body:
        owner = self.run["objects"][entry["object"]]
        return Body(entry["name"], owner["name"], owner["model"], entry["path"], entry.get("parent"))

    def _table(self, name: str) -> np.ndarray:
        """Rows counted by the header and present in the file."""
        path = self.folder / f"{name}.npy"
        try:
            with path.open("rb") as file:
                version = np.lib.format.read_magic(file)
                read_header = {(1, 0): np.lib.format.read_array_header_1_0, (2, 0): np.lib.format.read_array_header_2_0}
                shape, _, dtype = read_header[version](file)
                start = file.tell()
        except FileNotFoundError:
            raise LogError(f"{path}: it is missing; copy the whole folder of the log") from None
        except (ValueError, KeyError) as reason:
            raise LogError(f"{path}: it is no NumPy table ({reason}); record the run again") from None
        missing = FIELDS[name] - set(dtype.names or ())
        if missing or not shape:
            raise LogError(f"{path}: it lacks {', '.join(sorted(missing)) or 'rows'}; the table is not one of a response log")
        row = dtype.itemsize * math.prod(shape[1:])
        held = min(shape[0], (path.stat().st_size - start) // row if row else 0)
        if held < shape[0]:
            self.notes.append(f"{path}: it is cut off; {held} of {shape[0]} rows are there")
        if held == 0:
            return np.empty((0, *shape[1:]), dtype)  # nothing cannot be mapped
        return np.memmap(path, dtype, "r", start, (held, *shape[1:]))


def _read_run(folder: Path) -> dict:
    path = folder / "run.json"
    try:
        run = json.loads(path.read_text(encoding="utf-8"))
    except (FileNotFoundError, NotADirectoryError):
        raise LogError(f"{folder}: there is no run.json; name the folder that `pong run --log` wrote") from None
    except (ValueError, OSError) as reason:
        raise LogError(f"{path}: it is damaged ({reason}); record the run again") from None
    if not isinstance(run, dict) or run.get("format") != FORMAT:
        raise LogError(f"{path}: `format` is not {FORMAT!r}: this is no response log")
    if run.get("version") not in VERSIONS:
        raise LogError(f"{path}: version {run.get('version')} is not known here, only {VERSIONS[0]} to {VERSIONS[-1]}; get a newer pong_viz")
    return run

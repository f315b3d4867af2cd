# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads response logs (docs/response_logs.md). Numpy only; tables are mapped, not loaded."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np

FORMAT, VERSION = "pong-log", 1


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
    """One log folder. All arrays have one row for each frame that is complete."""

    def __init__(self, folder: str | Path):
        self.folder = Path(folder)
        self.run = _read_run(self.folder)
        frames = self._table("frames")
        # Tables are flushed one after another: a run that was cut off may have rows more in some of them.
        self.states = self._table("states")
        self.wrenches = self._table("wrenches")
        self.contacts = self._table("contacts")
        ends = frames["first_contact"].astype(np.int64) + frames["contacts"]
        complete = min(len(frames), len(self.states), len(self.wrenches))
        complete = min(complete, int(np.searchsorted(ends, len(self.contacts), side="right")))
        if complete == 0:
            raise LogError(f"{self.folder}: the log has no complete frame; record for longer, or close the log")
        self.frames = frames[:complete]
        self.times = np.asarray(self.frames["time"])
        self.models = [self.folder / entry["file"] for entry in self.run["models"]]
        self.bodies = [self._body(entry) for entry in self.run["bodies"]]
        self.primitives = [Primitive(p["body"], p["path"], p["kind"]) for p in self.run["primitives"]]
        if self.states.shape[1:] != (len(self.bodies),):
            raise LogError(f"{self.folder}/states.npy: it has {self.states.shape[1:]} columns for {len(self.bodies)} bodies; "
                           "the table is of another run: restore the folder")

    def contacts_of(self, row: int) -> np.ndarray:
        """Rows of the contact table that belong to a row of `frames`."""
        first = int(self.frames["first_contact"][row])
        return self.contacts[first:first + int(self.frames["contacts"][row])]

    def touching(self) -> set[int]:
        """Primitives that touch anything in the run."""
        first = int(self.frames["first_contact"][0])
        last = int(self.frames["first_contact"][-1]) + int(self.frames["contacts"][-1])
        rows = self.contacts[first:last]
        return {int(p) for name in ("primitive_a", "primitive_b") for p in np.unique(rows[name])}

    def _body(self, entry: dict) -> Body:
        owner = self.run["objects"][entry["object"]]
        return Body(entry["name"], owner["name"], owner["model"], entry["path"], entry.get("parent"))

    def _table(self, name: str) -> np.ndarray:
        path = self.folder / f"{name}.npy"
        try:
            return np.load(path, mmap_mode="r")
        except FileNotFoundError:
            raise LogError(f"{path}: it is missing; copy the whole folder of the log") from None
        except ValueError as reason:
            if "mmap" in str(reason) and path.stat().st_size > 0:
                return np.load(path)  # a table without rows cannot be mapped
            raise LogError(f"{path}: it is no NumPy table ({reason}); record the run again") from None


def _read_run(folder: Path) -> dict:
    path = folder / "run.json"
    try:
        run = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise LogError(f"{folder}: there is no run.json; name the folder that `pong run --log` wrote") from None
    except json.JSONDecodeError as reason:
        raise LogError(f"{path}: it is damaged ({reason}); record the run again") from None
    if run.get("format") != FORMAT:
        raise LogError(f"{path}: `format` is {run.get('format')!r}, not {FORMAT!r}: this is no response log")
    if run.get("version") != VERSION:
        raise LogError(f"{path}: version {run.get('version')} is not known here, only {VERSION}; get a newer pong_viz")
    return run

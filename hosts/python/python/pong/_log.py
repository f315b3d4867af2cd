"""Response logs (docs/response_logs.md) with their tables as memory-mapped NumPy arrays."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._pong import check_log


class Log:
    """A log opened for reading. If the log was cut off, its complete frames are available.

    The tables are views of the files: what is not looked at is not read.

    Parameters
    ----------
    folder : path_like
        Folder of the log.

    Attributes
    ----------
    folder : Path
        Folder of the log.
    is_whole : bool
        True if the log is complete.
    frame_count : int
        Number of complete frames.
    run : dict
        Contents of run.json.
    frames : structured ndarray, shape (k,)
        A row for each frame: `time` (s), `first_contact`, `contacts` and more.
    states : structured ndarray, shape (k, n)
        States of the bodies in the common frame: `position` (m), `orientation` (w, x, y, z) and velocities.
    wrenches : structured ndarray, shape (k, n)
        Contact wrenches on the bodies: `force` (N) and `moment` (N·m).
    contacts : structured ndarray, shape (m,)
        Contacts of all frames, one frame after the other.
    energies : structured ndarray, shape (k,), or None
        Energies (J); None if the run kept none.

    Raises
    ------
    LogError
        The folder has no log, or a table is damaged.
    """

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self.folder = Path(folder)
        self.is_whole, self.frame_count = check_log(self.folder)
        self.run: dict[str, Any] = json.loads((self.folder / "run.json").read_text(encoding="utf-8"))
        self.frames = self._table("frames", self.frame_count)
        self.states = self._table("states", self.frame_count)
        self.wrenches = self._table("wrenches", self.frame_count)
        last = self.frames[-1] if self.frame_count else {"first_contact": 0, "contacts": 0}
        self.contacts = self._table("contacts", int(last["first_contact"]) + int(last["contacts"]))
        self.energies = self._table("energies", self.frame_count) if "energies" in self.run["tables"] else None

    def _table(self, name: str, rows: int) -> NDArray[Any]:
        """The first rows of a table. `numpy.load` refuses a truncated file: it maps as many rows as the header gives."""
        path = self.folder / self.run["tables"][name]["file"]
        with path.open("rb") as file:
            np.lib.format.read_magic(file)
            shape, _, dtype = np.lib.format.read_array_header_1_0(file)
            start = file.tell()
        shape = (rows, *shape[1:])
        if rows == 0:
            return np.empty(shape, dtype)
        return np.memmap(path, dtype, mode="r", offset=start, shape=shape)

    @property
    def time(self) -> NDArray[np.float64]:
        """ndarray, shape (k,) : Times of the frames, s."""
        return self.frames["time"]

    @property
    def bodies(self) -> list[str]:
        """list of str : Names of the bodies: the columns of `states` and `wrenches`."""
        return [body["name"] for body in self.run["bodies"]]

    @property
    def events(self) -> list[dict[str, Any]]:
        """list of dict : Changes by the host between frames. An incomplete last line is skipped."""
        file = self.folder / "events.jsonl"
        whole = file.read_text(encoding="utf-8").rpartition("\n")[0] if file.exists() else ""
        return [json.loads(line) for line in whole.splitlines() if line.strip()]

    def contacts_of(self, frame: int) -> NDArray[Any]:
        """Returns the contacts of a frame.

        Parameters
        ----------
        frame : int
            Index of the frame, from 0.

        Returns
        -------
        structured ndarray
            Its rows of `contacts`.
        """
        row = self.frames[frame]
        first = int(row["first_contact"])
        return self.contacts[first : first + int(row["contacts"])]

    def primitive(self, index: int) -> str:
        """Returns the name of a primitive.

        Parameters
        ----------
        index : int
            Number of the primitive, as contacts give it.

        Returns
        -------
        str
            `object/path`.
        """
        primitive = self.run["primitives"][index]
        of = self.run["objects"][self.run["bodies"][primitive["body"]]["object"]]["name"]
        return f"{of}/{primitive['path']}"

    def __repr__(self) -> str:
        return f"<pong.Log {str(self.folder)!r}: {self.frame_count} frames>"

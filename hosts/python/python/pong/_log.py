"""Response logs (docs/response_logs.md) with their tables as memory-mapped NumPy arrays."""

import json
from pathlib import Path

import numpy as np

from ._pong import check_log


class Log:
    """A log opened for reading. If the log was cut off, its complete frames are available.

    `frames`, `states`, `wrenches`, `contacts` and `energies` are views of the files: what is not looked at is not read.
    """

    def __init__(self, folder):
        self.folder = Path(folder)
        self.is_whole, self.frame_count = check_log(self.folder)
        self.run = json.loads((self.folder / "run.json").read_text(encoding="utf-8"))
        self.frames = self._table("frames", self.frame_count)
        self.states = self._table("states", self.frame_count)
        self.wrenches = self._table("wrenches", self.frame_count)
        last = self.frames[-1] if self.frame_count else {"first_contact": 0, "contacts": 0}
        self.contacts = self._table("contacts", int(last["first_contact"]) + int(last["contacts"]))
        self.energies = self._table("energies", self.frame_count) if "energies" in self.run["tables"] else None

    def _table(self, name, rows):
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
    def time(self):
        """Times of the frames, s."""
        return self.frames["time"]

    @property
    def bodies(self):
        """Names of the bodies: the columns of `states` and `wrenches`."""
        return [body["name"] for body in self.run["bodies"]]

    @property
    def events(self):
        """Changes by the host between frames. An incomplete last line is skipped."""
        file = self.folder / "events.jsonl"
        whole = file.read_text(encoding="utf-8").rpartition("\n")[0] if file.exists() else ""
        return [json.loads(line) for line in whole.splitlines() if line.strip()]

    def contacts_of(self, frame):
        """Contacts of a frame, whose index counts from the log's first."""
        row = self.frames[frame]
        first = int(row["first_contact"])
        return self.contacts[first : first + int(row["contacts"])]

    def primitive(self, index):
        """`object/path` of a primitive, as contacts name it."""
        primitive = self.run["primitives"][index]
        of = self.run["objects"][self.run["bodies"][primitive["body"]]["object"]]["name"]
        return f"{of}/{primitive['path']}"

    def __repr__(self):
        return f"<pong.Log {str(self.folder)!r}: {self.frame_count} frames>"

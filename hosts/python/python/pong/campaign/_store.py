"""The folder of a campaign.

    lock                   held by the process that runs the campaign
    campaign.json          the plan, digests of the scene and its models, versions
    parts/part-….parquet   rows of runs that came to their end
    failures.jsonl         a line for each run that did not, with its values

A part is written under another name and renamed when it is whole; a line is written at once. What is there is whole.
"""

import contextlib
import fcntl
import json
import os
import pathlib

import pyarrow
import pyarrow.parquet

from ._errors import CampaignError
from ._plan import Plan

VERSION = 1


class Store:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.head = self.folder / "campaign.json"
        self.parts = self.folder / "parts"
        self.failed = self.folder / "failures.jsonl"

    @contextlib.contextmanager
    def locked(self):
        """Holds the folder: two processes that run one campaign would do the same runs. The system frees it when one dies."""
        self.folder.mkdir(parents=True, exist_ok=True)
        with (self.folder / "lock").open("w") as file:
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError:
                cure = "wait for its end, or name another folder"
                raise CampaignError(f"campaign `{self.folder}`: another process runs it at this moment; {cure}") from None
            yield

    def begin(self, plan, job, version):
        """Makes the folder, or takes up the campaign that is in it, if it is the same."""
        entry = {
            "format": "pong-campaign",
            "version": VERSION,
            "pong": version,
            "digest": job["digest"],
            "scene_hash": f"{job['scene_hash']:016x}",
            "plan": plan.to_json(),
        }
        if self.head.exists():
            known, entry = self._head(), json.loads(json.dumps(entry))
            different = sorted(key for key in entry if known.get(key) != entry[key])
            if different:
                told = {"digest": "the scene", "scene_hash": "the models", "plan": "the plan", "pong": "the version of Pong"}
                what = ", ".join(told.get(key, key) for key in different)
                raise CampaignError(
                    f"campaign `{self.folder}`: {what} changed since it began; name another folder, or bring back what it began with"
                )
            return
        self.parts.mkdir(parents=True, exist_ok=True)
        self._write(self.head, json.dumps(entry, indent=2).encode())

    def _head(self):
        try:
            entry = json.loads(self.head.read_text(encoding="utf-8"))
        except (OSError, ValueError) as reason:
            raise CampaignError(f"campaign `{self.folder}`: {self.head.name} cannot be read: {reason}; name the folder of a campaign") from None
        if entry.get("format") != "pong-campaign" or entry.get("version") != VERSION:
            raise CampaignError(f"campaign `{self.folder}`: {self.head.name} is none that this version reads; name another folder")
        return entry

    def plan(self):
        return Plan.from_json(self._head()["plan"])

    def origin(self):
        """Digest of the scene and hash of its world when the campaign began."""
        head = self._head()
        return head["digest"], int(head["scene_hash"], 16)

    def add(self, rows):
        """Keeps the rows of some runs."""
        good = [row for row in rows if "error" not in row]
        for row in rows:
            if "error" in row:
                with self.failed.open("a", encoding="utf-8") as file:
                    file.write(json.dumps(row) + "\n")
                    file.flush()
                    os.fsync(file.fileno())
        if good:
            sink = pyarrow.BufferOutputStream()
            pyarrow.parquet.write_table(pyarrow.Table.from_pylist(good), sink)
            self._write(self.parts / f"part-{good[0]['run']:08d}.parquet", sink.getvalue().to_pybytes())

    def _write(self, path, content):
        half = path.with_suffix(path.suffix + ".half")
        with half.open("wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        os.replace(half, path)

    def table(self):
        """All rows, in the order of the runs."""
        self._head()
        files = sorted(self.parts.glob("part-*.parquet"))
        if not files:
            return pyarrow.table({"run": pyarrow.array([], pyarrow.int64())})
        tables = [pyarrow.parquet.read_table(file) for file in files]
        return pyarrow.concat_tables(tables, promote_options="default").sort_by("run")

    def failures(self):
        if not self.failed.exists():
            return []
        # A last line that was cut off is of a run that will be done again.
        whole = self.failed.read_text(encoding="utf-8").rpartition("\n")[0]
        return sorted((json.loads(line) for line in whole.splitlines()), key=lambda row: row["run"])

    def done(self):
        """The numbers of the runs that need not be done again."""
        return set(self.table()["run"].to_pylist()) | {row["run"] for row in self.failures()}


def results(folder):
    """The rows of all runs that came to their end, as a table of PyArrow, in the order of the runs."""
    return Store(folder).table()


def failures(folder):
    """The runs that did not come to their end: number, values, error and message of each."""
    return Store(folder).failures()

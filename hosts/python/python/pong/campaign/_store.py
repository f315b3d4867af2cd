"""The folder of a campaign.

    lock                   held by the process that runs the campaign
    campaign.json          the plan, digests of the scene and its models, versions
    parts/part-….parquet   rows of runs that came to their end
    failures.jsonl         a line for each run that did not, with its values

    damaged/               parts that could not be read, once their runs are done again

A part is written under another name and renamed when it is whole; a line is written at once. What is there is whole.
Every part has the contents of campaign.json among its metadata, so that parts tell what they belong to without it.
"""

import contextlib
import json
import os
import pathlib
import sys

import pyarrow
import pyarrow.parquet

from ._errors import CampaignError
from ._plan import Plan

try:
    import fcntl
except ImportError:
    import msvcrt  # Windows

    def lock_file(file):
        """Locks an open file for this process, or raises OSError at once: another one holds it."""
        msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)

else:

    def lock_file(file):
        """Locks an open file for this process, or raises OSError at once: another one holds it."""
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)


VERSION = 1
# Metadata key of a part with the contents of campaign.json.
HEAD = b"pong-campaign"


class Store:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.head = self.folder / "campaign.json"
        self.parts = self.folder / "parts"
        self.failed = self.folder / "failures.jsonl"

    @contextlib.contextmanager
    def _writing(self, path):
        """Turns an error of the system while writing a file into one of the campaign."""
        try:
            yield
        except OSError as reason:
            cure = "make room or name another folder, and call run again: the runs that are kept are not done again"
            raise CampaignError(f"campaign `{self.folder}`: {path.name} cannot be written: {reason.strerror or reason}; {cure}") from None

    @contextlib.contextmanager
    def locked(self):
        """Locks the folder: two processes on one campaign would compute the same runs. The system releases the lock of
        a dead one."""
        lock = self.folder / "lock"
        with contextlib.ExitStack() as held:
            with self._writing(lock):
                self.folder.mkdir(parents=True, exist_ok=True)
                file = held.enter_context(lock.open("w"))
            try:
                lock_file(file)
            except OSError:
                cure = "wait for its end, or name another folder"
                raise CampaignError(f"campaign `{self.folder}`: another process runs it at this moment; {cure}") from None
            yield

    def begin(self, plan, job, version):
        """Creates the folder, or continues the campaign in it, if it is the same."""
        entry = {
            "format": "pong-campaign",
            "version": VERSION,
            "pong": version,
            "digest": job["digest"],
            "scene_hash": f"{job['scene_hash']:016x}",
            "plan": plan.to_json(),
        }
        known = self._known()
        if known is not None:
            entry = json.loads(json.dumps(entry))
            different = sorted(key for key in entry if known.get(key) != entry[key])
            if different:
                told = {"digest": "the scene", "scene_hash": "the models", "plan": "the plan", "pong": "the version of Pong"}
                what = ", ".join(told.get(key, key) for key in different)
                raise CampaignError(
                    f"campaign `{self.folder}`: {what} changed since it began; name another folder, or bring back what it began with"
                )
        with self._writing(self.parts):
            self.parts.mkdir(parents=True, exist_ok=True)
            for half in (*self.folder.glob("*.half"), *self.parts.glob("*.half")):
                half.unlink()
        self._set_damaged_aside()
        if not self.head.exists():
            self._write(self.head, json.dumps(entry, indent=2).encode())

    def _known(self):
        """Plan stored in the folder; `None` if it is new."""
        if self.head.exists():
            return self._head()
        for _, head in self._parts():
            if head is not None:
                return json.loads(head)
        if self.failed.exists() or any(self.parts.glob("part-*.parquet")):
            cure = "bring it back, or name another folder"
            raise CampaignError(f"campaign `{self.folder}`: there are results, but {self.head.name} is missing; {cure}")
        return None

    def _parts(self):
        """Every readable part, with its campaign."""
        for file in sorted(self.parts.glob("part-*.parquet")):
            with contextlib.suppress(OSError, pyarrow.ArrowException):
                yield file, (pyarrow.parquet.read_schema(file).metadata or {}).get(HEAD)

    def _set_damaged_aside(self):
        """Moves unreadable parts aside: their runs are repeated."""
        for file in sorted(self.parts.glob("part-*.parquet")):
            try:
                pyarrow.parquet.read_table(file)
            except (OSError, pyarrow.ArrowException) as reason:
                aside = self.folder / "damaged" / file.name
                with self._writing(aside):
                    aside.parent.mkdir(exist_ok=True)
                    os.replace(file, aside)
                told = f"its runs are done again, and it is kept in {aside.parent}"
                print(f"campaign `{self.folder}`: parts/{file.name} cannot be read: {first_line(reason)}; {told}", file=sys.stderr)

    def _head(self):
        try:
            entry = json.loads(self.head.read_text(encoding="utf-8"))
        except (OSError, ValueError) as reason:
            raise CampaignError(f"campaign `{self.folder}`: {self.head.name} cannot be read: {reason}; {self._cure_of_head()}") from None
        if entry.get("format") != "pong-campaign" or entry.get("version") != VERSION:
            raise CampaignError(f"campaign `{self.folder}`: {self.head.name} is none that this version reads; name another folder")
        return entry

    def _cure_of_head(self):
        if any(head is not None for _, head in self._parts()):
            return f"remove {self.head.name} and call run again with the same plan: it is made anew from the results"
        return "name the folder of a campaign"

    def plan(self):
        return Plan.from_json(self._head()["plan"])

    def origin(self):
        """Digest of the scene and hash of its world when the campaign began."""
        head = self._head()
        return head["digest"], int(head["scene_hash"], 16)

    def add(self, rows):
        """Stores the rows of some runs."""
        good = [row for row in rows if "error" not in row]
        for row in rows:
            if "error" in row:
                self._append(json.dumps(row).encode() + b"\n")
        if good:
            sink = pyarrow.BufferOutputStream()
            table = pyarrow.Table.from_pylist(good).replace_schema_metadata({HEAD: self.head.read_bytes()})
            pyarrow.parquet.write_table(table, sink)
            self._write(self.parts / f"part-{good[0]['run']:08d}.parquet", sink.getvalue().to_pybytes())

    def _append(self, line):
        """Adds a line to the failures, after the last complete one."""
        with self._writing(self.failed), self.failed.open("ab+") as file:
            file.seek(0)
            there = file.read()
            file.truncate(there.rfind(b"\n") + 1)
            file.write(line)
            file.flush()
            os.fsync(file.fileno())

    def _write(self, path, content):
        half = path.with_suffix(path.suffix + ".half")
        try:
            with self._writing(path):
                with half.open("wb") as file:
                    file.write(content)
                    file.flush()
                    os.fsync(file.fileno())
                os.replace(half, path)
        finally:
            half.unlink(missing_ok=True)

    def table(self):
        """All rows, in the order of the runs."""
        self._head()
        files = sorted(self.parts.glob("part-*.parquet"))
        if not files:
            return pyarrow.table({"run": pyarrow.array([], pyarrow.int64())})
        tables = [self._read(file).replace_schema_metadata(None) for file in files]
        return pyarrow.concat_tables(tables, promote_options="default").sort_by("run")

    def _read(self, file):
        try:
            return pyarrow.parquet.read_table(file)
        except (OSError, pyarrow.ArrowException) as reason:
            cure = "call run again with the same plan: it does the runs of this part anew"
            raise CampaignError(f"campaign `{self.folder}`: parts/{file.name} cannot be read: {first_line(reason)}; {cure}") from None

    def failures(self):
        if not self.failed.exists():
            return []
        # An incomplete last line belongs to a run that will be repeated.
        lines = self.failed.read_bytes().rpartition(b"\n")[0].splitlines()
        rows = []
        for number, line in enumerate(lines, 1):
            try:
                rows.append(json.loads(line))
                rows[-1]["run"]
            except (ValueError, TypeError, KeyError):
                cure = "take the line out and call run again: its run is done anew"
                raise CampaignError(f"campaign `{self.folder}`: line {number} of {self.failed.name} is damaged; {cure}") from None
        return sorted(rows, key=lambda row: row["run"])

    def done(self):
        """Numbers of the runs that need not be repeated."""
        return set(self.table()["run"].to_pylist()) | {row["run"] for row in self.failures()}


def first_line(reason):
    return str(reason).partition("\n")[0]


def results(folder):
    """Reads the rows of all completed runs.

    Parameters
    ----------
    folder : path_like
        Folder of the campaign.

    Returns
    -------
    pyarrow.Table
        A row for each run, in their order: dispersed values, peaks (N, N·m, m), criteria, end.
    """
    return Store(folder).table()


def failures(folder):
    """Reads the failed runs.

    Parameters
    ----------
    folder : path_like
        Folder of the campaign.

    Returns
    -------
    list of dict
        Number (`run`), dispersed values, `error` and `message` of each.
    """
    return Store(folder).failures()

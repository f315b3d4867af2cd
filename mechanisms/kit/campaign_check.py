"""Short checks of the kit's campaigns with a few runs of one mechanism: no run is lost or repeated."""

import contextlib
import io
import pathlib
import tempfile

from kit.campaign import drawn, go_on
from kit.rows import Fact


def rows(study):
    """Two runs; the last row is cut off as by a kill; then three runs are requested."""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder) / "campaign"
        first = go_on(study, folder, 2)
        path = folder / "rows.csv"
        path.write_text(path.read_text(encoding="utf-8")[:-3], encoding="utf-8")
        after = go_on(study, folder, 3)
        yield Fact("campaign: a row that was cut off is computed again, with the same bits", after[:2] == first)
        yield Fact("it went on with the next run", [row["run"] for row in after] == [0, 1, 2])
        told = all(row[name] == value for row in after for name, value in drawn(study, int(row["run"]), 1).items())
        yield Fact("rows have the values that seed and number give", told)
        clear = [row for row in after if abs(row["margin"]) >= study.band]
        yield Fact("runs come out as predicted", all((row["margin"] > 0) == row["success"] for row in clear))
        yield Fact("rows of another seed do not mix with these", _refused(study, folder))


def _refused(study, folder):
    try:
        with contextlib.redirect_stderr(io.StringIO()):
            go_on(study, folder, 3, seed=2)
    except SystemExit:
        return True
    return False

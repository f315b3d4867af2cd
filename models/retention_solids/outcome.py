"""Outcomes of the retention latches of plain solids: the rows of the marked model, with the same limits. Run by
models/outcomes.py."""

import pathlib
import runpy
import sys

HERE = pathlib.Path(__file__).resolve().parent
MARKED = HERE.parent / "payload_retention"
sys.path[:0] = [str(MARKED), str(HERE.parent)]

OUTCOMES = runpy.run_path(str(MARKED / "outcome.py"))["OUTCOMES"]

for name, text in runpy.run_path(str(HERE / "make.py"))["texts"]().items():
    if (HERE / name).read_text(encoding="utf-8") != text:
        raise SystemExit(f"{HERE.name}/{name} is not what make.py writes; run it and commit the result")

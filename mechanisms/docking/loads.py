"""Loads of a docking, for kit/loads.py: fields of a case are those of `docking.Case`, angles in rad.

`until` is the phase at whose begin a run ends: `align` leaves hard capture out. `level` is `training` or `analysis`.
"""

import dataclasses
import sys

import dimensions as d
import docking

LOADED = ("target", "ring")
LEVELS = {"training": d.TRAINING, "analysis": d.ANALYSIS}


def run_case(fields, prepare, watched):
    fields = {name: tuple(value) if isinstance(value, list) else value for name, value in fields.items()}
    until, level = fields.pop("until", "done"), fields.pop("level", "training")
    known = {field.name for field in dataclasses.fields(docking.Case)} - {"level"}
    unknown = sorted(fields.keys() - known)
    if unknown or level not in LEVELS:
        cause = f"there is no field `{unknown[0]}`" if unknown else f"there is no level `{level}`"
        sys.exit(f"case of the docking: {cause}; give until, level ({', '.join(LEVELS)}), {', '.join(sorted(known))}")
    return docking.run(docking.Case(level=LEVELS[level], **fields), until, prepare=prepare, watched=watched)

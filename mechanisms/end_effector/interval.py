#!/usr/bin/env python3
"""Greatest force on a payload of 16 t while it is captured, as an interval in three parts (docs/sensitivity.md).

python3 mechanisms/end_effector/interval.py DIR [--runs 20] [--pairs 4]      with the plugin as for mechanisms/run.py

Runs are those of a campaign of the kit, at level training; a second call does what is left.
"""

import argparse
import contextlib
import math
import pathlib
import sys
import tempfile
from dataclasses import replace

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import capture  # noqa: E402
import models  # noqa: E402
from dimensions import Snare, training  # noqa: E402
from kit.campaign import ANY_WAY, OverDisc, Study, Uniform, go_on  # noqa: E402
from pong import campaign  # noqa: E402
from scene import Case  # noqa: E402

DISPERSED = {
    "offset": OverDisc(0.030),  # of the knob from the axis, m
    "direction": ANY_WAY,
    "tilt_deg": Uniform(0.0, 2.0),
    "roll_deg": Uniform(-2.0, 2.0),
    "drift": Uniform(0.0, 0.010),  # across, m/s
    "friction": Uniform(0.1, 0.3),
}
LAWS = [
    campaign.OtherLaws("hunt_crossley", force=5000.0, damping_exponent=1.0),
    campaign.OtherLaws("hertz", force=5000.0, exponent=1.5, damping_exponent=1.5),
]


def study(step, law=None):
    """Captures at one step, s, and under one law."""

    def attempt(values):
        x, y = (values["offset"] * turn(values["direction"]) for turn in (math.cos, math.sin))
        snare = replace(training(Snare()), friction=values["friction"], step=step)
        case = Case(
            snare=snare, mass=16000.0, offset=(x, y), tilt_deg=values["tilt_deg"], roll_deg=values["roll_deg"],
            drift=(0.0, values["drift"], 0.0),
        )  # fmt: skip
        with under(law):
            found = capture.run(case, until="hold", accounts=False)
        peak = max(found.peaks[phase] for phase in ("snare", "retract", "rigidize"))
        return {"success": int(not found.missed), "peak": peak, "tunnelled": int(found.machine.tunnelled)}

    name = f"end_effector, {1e3 * step:g} ms, {law.name if law else 'linear'}"
    return Study(name, DISPERSED, attempt, {"peak": ("greatest force on the payload", "N", 1.0)}, predicts=False)


@contextlib.contextmanager
def under(law):
    """Gives the machine its models as files of a folder of their own, with another normal law of all elastic surfaces."""
    data, sources, text_of_machine = models.Surface.data, models.sources, capture.mjcf_text

    def changed(surface):
        told = data(surface)
        if law is not None and surface.stiffness is not None:
            told["stiffness"], told["normal"] = law.law(surface.stiffness, surface.damping)
        return told

    with tempfile.TemporaryDirectory() as folder:

        def files(objects):
            for model in objects.values():
                pathlib.Path(folder, f"{model.name}.ron").write_text(model.text(), encoding="utf-8")
            return {name: f"{model.name}.ron" for name, model in objects.items()}, []

        models.Surface.data, models.sources = changed, files
        capture.mjcf_text = lambda case: text_of_machine(case, folder=folder)
        try:
            yield
        finally:
            models.Surface.data, models.sources, capture.mjcf_text = data, sources, text_of_machine


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=20)
    parser.add_argument("--pairs", type=int, default=4)
    given = parser.parse_args()
    step = training(Snare()).step

    def peaks(name, one, runs):
        return [row["peak"] for row in go_on(one, given.folder / name, runs)]

    base = peaks("plan", study(step), given.runs)
    halved = {"half_step": step / 2, "quarter_step": step / 4}
    steps = [peaks(name, study(finer), given.pairs) for name, finer in halved.items()]
    laws = {law.name: peaks(law.name, study(step, law), given.pairs) for law in LAWS}
    found = campaign.three_parts("greatest force on the payload", base, steps, laws)
    print(found, found.markdown("N"), sep="\n\n")


if __name__ == "__main__":
    main()

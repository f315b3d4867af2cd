#!/usr/bin/env python3
"""The capture map over misalignment and rate, at level training; draws capture_map.png.

python3 mechanisms/end_effector/capture_map.py          with the plugin as for mechanisms/run.py, and matplotlib
python3 mechanisms/end_effector/capture_map.py --all    every case again at half the step, not a part of them

Each case runs to its end: *seated* (pressed with the preload), *snared* only (the plate does not come to rest on the
pads), or *missed*. Prediction of what is snared by geometry alone: the knob goes in if its edge is inside of the open cables, and does not if its edge is beyond the crest of the lip's rounding, unless it is tilted so that its face
slides off the lip to the inside. Of what is inside, a payload that moves away is snared if the knob is still below the
cables when they are as narrow as it, and missed if it is above them by then.
"""

import argparse
import math
import pathlib
import random
import sys
from collections import Counter
from dataclasses import dataclass, replace

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import capture  # noqa: E402
import numpy as np  # noqa: E402
import snare as s  # noqa: E402
from dimensions import LIP, Fixture, Snare, training  # noqa: E402
from kit.rows import Fact, line  # noqa: E402
from rig_snare import axes, segments_apart  # noqa: E402
from scene import PLATE_HEIGHT  # noqa: E402

TRAINING, FIXTURE = training(Snare()), Fixture()
LEVEL = capture.Case(snare=TRAINING, tilt_deg=0.0, roll_deg=0.0)
ABOVE = 0.095  # m from where the tip is above the lip to where the snare is triggered
CLOSING = 0.05  # m/s
REPEATED = 0.25  # of the cases are run again at half the step, drawn by chance with the seed
SEED = 15


@dataclass(frozen=True)
class Point:
    """One case: its panel, its coordinates there, and whether geometry predicts a capture; None if undecided."""

    panel: str
    x: float
    y: float
    predicted: bool | None
    case: capture.Case


def open_aperture():
    """Distance from the axis to the open cables: to the middles of their links."""
    return TRAINING.ring_radius * math.cos(0.5 * s.bend(TRAINING)) - TRAINING.radius


def entering(offset, tilt_deg):
    """True if the knob enters: the point of its edge farthest from the axis, against cables and the lip's crest."""
    tilt = math.radians(tilt_deg)
    radius = FIXTURE.knob_radius * math.cos(tilt) + 0.5 * FIXTURE.knob_length * abs(math.sin(tilt))
    edge = math.hypot(*offset) + radius
    if edge <= open_aperture():
        return True
    slides = math.copysign(tilt, offset[0] * tilt) > math.atan(TRAINING.friction)
    return None if slides or edge <= LIP.aperture + LIP.radius else False


def from_above(panel, x, y, offset, tilt_deg=0.0):
    case = replace(LEVEL, offset=offset, tilt_deg=tilt_deg, approach=ABOVE, drift=(0.0, 0.0, -CLOSING))
    return Point(panel, x, y, entering(offset, tilt_deg), case)


def closing_time():
    """Time in which an empty snare narrows its aperture to the knob, s."""
    machine, sequencer = s.rig(TRAINING), capture.Sequencer(TRAINING)
    narrow = FIXTURE.knob_radius + TRAINING.radius
    axis = np.array([(0.0, 0.0, -1.0), (0.0, 0.0, 1.0)])

    def open_still():
        return min(segments_apart(link, axis) for link in axes(machine, TRAINING, 0)) > narrow

    while open_still():
        machine.hurry(sequencer.close)
    return machine.time


def leaving(offset, rate, time):
    """A payload whose shaft is inside when the snare is triggered, and which retreats at a rate, m/s.

    Captured if the knob is still below all cables when the aperture is as narrow as it; missed if it is above them all.
    """
    top = PLATE_HEIGHT - FIXTURE.shaft_length - FIXTURE.cone_length
    reach = s.height(TRAINING, s.CABLES - 1) + TRAINING.radius
    below, above = (-reach - top) / time, (reach - top + FIXTURE.knob_length) / time
    predicted = True if rate < below else (False if rate > above else None)
    return Point("rate away", rate, offset, predicted, replace(LEVEL, offset=(offset, 0.0), drift=(0.0, 0.0, rate)))


def aside(offset, rate):
    return Point("rate aside", rate, offset, None, replace(LEVEL, offset=(offset, 0.0), drift=(rate, 0.0, 0.0)))


def points():
    yield from offsets()
    yield from tilts()
    time = closing_time()
    for rate in (0.01, 0.03, 0.045, 0.06, 0.08, 0.10):
        yield from (leaving(offset, rate, time) for offset in (0.0, 0.040))
    for rate in (-0.05, 0.05):
        yield from (aside(offset, rate) for offset in (0.0, 0.040))


def offsets():
    """The snare is symmetric under rotations by 120 degrees."""
    azimuths = {0.0: (0,), 0.040: (0, 60), 0.065: (0, 30, 60, 90), 0.074: (0, 30, 60, 90), 0.080: (0, 30, 60, 90)}
    for radius, around in azimuths.items():
        for azimuth in around:
            a = math.radians(azimuth)
            place = (radius * math.cos(a), radius * math.sin(a))
            yield from_above("offset", *place, place)


def tilts():
    for tilt in (7.5, 15.0):
        for offset in (-0.080, -0.070, -0.040, 0.0, 0.040, 0.070, 0.080):
            yield from_above("tilt", tilt, offset, (offset, 0.0), tilt)


# --- runs and the plot -------------------------------------------------------------------------------------------------


def ran(case):
    """Outcome: seated, snared or missed."""
    result = capture.run(case, until="release", accounts=False)
    if result.captured:
        return "seated"
    return "missed" if result.missed in ("approach", "snare") else "snared"


def found():
    """(point, outcome) of every case."""
    return [(point, ran(point.case)) for point in points()]


def repeated(results, share):
    """Number of random cases repeated at half the step, and those with another outcome."""
    chosen = random.Random(SEED).sample(results, round(share * len(results)))
    halves = [(point, came, ran(replace(point.case, step=TRAINING.step / 2))) for point, came in chosen]
    return len(chosen), [f"{point.panel} {point.x:g}, {point.y:g}: {a}, {b}" for point, a, b in halves if a != b]


def rows(picture=None, share=REPEATED):
    """Writes the map into the file `picture`, and repeats the `share` of the cases at half the step."""
    results = found()
    if picture is not None:
        plot(results, picture)
    counts = Counter(came for _, came in results)
    told = [(point, came) for point, came in results if point.predicted is not None]
    wrong = [(point, came) for point, came in told if point.predicted == (came == "missed")]
    print(f"      {len(results)} cases: {dict(counts)}; geometry predicts {len(told)}")
    for point, came in results:
        if point.predicted is None or came == "snared" or (point, came) in wrong:
            print(f"      {point.panel} {point.x:.3g}, {point.y:.3g}: {came}; snared as predicted: {point.predicted}")
    yield Fact("every case of which geometry says whether it is snared comes out so", not wrong)
    upright = [came for point, came in results if point.panel == "offset" and point.predicted]
    yield Fact("what clears the cables, upright and without a rate across, is seated", set(upright) == {"seated"})
    count, other = repeated(results, share)
    print("".join(f"      {line}, at half the step\n" for line in other), end="")
    yield Fact(f"{count} of them, drawn by chance, come to the same at half the step", not other)


PANELS = {
    "offset": ("offset of the knob, mm", "offset across, mm", 1e3, 1e3),
    "tilt": ("tilt, deg", "offset of the knob, mm", 1.0, 1e3),
    "rate away": ("rate away along the axis, mm/s", "offset of the knob, mm", 1e3, 1e3),
    "rate aside": ("rate across the axis, mm/s", "offset of the knob, mm", 1e3, 1e3),
}


MARKS = (("seated", "o", "tab:green"), ("snared", "^", "tab:orange"), ("missed", "x", "tab:red"))


def plot(results, path):
    """Lines of the predicted edge; between adjacent ones geometry does not decide."""
    from matplotlib import pyplot

    figure, places = pyplot.subplots(1, len(PANELS), figsize=(15, 4), layout="constrained")
    for place, (panel, (across, up, first, second)) in zip(places, PANELS.items()):
        for came, marker, colour in MARKS:
            shown = [point for point, what in results if point.panel == panel and what == came]
            x, y = [first * p.x for p in shown], [second * p.y for p in shown]
            place.plot(x, y, marker, color=colour, label=came)
        place.set_xlabel(across)
        place.set_ylabel(up)
        place.set_title(panel)
    for edge in (open_aperture(), LIP.aperture + LIP.radius):
        turn = [math.radians(a) for a in range(91)]
        radius = 1e3 * (edge - FIXTURE.knob_radius)
        places[0].plot([radius * math.cos(a) for a in turn], [radius * math.sin(a) for a in turn], "k--", lw=0.8)
    places[0].set_aspect("equal")
    places[0].legend()
    figure.savefig(path, dpi=100)
    pyplot.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--all", action="store_true", help="every case again at half the step")
    share = 1.0 if parser.parse_args().all else REPEATED
    for row in rows(HERE / "capture_map.png", share):
        print(line(row))


if __name__ == "__main__":
    main()

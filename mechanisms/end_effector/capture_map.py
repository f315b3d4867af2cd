#!/usr/bin/env python3
"""The capture map over misalignment and rate, at level training; draws capture_map.png.

python3 mechanisms/end_effector/capture_map.py        with the plugin as for mechanisms/run.py, and matplotlib

Each case runs to its end: pressed with the preload, or given up by the sequencer. Prediction by geometry alone: the knob
goes through the mouth if its edge is inside of the lip, and does not if its edge is beyond the crest of the lip's rounding.
Of what is inside, a payload that moves away is missed if the knob leaves the plane of the snare before that has closed.
"""

import math
import pathlib
import random
import sys
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
    """One case of the map: which panel, where in it, and what geometry says: True, False, or None where it does not."""

    panel: str
    x: float
    y: float
    predicted: bool | None
    case: capture.Case


def entering(offset, tilt_deg):
    """Whether the knob goes in: the farthest place of its edge from the axis, against the lip and its crest."""
    tilt = math.radians(tilt_deg)
    radius = FIXTURE.knob_radius * math.cos(tilt) + 0.5 * FIXTURE.knob_length * abs(math.sin(tilt))
    edge = math.hypot(*offset) + radius
    if edge <= LIP.aperture:
        return True
    return False if edge > LIP.aperture + LIP.radius else None


def from_above(panel, x, y, offset, tilt_deg=0.0):
    case = replace(LEVEL, offset=offset, tilt_deg=tilt_deg, approach=ABOVE, drift=(0.0, 0.0, -CLOSING))
    return Point(panel, x, y, entering(offset, tilt_deg), case)


def closing_time():
    """How long a snare that closes on nothing takes until its aperture is as narrow as the knob, s."""
    machine, sequencer = s.rig(TRAINING), capture.Sequencer(TRAINING)
    narrow = FIXTURE.knob_radius + TRAINING.radius
    axis = np.array([(0.0, 0.0, -1.0), (0.0, 0.0, 1.0)])

    def open_still():
        return min(segments_apart(link, axis) for link in axes(machine, TRAINING, 0)) > narrow

    while open_still():
        machine.hurry(sequencer.close)
    return machine.time


def leaving(offset, rate, time):
    """A payload whose shaft is inside when the snare is triggered, and that moves away at a rate, m/s.

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
    """The snare looks the same from azimuths that are 120 degrees apart."""
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
    return capture.run(case, until="release", accounts=False)


def found():
    """(point, captured) of every case."""
    return [(point, ran(point.case).captured) for point in points()]


def repeated(results):
    """How many of a random part were run again at half the step, and which came to something else."""
    chosen = random.Random(SEED).sample(results, round(REPEATED * len(results)))
    halves = [replace(point.case, step=TRAINING.step / 2) for point, _ in chosen]
    other = [point for (point, yes), case in zip(chosen, halves) if ran(case).captured != yes]
    return len(chosen), other


def rows():
    results = found()
    plot(results, HERE / "capture_map.png")
    wrong = [point for point, yes in results if point.predicted not in (None, yes)]
    told = sum(point.predicted is not None for point, _ in results)
    print(f"      {len(results)} cases, {sum(yes for _, yes in results)} captured; geometry predicts {told}")
    for point, yes in results:
        if point in wrong or point.predicted is None:
            mark = "captured" if yes else "missed"
            print(f"      {point.panel} {point.x:g}, {point.y:g}: {mark}, predicted {point.predicted}")
    yield Fact("every case that geometry predicts comes out so", not wrong)
    count, other = repeated(results)
    yield Fact(f"{count} of them, drawn by chance, come to the same at half the step", not other)


PANELS = {
    "offset": ("offset of the knob, mm", "offset across, mm", 1e3, 1e3),
    "tilt": ("tilt, deg", "offset of the knob, mm", 1.0, 1e3),
    "rate away": ("rate away along the axis, mm/s", "offset of the knob, mm", 1e3, 1e3),
    "rate aside": ("rate across the axis, mm/s", "offset of the knob, mm", 1e3, 1e3),
}


def plot(results, path):
    """Captured: filled; missed: crosses; the line of a ring is the geometry's edge."""
    from matplotlib import pyplot

    figure, places = pyplot.subplots(1, len(PANELS), figsize=(15, 4), layout="constrained")
    for place, (panel, (across, up, first, second)) in zip(places, PANELS.items()):
        for yes, marker, colour in ((True, "o", "tab:green"), (False, "x", "tab:red")):
            shown = [point for point, came in results if point.panel == panel and came == yes]
            x, y = [first * p.x for p in shown], [second * p.y for p in shown]
            place.plot(x, y, marker, color=colour, label="captured" if yes else "missed")
        place.set_xlabel(across)
        place.set_ylabel(up)
        place.set_title(panel)
    for edge in (LIP.aperture, LIP.aperture + LIP.radius):
        turn = [math.radians(a) for a in range(91)]
        radius = 1e3 * (edge - FIXTURE.knob_radius)
        places[0].plot([radius * math.cos(a) for a in turn], [radius * math.sin(a) for a in turn], "k--", lw=0.8)
    places[0].set_aspect("equal")
    places[0].legend()
    figure.savefig(path, dpi=100)
    pyplot.close(figure)


def main():
    for row in rows():
        print(line(row))


if __name__ == "__main__":
    main()

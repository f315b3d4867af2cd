"""An approach in which the engine says that something went through something else, and what it was.

A catch snaps over the edge of its striker, as it shall: in one step its end is in front of the inclined face, in the
next behind the back face. The two meet at 45°, a wedge, round whose edge a catch may go. The engine takes it for a wall,
because where the catch lies on the edge it is pushed along a normal more than 150° from that of the inclined face. When
the flag no longer comes, this file has done its work.
"""

from dataclasses import replace

import dimensions as d
import docking
import mujoco
import numpy as np
from kit.machine import TUNNELLED
from kit.rows import Fact, Limit, Row
from sequence import STRIKER_EDGE, Sequencer, catch
from vehicles import LATCHES

# Drawn by a campaign, rounded.
CASE = docking.Case(
    speed=0.0955,
    lateral=(0.0551, -0.0273),
    lateral_rate=(-0.0195, -0.0331),
    tilt=(-0.0368, -0.0071),
    roll=0.0512,
    rates=(-0.00288, 0.00302, 0.00108),
)
STEPS = (d.TRAINING.step, d.TRAINING.step / 4)
NEAR = 2e-4  # m


def passage(step):
    """(time of the flag or None, how far each catch is behind and over the edge of its striker then, time of capture)."""
    made = docking.approach(replace(CASE, level=replace(d.TRAINING, step=step)), hard=False)
    sequencer, at, places = Sequencer(hard=False), None, None
    while sequencer.phase == "capture":
        before = [beside_edge(made, i) for i in LATCHES]
        sequencer(made)
        mujoco.mj_step(made.model, made.data)
        if at is None and int(made.data.sensordata[made.sensed][1]) & TUNNELLED:
            at, places = made.time, before
    return at, places, sequencer.captured_at


def beside_edge(made, i):
    x, y, z = catch(made, i)
    return z + d.IDSS.STRIKER_BACK, np.hypot(x, y) - STRIKER_EDGE


def rows():
    found = [passage(step) for step in STEPS]
    for step, (at, places, captured) in zip(STEPS, found):
        what = f"step {step * 1e3:g} ms"
        yield Fact(f"{what}: flagged once a catch passes, and captured", at is not None and captured is not None)
        nearest = min(max(abs(place[0]), abs(place[1])) for place in places)
        yield Limit(f"{what}: the catch that passes is from the edge of its striker", nearest, NEAR, "m")
    yield Row("time of the flag at a quarter of the step", found[1][0], found[0][0], 1e-3, "s")
    yield Row("time of capture", found[1][2], found[0][2], 1e-3, "s")

"""An approach with a former false report of tunnelling: there must be none.

A catch snaps over the edge of its striker, as it shall: in one step its end is in front of the inclined face, in the
next behind the back face. The two meet at 45°, a wedge, round whose edge a catch may go. The engine took it for a wall,
because of what the other end of the catch's segment met.
"""

from dataclasses import replace

import dimensions as d
import docking
import mujoco
import numpy as np
from kit.rows import Fact, Limit, Row
from sequence import STRIKER_EDGE, Sequencer, catch
from vehicles import LATCHES

# From a campaign, rounded.
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
    """(flagged, least distance of a catch from the edge of its striker, time of capture)."""
    made = docking.approach(replace(CASE, level=replace(d.TRAINING, step=step)), hard=False)
    sequencer, nearest = Sequencer(hard=False), np.inf
    while sequencer.phase == "capture":
        nearest = min(nearest, *(beside_edge(made, i) for i in LATCHES))
        sequencer(made)
        mujoco.mj_step(made.model, made.data)
        made.judge(made.data.sensordata[made.sensed][None])
    return made.tunnelled, nearest, sequencer.captured_at


def beside_edge(made, i):
    x, y, z = catch(made, i)
    return max(abs(z + d.IDSS.STRIKER_BACK), abs(np.hypot(x, y) - STRIKER_EDGE))


def rows():
    found = [passage(step) for step in STEPS]
    for step, (flagged, nearest, captured) in zip(STEPS, found):
        what = f"step {step * 1e3:g} ms"
        yield Fact(f"{what}: captured, and nothing tunnelled", captured is not None and not flagged)
        yield Limit(f"{what}: a catch goes round the edge of its striker as near as", nearest, NEAR, "m")
    yield Row("time of capture at a quarter of the step", found[1][2], found[0][2], 1e-3, "s")

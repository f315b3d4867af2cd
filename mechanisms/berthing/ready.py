#!/usr/bin/env python3
"""The ready map: offset and tilt at which all four indicators are ready, measured and by geometry.

python3 mechanisms/berthing/ready.py [PNG]      draws ready.png; with the plugin as for mechanisms/run.py, and matplotlib

A module that nothing can push aside comes in at a constant speed with an offset along x and a tilt about y. What is
noted is the greatest gap at which all four are ready, and whether the guides touched before.
"""

import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import mujoco  # noqa: E402
import numpy as np  # noqa: E402

import arm  # noqa: E402
import berth  # noqa: E402
import dimensions as d  # noqa: E402
import mechanism  # noqa: E402
import sequencer as seq  # noqa: E402
from dimensions import TRAINING, common  # noqa: E402
from kit.machine import Machine  # noqa: E402
from kit.rows import Fact, Limit  # noqa: E402

OFFSETS = [x * 1e-3 for x in range(-40, 41, 10)]
TILTS = [math.radians(0.5 * n) for n in range(-4, 5)]
HIGH, LOW, SPEED = 0.130, 0.030, 0.050  # m, m, m/s
IMMOVABLE = mechanism.Load(1e9, (1e9, 1e9, 1e9), (0.0, 0.0, 0.0))
TOLD_BY_TEXT = (0.025, math.radians(1.5))  # of low trust; drawn, not used
APPROACHES = ([0.0, 0.010, 0.020, 0.030, 0.040], [math.radians(t) for t in (0.0, 0.5, 1.0, 1.5, 2.0)])
WAITED = 8.0  # s that an approach by the arm may take


def measured(offset, tilt):
    """Gap at which all indicators are ready, and gap of the first contact with a guide; None if there is none."""
    start = mechanism.Start((offset, 0.0), (0.0, tilt, 0.0), HIGH)
    scene = mechanism.Scene(TRAINING, IMMOVABLE, start)
    machine = Machine(mechanism.text(scene), mechanism.carried(scene).values())
    machine.model.opt.disableactuator = 1 << arm.GROUP
    machine.data.qvel[machine.model.joint("module").dofadr[0] + 2] = -SPEED
    touched = None
    while machine.place("passive")[2] > LOW:
        mujoco.mj_step(machine.model, machine.data)
        gap = float(machine.place("passive")[2])
        if touched is None and np.any(machine.wrench("world")):
            touched = gap
        if ready(machine):
            return gap, touched
    return None, touched


def ready(machine):
    strokes = [machine.joint(f"plunger_{i}") for i in range(4)]
    turns = [machine.joint(f"paddle_{i}") for i in range(4)]
    return min(strokes) >= d.READY_STROKE and min(turns) >= d.READY_TURN


# --- geometry alone --------------------------------------------------------------------------------------------------


def predicted(offset, tilt):
    """Predicted gap from geometry alone, or None."""
    gaps = [f(azimuth, offset, tilt) for azimuth in common.LATCH_AZIMUTHS for f in (plunger_gap, paddle_gap)]
    return None if None in gaps or min(gaps) < LOW else min(gaps)


def plunger_gap(azimuth, offset, tilt):
    """Gap at which a plunger reaches its required stroke; its round tip is compressed by 1 % of that."""
    x, y, _ = common.radial(common.PLUNGER_RADIUS, azimuth)
    pushed = d.READY_STROKE * (1.0 + d.PLUNGER_SPRING / d.TIP_STIFFNESS)
    z = common.PLUNGER_TIP_Z - pushed + d.PLUNGER_TIP_RADIUS * (1.0 / math.cos(tilt) - 1.0)
    gap, outward, around = at_face((x, y, z), azimuth, offset, tilt)
    beyond = max(
        0.0, outward - common.FITTING_OUTER, common.FITTING_INNER - outward, abs(around) - common.FITTING_HALF_WIDTH
    )
    if beyond >= d.PLUNGER_TIP_RADIUS:
        return None
    # Past the edge, the round tip touches the edge beside its top.
    return gap - d.PLUNGER_TIP_RADIUS + math.sqrt(d.PLUNGER_TIP_RADIUS**2 - beyond**2)


def paddle_gap(azimuth, offset, tilt):
    """Gap at which the edge of a paddle reaches its required angle: one of its ends meets the face, as it did in its
    free position."""
    raised, turned, reached = math.radians(common.PADDLE_DEG), math.radians(azimuth), []
    for side in (-common.PADDLE_HALF_WIDTH, common.PADDLE_HALF_WIDTH):
        free, last = (edge(turned, side, angle) for angle in (raised, raised - d.READY_TURN))
        if covered(free, azimuth, offset, tilt) and covered(last, azimuth, offset, tilt):
            reached.append(at_face(last, azimuth, offset, tilt)[0])
    return max(reached, default=None)


def edge(turned, side, raised):
    """Position of an end of a paddle's edge."""
    radius = common.HINGE[0] + common.PADDLE_LENGTH * math.cos(raised)
    x, y = radius * math.cos(turned) - side * math.sin(turned), radius * math.sin(turned) + side * math.cos(turned)
    return x, y, common.HINGE[2] + common.PADDLE_LENGTH * math.sin(raised)


def covered(place, azimuth, offset, tilt):
    _, outward, around = at_face(place, azimuth, offset, tilt)
    return common.FITTING_INNER <= outward <= common.FITTING_OUTER and abs(around) <= common.FITTING_HALF_WIDTH


def at_face(place, azimuth, offset, tilt):
    """Gap at which the plane of the undersides passes a point, if that is in the frame of a fitting."""
    x, y, z = place[0] - offset, place[1], place[2]
    sine, cosine = math.sin(tilt), math.cos(tilt)
    gap = z + (sine * x - common.FITTING_BOTTOM) / cosine
    along_x, turned = cosine * x - sine * (z - gap), math.radians(azimuth)
    outward = along_x * math.cos(turned) + y * math.sin(turned)
    return gap, outward, -along_x * math.sin(turned) + y * math.cos(turned)


# --- by the arm -------------------------------------------------------------------------------------------------------


def approached(offset, tilt):
    """True if the arm, which yields to the guides, makes all four ready from an offset and a tilt."""
    machine = berth.Berthing(berth.Case(offset=(offset, 0.0), turn=(0.0, tilt, 0.0)))
    while machine.time < WAITED and machine.sequencer.phase == seq.APPROACH:
        machine.control()
        mujoco.mj_step(machine.model, machine.data)
    return machine.sequencer.phase != seq.APPROACH


def approaches():
    return {(offset, tilt): approached(offset, tilt) for offset in APPROACHES[0] for tilt in APPROACHES[1]}


# --- checks and plot ----------------------------------------------------------------------------------------------------


def the_map(offsets=OFFSETS, tilts=TILTS):
    """(offset, tilt) → (gap measured, gap at which guides were touched, gap predicted)."""
    return {(x, t): (*measured(x, t), predicted(x, t)) for x in offsets for t in tilts}


def rows(offsets=OFFSETS, tilts=TILTS):
    found = the_map(offsets, tilts)
    both = [(m, p) for m, _, p in found.values() if m is not None and p is not None]
    same = sum((m is None) == (p is None) for m, _, p in found.values())
    yield Fact(f"ready or never, as geometry says, at {len(found)} offsets and tilts", same == len(found))
    yield Limit("greatest difference of the gap at which all are ready", max(abs(m - p) for m, p in both), 1e-3, "m")
    inside = [
        m for (x, t), (m, _, _) in found.items() if abs(x) <= TOLD_BY_TEXT[0] and abs(t) <= TOLD_BY_TEXT[1] + 1e-9
    ]
    if inside:
        least = "never" if None in inside else f"at a gap of {min(inside) * 1e3:.1f} mm or more"
        print(f"      within 25 mm and 1.5 degrees, as a text of low trust has it: ready {least}")


def draw(target):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    found, arms = the_map(), approaches()
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.6), constrained_layout=True)
    _draw_gaps(left, figure, found)
    _draw_approaches(right, arms)
    for axes in (left, right):
        half = TOLD_BY_TEXT[0] * 1e3, math.degrees(TOLD_BY_TEXT[1])
        box = plt.Rectangle((-half[0], -half[1]), 2 * half[0], 2 * half[1], fill=False, ls="--", ec="k")
        axes.add_patch(box)
        axes.set_xlabel("offset, mm")
        axes.set_ylabel("tilt, degrees")
    figure.savefig(target, dpi=110)


def _draw_gaps(axes, figure, found):
    gaps = np.array([[(found[x, t][0] or np.nan) * 1e3 for x in OFFSETS] for t in TILTS])
    x, t = np.array(OFFSETS) * 1e3, np.degrees(TILTS)
    shown = axes.pcolormesh(x, t, gaps, cmap="viridis", shading="nearest")
    figure.colorbar(shown, ax=axes, label="gap at which all four are ready, mm")
    for (offset, tilt), (gap, touched, _) in found.items():
        if gap is not None and touched is not None:
            axes.plot(offset * 1e3, math.degrees(tilt), "wx", ms=6)
    axes.set_title("held in its pose (x: a guide is in the way before)")


def _draw_approaches(axes, found):
    for (offset, tilt), yes in found.items():
        axes.plot(offset * 1e3, math.degrees(tilt), "o" if yes else "x", color="tab:green" if yes else "tab:red", ms=8)
    axes.set_title("brought by the arm (circle: ready)")


if __name__ == "__main__":
    draw(pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else HERE / "ready.png")

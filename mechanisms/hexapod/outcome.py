"""Outcomes of the hexapod and their predictions. Run by mechanisms/run.py."""

import copy
import math
import random

import campaign
import dimensions as d
import leg
import numpy as np
import rig
import scenes

from kit import conclusion
from kit.rules import honest
from kit.rows import Fact, Limit, Row

STEP = d.TRAINING.step
BELOW, ABOVE = 0.97, (1.03, 1.2)  # of tan θ = μ
STIFF = 4.0  # servos that yield less
SHARE_OF_SLIP = 0.05  # of the way, at most


def kinematics():
    """The closed form's angles in MuJoCo's own kinematics, at random positions of all feet."""
    hexapod, draw, off, tried = rig.machine(STEP), random.Random(1), 0.0, 0
    while tried < 500:
        places = [[c + draw.uniform(-0.08, 0.08) for c in leg.neutral(i, 0.14)] for i in rig.LEGS]
        if any(leg.angles(i, place) is None for i, place in enumerate(places)):
            continue
        rig.pose(hexapod, places, 0.0)
        off, tried = max(off, np.abs(rig.feet(hexapod) - places).max()), tried + 1
    yield Limit("inverse kinematics: 3000 feet are off by", off, 1e-12, "m")


def statics():
    for slope, azimuth in ((0.0, 0.0), (0.3, 0.7)):
        measured, predicted, made = scenes.tripod_loads(STEP, slope, azimuth)
        for i, (load, closed) in enumerate(zip(measured, predicted)):
            yield Row(f"on three feet, slope {math.degrees(slope):.0f} deg: load {i}", load, closed, 2e-3, "N")
    yield from honest(made)
    six = rig.machine(STEP)
    six.run(2.0)
    lines = six.forces()[:, 2]
    yield Row("on six feet: loads, sum", lines.sum(), d.MASS * d.GRAVITY, 1e-4, "N")


def tipping(feet=(0,)):
    for foot in feet:
        edge = scenes.edge_shift(foot)
        empty, stands = scenes.shifted(STEP, foot, 0.97 * edge)
        yield Fact(f"shifted 0.97 of the way to the edge, foot {foot} stays loaded", empty is None)
        yield Limit("and it stands: has turned by", rig.tilt(stands), 0.03, "rad")
        empty, tips = scenes.shifted(STEP, foot, 1.03 * edge)
        yield Row(f"shift at which foot {foot} is empty", empty or math.nan, edge, 0.02, "m")
        yield Limit("at 1.03 it tips: has turned by", rig.tilt(tips), 0.1, "rad", least=True)


def tipping_stiff():
    """Remaining difference with stiffer servos."""
    edge = scenes.edge_shift(0)
    empty, _ = scenes.shifted(d.ANALYSIS.step, 0, 1.01 * edge, STIFF)
    yield Row(f"shift at which foot 0 is empty, servos {STIFF:g} times stiffer", empty or math.nan, edge, 5e-3, "m")


def slopes(seconds):
    crept, _ = scenes.creeps(STEP, BELOW, seconds)
    yield Limit(f"at {BELOW} of tan θ = μ it creeps in {seconds:g} s by", crept, 1e-6, "m")
    for share in ABOVE:
        slid, predicted, _ = scenes.slides(STEP, share)
        yield Row(f"at {share} of it: g(sin θ − μ cos θ)", slid, predicted, 1e-2, "m/s²")


def level_walk():
    """Soft servos let the feet roll as load shifts; stiffer ones less."""
    for step, stiffer, within in ((STEP, 1.0, 2e-2), (STEP / 2, STIFF, 5e-3)):
        walk = scenes.Walk(step, stiffer=stiffer)
        walk.go(2.5)
        start, time = walk.way(), walk.hexapod.time
        walk.go(3 * d.PERIOD)
        speed = (walk.way() - start) / (walk.hexapod.time - time)
        what = "speed on the plane: stride over period" + (
            f", servos {stiffer:g} times stiffer" if stiffer > 1.0 else ""
        )
        yield Row(what, speed, d.STRIDE / d.PERIOD, within, "m/s")
        yield Limit("feet slid, of the way", walk.slip_share(), SHARE_OF_SLIP)
        yield Limit("time that it waited for a foot to find ground", walk.gait.waited, 0.0, "s")


def analysed(level, tiles, seconds=1.7):
    """Walk with the energy account."""
    walk = scenes.Walk(level.step, tiles)
    walk.go(seconds, walk.hexapod.advance)
    print(f"      {walk.hexapod.ledger.through:.2f} J went through")
    yield from honest(walk.hexapod)


def terrain(metres):
    walk = scenes.Walk(STEP, scenes.tiles_for(metres))
    limit = 1.6 * metres / (d.STRIDE / d.PERIOD) + 5.0  # waiting for feet to find ground takes a quarter
    while walk.way() < metres and walk.hexapod.time < limit:
        walk.go(1.0)
    made = walk.hexapod
    yield Limit("way over the terrain", walk.way(), metres, "m", least=True)
    yield Limit("feet slid, of the way", walk.slip_share(), SHARE_OF_SLIP)
    yield Limit("off the line at the end", abs(float(made.data.qpos[1])), 0.05, "m")
    yield Limit("greatest tilt", math.degrees(walk.tilt), 10.0, "deg")
    yield Fact("no contact tunnelled, no limit was met", made.flags == 0)
    speed = walk.way() / (made.time - walk.gait.waited - 0.5)
    yield Row("speed while it did not wait", speed, d.STRIDE / d.PERIOD, 2e-2, "m/s")
    print(
        f"      {walk.way():.2f} m in {made.time:.1f} s, waited {walk.gait.waited:.2f} s, torque {walk.torque:.2f} N m at most"
    )


def restarted():
    """Restart on the terrain, in the middle of a swing."""
    walk = scenes.Walk(STEP, 1)
    walk.go(2.3)
    middle, ends = (walk.hexapod.save(), walk.gait), []
    for _ in range(2):
        walk.hexapod.restore(middle[0])
        walk.gait = copy.deepcopy(middle[1])
        walk.go(1.0)
        ends.append(walk.hexapod.save().tobytes())
    yield Fact("restarted on the terrain: the same bits", ends[0] == ends[1])


def half_step(seconds):
    ways = []
    for step in (STEP, STEP / 2):
        walk = scenes.Walk(step, 2)
        walk.go(seconds)
        ways.append(walk.hexapod.place("body"))
    off = float(np.abs(ways[0] - ways[1]).max())
    yield Limit(f"{ways[0][0]:.2f} m over the terrain at half the step: place differs by", off, 5e-3, "m")


DRAWN = ("body", "coxa_*", "femur_*", "tibia_*")  # bodies that logs and films show beside what touches


def shown(prepare):
    """Run for logs and films: it walks over the terrain."""
    walk = scenes.Walk(STEP, 2)
    prepare(walk.hexapod)
    walk.go(12.0, walk.hexapod.advance)


def rows(thorough):
    yield "kinematics", kinematics()
    yield "statics", statics()
    yield "tipping", tipping((0, 2, 4) if thorough else (0,))
    yield "slopes", slopes(60.0 if thorough else 20.0)
    yield "walking on the plane", level_walk()
    yield "terrain", terrain(100.0 if thorough else 2.0)
    yield "terrain, level training", analysed(d.TRAINING, 1)
    yield "terrain, level analysis", analysed(d.ANALYSIS, 1)
    yield "restart", restarted()
    yield "half the step", half_step(20.0 if thorough else 6.0)
    yield "worst case of the campaign", conclusion.again(campaign.STUDY, d.HERE)
    if thorough:
        yield "tipping, stiff servos", tipping_stiff()
        yield "plane, level analysis", analysed(d.ANALYSIS, 0)

"""Outcomes of the rover and their predictions. Run by mechanisms/run.py: `rows(thorough)` yields (title, rows)."""

import math
import time

import campaign
import dimensions as d
import numpy as np
import rig
import scenes
import statics
from dimensions import model
from kit import conclusion
from kit.restart import same_bits
from kit.rules import honest
from kit.rows import Fact, Limit, Row

RADIUS = 5.0  # m
ROLLED = 0.5  # s of driving after which bits are saved


def turning():
    radius, made = scenes.turned(RADIUS, d.RIGID)
    yield Row("radius of the circle with Ackermann's angles", radius, RADIUS, 2e-3, "m")
    yield from honest(made)


def slopes():
    predicted = scenes.stall_slope()
    angle, made = scenes.stalls_at(predicted)
    yield Row("slope at which the motors stall", math.degrees(angle), math.degrees(predicted), 5e-3, "deg")
    limit = math.degrees(math.atan(model.FRICTION))
    held, _ = scenes.slides(math.radians(limit - 0.5))
    yield Limit(f"locked, {limit - 0.5:.2f} deg, 0.5 deg below atan μ: slides with", abs(held), 2e-4, "m/s²")
    for more in (0.5, 2.0):
        angle = math.atan(model.FRICTION) + math.radians(more)
        slid, made = scenes.slides(angle)
        closed = model.GRAVITY * (math.sin(angle) - model.FRICTION * math.cos(angle))
        yield Row(f"{more:g} deg above it: g·(sin − μ·cos)", slid, closed, 1e-2, "m/s²")
    yield from honest(made)


def step_up(name, climbed, missed):
    """The highest step that statics allows with the motors' torque, and the next."""
    highest = statics.highest(d.STALL_TORQUE, (name,))
    print(f"      statics: the {name} wheels come up {highest * 1e3:.0f} mm")
    torque, up, made = scenes.climbs(name, climbed)
    yield Fact(f"the {name} wheels climb {climbed * 1e3:g} mm", up and climbed < highest)
    yield Row("torque at which they come off the ground", torque, statics.needed(name, climbed), 0.06, "N m")
    _, up, _ = scenes.climbs(name, missed)
    yield Fact(f"and not {missed * 1e3:g} mm", not up and missed > highest)
    yield from honest(made)


def drums():
    """Cylinders for wheels, beside the spheres and ellipsoids of the other checks."""
    level = d.RIGID_DRUM
    predicted = scenes.stall_slope()
    angle, made = scenes.stalls_at(predicted, level=level)
    yield Row("slope at which the motors stall", math.degrees(angle), math.degrees(predicted), 5e-3, "deg")
    more = math.atan(model.FRICTION) + math.radians(0.5)
    slid, made = scenes.slides(more, level)
    closed = model.GRAVITY * (math.sin(more) - model.FRICTION * math.cos(more))
    yield Row("locked, 0.5 deg above atan μ: g·(sin − μ·cos)", slid, closed, 1e-2, "m/s²")
    for tyre in (d.RIGID, level, d.TRAINING, d.DRUM, d.ANALYSIS):
        slip, _ = scenes.slip(tyre)
        yield Limit(f"slip of the {tyre.tyre} tyre with 60 % of the voltage", abs(slip), 0.05)
    torque, up, made = scenes.climbs("front", 0.19, level=level)
    yield Fact("the front wheels climb 190 mm", up)
    yield Row("torque at which they come off the ground", torque, statics.needed("front", 0.19), 0.06, "N m")
    yield from honest(made)
    _, exact = timed(d.ANALYSIS)
    made, rough = timed(d.DRUM)
    count = min(len(exact), len(rough))
    off = np.abs(rough[:count] - exact[:count])[:, 1:3].max()
    yield Limit("drum beside fine tyre over the stone: way and height", off, 0.05, "m")
    yield from honest(made)


def trade():
    """The stone with both tyres: cost and error of the coarse one."""
    fine, exact = timed(d.ANALYSIS)
    coarse, rough = timed(d.TRAINING)
    yield from honest(fine)
    yield from honest(coarse)
    count = min(len(exact), len(rough))
    off = rough[:count] - exact[:count]
    print(
        f"      coarse beside fine: height of the chassis {np.abs(off[:, 2]).max() * 1e3:.1f} mm, way {np.abs(off[:, 1]).max() * 1e3:.0f} mm, "
        f"pitch {math.degrees(np.abs(off[:, 4]).max()):.2f} deg at most; "
        f"greatest load {rough[:, 5].max():.0f} and {exact[:, 5].max():.0f} N"
    )
    off_middle = max(np.abs(table[:, 6]).max() for table in (exact, rough))
    yield Limit("differential: angles of both rockers, sum", off_middle, 1e-3, "rad")
    rise = model.GRAVITY * d.GROSS_MASS / 6
    yield Limit("greatest load on a wheel, of its share at rest", exact[:, 5].max() / rise, 4.0)


def timed(level, step=None):
    began = time.process_time()
    made, table = scenes.over_stone(level, step)
    spent = (time.process_time() - began) / (made.time / made.step)
    print(f"      {level.tyre} tyre, step {made.step * 1e3:g} ms: {spent * 1e6:.0f} µs of processor time a step")
    return made, table


def half_step():
    for level in (d.TRAINING, d.ANALYSIS):
        _, whole = scenes.over_stone(level)
        _, half = scenes.over_stone(level, level.step / 2)
        off = np.abs(whole - half)[:, 1:3].max()
        yield Limit(f"{level.tyre} tyre over the stone at half the step: way and height differ by", off, 3e-3, "m")
    for step in (None, 5e-4):
        torque, up, made = scenes.climbs("front", 0.19, step)
        yield Row(
            f"torque at the step of 190 mm, step {made.step * 1e3:g} ms", torque, statics.needed("front", 0.19), 0.06
        )
        yield Fact("climbed", up)


def off_nominal():
    dead = ("middle_left",)
    predicted = scenes.stall_slope(motors=5)
    angle, _ = scenes.stalls_at(predicted, dead)
    yield Row("slope of stall with one dead motor", math.degrees(angle), math.degrees(predicted), 1e-2, "deg")


def restarted():
    """Restart in the middle of the stone, at level training."""

    def begin():
        made = rig.machine(d.TRAINING, ground="stone", x=-1.6)
        rig.rolling(made, d.TRAINING, 0.7)
        return made

    same = same_bits(begin, scenes.crawl(0.7, d.TRAINING), ROLLED, ROLLED)
    yield Fact("restarted on the stone: the same bits", same)


def rocks():
    made = scenes.over_rocks(d.TRAINING)
    yield Limit("way over the rocks in 8 s", made.data.qpos[0] + 2.3, 6.0, "m", least=True)
    yield from honest(made)


DRAWN = ("chassis", "rocker_*", "bogie_*")  # bodies that logs and films show beside what touches


def shown(prepare):
    """Run for logs and films: `prepare` receives the machine before it moves."""
    scenes.over_rocks(d.ANALYSIS, seconds=12.0, prepare=prepare)


def rows(thorough):
    yield "turning", turning()
    yield "slopes", slopes()
    yield "step, front wheels", step_up("front", 0.19, 0.22)
    yield "restart", restarted()
    yield "worst case of the campaign", conclusion.again(campaign.STUDY, d.HERE)
    if thorough:
        yield "step, middle wheels", step_up("middle", 0.20, 0.25)
        yield "step, rear wheels", step_up("rear", 0.12, 0.14)
        yield "stone: fine and coarse tyre", trade()
        yield "cylinders for wheels", drums()
        yield "one motor does not drive", off_nominal()
        yield "rocks", rocks()
        yield "half the step", half_step()

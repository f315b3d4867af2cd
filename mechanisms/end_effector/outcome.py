"""Outcomes of the end effector and their predictions. Run by mechanisms/run.py: `rows(thorough)` yields (title, rows)."""

import math
import time
from dataclasses import replace

import capture
import capture_map
import loads
import rig_capstan
import rig_preload
import rig_snare
import numpy as np
import rig_teeth
import scene
import snare
import trade
from dimensions import ARM, LARGE_FIXTURE, Fixture, Snare, training
from kit import rules
from kit.rows import Fact, Limit, Row

ANALYSIS, TRAINING = Snare(), training(Snare())
LIGHT = capture.Case(snare=TRAINING)


def closed_forms():
    yield "cables", rig_snare.rows(ANALYSIS, Fixture())
    yield "wrapped cable", rig_capstan.rows()
    yield "curvic teeth", rig_teeth.rows()


def honest(result):
    """Rules for every run: energy, reactions, no tunnelling."""
    yield from rules.honest(result.machine)


def released(result, mass=1000.0):
    yield Fact("captured, pressed, released", result.captured)
    yield Row("preload between shell and payload", result.preload, scene.screw_force(), 0.01, "N")
    low, high = rig_teeth.share_bounds()
    yield Limit("share of the preload on the teeth, least", result.on_teeth / result.preload, low, least=True)
    yield Limit("the same, most", result.on_teeth / result.preload, high)
    yield Limit("the payload is turned by, of its 2 degrees", abs(result.turned_deg), 0.02, "deg")
    yield Limit("and is aside by", result.aside, 2e-4, "m")
    predicted = capture.push_off_speed(mass, result.gap, result.before)
    yield Row("speed after push-off, from the energy of the plungers", result.away, predicted, 0.01, "m/s")


def nominal():
    """Level analysis, also at half the step; cost and error of the levels."""
    half_given, whole_given, *rest = trade.LEVELS
    whole_level = trade.measured(*whole_given, until="done", accounts=True)
    whole = whole_level.result
    yield from released(whole)
    yield from honest(whole)
    half_level = trade.measured(*half_given)
    half = half_level.result
    yield Fact("captured at half the step", half.captured)
    yield Row("preload at half the step", half.preload, whole.preload, 0.01, "N")
    for phase in ("snare", "retract"):
        what = f"greatest force in the phase {phase} at half the step"
        yield Row(what, half.peaks[phase], whole.peaks[phase], 0.05, "N")
    levels = [half_level, whole_level] + [trade.measured(*given) for given in rest]
    print("\n".join(trade.table(levels)))


class Farthest:
    """Largest distance of the cables' axes from the shell's: while holding or closing, and overall. No wall of the ring
    limits it."""

    def __init__(self):
        self.held, self.most, self.steps = 0.0, 0.0, 0

    def __call__(self, machine, sequencer):
        self.steps += 1
        if self.steps % 25:
            return
        links = (link for cable in range(snare.CABLES) for link in rig_snare.axes(machine, TRAINING, cable))
        far = max(float(np.hypot(link[:, 0], link[:, 1]).max()) for link in links)
        self.most = max(self.most, far)
        if sequencer.phase not in ("open", "push", "done"):
            self.held = max(self.held, far)


def trained():
    """Level training: 1 ms, and its cost."""
    began, far = time.process_time(), Farthest()
    result = capture.run(LIGHT, watch=far)
    spent = (time.process_time() - began) / (result.machine.time / result.machine.step)
    yield from released(result)
    yield from honest(result)
    yield Limit("farthest that cables are from the axis before they open", far.held, 1.001 * TRAINING.ring_radius, "m")
    print(f"      and at most, when they open: {far.most:.4f} m")
    print(f"      processor time of a step of 1 ms, with the account of energy: {spent * 1e6:.0f} µs")
    yield Fact("restarted in the middle of snaring: the same bits", capture.same_bits_after_restart(LIGHT, 1.0, 0.2))
    yield Fact(
        "restarted in the middle of pulling in: the same bits", capture.same_bits_after_restart(LIGHT, 6.0, 0.2)
    )


def off_nominal():
    _, heavy = loads.measured(loads.HEAVY)
    yield Fact("a free flyer of 16 t is captured", heavy.captured)
    yield Row("its preload", heavy.preload, scene.screw_force(), 0.05, "N")
    print(f"      greatest force on it: {max(heavy.peaks.values()):.0f} N, in release {heavy.peaks['release']:.0f} N")
    for what, case in (
        ("the larger fixture", replace(LIGHT, fixture=LARGE_FIXTURE)),
        ("with a cable that is 4 mm longer", replace(LIGHT, slack=0.004)),
    ):
        yield Fact(f"{what}: captured", capture.run(case, until="release", accounts=False).captured)
    stalled = capture.run(replace(LIGHT, motor_share=1e-6), accounts=False)
    yield Fact("with a snare motor without power: not captured", not stalled.captured)
    yield Fact("and its payload drifts on", math.hypot(*capture.velocity(stalled.machine)) > 0.005)


def held_by_an_arm():
    """Capture with the shell on springs and dampers: the outcome is that of the fixed shell."""
    result = capture.run(replace(LIGHT, holder=scene.arm()))
    yield Fact("captured, pressed, released", result.captured)
    yield Row("preload", result.preload, scene.screw_force(), 0.01, "N")
    yield Limit("the payload is turned by", abs(result.turned_deg), 0.02, "deg")
    yield from honest(result)
    half = capture.run(replace(LIGHT, holder=scene.arm(), step=0.5e-3), until="release", accounts=False)
    yield Row("preload at half the step", half.preload, result.preload, 0.01, "N")


def cams_turn():
    """Capture of a payload at the largest roll for which its cams enter between the rollers."""
    rolled = replace(LIGHT, roll_deg=0.95 * scene.cam_roll_deg())
    seated = capture.run(rolled, until="release", accounts=False)
    what = f"a roll of {rolled.roll_deg:.1f} deg, 95 % of what lets the cams between the rollers, is turned back to"
    yield Limit(what, abs(seated.turned_deg), 0.02, "deg")
    bare = capture.run(replace(rolled, cams=False), until="release", accounts=False)
    yield Fact("without cams the same payload is not seated", not bare.captured)


DRAWN = ("ring",)  # bodies that logs and films show beside what touches


def shown(prepare):
    """Run for logs and films: `prepare` receives the machine before it moves."""
    capture.run(capture.Case(snare=TRAINING), prepare=prepare)


def rows(thorough):
    yield "level training", trained()
    yield "preload and joint", rig_preload.rows()
    if thorough:
        yield "off nominal", off_nominal()
        yield f"held by an arm of {ARM.stiffness:g} N/m", held_by_an_arm()
        yield "cams", cams_turn()
        yield from closed_forms()
        yield "level analysis", nominal()
        yield "capture map", capture_map.rows()

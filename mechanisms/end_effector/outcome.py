"""What the end effector must come to. Run by mechanisms/run.py: `rows(thorough)` yields (title, rows)."""

import math
import time

import capture
import rig_capstan
import rig_preload
import rig_snare
import rig_teeth
from dimensions import LARGE_FIXTURE, Fixture, Snare, training
from kit.rows import Fact, Limit, Row

ANALYSIS, TRAINING = Snare(), training(Snare())
HEAVY = 16000.0  # kg


def closed_forms():
    yield "cables", rig_snare.rows(ANALYSIS, Fixture())
    yield "wrapped cable", rig_capstan.rows()
    yield "curvic teeth", rig_teeth.rows()


def honest(result, share):
    """What holds of every run: energy, reactions, no tunnelling."""
    machine = result.machine
    yield Limit("energy that does not close, of what went through", machine.ledger.open_share(), share)
    yield Limit("forces that have no reaction, of the greatest", machine.imbalance, 1e-9)
    yield Fact("no contact tunnelled, no limit was met", machine.flags == 0)


def released(result):
    yield Fact("captured, pressed, released", result.captured)
    yield Row("preload on the pads", result.preload, rig_preload.preload(), 0.03, "N")
    yield Limit("speed of the payload after release", result.away, 0.05, "m/s")


def nominal():
    """Level analysis, and the same at half the step."""
    whole = capture.run(capture.Case(snare=ANALYSIS))
    yield from released(whole)
    yield from honest(whole, 1e-3)
    half = capture.run(capture.Case(snare=ANALYSIS, step=ANALYSIS.step / 2))
    yield Fact("captured at half the step", half.captured)
    yield Row("preload at half the step", half.preload, whole.preload, 0.01, "N")
    for phase in ("snare", "retract"):
        yield Row(
            f"greatest force in the phase {phase} at half the step", half.peaks[phase], whole.peaks[phase], 0.05, "N"
        )


def trained():
    """Level training: 1 ms, and what it costs."""
    case = capture.Case(snare=TRAINING)
    began, spent = time.process_time(), 0.0
    result = capture.run(case)
    spent = (time.process_time() - began) / (result.machine.time / result.machine.step)
    yield from released(result)
    yield from honest(result, 2e-2)
    print(
        f"      processor time of a step of {case.snare.step * 1e3:g} ms, with the account of energy: {spent * 1e6:.0f} µs"
    )
    yield Fact("restarted in the middle of snaring: the same bits", capture.same_bits_after_restart(case, 1.0, 0.4))
    yield Fact("restarted in the middle of pulling in: the same bits", capture.same_bits_after_restart(case, 8.0, 0.4))


def off_nominal():
    heavy = capture.run(capture.Case(snare=TRAINING, mass=HEAVY))
    yield Fact("a free flyer of 16 t is captured", heavy.captured)
    yield Row("its preload", heavy.preload, rig_preload.preload(), 0.05, "N")
    print(f"      greatest force on it: {max(heavy.peaks.values()):.0f} N, in release {heavy.peaks['release']:.0f} N")
    large = capture.run(capture.Case(snare=TRAINING, fixture=LARGE_FIXTURE))
    yield Fact("the larger fixture is captured", large.captured)
    slack = capture.run(capture.Case(snare=TRAINING, slack=0.004))
    yield Fact("with a cable that is 4 mm longer: captured", slack.captured)
    stalled = capture.run(capture.Case(snare=TRAINING, motor_share=1e-6), until="hold")
    yield Fact("with a snare motor without power: not captured", not stalled.captured)
    drifted = capture.velocity(stalled.machine)
    yield Fact("and its payload drifts on", math.hypot(*drifted) > 0.005)


def capture_map(offsets, rates):
    """(offset, rate) → captured, at level training; the payload comes from the side."""
    for offset in offsets:
        for rate in rates:
            case = capture.Case(snare=TRAINING, offset=(offset, 0.0), drift=(rate, 0.0, 0.0))
            yield offset, rate, capture.run(case, until="release").captured


def mapped():
    found = list(capture_map([0.0, 0.02, 0.04, 0.06, 0.08, 0.10, 0.12], [-0.06, 0.0, 0.06]))
    for rate in sorted({rate for _, rate, _ in found}):
        print(
            f"      rate {rate:+.2f} m/s: captured at offsets of "
            + ", ".join(f"{o * 1e3:.0f}" for o, r, yes in found if yes and r == rate)
            + " mm"
        )
    yield Fact(
        "all offsets up to 40 mm at rest are captured", all(yes for o, r, yes in found if o <= 0.04 and r == 0.0)
    )
    yield Fact("an offset beyond the ring is not", not any(yes for o, r, yes in found if o > 0.11 and r == 0.0))


def shown(prepare):
    """For logs and films: `prepare` sees the machine before it moves."""
    capture.run(capture.Case(snare=TRAINING), prepare=prepare)


def rows(thorough):
    yield "level training", trained()
    yield "preload and joint", rig_preload.rows()
    if thorough:
        yield "off nominal", off_nominal()
        yield from closed_forms()
        yield "level analysis", nominal()
        yield "capture map", mapped()

"""Outcomes of the pallet and their predictions. Run by mechanisms/run.py: `rows(thorough)` yields (title, rows)."""

import time

import campaign
import drawer
import stowage
from dimensions import ANALYSIS, HERE, LEVER, TRAINING, HOOK_STALL, model
from kit import campaign_check, conclusion
from kit.rules import honest
from kit.rows import Fact, Limit, Row

OUTSIDE = -1.800  # m: of a pallet whose first rollers have not reached the flares


def law():
    """F = D/(1 − 2·μ·e/L), with rollers 0.6 m apart, and with those of the model."""
    cases = ((0.4, drawer.SHORT), (0.7, drawer.SHORT), (1.0, drawer.SHORT), (1.1, drawer.LONG))
    for offset, base in cases:
        force, predicted, made = drawer.steady(offset, base, TRAINING)
        yield Row(f"push {offset:g} m beside the drag, base {base:g} m", force, predicted, 0.01, "N")
    yield from honest(made)


def jam(most=1000.0, offset=1.6):
    """Beyond e = L/(2·μ) no push moves it; it is freed when the remaining moment lets the push through."""
    made, push, went = drawer.jammed(offset, drawer.SHORT, most, TRAINING)
    yield Limit("2·μ·e/L of the jammed pallet", drawer.share(made, push), 1.0, least=True)
    yield Limit("how far a second of pushing with 1 kN moves it", went, 2e-4, "m")
    freed, share = drawer.accommodate(made, push)
    yield Fact("accommodation frees it", freed)
    yield Row("2·μ·e/L when it begins to go, 1 − D/F", share, 1.0 - drawer.DRAG / most, 0.06)
    made.run(6.0, push)
    left = drawer.DRAG / (1.0 - drawer.share(made, push))
    yield Row("push when it goes evenly again, D/(1 − 2·μ·e/L)", push.arm.force[0], left, 0.05, "N")
    yield from honest(made)


def harder():
    """A push half as large again does not move it either."""
    _, _, went = drawer.jammed(1.6, drawer.SHORT, 1500.0, TRAINING)
    yield Limit("how far a second of pushing with 1.5 kN moves it", went, 2e-4, "m")


def stowed(case):
    began = time.process_time()
    made, sequencer, most = stowage.run(case)
    spent = (time.process_time() - began) / (made.time / made.step)
    yield Row(
        "force on the stops when the arm has come into line", sequencer.stops["press"], stowage.pressed(), 0.01, "N"
    )
    yield Row("when it is tied down and the arm gives way", sequencer.stops["held"], stowage.tied(), 0.01, "N")
    yield Limit("when it is let go", sequencer.stops["untie"], 0.5 * stowage.pressed(), "N")
    yield Limit("place at the end, from where it began", abs(made.place("pallet")[0] - case.start), 1e-2, "m")
    yield Limit("greatest force of the arm on the way out", most["out"], 150.0, "N")
    yield from honest(made)
    print(
        f"      processor time of a step of {made.step * 1e3:g} ms, with the account of energy: {spent * 1e6:.0f} µs"
    )


def off_nominal():
    """A hook whose motor keeps closing holds the pallet against the arm."""
    made, sequencer, _ = stowage.run(stowage.Case(stuck=True))
    x = made.place("pallet")[0]
    yield Limit("the pallet stays: how far from the stops", model.SEATED_X - x, 0.010, "m")
    hold = HOOK_STALL / LEVER
    balance = sequencer.stops["out"] - sequencer.arm.force[0]
    yield Row("stops less arm is what the one hook pulls", balance, hold, 0.02, "N")


def half_step():
    _, one, _ = stowage.run(stowage.Case())
    _, other, _ = stowage.run(stowage.Case(step=TRAINING.step / 2))
    for phase in ("press", "held"):
        yield Row(
            f"force on the stops after {phase} at half the step", other.stops[phase], one.stops[phase], 2e-3, "N"
        )
    shares = []
    for step in (TRAINING.step, TRAINING.step / 2):
        made, push, _ = drawer.jammed(1.6, drawer.SHORT, 1000.0, TRAINING, step)
        shares.append(drawer.accommodate(made, push)[1])
    yield Row("2·μ·e/L when it is freed at half the step", shares[1], shares[0], 0.03)


DRAWN = ("pallet", "hook_*")  # bodies that logs and films show beside what touches


def shown(prepare):
    """Run for logs and films: `prepare` receives the machine before it moves."""
    stowage.run(stowage.Case(start=OUTSIDE), prepare)


def rows(thorough):
    yield "law of a drawer", law()
    yield "jam and accommodation", jam()
    yield "stowed and released, level training", stowed(stowage.Case())
    restart = stowage.same_bits_after_restart
    yield "restart", [Fact("restarted while it is pressed: the same bits", restart(stowage.Case(), 7.0, 0.5))]
    yield "a campaign of three runs", campaign_check.rows(campaign.STUDY)
    yield "worst case of the campaign", conclusion.again(campaign.STUDY, HERE)
    if thorough:
        yield "a harder push", harder()
        yield "stowed and released, level analysis", stowed(stowage.Case(level=ANALYSIS))
        yield "from outside of the rails", stowed(stowage.Case(start=OUTSIDE))
        yield "one hook does not open", off_nominal()
        yield "half the step", half_step()

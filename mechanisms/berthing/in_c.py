"""Input of hosts/mujoco/realtime/berthing.c: a berthing and unberthing at level training, with its sequence as numbers."""

import arm
import berth
import dimensions as d
import sequencer as seq
import statics

CASE = berth.Case(unberth=True)
AWAY_FOR = 2.0  # s that are run after the bolts have let go
AWAY_GAP = 0.05  # m of the passive ring by then at least: standoffs have pushed the module off
MOVED_EARLY = 1e-9  # rad by which a latch may move before the indicators are ready


def machine():
    return berth.Berthing(CASE)


def rows(_):
    for name in ("ready_for", "caught", "caught_for", "capture_most", "limp_for", "ramp", "stands", "stands_for"):
        yield [name, getattr(seq, name.upper())]
    for name in ("pull_most", "held_for", "bolted_for", "stowed_within", "open_most", "closed_least"):
        yield [name, getattr(seq, name.upper())]
    for name in (
        "pushed_gap",
        "approach_speed",
        "ready_stroke",
        "ready_turn",
        "stowed",
        "capture_share",
        "free_speed",
    ):
        yield [name, getattr(d, name.upper())]
    yield ["start_gap", CASE.gap]
    yield ["arm", *arm.command(CASE.offset, CASE.turn, 0.0)]
    yield ["arm_group", arm.GROUP]
    yield ["away_for", AWAY_FOR]
    yield ["away_gap", AWAY_GAP]
    yield ["moved_early", MOVED_EARLY]
    yield from _pressed()


def _pressed():
    """Compression of the rings by the latches; friction of the rollers takes a share of the pull, and the module still rocks
    by some 6 µm of the 100 when it is measured."""
    gap = statics.rest()[0]
    least = statics.latch(gap, 1.0, d.ROLLER_FRICTION) / statics.latch(gap, 1.0)
    yield ["pressed_gap", gap]
    yield ["pressed_within", 1.0 - least + 0.1]


def run(made):
    """Runs the same case in Python."""
    while made.sequencer.phase < seq.AWAY or made.time - made.sequencer.since <= AWAY_FOR:
        made.hurry(made.control)

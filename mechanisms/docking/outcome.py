"""Outcomes of the docking and their predictions. Run by mechanisms/run.py: `rows(thorough)` yields (title, rows)."""

import math
import time
from dataclasses import replace

import campaign
import dimensions as d
import docking
import flagged
import numpy as np
import rig_hard
import rig_ring
import vehicles
from docking import Case
from kit import conclusion, rules
from kit.rows import Fact, Limit, Row
from sequence import STRIKER_EDGE, TIMES, Sequencer, catch

NOMINAL = Case()
ALIGNED = Case(lateral=(0.0, 0.0), tilt=(0.0, 0.0), roll=0.0)


def honest(result):
    """Rules for every run: energy, reactions, no tunnelling, the legs' kinematics."""
    yield from rules.honest(result.machine)
    yield Limit("closures of the legs open by", result.watch.closure, 1e-5, "m")
    yield Limit("slides differ from the closed form by more than the closures' gap", result.watch.beyond, 1e-12, "m")


class Seen:
    """Data of a docking: positions of the catches at capture, and forces of the hooks at the end of `hold`."""

    def __init__(self):
        self.hooked, self.catches = None, None

    def __call__(self, made, sequencer):
        if self.catches is None and sequencer.captured_at is not None:
            self.catches = [catch(made, i) for i in range(3)]
        ending = made.time - sequencer.since > TIMES["hold"] - 1.5 * made.step
        if self.hooked is None and sequencer.phase == "hold" and ending:
            self.hooked = list(rig_hard.hooked(made))


def whole(level):
    """Run from the approach to the push-off."""
    seen = Seen()
    result = docking.run(replace(NOMINAL, level=level), "done", watched=seen)
    yield Fact("captured, hooked, released", result.sequencer.phase == "done")
    yield Limit(
        "when it says captured, the least catch lies behind its striker by", caught(seen)[0], 0.0, "m", least=True
    )
    yield Limit("and over its edge by", caught(seen)[1], 0.0, "m", least=True)
    yield from seen.hooked
    yield from rig_hard.separated(result.machine)
    yield from honest(result)
    peaks = ", ".join(f"{phase} {force:.0f}" for phase, force in result.watch.force.items())
    print(f"      greatest force between the vehicles by phase, N: {peaks}")
    print(
        f"      greatest force of a leg: {max(result.watch.leg.values()):.0f} N; stroke {result.watch.stroke * 1e3:.0f} mm"
    )


def caught(seen):
    """Least distances of the three catches behind and over the edges of their strikers, m."""
    behind = min(-d.IDSS.STRIKER_BACK - place[2] for place in seen.catches)
    return behind, min(math.hypot(place[0], place[1]) - STRIKER_EDGE for place in seen.catches)


def trained():
    """Level training, and its cost."""
    began = time.process_time()
    yield from whole(d.TRAINING)
    print(f"      {time.process_time() - began:.1f} s of processor time with the account of energy")


def restarts():
    yield Fact("restarted while the petals align: the same bits", docking.same_bits_after_restart(NOMINAL, 1.9, 0.2))
    yield Fact("restarted while the hooks close: the same bits", docking.same_bits_while_hooking(d.TRAINING, 1.9, 0.2))


def attenuation(level):
    """An aligned approach: when the closing speed is zero, the legs store ½mv² less the energy of capture."""
    made, sequencer = docking.approach(replace(ALIGNED, level=level)), Sequencer()
    result = docking.Result(made, sequencer, docking.Watch())
    moving = 0.5 * vehicles.reduced_mass() * ALIGNED.speed**2

    def turned(m):
        result.watch(m, sequencer)
        return m.time > 1.0 and result.relative_speed()[2] <= 0.0

    made.run(10.0, sequencer, turned)
    work = made.ledger.work
    yield Row("work on the legs over ½mv², when the vehicles stop", -work["motors"] / moving, 1.0, 0.05)
    yield Row("with what contacts, latches and closures took", -sum(work.values()) / moving, 1.0, 2e-3)
    yield Limit("stroke", result.watch.stroke, d.EXTENDED - d.IDSS.HARD_RING_HEIGHT, "m")
    yield from honest(result)


def analysed():
    """Soft capture at level analysis, also at half the step."""
    found = {}
    for label, level in (("", d.ANALYSIS), (" at half the step", replace(d.ANALYSIS, step=d.ANALYSIS.step / 2))):
        result = docking.run(replace(NOMINAL, level=level), "align")
        found[label] = result
        yield Fact("captured" + label, result.captured)
        yield from honest(result)
    one, half = found.values()
    yield Row("time of capture at half the step", half.sequencer.captured_at, one.sequencer.captured_at, 0.02, "s")
    for phase in ("capture", "attenuate"):
        yield Row(
            f"greatest force in the phase {phase} at half the step",
            half.watch.force[phase],
            one.watch.force[phase],
            0.05,
            "N",
        )
    yield Row("stroke at half the step", half.watch.stroke, one.watch.stroke, 0.01, "m")


def hard_analysed():
    """Run from the last 12 mm of retraction to the push-off."""
    for label, level in (("", d.ANALYSIS), (" at half the step", replace(d.ANALYSIS, step=d.ANALYSIS.step / 2))):
        seen = Seen()
        made = docking.captured(d.MATED + d.SLOW_FROM, level)
        result = docking.go_on(made, Sequencer(from_phase="slow"), "done", watched=seen)
        print(f"      step {level.step * 1e3:g} ms")
        yield from seen.hooked
        yield from rig_hard.separated(made)
        yield from honest(result)


def latch_energy():
    """Energy of three latches pushed over the edges of their strikers, J."""
    return 1.5 * d.LATCH_STIFFNESS * d.IDSS.LATCH_ENGAGEMENT**2


def too_slow():
    """An approach with less energy than the latches need to open, and therefore without capture.

    Half the step of level training: at the end the latches spring back, and semi-implicit Euler has ½h·F·v of their springs
    more than the forces explain, which is 1.2e-3 of the little that went through at 1 ms.
    """
    slowest = math.sqrt(2 * latch_energy() / vehicles.reduced_mass())
    level = replace(d.TRAINING, step=d.TRAINING.step / 2)
    case = replace(ALIGNED, speed=0.7 * slowest, gap=0.03, give_up=12.0, level=level)
    deepest = [0.0]

    def watched(made, _):
        deepest[0] = min(deepest[0], *(made.joint(f"latch_{i}") for i in range(3)))

    result = docking.run(case, "align", watched=watched)
    bound = math.sqrt(vehicles.reduced_mass() * case.speed**2 / (3 * d.LATCH_STIFFNESS))
    yield Fact(f"at {case.speed * 1e3:.2f} mm/s, 0.7 of √(2E/m): not captured", not result.captured)
    yield Limit("its latches were pushed aside by", -deepest[0], bound, "m")
    yield Limit("by more than", -deepest[0], 1e-3, "m", least=True)
    yield from honest(result)


def failures():
    dead = docking.run(replace(NOMINAL, dead_latch=0), "align")
    yield Fact("with a dead latch: no capture, the approach is aborted", dead.sequencer.phase == "abort")
    parted = dead.machine.run(25.0, dead.sequencer, lambda m: m.place("target")[2] - m.place("ring")[2] > 0.15)
    yield Fact("and the vehicles part", parted)
    yield from honest(dead)
    stuck = docking.run(replace(NOMINAL, stuck_leg=0), "align")
    yield Fact("with a stuck leg: captured all the same", stuck.captured)
    bound = max(stuck.watch.leg.values()) / d.STUCK.stiffness + 1e-4
    yield Limit("the stuck leg gave way by", abs(stuck.machine.joint("leg_0")), bound, "m")
    print(f"      greatest force of a leg: {max(stuck.watch.leg.values()):.0f} N")
    yield from honest(stuck)


def limits():
    """Approaches at all limits of the initial contact conditions at once."""
    for speed in d.CLOSING:
        for side in (1, -1):
            case = Case(
                speed=speed,
                lateral=(d.LATERAL * 0.6, d.LATERAL * 0.8),
                lateral_rate=(side * d.LATERAL_RATE, 0.0),
                tilt=(side * d.TILT * 0.8, d.TILT * 0.6),
                roll=side * d.ROLL,
                rates=(side * d.RATE, side * d.RATE, -side * d.RATE),
            )
            result = docking.run(case, "align", limit=15.0)
            what = f"{speed} m/s, 0.10 m, 4° of tilt and of roll, rates {'+' if side > 0 else '-'}"
            yield Fact(f"captured at {what}", result.captured)
            yield Fact("nothing tunnelled", not result.tunnelled)


def elsewhere():
    """An approach repeated in another attitude, 1 km away."""
    frame = vehicles.about("z", 0.7) @ vehicles.about("y", 1.1) @ vehicles.about("x", 0.4)
    results = []
    for moved in (False, True):
        made = docking.approach(NOMINAL)
        if moved:
            docking.turn(made, frame, np.array([600.0, -700.0, 400.0]))
        results.append(docking.go_on(made, Sequencer(), "align"))
    one, other = results
    yield Row("turned and moved: time of capture", other.sequencer.captured_at, one.sequencer.captured_at, 1e-9, "s")
    for phase in ("capture", "attenuate"):
        yield Row(
            f"its greatest force in the phase {phase}", other.watch.force[phase], one.watch.force[phase], 1e-6, "N"
        )


DRAWN = ("cylinder_*", "rod_*")  # bodies that logs and films show beside what touches


def shown(prepare):
    """Run for logs and films: `prepare` receives the machine before it moves."""
    docking.run(NOMINAL, "done", prepare=prepare)


def rows(thorough):
    yield "ring on its legs", rig_ring.rows()
    yield "level training", trained()
    yield "restarts", restarts()
    yield "worst case of the campaign", conclusion.again(campaign.STUDY, d.HERE)
    if thorough:
        yield "unequal pushers", rig_hard.unequal(d.ANALYSIS)
        yield "attenuation", attenuation(d.ANALYSIS)
        yield "soft capture, level analysis", analysed()
        yield "hard capture, level analysis", hard_analysed()
        yield "too slow", too_slow()
        yield "failures", failures()
        yield "limits", limits()
        yield "turned", elsewhere()
        yield "a catch goes round the edge of its striker", flagged.rows()

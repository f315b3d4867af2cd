"""Outcomes of box, connector and gripper and their predictions. Run by mechanisms/run.py: `rows(thorough)` yields
(title, rows)."""

import campaign
import dimensions as d
import exchange
import grip
import jam
import numpy as np
import rig
import statics
from kit import conclusion
from kit.rules import honest
from kit.rows import Fact, Limit, Row

NEAR = 0.03  # loads so near to the sides of the parallelogram are left out: turned boxes and springs that sink in


def loads(random):
    """Random loads, uniform over nearly twice the parallelogram: Fy/Fx, and M/Fx in m."""
    across = random.uniform(-1.8, 1.8) / d.FRICTION
    beyond = random.uniform(-1.8, 1.8) * d.BETWEEN / (2 * d.FRICTION)
    return across, beyond - d.FRICTION * d.WIDTH / 2 * across


def diagram(count, seed=1):
    """Random loads: a box between its rails slides if they are within the parallelogram, else it jams."""
    random = np.random.default_rng(seed)
    far = max(
        abs(statics.parallelogram(*load) - statics.resistance(*load)) for load in (loads(random) for _ in range(1000))
    )
    yield Limit("1,000 loads: parallelogram less the balance of two corners", far, 1e-12)
    wrong, slid, tried, nearest, imbalance, flags = 0, 0, 0, np.inf, 0.0, 0
    while tried < count:
        load = loads(random)
        out = statics.parallelogram(*load)
        if abs(out - 1.0) < NEAR:
            continue
        moved, made = rig.moves(*load)
        tried, slid, wrong = tried + 1, slid + moved, wrong + (moved != (out < 1.0))
        nearest, imbalance, flags = min(nearest, abs(out - 1.0)), max(imbalance, made.imbalance), flags | made.flags
        if moved != (out < 1.0):
            print(f"      wrong: Fy/Fx {load[0]:.3f}, M/Fx {load[1]:.3f} m, {out:.3f} of the way to the side")
    yield Limit(f"of {count} loads, those that slide or jam against the diagram", wrong, 0)
    yield Fact(f"some slid ({slid}), some jammed ({count - slid})", 0 < slid < count)
    print(f"      the load nearest to a side was {nearest:.1%} from it")
    yield Limit("forces that have no reaction, of the greatest", imbalance, 1e-9)
    yield Fact("no contact tunnelled, no limit was met", flags == 0)


def jammed(level=d.TRAINING):
    """Offset and turned: it jams at the second contact, and a yielding wrist frees it."""
    made, wrist, touched, went = jam.pushed(jam.OFFSET, step=level.step)
    yield Row("depth of the second touch", touched, statics.second_touch(jam.TILT), 0.02, "m")
    yield Limit("further way from there with 120 N", jam.depth(made) - touched, 1.5e-3, "m")
    yield Limit("way in the last half second with 120 N", went, 1e-5, "m")
    yield Row("push that does not move it", wrist.push, d.ARM_FORCE, 1e-6, "N")
    freed, moment, stood = jam.released(made, wrist)
    yield Fact("accommodation frees it", freed)
    yield Row("moment of the wrist then", moment, jam.predicted_release(stood), 0.06, "N·m")
    yield from seated(made, wrist)
    yield from honest(made)


def moved_push():
    """The other cure: the arm takes the jammed box in the middle and continues to push."""
    made, wrist, _, went = jam.pushed(jam.OFFSET)
    yield Limit("way in the last half second of the jam", went, 1e-5, "m")
    wrist.grip[1] = 0.0
    yield from seated(made, wrist)


def seated(made, wrist):
    arrived, force = jam.home(made, wrist)
    yield Fact("the box comes home", arrived)
    yield Row(
        "force on the stop: push less the springs of the connector", force, d.ARM_FORCE - statics.spring(), 0.01, "N"
    )


def opposite(level=d.TRAINING):
    """A push in the middle at the same tilt: the box enters, with the push of the closed form."""
    made, wrist = jam.start(0.0, step=level.step)
    for deep in (0.040, 0.060, 0.080):
        made.run(5.0, wrist, watch=lambda m, deep=deep: jam.depth(m) > deep)
        expected = statics.feed(jam.depth(made), jam.TILT, 0.0)
        yield Row(f"push at the depth {deep * 1e3:.0f} mm", wrist.push, expected, 0.03, "N")
    yield from seated(made, wrist)
    yield from honest(made)


def limit():
    """Offsets just within and just beyond the jamming limit."""
    most = statics.jams_from(jam.TILT)
    for part, jams in ((0.9, False), (1.1, True)):
        _, _, _, went = jam.pushed(part * most)
        word = "jams" if jams else "goes on"
        yield Fact(
            f"held {part * most * 1e3:.1f} mm beside the middle ({part:g} of the limit) it {word}",
            (went < 1e-5) == jams,
        )


def cone():
    """Self-locking if tan α is below the friction, else slipping; forces that pull the cone out and drive it in."""
    for trial, part in d.ABOUT_LIMIT.items():
        slipped, way, _ = grip.slips(trial)
        word = "holds by itself" if part < 1 else "slips out"
        yield Fact(f"tan α = {part:g} of the friction: it {word} (it went {way * 1e3:.3f} mm)", slipped == (part > 1))
    for way, word in ((1, "pulls it out"), (-1, "drives it in")):
        force, made = grip.drawn_through(way)
        yield Row(f"force that {word} against stalled motors", force, grip.predicted(way), 0.01, "N")
        yield from honest(made)


def exchanged(level):
    """A gripper takes the box by its cone, inserts it, pulls it out, releases it and retreats."""
    made, sequencer = exchange.run(level.step)
    force = d.ARM_FORCE - statics.spring()
    yield Row("force on the stop: push less the springs of the connector", sequencer.stop, force, 0.01, "N")
    yield Limit("how far the cone moves in the jaws", sequencer.slipped, 2e-4, "m")
    yield Limit("the box is where it began: off by", abs(made.place("box")[0] - exchange.BEGIN), 2.5e-3, "m")
    apart = exchange.along(made) - d.LENGTH / 2
    yield Limit("the gripper has left it: distance", apart, 0.015, "m", least=True)
    yield from honest(made)


def weak_jaws(voltage=0.6):
    """A push that overcomes the jaws: the cone enters them, and the stop bears the force that the wedge transmits."""
    made, sequencer = exchange.run(voltage=voltage, until="out")
    predicted = exchange.driven_in(voltage)
    yield Row(f"jaws at {voltage:g} of their voltage: force on the stop", sequencer.stop, predicted, 0.02, "N")
    yield Limit("the cone has gone into them by", sequencer.slipped, 1e-3, "m", least=True)


def half_step():
    ends = []
    for step in (d.ANALYSIS.step, d.ANALYSIS.step / 2):
        made, wrist, touched, _ = jam.pushed(jam.OFFSET, step=step)
        _, moment, _ = jam.released(made, wrist)
        ends.append((touched, moment, grip.drawn_through(1, step)[0]))
    for what, one, half, unit in zip(
        ("depth of the second touch", "moment of release", "force that pulls the cone out"), *ends, ("m", "N·m", "N")
    ):
        yield Row(f"{what} at half the step", half, one, 0.02, unit)
    one, half = (exchange.run(step, until="out")[1].stop for step in (d.TRAINING.step, d.TRAINING.step / 2))
    yield Row("force on the stop, the whole, at half the step", half, one, 2e-3, "N")


def shown(prepare):
    """Run for logs and films: the jam, the yielding wrist, and the way home. `prepare` receives the machine before it
    moves."""
    made, wrist = jam.start(jam.OFFSET)
    prepare(made)
    made.run(2.0, wrist)
    wrist.accommodating = True
    jam.home(made, wrist)


def rows(thorough):
    yield "Whitney's diagram for a box between rails", diagram(200 if thorough else 24)
    yield "turned, and held beside the middle: jam and its cure", jammed()
    yield "the opposite: held in the middle", opposite()
    yield "restart", [Fact("restarted in the jam: the same bits", jam.same_bits_after_restart())]
    yield "cone and jaws", cone()
    yield "the whole, with the gripper, level training", exchanged(d.TRAINING)
    yield "weak jaws", weak_jaws()
    yield "restart", [Fact("restarted on the way in: the same bits", exchange.same_bits_after_restart())]
    yield "worst case of the campaign", conclusion.again(campaign.STUDY, d.HERE)
    if thorough:
        yield "the whole, level analysis", exchanged(d.ANALYSIS)
        yield "the limit of the jam", limit()
        yield "the jammed box is taken in the middle", moved_push()
        yield "jam and cure, level analysis", jammed(d.ANALYSIS)
        yield "the opposite, level analysis", opposite(d.ANALYSIS)
        yield "half the step", half_step()

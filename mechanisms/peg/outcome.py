"""Outcomes of the peg and their predictions. Run by mechanisms/run.py."""

import held
import rig
import wedge
import whitney
from dimensions import LIMIT
from kit.rules import honest
from kit.rows import Fact, Row

NEAR_DEPTHS = (-1e-3, -0.5e-3, 0.01, 0.03, 0.05, 0.07)  # m, of the tip below the end of the chamfer
FAR_DEPTHS = (-1.5e-3, -1e-3, 0.01, 0.03, 0.05, 0.07)
BOTTOM = 0.095  # m of insertion at which it is called through


def deep(depth):
    return lambda made: rig.height(made) < -depth


def phases(name, step, depths):
    """Force and tilt against depth: chamfer, one contact, two contacts."""
    support = whitney.Support(rig.CENTRES[name])
    made = rig.machine(support.centre, step)
    for depth in depths:
        made.run(10.0, rig.feed, deep(depth))
        phase, force, lean = whitney.insertion(support, rig.height(made))
        # In the chamfer the wrist moves sideways, against its dampers.
        within = 0.03 if phase == "chamfer" else 0.01
        at = f"{name} centre, {phase}, {depth * 1e3:g} mm deep"
        yield Row(f"{at}: force of insertion", rig.resistance(made), force, within, "N")
        yield Row(f"{at}: lean", rig.lean(made), lean, 0.005, "rad")
    yield from honest(made)


def second_place(step):
    """Slow insertion: depth of the second contact."""
    for name, centre in rig.CENTRES.items():
        made = rig.machine(centre, step)
        made.run(4.0, rig.feed, deep(0.004))
        made.run(10.0, rig.feed, lambda m: m.contacts() > 1)
        predicted = whitney.second(whitney.Support(centre))
        yield Row(f"{name} centre: the second place touches at the depth", -rig.height(made), predicted, 0.005, "m")


def limited(step):
    """A feed of limited force: it passes with the centre at the tip, and jams with the centre far away."""
    near = rig.machine(rig.CENTRES["near"], step, LIMIT)
    yield Fact(f"pushed with at most {LIMIT:g} N, centre at the tip: through", near.run(9.0, rig.feed, deep(BOTTOM)))
    far = rig.machine(rig.CENTRES["far"], step, LIMIT)
    far.run(8.0, rig.feed)
    predicted = whitney.jams(whitney.Support(rig.CENTRES["far"]), LIMIT)
    yield Row("centre far away: it jams at the depth", -rig.height(far), predicted, 0.03, "m")
    middle, ends = far.save(), []
    for _ in range(2):
        far.restore(middle)
        far.run(0.3, rig.feed)
        ends.append(far.save().tobytes())
    yield Fact("restarted while it is jammed: the same bits", ends[0] == ends[1])


def halved(step):
    """Outcome at the step and at half of it."""
    results = []
    for each in (step, step / 2):
        made = rig.machine(rig.CENTRES["far"], each)
        made.run(10.0, rig.feed, deep(0.04))
        results.append(rig.resistance(made))
    yield Row("force 40 mm deep at half the step", results[1], results[0], 0.01, "N")


def rows(thorough):
    yield "centre of compliance at the tip", phases("near", rig.ANALYSIS, NEAR_DEPTHS)
    yield "centre of compliance far away", phases("far", rig.ANALYSIS, FAR_DEPTHS)
    if thorough:
        yield "level training, centre at the tip", phases("near", rig.TRAINING, NEAR_DEPTHS)
        yield "level training, centre far away", phases("far", rig.TRAINING, FAR_DEPTHS)
        yield "second place", second_place(rig.ANALYSIS)
    yield "limited feed", limited(rig.TRAINING)
    yield "half the step", halved(5e-4)
    yield "wedging, with sixteen edges", wedge.rows()
    yield "in the hand of the arm", held.inserted()
    if thorough:
        yield "in the hand of the arm, half the step", held.inserted(held.STEP / 2)


DRAWN = ("hole", "base", "link_*")  # bodies that logs and films show beside what touches


def shown(prepare):
    """Run for logs and films: the arm inserts the peg."""
    made, controller = held.machine(held.YIELDING)
    prepare(made)
    held.push(controller)
    made.run(20.0, controller.control)

"""Outcomes of the retention latches and their predictions. Run by mechanisms/run.py: `rows(thorough)` yields (title,
rows)."""

import time

import campaign
import dimensions as d
import latch
import numpy as np
import pull
from dimensions import model
from kit.arm.dimensions import LINKS, TORQUE
from kit.conclusion import again
from kit.rules import honest
from kit.rows import Fact, Limit, Row

BEFORE, STANDS, END = 6.0, 15.0, 26.0  # s: before the stall; the truss stands against its latches; the end


def pulled(torque, step=d.TRAINING, prepare=None):
    """A pull to its end; bits before the stall, torques and position at standstill, and the displacement."""
    made, began = pull.Pull(torque, step), time.process_time()
    if prepare is not None:
        prepare(made.machine)
    made.run(BEFORE)
    early = made.machine.save().tobytes()
    made.run(STANDS - BEFORE)
    torques, stood = made.torques(), made.machine.place("truss")
    made.run(END - STANDS)
    spent = (time.process_time() - began) / (made.machine.time / made.machine.step)
    print(f"      step {made.machine.step * 1e3:g} ms: {spent * 1e6:.0f} µs of processor time a step")
    return made, early, torques, made.machine.place("truss") - stood


def conclusion(step=d.TRAINING):
    """Uncommanded motion when joints stall, and none with unlimited joints, under the same commands."""
    limited, early, torques, went = pulled(TORQUE, step)
    joint, when, asked, _ = limited.stalled
    print(f"      {LINKS[joint].name} stalls at {when:.2f} s")
    yield Row("torque that the latches ask of it, JᵀF", abs(asked[joint]), TORQUE, 0.03, "N m")
    for number in np.flatnonzero(np.abs(torques) > 0.9 * TORQUE):
        yield Row(f"while the truss stands: JᵀF of {LINKS[number].name}", abs(torques[number]), TORQUE, 0.02, "N m")
    yield Limit("the arm pulls aft; the truss goes forward by", -went[0], 0.005, "m", least=True)
    yield Limit("and to the side by", abs(went[1]), 0.005, "m", least=True)
    yield from honest(limited.machine)
    free, other, torques, stays = pulled(pull.UNLIMITED, step)
    yield Fact("with unlimited joints: the same bits before the stall", early == other)
    yield Limit("forward", -stays[0], 1e-3, "m")
    yield Limit("to the side", abs(stays[1]), 1e-3, "m")
    greatest = np.abs(free.torques()).max()
    yield Limit("greatest JᵀF at the end", greatest, 2 * TORQUE, "N m", least=True)
    yield from honest(free.machine)


def berthed(step=d.TRAINING):
    made = latch.Berthing(step)
    made.run()
    place = made.machine.place("truss")
    yield Limit("off the middle along x: the play of the sockets", abs(place[0]), model.PRIMARY_CLEARANCE + 2e-4, "m")
    yield Limit("off the middle sideways: the gap of the keel latch", abs(place[1]), model.KEEL_CLOSED_GAP + 2e-4, "m")
    for name, force in made.held().items():
        yield Row(f"force of the claw of {name}: torque over lever", force, latch.preload(place[0]), 0.01, "N")
    yield from honest(made.machine)


def off_nominal():
    """Latching with one claw that does not close; the others hold."""
    made = latch.Berthing(dead="claw_primary_port")
    made.run()
    held = made.held()
    yield Limit("force of the claw without power", abs(held.pop("primary_port")), 1e-9, "N")
    for name, force in held.items():
        yield Row(f"of the claw of {name}", force, latch.preload(made.machine.place("truss")[0]), 0.01, "N")
    yield Limit("height of the truss above its seat", abs(made.machine.place("truss")[2]), 1e-3, "m")


def restart():
    yield Fact("restarted on the way into the guides: the same bits", latch.same_bits_after_restart(7.0, 0.5))


DRAWN = ("base", "link_*", "truss", "claw_*", "keel_jaw_*")  # bodies that logs and films show beside what touches


def shown(prepare):
    """Run for logs and films: `prepare` receives the machine before it moves."""
    made = latch.Berthing()
    prepare(made.machine)
    made.run()


def rows(thorough):
    yield "joints that stall, level training", conclusion()
    yield "restart", restart()
    yield "worst case of the campaign", again(campaign.STUDY, d.HERE)
    if thorough:
        yield "berthed and latched", berthed()
        yield "one claw does not close", off_nominal()
        yield "joints that stall, level analysis at half the step", conclusion(d.ANALYSIS)

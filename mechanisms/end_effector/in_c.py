"""Input of hosts/mujoco/realtime/end_effector.c: a capture at level training, with its sequence as rows of numbers."""

import capture
import snare as s
from dimensions import Snare, training
from scene import screw_force

CASE = capture.Case(snare=training(Snare()))
PRELOAD_WITHIN = 0.01  # of the predicted one


def machine():
    return capture.machine(CASE)


def rows(made):
    sequencer = capture.sequencer_of(CASE)
    yield ["begin", sequencer.phase]
    yield from _phases(sequencer)
    yield from (["group", name, i] for name, i in made.groups.items())
    snare = CASE.snare
    for name in ("snare_torque", "stall_torque", "free_speed"):
        yield [name, getattr(snare, name)]
    yield ["open_turn", s.open_turn(snare)]
    yield ["plate_height", capture.PLATE_HEIGHT]
    yield ["extended", capture.EXTENDED]
    yield ["unloaded", capture.UNLOADED * screw_force()]
    yield ["apart_for", capture.APART_FOR]
    yield ["steps_after", round(capture.AFTER / made.step)]
    yield ["preload", screw_force()]
    yield ["preload_within", PRELOAD_WITHIN]


def _phases(sequencer):
    """Limit, ring, its brake, screw, plungers; the joint whose rest ends the phase, its speed limit, and the duration."""
    for phase, (ring, brake, screw, plungers) in sequencer.MOTORS.items():
        brake = CASE.snare.brake_torque if brake else 0.0
        calm = sequencer.CALM.get(phase, ("-", 0.0, 0.0))
        yield ["phase", phase, sequencer.limits.get(phase, 0.0), ring, brake, screw, plungers, *calm]


def run(made):
    """Runs the same case in Python."""
    sequencer = capture.sequencer_of(CASE)
    while sequencer.phase != "done":
        made.hurry(sequencer)
    for _ in range(round(capture.AFTER / made.step)):
        made.hurry(sequencer)

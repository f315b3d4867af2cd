"""Capture and release: the sequencer of the end effector, and the result of a run. The machine: scene.py."""

import math
from dataclasses import dataclass

import numpy as np
import snare as s
from dimensions import PLUNGERS, SEAT
from kit.machine import Machine
from kit.restart import same_bits
from scene import PLATE_HEIGHT, Case, groups, mjcf_text, screw_force

EXTENDED = 0.012  # m: how far the carriage goes back at most before the snare opens
UNLOADED = 0.03  # of the preload on the pads, at which the carriage stops going back
AFTER = 0.5  # s that are run after the end
APART_FOR = 0.1  # s without contact after which plungers and payload are apart


class Sequencer:
    """Phases in sequence: each begins when the one before is finished or has timed out.

    Its state is in its attributes, so `copy.deepcopy` saves it beside the state of the machine.
    """

    # s
    LIMITS = {
        "approach": 3.0,
        "snare": 6.0,
        "retract": 15.0,
        "rigidize": 4.0,
        "release": 4.0,
        "open": 6.0,
        "push": 6.0,
    }
    # Ring: voltage and brake; screw: voltage; plungers: released. Slow while a payload is pulled in, so that a heavy
    # one follows, and slower while the preload is released, so that a payload sticking to the cables is not dragged
    # along.
    MOTORS = {
        "approach": (0, True, 0.0, 0),
        "snare": (1, False, 0.0, 0),
        "retract": (0, True, 0.5, 0),
        "rigidize": (0, True, 1.0, 0),
        "hold": (0, True, 1.0, 0),
        "release": (0, True, -0.1, 0),
        "open": (-1, False, 0.0, 0),
        "push": (0, True, 0.0, 1),
        "done": (0, True, 0.0, 1),
    }
    # Joint whose rest ends a phase, the limit of its speed (rad/s or m/s), and the duration, s.
    CALM = {"snare": ("turn", 0.02, 0.5), "retract": ("retract", 1e-3, 0.3), "rigidize": ("retract", 3e-4, 0.3)}

    def __init__(self, snare, held_for=0.3, first="snare"):
        self.limits = {**self.LIMITS, "hold": held_for}
        self.missed = ""  # the phase in which the sequencer saw that there is nothing to capture, and gave up
        self.snare, self.phase, self.since, self.calm, self.carriage = snare, first, 0.0, 0.0, 0.0
        self.peaks, self.ends = dict.fromkeys(self.MOTORS, 0.0), {}

    def __call__(self, machine):
        self.peaks[self.phase] = max(self.peaks[self.phase], float(np.linalg.norm(machine.wrench("payload")[:3])))
        if self.phase != "done" and self._finished(machine):
            self.ends[self.phase] = machine.time
            self.phase, self.since = self._next(machine), machine.time
            self.calm = self.since
            self.carriage = machine.joint("retract")
        self._drive(machine)

    def _next(self, machine):
        """Next phase; after a failure it is the end."""
        if self._failed(machine):
            self.missed = self.phase
            return "done"
        phases = list(self.MOTORS)
        return phases[phases.index(self.phase) + 1]

    def _failed(self, machine):
        """True if the phase failed: nothing entered the mouth, the closed snare touches nothing, or nothing presses the
        pads."""
        return {
            "approach": lambda: not self._near(machine),
            "snare": lambda: not np.any(machine.on("fixture")),
            "retract": lambda: not np.any(machine.on("pads")),
        }.get(self.phase, lambda: False)()

    def _drive(self, machine):
        ring, brake, screw, plungers = self.MOTORS[self.phase]
        self._turn(machine, ring)
        for name, voltage in (("screw", screw), ("plungers", plungers)):
            machine.data.ctrl[machine.model.actuator(name).id] = voltage
        machine.model.dof_frictionloss[machine.model.joint("turn").dofadr[0]] = (
            self.snare.brake_torque if brake else 0.0
        )

    def _turn(self, machine, voltage):
        """Voltage of the ring's motor, limited by its current."""
        limit = self.snare.snare_torque / self.snare.stall_torque
        turning = machine.speed("turn") / self.snare.free_speed
        machine.data.ctrl[machine.model.actuator("ring").id] = min(limit + turning, max(turning - limit, voltage))

    def close(self, machine):
        """Closes the snare in any phase."""
        self._turn(machine, 1.0)

    def _finished(self, machine):
        waited = machine.time - self.since
        if waited >= self.limits[self.phase]:
            return True
        if self.phase in self.CALM:
            joint, speed, lasting = self.CALM[self.phase]
            if abs(machine.speed(joint)) > speed:
                self.calm = machine.time
            return machine.time - self.calm > lasting
        return {"approach": self._near, "release": self._unloaded, "open": self._opened, "push": self._apart}.get(
            self.phase, lambda _: False
        )(machine)

    def _near(self, machine):
        """The operator's camera view: the target is near enough."""
        return in_shell(machine)[2] <= PLATE_HEIGHT

    def _unloaded(self, machine):
        """Signal of a load cell behind the pads."""
        moved = self.carriage - machine.joint("retract")
        return moved > EXTENDED or pressed(machine) < UNLOADED * screw_force()

    def _opened(self, machine):
        return machine.joint("turn") <= s.open_turn(self.snare)

    def _apart(self, machine):
        if np.any(machine.on("plungers")[:3]):
            self.calm = machine.time
        return machine.time - self.calm > APART_FOR


def sequencer_of(case):
    return Sequencer(case.snare, case.held_for, "approach" if case.approach else "snare")


def in_shell(machine):
    """Place of the plate's centre in the frame of the shell, m."""
    shell = machine.model.body("shell").id
    axes = machine.data.xmat[shell].reshape(3, 3)
    return axes.T @ (machine.place("payload") - machine.data.xpos[shell])


def axial(machine, group):
    """Force on one of the shell's groups along its axis, N: positive inwards."""
    return -float(machine.data.xmat[machine.model.body("shell").id].reshape(3, 3)[:, 2] @ machine.on(group)[:3])


def pressed(machine):
    return axial(machine, "pads")


def machine(case: Case):
    carried = groups(case)
    made = Machine(mjcf_text(case), list(carried.values()), list(carried))
    freedom = made.model.body("payload").dofadr[0]
    made.data.qvel[freedom : freedom + 3] = case.drift
    made.start()
    return made


@dataclass
class Result:
    """Result of a capture; forces in N."""

    captured: bool  # the pads were pressed with more than half of the preload
    missed: str  # the phase after which the sequencer gave up, or ""
    preload: float  # between shell and payload when the hold ends: pads, teeth, cams
    on_teeth: float  # what of it is on the teeth
    turned_deg: float  # of the payload about the shell's axis, when the hold ends
    aside: float  # of the plate's centre from the shell's axis, then, m
    peaks: dict  # greatest force on the payload in each phase
    ends: dict  # time at which each phase ended, s
    gap: float  # of the plate from the tips of the plungers when these are let go, m
    before: float  # speed of the payload along the shell's axis, then, m/s
    away: float  # and at the end
    machine: Machine


def look(made):
    """Measurements of a preloaded joint."""
    parts = {name: axial(made, name) for name in ("pads", "teeth", "rollers") if name in made.groups}
    place = in_shell(made)
    return parts["pads"], sum(parts.values()), parts["teeth"], roll_deg(made), math.hypot(place[0], place[1])


def run(case, until="done", watch=None, accounts=True, prepare=None):
    """Runs a case. `watch(machine, sequencer)` is called at every step, `prepare(machine)` at the start. Without
    `accounts` of energy and reactions it takes half the time.
    """
    made, sequencer = machine(case), sequencer_of(case)
    if prepare is not None:
        prepare(made)
    advance = made.advance if accounts else made.hurry
    seen, before = (0.0, 0.0, 0.0, 0.0, 0.0), (0.0, 0.0)
    while sequencer.phase not in (until, "done"):
        advance(sequencer)
        if sequencer.phase == "hold":
            seen = look(made)
        if sequencer.phase == "open":
            before = (in_shell(made)[2] - SEAT - made.joint("plungers"), speed_apart(made))
        if watch is not None:
            watch(made, sequencer)
    if until == "done":
        for _ in range(round(AFTER / made.step)):
            advance(sequencer)
    pads, *rest = seen
    return Result(
        pads > 0.5 * screw_force(),
        sequencer.missed,
        *rest,
        sequencer.peaks,
        sequencer.ends,
        *before,
        speed_apart(made),
        made,
    )


def roll_deg(made):
    """Roll of the payload about the shell's axis, degrees."""
    shell, payload = (made.data.xmat[made.model.body(name).id].reshape(3, 3) for name in ("shell", "payload"))
    seen = shell.T @ payload
    return math.degrees(math.atan2(seen[1, 0] - seen[0, 1], seen[0, 0] + seen[1, 1]))


def speed_apart(made):
    """Velocity of the payload's origin in the world along the shell's axis, m/s."""
    return float(made.data.xmat[made.model.body("shell").id].reshape(3, 3)[:, 2] @ velocity(made))


def velocity(made):
    """Velocity of the payload's origin, m/s."""
    first = made.model.body("payload").dofadr[0]
    return made.data.qvel[first : first + 3]


def push_off_speed(mass, gap=0.0, before=0.0):
    """Speed from the plunger springs' remaining energy at the gap, shared by payload and plungers, m/s."""
    energy = 0.5 * PLUNGERS.spring * (PLUNGERS.stroke - gap) ** 2 + 0.5 * mass * before**2
    return math.sqrt(2.0 * energy / (mass + PLUNGERS.mass))


def same_bits_after_restart(case, before, after):
    """The brake belongs to the model, not to the state: the sequencer sets it before the first step after the restart."""
    return same_bits(lambda: machine(case), sequencer_of(case), before, after)

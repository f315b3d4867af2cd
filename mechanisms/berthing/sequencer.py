"""The sequence of a berthing: a state machine over numbers that sensors give. No MuJoCo, no NumPy: easy to port to C.

approach   the arm brings the module in; nothing moves until all four indicators have been ready for a while
capture    the latches close with little current until all have caught; standoffs carry the module
limp       the arm lets go
pull       the current rises to that of the stalled motor; the latches pull the module onto the stops
hold       stalled
bolt       (when asked to unberth) bolts hold the module
open       latches open and stow
away       bolts let go, standoffs push the module off
"""

from dataclasses import dataclass, field

import dimensions as d

APPROACH, CAPTURE, LIMP, PULL, HOLD, BOLT, OPEN, AWAY = range(8)
PHASES = ("approach", "capture", "limp", "pull", "hold", "bolt", "open", "away")
LATCHES = 4
READY_FOR = 0.5  # s that all indicators must have been ready without a break
STANDS = 0.03  # rad/s, a twentieth of the free speed: a crank that is slower stands
STANDS_FOR = 0.5  # s
CAUGHT = 0.60  # angle of a crank whose roller has drawn its fitting down to about 40 mm
CAUGHT_FOR = 1.0  # s
CAPTURE_MOST, PULL_MOST, OPEN_MOST = 8.0, 15.0, 12.0  # s
LIMP_FOR = 1.0
RAMP = 6.0  # s in which the current rises
HELD_FOR = 1.5
BOLTED_FOR = 0.5
CLOSED_LEAST = 0.80  # angle of a crank that has drawn its fitting in
STOWED_WITHIN = 0.03  # of the stowed angle


@dataclass
class Sensed:
    """Sensor values: strokes of four plungers, angles of four paddles, angles of four cranks."""

    time: float
    stroke: list
    turn: list
    crank: list
    crank_speed: list


@dataclass
class Commands:
    """Commands: voltages −1 to 1 of the latches; height of the arm's tip; arm on or off; bolts fixed or released."""

    voltage: list = field(default_factory=lambda: [0.0] * LATCHES)
    gap: float = d.START_GAP
    arm_on: bool = True
    bolts: bool = False


class Sequencer:
    def __init__(self, unberth=False, start_gap=d.START_GAP):
        self.unberth, self.start_gap = unberth, start_gap
        self.phase = APPROACH
        self.since = 0.0  # time at which the phase began
        self.quiet_since = 0.0  # since when what ends the phase has been so
        self.gap = start_gap
        self.fault = False  # a latch did not draw its fitting in
        self.ends = [-1.0] * len(PHASES)  # time at which each phase ended

    def step(self, sensed):
        if self._finished(sensed):
            self._next(sensed)
        if self.phase == APPROACH:
            self.gap = max(d.PUSHED_GAP, self.start_gap - d.APPROACH_SPEED * sensed.time)
        return Commands(self._voltages(sensed), self.gap, self.phase <= CAPTURE, self.phase in (BOLT, OPEN))

    def _next(self, sensed):
        self.ends[self.phase] = sensed.time
        if self.phase == PULL:
            self.fault = min(sensed.crank) < CLOSED_LEAST
        self.phase += 1
        self.since = self.quiet_since = sensed.time

    def _finished(self, sensed):
        waited = sensed.time - self.since
        if self.phase == APPROACH:
            return self._lasting(all_ready(sensed), READY_FOR, sensed.time)
        if self.phase == CAPTURE:
            return self._lasting(all_caught(sensed), CAUGHT_FOR, sensed.time) or waited > CAPTURE_MOST
        if self.phase == LIMP:
            return waited > LIMP_FOR
        if self.phase == PULL:
            standing = self._lasting(all_stand(sensed), STANDS_FOR, sensed.time)
            return waited > RAMP and standing or waited > PULL_MOST
        if self.phase == HOLD:
            return self.unberth and waited > HELD_FOR
        if self.phase == BOLT:
            return waited > BOLTED_FOR
        if self.phase == OPEN:
            return all_stowed(sensed) or waited > OPEN_MOST
        return False

    def _lasting(self, holds, seconds, time):
        """True if a condition has held for a time."""
        if not holds:
            self.quiet_since = time
        return holds and time - self.quiet_since > seconds

    def _voltages(self, sensed):
        if self.phase in (CAPTURE, LIMP):
            return [driven(d.CAPTURE_SHARE, speed) for speed in sensed.crank_speed]
        if self.phase == PULL:
            risen = min(1.0, (sensed.time - self.since) / RAMP)
            share = d.CAPTURE_SHARE + (1.0 - d.CAPTURE_SHARE) * risen
            return [driven(share, speed) for speed in sensed.crank_speed]
        if self.phase in (HOLD, BOLT):
            return [1.0] * LATCHES
        if self.phase == OPEN:
            return [-1.0 if crank > d.STOWED + STOWED_WITHIN else 0.0 for crank in sensed.crank]
        return [0.0] * LATCHES


def driven(share, speed):
    """Voltage at which a turning motor acts as one with this share of the stall torque, and the same free speed."""
    return min(1.0, max(-1.0, share + (1.0 - share) * speed / d.FREE_SPEED))


def all_ready(sensed):
    return min(sensed.stroke) >= d.READY_STROKE and min(sensed.turn) >= d.READY_TURN


def all_caught(sensed):
    return min(sensed.crank) >= CAUGHT


def all_stand(sensed):
    return max(abs(speed) for speed in sensed.crank_speed) < STANDS


def all_stowed(sensed):
    return max(sensed.crank) <= d.STOWED + STOWED_WITHIN

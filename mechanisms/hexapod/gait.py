"""Tripod gait as a state machine. Three legs swing while three stand; each swing ends where its foot finds ground."""

import math

import dimensions as d
import leg
import rig

SWING, STAND = 0, 1
LEVELLING, HEADING, SIDE, RAISING = 2.0, 1.0, 0.5, 2.0  # 1/s: how fast the body's errors are taken out
LOWERING = 0.10  # m/s at which a foot feels for ground that is lower than it should be
HALF = d.PERIOD / 2
SWINGS = (1.0 - d.DUTY) * d.PERIOD  # s


class Gait:
    """`speed`: that of the body, m/s. All standing feet move with the body's motion, so none must slip."""

    def __init__(self, speed=d.STRIDE / d.PERIOD):
        self.speed = speed
        self.places = [list(leg.neutral(i)) for i in rig.LEGS]
        self.states = [STAND] * 6
        self.tripod, self.clock, self.waited = 0, -0.5, 0.0  # it stands for half a second first
        self.began = None  # where the swinging feet were
        self.leans = [0.0] * 6  # of the tibias at the last tick
        for i in rig.LEGS:
            self._touched(i)

    def control(self, hexapod):
        """Runs every TICK."""
        if round(hexapod.time / hexapod.step) % round(d.TICK / hexapod.step):
            return
        self.advance(hexapod.forces(), hexapod.data.qpos)
        rig.tell(hexapod, self.places)

    def advance(self, forces, pose):
        waiting = self.clock >= SWINGS and SWING in self.states
        speed = 0.0 if waiting or self.clock < 0.0 else self.speed
        self._stand(speed, pose)
        if self.clock >= 0.0:
            self._swing(forces)
        if waiting:
            self.waited += d.TICK
            return
        self.clock += d.TICK
        if self.clock >= HALF - 0.5 * d.TICK:
            self.clock, self.tripod, self.began = 0.0, 1 - self.tripod, None

    def _stand(self, speed, pose):
        """Moves the standing feet against the body's velocity and angular velocity, in the body's frame."""
        standing = [i for i in rig.LEGS if self.states[i] == STAND]
        mean = sum(self.places[i][2] for i in standing) / len(standing)
        w, x, y, z = pose[3:7]
        # Small angles about the body's axes.
        roll, pitch, yaw = 2.0 * w * x, 2.0 * w * y, 2.0 * w * z
        turn = (-LEVELLING * roll, -LEVELLING * pitch, -HEADING * yaw)
        move = (speed, -SIDE * pose[1], RAISING * (d.HEIGHT + mean))
        for i in standing:
            p = self.places[i]
            p[0], p[1], p[2] = (
                p[0] - d.TICK * (move[0] + turn[1] * p[2] - turn[2] * p[1]),
                p[1] - d.TICK * (move[1] + turn[2] * p[0] - turn[0] * p[2]),
                p[2] - d.TICK * (move[2] + turn[0] * p[1] - turn[1] * p[0]),
            )
            self._roll(i)

    def _roll(self, i):
        """Correction for a spherical foot: as its tibia rises by an angle, its middle rolls to the hip by radius · angle."""
        yaw, femur, knee = leg.angles(i, self.places[i])
        rolled = d.FOOT_RADIUS * (femur + knee - self.leans[i])
        self.places[i][0] -= rolled * math.cos(d.AZIMUTHS[i] + yaw)
        self.places[i][1] -= rolled * math.sin(d.AZIMUTHS[i] + yaw)
        self.leans[i] = femur + knee

    def _swing(self, forces):
        if self.began is None:
            self.began = {i: tuple(self.places[i]) for i in d.TRIPODS[self.tripod]}
            for i in self.began:
                self.states[i] = SWING
        share = self.clock / SWINGS
        for i, start in self.began.items():
            if self.states[i] != SWING:
                continue
            self._move(i, start, share)
            lowest = -d.HEIGHT - d.DEEPEST
            if share > 0.6 and forces[i][2] > d.TOUCH or self.places[i][2] <= lowest:
                self.states[i] = STAND
                self._touched(i)

    def _touched(self, i):
        """Marks the start of rolling."""
        _, femur, knee = leg.angles(i, self.places[i])
        self.leans[i] = femur + knee

    def _move(self, i, start, share):
        """Swing: up, ahead to half a stance before the neutral position, and down to the expected ground.

        Both ends are fixed on the ground: seen from the body they move back, so no foot leaves or lands sliding.
        """
        if share >= 1.0:
            self.places[i][2] -= LOWERING * d.TICK
            return
        x, y, z = leg.neutral(i)
        left = start[0] - self.speed * share * SWINGS
        land = x + self.speed * (0.5 * d.DUTY * d.PERIOD + (1.0 - share) * SWINGS)
        ahead = _eased((share - 0.2) / 0.6)
        self.places[i][:] = (
            left + ahead * (land - left),
            start[1] + ahead * (y - start[1]),
            _raised(start[2], z, share),
        )


def _raised(start, end, share):
    """Height of a swinging foot."""
    top = max(start, end) + d.LIFT
    if share < 0.4:
        return start + (top - start) * _eased(share / 0.4)
    return top + (end - top) * _eased((share - 0.4) / 0.6)


def _eased(t):
    """Smooth step from 0 to 1 with zero slope at the ends."""
    return 0.5 - 0.5 * math.cos(math.pi * min(max(t, 0.0), 1.0))

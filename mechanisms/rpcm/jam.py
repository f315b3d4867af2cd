"""Insertion of the box into the rails by an arm: offset and turned, it jams; aligned, it does not."""

import dimensions as d
import numpy as np
import rig
import statics
from kit.restart import same_bits

BEGIN = 0.010  # depth of the front corners at the beginning
TILT = 0.040  # rad: the arm holds the box turned to the left by so much
OFFSET = 0.070  # m to the right of the middle of the rear, where it holds it
FREED = 1e-4  # m: a box that went so far is free


class Wrist:
    """A six-axis drive on a body, the box at its rear or the gripper: a limited feed along x, free sideways, springs
    against rotation.

    `most`: of its push; `turning`: of the springs. `accommodating`: the attitude that it holds turns at a rate in proportion to the moment about the middle line of the rails.
    What it remembers is all in its attributes.
    """

    def __init__(self, grip, tilt, body="box", most=d.ARM_FORCE, turning=d.ARM_TURNING):
        self.most, self.turning = most, turning
        self.grip, self.tilt, self.body, self.way = np.array(grip), tilt, body, 1.0
        self.accommodating, self.goal = False, None
        self.push, self.moment, self.sensed = 0.0, 0.0, 0.0

    def __call__(self, made):
        held = made.model.body(self.body)
        turned, rates = made.data.xmat[held.id].reshape(3, 3), made.data.qvel[held.dofadr[0] :][:6]
        arm, spin = turned @ self.grip, turned @ rates[3:]
        place, velocity = made.place(self.body) + arm, rates[:3] + np.cross(spin, arm)
        force = np.array((self._feed(made, place[0], velocity[0]), *(-d.ARM_ACROSS * velocity[1:])))
        twist = self._turning(turned, spin)
        self.push, self.moment = force[0], twist[2]
        self.sensed = self.moment - place[1] * self.push
        if self.accommodating:
            self.tilt -= d.ACCOMMODATION * self.sensed * made.step
        made.data.xfrc_applied[held.id] = (*force, *(twist + np.cross(arm, force)))

    def _feed(self, made, x, speed):
        """Advances the goal steadily, but never further ahead than the largest push needs."""
        rate, ahead = self.way * d.SPEED, self.most / d.ARM_STIFFNESS
        goal = x if self.goal is None else self.goal + rate * made.step
        self.goal = float(np.clip(goal, x - ahead, x + ahead))
        wanted = d.ARM_STIFFNESS * (self.goal - x) + d.ARM_DAMPING * (rate - speed)
        return float(np.clip(wanted, -self.most, self.most))

    def _turning(self, turned, spin):
        held = np.array((-turned[2, 1], turned[2, 0], self.tilt - np.arctan2(turned[1, 0], turned[0, 0])))
        return self.turning * held - d.ARM_TURNING_DAMPING * spin


def depth(made, side=1):
    """Depth of the left front corner, or with −1 of the right one, m."""
    x, y = d.LENGTH / 2 - d.ROUNDING, d.WIDTH / 2 - d.ROUNDING
    angle = rig.yaw(made)
    return float(made.place("box")[0] + x * np.cos(angle) - side * y * np.sin(angle))


def start(offset, tilt=TILT, step=d.TRAINING.step):
    """The machine with a box held by the arm, in the middle of the mouth; and the wrist."""
    x, y = d.LENGTH / 2 - d.ROUNDING, d.WIDTH / 2 - d.ROUNDING
    place = BEGIN - x * np.cos(tilt) + y * np.sin(tilt), -x * np.sin(tilt), 0.0
    return rig.machine(place, tilt, step=step), Wrist((-d.LENGTH / 2, -offset, 0.0), tilt)


def second_touch(made, wrist):
    """Depth at which the pushed box has two contacts, each with its upper and its lower corner, m."""
    made.run(3.0, wrist, watch=lambda m: m.contacts() >= 4)
    return depth(made)


def pushed(offset, tilt=TILT, step=d.TRAINING.step, seconds=2.0):
    """Push for a duration: machine, wrist, depth of the second contact, and displacement in the last half second, m."""
    made, wrist = start(offset, tilt, step)
    touched = second_touch(made, wrist)
    made.run(seconds - 0.5 - made.time, wrist)
    before = depth(made)
    made.run(0.5, wrist)
    return made, wrist, touched, depth(made) - before


def released(made, wrist, seconds=5.0):
    """Accommodation of the wrist until the box moves on: whether it did, moment of the wrist then, and depth before."""
    stood, wrist.accommodating = depth(made), True
    free = made.run(seconds, wrist, watch=lambda m: depth(m) - stood > FREED)
    return free, wrist.moment, stood


def home(made, wrist, seconds=14.0):
    """Push until the box is at the stop; force on the stop, N."""
    rest = d.STOP - d.LENGTH / 2
    arrived = made.run(seconds, wrist, watch=lambda m: m.place("box")[0] > rest - 1e-5)
    made.run(0.5, wrist)
    return arrived, float(made.data.sensordata[made.sensed][3])


def predicted_release(stood):
    """Moment of the wrist at which the largest push slides the box again, including the contact depths under that push."""
    mouth = 0.0
    for _ in range(20):
        push, moment = statics.wedge(stood, statics.tilt_at(stood, mouth), OFFSET)
        mouth = d.ARM_FORCE / push
    return mouth * moment


def same_bits_after_restart(before=1.0, after=0.3):
    _, wrist = start(OFFSET)
    return same_bits(lambda: start(OFFSET)[0], wrist, before, after)

"""Holder of the pallet at its grapple fixture: a six-axis drive with compliance and limits of force and moment.

It stands for the arm. Another one takes its place if it has `lead(place, yaw)`, `accommodating`, `force`, `moment` and the
call `arm(machine)` before each step, which puts its wrench on the pallet into `data.xfrc_applied`.
"""

import dimensions as d
import numpy as np


def within(vector, most):
    """Vector limited to a length."""
    length = np.linalg.norm(vector)
    return vector if length <= most else vector * (most / length)


class Drive:
    """Springs and dampers between the commanded pose of the tip and the fixture.

    `limp`: the tip's wrist gives way, with its damping. `accommodating`: the tip yields to the moment about `about` (a place in the
    pallet), at ACCOMMODATION rad/s for each N·m beyond the dead band. All that it remembers is in its attributes.
    """

    def __init__(
        self,
        fixture=d.FIXTURE,
        most=d.ARM_FORCE,
        stiffness=d.ARM_STIFFNESS,
        damping=d.ARM_DAMPING,
        turning_damping=d.ARM_TURNING_DAMPING,
        limp=False,
    ):
        self.turning_damping = turning_damping
        self.fixture, self.most, self.limp = np.array(fixture), most, limp
        self.stiffness, self.damping = np.array(stiffness), np.array(damping)
        self.place, self.rate = np.zeros(3), np.zeros(3)
        self.yaw, self.pitch = 0.0, 0.0
        self.accommodating, self.about = False, np.zeros(3)
        self.force, self.moment = np.zeros(3), np.zeros(3)

    def lead(self, place, rate=(0.0, 0.0, 0.0)):
        """Sets the commanded position of the tip, and its rate."""
        self.place, self.rate = np.array(place), np.array(rate)

    def follow(self, machine):
        """Lets the wrist hold the present attitude of the pallet."""
        self.yaw, self.pitch, self.limp = *attitude(machine), False

    def at(self, machine):
        """Position and velocity of the fixture in the world."""
        arm = rotation(machine) @ self.fixture
        spin = rotation(machine) @ machine.data.qvel[3:6]
        return machine.place("pallet") + arm, machine.data.qvel[:3] + np.cross(spin, arm), arm, spin

    def __call__(self, machine):
        place, velocity, arm, spin = self.at(machine)
        wanted = self.stiffness * (self.place - place) + self.damping * (self.rate - velocity)
        self.force = within(wanted, self.most)
        self.moment = within(self._turning(machine, spin), d.ARM_MOMENT)
        about = rotation(machine) @ self.about
        self.sensed = self.moment[2] + np.cross(arm - about, self.force)[2]
        if self.accommodating:
            beyond = np.sign(self.sensed) * max(0.0, abs(self.sensed) - d.DEAD_BAND)
            self.yaw -= d.ACCOMMODATION * beyond * machine.step
        body = machine.model.body("pallet").id
        machine.data.xfrc_applied[body] += (*self.force, *(self.moment + np.cross(arm, self.force)))

    def _turning(self, machine, spin):
        yaw, pitch = attitude(machine)
        roll = 2.0 * machine.data.qpos[4]
        off = np.array((-roll, self.pitch - pitch, self.yaw - yaw)) * (not self.limp)
        return np.array(d.ARM_TURNING) * off - self.turning_damping * spin


def attitude(machine):
    """Yaw and pitch of a pallet rotated by a few degrees only."""
    q = machine.data.qpos[3:7]
    return 2.0 * q[3], 2.0 * q[2]


def rotation(machine):
    return machine.data.xmat[machine.model.body("pallet").id].reshape(3, 3)

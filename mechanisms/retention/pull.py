"""Pull by the arm at a truss with two pins still in their sockets: a joint stalls, and the truss moves sideways.

The walls of the primary sockets hold the pins. The force on them rises, and with it the torque of each joint, JᵀF. Where
it reaches what a motor can give, that joint stalls: it no longer follows, the others do, and the tip leaves its line.
"""

import dimensions as d
import numpy as np
import rig
from dimensions import model
from kit.arm import Arm, Law
from kit.arm.dimensions import READY, TORQUE

RATE = np.array((0.010, 0.0, 0.0, 0.0, 0.0, 0.0))  # of the tip: m/s and rad/s
RISE = 4.0  # s to this rate
UNLIMITED = 1e9  # N·m
STIFF = Law(admittance=0.0, admittance_turn=0.0, trip=1e9)  # no accommodation
START = (model.PRIMARY_CLEARANCE, 0.0, 1e-4)  # m from the seat: pins touch their aft walls, and just not their floors


class Pull:
    """The machine and its arm, with a record of each step."""

    def __init__(self, torque=TORQUE, step=d.TRAINING):
        self.machine = rig.machine(START, step)
        self.arm = Arm(self.machine, law=STIFF, torque=torque)
        self.arm.pose(READY)
        self.arm.command("tip")
        self.stalled = None  # joint, time, torques JᵀF of the contact, contact wrench

    def run(self, seconds):
        self.machine.run(seconds, self._control, self._watch)

    def _control(self, machine):
        self.arm.state.rates = RATE * min(1.0, machine.time / RISE)
        self.arm.control(machine)

    def torques(self):
        """JᵀF: motor torques for the latches' wrench on the truss, transferred to the tip, N·m."""
        wrench = self.machine.wrench("truss")
        arm = self.machine.place("truss") - self.machine.place("tip")
        moment = wrench[3:] + np.cross(arm, wrench[:3])
        return self.arm.jacobian().T @ np.concatenate([wrench[:3], moment])

    def _watch(self, machine):
        given = np.abs(machine.data.ctrl[self.arm.motors])
        if self.stalled is None and given.max() >= 0.99999 * TORQUE:
            joint = int(given.argmax())
            self.stalled = joint, machine.time, self.torques(), machine.wrench("truss")[:3]

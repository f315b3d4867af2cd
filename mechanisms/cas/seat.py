"""The payload in its vanes: pulled with a given load, released beside them, and pulled by the claw."""

import dimensions as d
import numpy as np
import rig

PULL = 6000.0  # N


def pulled(step, load, pose=(0.0,) * 6, friction=rig.SMOOTH, seconds=4.0):
    """Payload under a wrench about the origin of the platform, without an arm."""
    made = rig.machine(step, friction=friction, pose=pose)
    made.run(seconds, lambda machine: push(machine, load))
    return made


def push(made, load):
    """`load` is a wrench about the origin of the platform, so its moment about the mass centre moves with that."""
    body = made.model.body("payload").id
    force, moment = np.array(load[:3]), np.array(load[3:])
    made.data.xfrc_applied[body] = np.r_[force, moment - np.cross(made.data.xipos[body], force)]


def turned(step, most, rise=3.0):
    """Response with friction under a pull of 6 kN: a moment about z rises slowly, then falls again.

    The turns at both ends.
    """
    made = rig.machine(step, friction=rig.SOON_SLIPS)
    made.run(1.0, lambda machine: push(machine, (0.0, 0.0, -PULL, 0.0, 0.0, 0.0)))
    ends = []
    for start, end in ((0.0, most), (most, 0.0)):
        began = made.time

        def control(machine, start=start, end=end, began=began):
            share = min((machine.time - began) / rise, 1.0)
            push(machine, (0.0, 0.0, -PULL, 0.0, 0.0, start + share * (end - start)))

        made.run(rise + 0.5, control)
        ends.append(rig.pose(made)[5])
    return made, ends


class Capture:
    """A payload, beside the vanes and level, is led in; the claw closes when the bar is near. `voltage`: of the claw.

    `feed`: speed with which it is led, m/s; `mu`: coefficient of friction, where it is another than that of the model.
    """

    ABOVE, BELOW = 0.075, -0.020  # m

    def __init__(self, step, offset=(0.0, 0.0), yaw=0.0, voltage=-1.0, feed=0.04, mu=None):
        self.voltage, self.feed, self.closing = voltage, feed, False
        pose = (*offset, self.ABOVE, 0.0, 0.0, yaw)
        self.machine = rig.machine(step, (d.LIMP,), pose=pose, mu=mu)

    def control(self, machine):
        z = max(self.ABOVE - self.feed * machine.time, self.BELOW)
        rig.lead(machine, d.LIMP, (0.0, 0.0, z, 0.0, 0.0, 0.0))
        self.closing = self.closing or machine.place("payload")[2] < d.READY_Z
        rig.drive(machine, self.voltage if self.closing else 0.0)

    def run(self, seconds=9.0):
        """Ends early if the payload stops on a crest."""
        self.machine.run(4.0, self.control)
        if self.closing:
            self.machine.run(seconds - 4.0, self.control)
        return self

    def seated(self):
        """True if all three pins are within 2 mm of their seats."""
        pose = rig.pose(self.machine)
        turn = rig.rotation(pose[3:])
        pins = [d.RADIUS * rig.radial(name) for name in rig.VANES]
        return max(float(np.linalg.norm(pose[:3] + turn @ pin - pin)) for pin in pins) < 2e-3


def claw_force(made):
    """Force of the claw on the bar, normal to the pulling face, N."""
    angle = made.joint("claw")
    return float(made.on("claw")[:3] @ (-np.sin(angle), 0.0, np.cos(angle)))


def preload(made, share=1.0):
    """Force of a claw stalled in its place, N: torque over the lever of the bar along the face."""
    angle = made.joint("claw")
    bar = made.place("payload") + rig.rotation(rig.pose(made)[3:]) @ (0.0, 0.0, d.BAR_Z)
    return share * d.CLAW_STALL / float((bar - d.HINGE) @ (np.cos(angle), 0.0, np.sin(angle)))


def on_two(step, share, holders, missing=1, seconds=8.0):
    """Payload with one pin missing; the claw pulls with a share of its torque, and one arm or none holds the payload."""
    made = rig.machine(step, holders, friction=rig.SMOOTH, missing=missing, opened=0.05)

    def control(machine):
        rig.drive(machine, -share)

    made.run(seconds, control)
    return made


def same_bits_after_restart(step, before, after):
    """Restart of a capture: continues, repeats that in another machine, and compares the bits of both ends."""
    first, second = Capture(step, (0.02, 0.01)), Capture(step, (0.02, 0.01))
    first.machine.run(before, first.control)
    middle, second.closing = first.machine.save(), first.closing
    first.machine.run(after, first.control)
    second.machine.restore(middle)
    second.machine.run(after, second.control)
    return first.machine.save().tobytes() == second.machine.save().tobytes()

"""Loads of the attachment, for kit/loads.py: a payload is led into the vanes, and the claw draws it down."""

from dataclasses import dataclass

import dimensions as d
import rig
import seat

LOADED = (*rig.VANES, "claw", "payload")
LEVELS = {"training": d.TRAINING, "analysis": d.ANALYSIS}
CHECKED = "seated"


@dataclass(frozen=True)
class Case:
    """`offset` and `yaw` of the payload beside its seat, m and rad. `voltage`: of the claw, −1 closes with full torque.

    `feed`: speed with which the payload is led, m/s. `seconds`: length of the run.
    """

    level: d.Level = d.TRAINING
    offset: tuple = (0.0, 0.0)
    yaw: float = 0.0
    voltage: float = -1.0
    feed: float = 0.04
    seconds: float = 9.0


def run_case(case, watch):
    made = seat.Capture(case.level.step, case.offset, case.yaw, case.voltage, case.feed)
    watch(made.machine, lambda: "claw" if made.closing else "led in")
    made.machine.run(case.seconds, made.control)


def predicted(case):
    """Preload of the stalled claw: torque over lever."""
    return {("claw", "force"): -case.voltage * d.CLAW_STALL / d.LEVER}

"""Loads of a berthing, for kit/loads.py: fields of a case are those of `berth.Case` and those below."""

from dataclasses import dataclass

import berth
import dimensions as d
import linkage
import mechanism
import rig_push
import statics

LOADED = ("passive", *(f"coupler_{i}" for i in mechanism.LATCHES))
LEVELS = {"training": d.TRAINING, "analysis": d.ANALYSIS}
CHECKED = "held"


@dataclass(frozen=True)
class Case(berth.Case):
    """`begin`: `approach`, a whole berthing; or `hold`, with a module on its stops and latches closed. `seconds`: at most."""

    begin: str = "approach"
    seconds: float = 60.0


def run_case(case, watch):
    if case.begin == "hold":
        made = closed(case)
        watch(made, lambda: "hold")
        made.run(case.seconds)
        return
    made = berth.Berthing(case)
    watch(made, made.phase)
    last = berth.seq.AWAY if case.unberth else berth.seq.HOLD
    made.run(case.seconds, made.control, lambda m: m.sequencer.phase >= last)
    made.run(2.0, made.control)


def closed(case):
    """The module at rest on its stops, each latch on its fitting with all the torque of its motor."""
    made, z = rig_push.rig(case.level, case.load, None), statics.rest()[0]
    made.data.eq_active[made.model.equality("bolts").id] = 0
    height = z + d.common.FITTING_TOP + d.ROLLER_RADIUS
    pose = linkage.pose(linkage.crank_at(height, 0.0, d.CRANK_MOST))
    angles = {"crank": pose.crank, "coupler": pose.coupler - pose.crank, "follower": pose.follower}
    for i in mechanism.LATCHES:
        for name, angle in angles.items():
            made.data.qpos[made.model.joint(f"{name}_{i}").qposadr[0]] = angle
        made.data.ctrl[made.model.actuator(f"latch_{i}").id] = 1.0
    made.data.qpos[made.model.joint("module").qposadr[0] + 2] = z
    made.start()
    return made


def predicted(case):
    """Force of each stalled latch; friction of the roller, which slid in, holds it back."""
    if case.begin != "hold":
        return {}
    force = statics.latch(statics.rest()[0], 1.0, d.ROLLER_FRICTION)
    return {(f"coupler_{i}", "force"): force for i in mechanism.LATCHES}

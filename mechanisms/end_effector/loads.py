"""Loads of the end effector, for kit/loads.py: fields of a case are those of `scene.Case` and those below."""

from dataclasses import dataclass, field, replace

import capture
import rig_preload
import scene
from dimensions import Snare, training

LOADED = ("payload",)
LEVELS = {"training": training(Snare()), "analysis": Snare()}
CHECKED = "pressed"


@dataclass(frozen=True)
class Case(scene.Case):
    """`begin`: `snare`, a capture and release; or `press`, where the carriage pulls a plate onto eight pads.

    `until`: phase of the sequence at whose begin a capture ends.
    """

    level: Snare = field(default_factory=lambda: LEVELS["training"])
    begin: str = "snare"
    until: str = "done"


def run_case(case, watch):
    if case.begin == "press":
        made = rig_preload.joint_rig(8)
        watch(made, lambda: "press")
        rig_preload.press(made)
        return
    case = replace(case, snare=case.level)
    made, sequencer = capture.machine(case), capture.sequencer_of(case)
    watch(made, lambda: sequencer.phase)
    while sequencer.phase not in (case.until, "done"):
        made.advance(sequencer)


def predicted(case):
    """Preload of the stalled carriage."""
    return {("payload", "force"): scene.screw_force()} if case.begin == "press" else {}

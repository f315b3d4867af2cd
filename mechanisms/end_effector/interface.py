"""Linear interfaces of the rigidized joint (mechanisms/run.py end_effector --interface)."""

import capture
from dimensions import Snare, training

# Sets of bodies whose contacts are the interface: what the payload carries, on what the shell carries. Cables and carriage
# belong to no set: the screw stalls, so they give way and keep their force.
SETS = {
    "screw_stalled": ("plate,crowns,cams,fixture", "pads,teeth,rollers,lip"),
    "pads_alone": ("plate", "pads"),
}


def held(prepare):
    """A capture until the screw has stalled and the joint rests."""
    capture.run(capture.Case(snare=training(Snare())), "release", prepare=prepare)

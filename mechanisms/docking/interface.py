"""Linear interfaces of the mated vehicles (mechanisms/run.py docking --interface)."""

import docking

# Sets of bodies whose contacts are the interface. Hooks that belong to no set are at stall: they give way and keep their force.
SETS = {
    "hooks_locked": ("hard_chaser*", "hard_target"),
    "hooks_stalled": ("hard_chaser", "hard_target"),
}


def held(prepare):
    """A docking until the hooks have stalled and hold."""
    docking.run(docking.Case(), "unhook", prepare=prepare)

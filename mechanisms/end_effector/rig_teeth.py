"""Curvic teeth: axial force that holds them together against a torque.

A torque T on teeth whose flanks are at α from the axis pushes the halves apart with T·tan α/r; with friction, ρ its angle, the
halves slide apart once the axial force falls below T·tan(α − ρ)/r.
"""

import math

import models
from dimensions import FRICTION, PADS, TEETH
from kit import mjcf
from kit.machine import Machine
from kit.rows import Row

TORQUE = 200.0  # N·m
FALL = 0.1  # of the predicted force in a second: how slowly the axial force falls
SLID = 2e-4  # m of way apart that is more than what springs give back


def separating_force(friction):
    """Axial force at which the halves slide apart, N: lowered slowly at the torque TORQUE."""
    world = (
        '<body name="half"><joint name="lift" type="slide" axis="0 0 1" damping="500"/><joint name="turn" axis="0 0 1" damping="5"/>'
        '<inertial pos="0 0 0" mass="30" diaginertia="0.3 0.3 0.3"/></body>'
    )
    things = {"teeth": "text1", "crowns": "text2"}
    texts = [models.teeth(friction, 0.0).text(), models.crowns(friction).text()]
    extension = mjcf.contact_instance(things, [("teeth", "crowns")], {"teeth": "world", "crowns": "half"}, texts)
    machine = Machine(mjcf.model("teeth", extension, world, "", 1e-4, "RK4"), ["world", "half"])
    predicted = TORQUE * math.tan(math.radians(TEETH.flank_deg) - math.atan(friction)) / TEETH.circle
    axial = 0.0

    def control(m):
        nonlocal axial
        axial = predicted * (1.3 - 0.2 * min(1.0, m.time / 0.3) - FALL * max(0.0, m.time - 0.3))
        m.data.qfrc_applied[:] = (-axial, TORQUE * min(1.0, m.time / 0.1))

    machine.run(0.3, control)
    rest = machine.joint("lift")
    machine.run(3.0, control, watch=lambda m: m.joint("lift") > rest + SLID)
    return axial


def share_bounds(friction=FRICTION):
    """Share of the preload carried by teeth that came together and stick: friction on the flanks acts in either direction.

    Both halves give way along the axis by the same: a ball by sin α of it along its normal.
    """
    flank = math.radians(TEETH.flank_deg)
    across = 2 * TEETH.count * TEETH.stiffness * math.sin(flank)
    pads = PADS.count * PADS.stiffness
    taken = [across * (math.sin(flank) + sign * friction * math.cos(flank)) for sign in (-1.0, 1.0)]
    return tuple(one / (one + pads) for one in taken)


def rows():
    for friction in (0.0, 0.1, 0.2):
        slope = math.tan(math.radians(TEETH.flank_deg) - math.atan(friction))
        what = f"teeth with friction {friction:g} part at T·tan(α − ρ)/r"
        yield Row(what, separating_force(friction), TORQUE * slope / TEETH.circle, 0.02, "N")

"""Curvic teeth: how much axial force holds them together against a torque.

A torque T on teeth whose flanks are at α from the axis pushes the halves apart with T·tan α/r; with friction, ρ its angle, the
halves slide apart once the axial force falls below T·tan(α − ρ)/r.
"""

import math

from kit import mjcf, ron
from kit.machine import Machine
from kit.rows import Row

TEETH = 12
CIRCLE = 0.100  # pitch radius r, m; chosen
FLANK_DEG = 30.0  # α from the axis; chosen
DEPTH = 0.006  # of a tooth, m; chosen
CROWN = 0.002  # radius of the balls that stand for the crowned flanks of the other half, m
TORQUE = 200.0  # N·m
FALL = 0.1  # of the predicted force in a second: how slowly the axial force falls
SLID = 2e-4  # m of way apart that is more than what springs give back


MIDDLE = 0.012  # half of a tooth's width at the pitch plane, m


def turned(index, x, y, z):
    """A place given at the first tooth, at the tooth `index`."""
    a = 2.0 * math.pi * index / TEETH
    return (x * math.cos(a) - y * math.sin(a), x * math.sin(a) + y * math.cos(a), z)


def wedge(index):
    """A tooth of the fixed half: its flanks meet the tangent of the pitch circle at α from the axis."""
    slope = DEPTH * math.tan(math.radians(FLANK_DEG))
    corners = [
        turned(index, radius, side * half, z)
        for radius in (CIRCLE - 0.012, CIRCLE + 0.012)
        for half, z in ((MIDDLE + slope, -DEPTH), (MIDDLE - slope, DEPTH))
        for side in (-1, 1)
    ]
    vertices = ", ".join(map(ron.vector, corners))
    faces = "[0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6], [0, 4, 6, 2], [1, 3, 7, 5]"
    return f'Polyhedron(name: "tooth_{index:02}", vertices: [{vertices}], faces: [{faces}])'


def fixed_half(friction):
    return ron.model("teeth", ron.rigid(friction), [wedge(i) for i in range(TEETH)])


def turning_half(friction):
    """Two balls to each gap, one on each flank; each touches its flank at the pitch circle and half the depth."""
    flank = math.radians(FLANK_DEG)
    out, up = MIDDLE + CROWN * math.cos(flank), CROWN * math.sin(flank)
    balls = [
        ron.primitive("Sphere", f"flank_{2 * i + k:02}", center=turned(i, CIRCLE, side * out, up), radius=CROWN)
        for i in range(TEETH)
        for k, side in enumerate((-1, 1))
    ]
    return ron.model("crowns", ron.elastic(2e6, 1e3, friction, 100.0), balls)


def separating_force(friction):
    """The axial force under which the halves slide apart, N: lowered slowly at the torque TORQUE."""
    world = (
        '<body name="half"><joint name="lift" type="slide" axis="0 0 1" damping="500"/><joint name="turn" axis="0 0 1" damping="5"/>'
        '<inertial pos="0 0 0" mass="30" diaginertia="0.3 0.3 0.3"/></body>'
    )
    things = {"teeth": "text1", "crowns": "text2"}
    texts = [fixed_half(friction), turning_half(friction)]
    extension = mjcf.contact_instance(things, [("teeth", "crowns")], {"teeth": "world", "crowns": "half"}, texts)
    machine = Machine(mjcf.model("teeth", extension, world, "", 1e-4, "RK4"), ["world", "half"])
    predicted = TORQUE * math.tan(math.radians(FLANK_DEG) - math.atan(friction)) / CIRCLE
    axial = 0.0

    def control(m):
        nonlocal axial
        axial = predicted * (1.3 - 0.2 * min(1.0, m.time / 0.3) - FALL * max(0.0, m.time - 0.3))
        m.data.qfrc_applied[:] = (-axial, TORQUE * min(1.0, m.time / 0.1))

    machine.run(0.3, control)
    rest = machine.joint("lift")
    machine.run(3.0, control, watch=lambda m: m.joint("lift") > rest + SLID)
    return axial


def rows():
    for friction in (0.0, 0.1, 0.2):
        slope = math.tan(math.radians(FLANK_DEG) - math.atan(friction))
        what = f"teeth with friction {friction:g} part at T·tan(α − ρ)/r"
        yield Row(what, separating_force(friction), TORQUE * slope / CIRCLE, 0.02, "N")

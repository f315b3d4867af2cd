"""Curvic teeth: how much axial force holds them together against a torque.

A torque T on teeth whose flanks are at α from the axis pushes the halves apart with T·tan α/r; with friction, ρ its angle, the
halves slide apart once the axial force falls below T·tan(α − ρ)/r.
"""

import math

from kit import mjcf
from kit.machine import Machine
from kit.outcome import Row

TEETH = 12
CIRCLE = 0.100  # pitch radius r, m; chosen
FLANK_DEG = 30.0  # α from the axis; chosen
DEPTH = 0.006  # of a tooth, m; chosen
CROWN = 0.002  # radius of the balls that stand for the crowned flanks of the other half, m
TORQUE = 200.0  # N·m
FALL = 0.1  # of the predicted force in a second: how slowly the axial force falls
SLID = 2e-4  # m of way apart that is more than what springs give back


def wedge(index):
    """A tooth of the fixed half as a polyhedron: its flanks meet the pitch circle's tangent at α from the axis."""
    azimuth = 2.0 * math.pi * index / TEETH
    middle, foot = 0.012, 0.012 + DEPTH * math.tan(math.radians(FLANK_DEG))
    tip = 0.012 - DEPTH * math.tan(math.radians(FLANK_DEG))
    vertices = []
    for radius in (CIRCLE - 0.012, CIRCLE + 0.012):
        for half, z in ((foot, -DEPTH), (tip, DEPTH)):
            for side in (-1, 1):
                x, y = radius, side * half
                vertices.append(
                    (x * math.cos(azimuth) - y * math.sin(azimuth), x * math.sin(azimuth) + y * math.cos(azimuth), z)
                )
    faces = "[0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6], [0, 4, 6, 2], [1, 3, 7, 5]"
    text = ", ".join(f"({x!r}, {y!r}, {z!r})" for x, y, z in vertices)
    return f'Polyhedron(name: "tooth_{index:02}", vertices: [{text}], faces: [{faces}])', middle


def fixed_half(friction):
    teeth = ", ".join(wedge(i)[0] for i in range(TEETH))
    law = f", friction: Bristle(mu: {friction!r})" if friction else ""
    return (
        f'(format: "pong-model", version: 1, name: "teeth", surfaces: {{ "steel": (stiffness: inf{law}) }}, '
        f'root: (name: "teeth", surface: "steel", primitives: [{teeth}]))'
    )


def turning_half(friction):
    """Two balls to each gap, one on each flank, at the pitch circle and half the depth."""
    flank = math.radians(FLANK_DEG)
    half = wedge(0)[1]
    balls = []
    for i in range(TEETH):
        for side in (-1, 1):
            # The ball touches the flank at z = 0: its centre is one radius off along the flank's normal.
            x, y, z = CIRCLE, side * (half + CROWN * math.cos(flank)), CROWN * math.sin(flank)
            a = 2.0 * math.pi * i / TEETH
            centre = (x * math.cos(a) - y * math.sin(a), x * math.sin(a) + y * math.cos(a), z)
            balls.append(
                f'Sphere(name: "flank_{2 * i + (side > 0):02}", center: ({", ".join(map(repr, centre))}), radius: {CROWN!r})'
            )
    law = f", friction: Bristle(mu: {friction!r}, damping: 100.0)" if friction else ""
    return (
        f'(format: "pong-model", version: 1, name: "crowns", surfaces: {{ "steel": (stiffness: 2e6, normal: Linear(damping: 1e3){law}) }}, '
        f'root: (name: "crowns", surface: "steel", primitives: [{", ".join(balls)}]))'
    )


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

"""A round peg in a round hole: a cylinder in a bore.

The bore's axis is z, its mouth at z = 0, the hole below. The peg's origin is the centre of its tip. Angles turn about y.
"""

import math

import numpy as np
from dimensions import DAMPING, DEPTH, DIAMETER, FRICTION, HOLE, MASS, STIFFNESS

from kit import mjcf, ron
from kit.machine import Machine

SLID = (
    5e-3  # m: a peg that slides goes further in the time that it is given; one that jams may still tilt on its springs
)
TRAINING, ANALYSIS = 4e-4, 1e-4  # s


def peg():
    part = ron.primitive("Cylinder", "peg", ends=((0, 0, 0), (0, 0, 0.15)), radius=DIAMETER / 2)
    return ron.model("peg", ron.elastic(STIFFNESS, DAMPING, FRICTION, 100.0), [part])


def hole():
    part = ron.primitive("Bore", "hole", ends=((0, 0, 0), (0, 0, -DEPTH)), radii=(HOLE / 2, HOLE / 2))
    return ron.model("hole", ron.rigid(FRICTION), [part])


def machine(body, more="", step=ANALYSIS):
    """`body`: text of the MuJoCo body `peg`."""
    extension = mjcf.contact_instance(
        {"hole": "text1", "peg": "text2"}, [("hole", "peg")], {"hole": "world"}, [hole(), peg()]
    )
    return Machine(mjcf.model("round_peg", extension, body, more, step), ["world", "peg"])


INERTIAL = f'<inertial pos="0 0 0" mass="{MASS:g}" diaginertia="0.005 0.005 0.002"/>'


def tilt_at(depth, push=0.0):
    """Tilt at which an inserted peg has two contacts: l·sin θ + d·cos θ = D (bisection).

    Two places that push with so many newtons sink in, each on half of the spring: D grows by what both sink.
    """
    hole = HOLE + 2 * push / (STIFFNESS / 2)
    low, high = 0.0, 0.5 * math.atan2(hole, depth)
    for _ in range(100):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if depth * math.sin(middle) + DIAMETER * math.cos(middle) < hole else (low, middle)
    return low


# --- Whitney's diagram -----------------------------------------------------------------------------------------------


def resistance(depth, across, moment):
    """Friction against sliding in, relative to the axial force Fz: the peg jams if it is above 1.

    Loads are at the tip: `across` is Fx/Fz, `moment` is M/(r·Fz) about y. Two places push, at the tip or at the mouth, on
    one side or on both, each with friction upwards: those two that can be in balance with the loads.
    """
    radius = DIAMETER / 2
    places = [(+1, 0.0), (+1, depth), (-1, 0.0), (-1, depth)]  # side, height above the tip
    found = []
    for i, k in ((0, 1), (2, 3), (0, 3), (1, 2)):
        system = np.array([[-side, -side * (height / radius + FRICTION)] for side, height in (places[i], places[k])]).T
        pushes = np.linalg.solve(system, [-across, -moment])
        if (pushes >= -1e-12).all():
            found.append(FRICTION * pushes.sum())
    return min(found)


def whitney(depth, across, moment):
    """Load factor by Whitney's parallelogram, 1 on its sides."""
    slope = depth / (DIAMETER * FRICTION)
    return max(abs(across) * FRICTION, abs(moment - FRICTION * (1 + slope) * across) / slope)


def moves(depth, across, moment, force=100.0):
    """Load factor by experiment: lateral load and moment first, then the axial force."""
    made = machine(f'<body name="peg" pos="0 0 {-depth:g}"><freejoint/>{INERTIAL}</body>')
    index = made.model.body("peg").id

    def control(m):
        first, then = min(1.0, m.time / 0.1), min(1.0, max(0.0, (m.time - 0.15) / 0.1))
        made.data.xfrc_applied[index] = (
            across * force * first,
            0,
            -force * then,
            0,
            moment * force * DIAMETER / 2 * first,
            0,
        )

    made.run(0.15, control)
    start = made.place("peg")[2]
    return made.run(0.25, control, watch=lambda m: start - m.place("peg")[2] > SLID), made

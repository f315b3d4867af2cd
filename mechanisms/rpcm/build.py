#!/usr/bin/env python3
"""Builds the contact models through the modelling toolkit: python build.py [FOLDER] [--blend FILE], with Blender as a
Python module. Writes rails.ron, box.ron, plug.ron, socket.ron, and cone and jaws for each half-angle.
"""

import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent.parent / "models")]
import authoring as a  # noqa: E402
import dimensions as d  # noqa: E402

RIGID = float("inf")


def surface(stiffness, damping, friction):
    held = a.bristle(friction, damping=d.STICKING_DAMPING if stiffness < RIGID else None) if friction else None
    return a.surface(stiffness, a.linear(damping, ramp=d.RAMP), held)


def block(name, least, most):
    half_spaces = []
    for axis in range(3):
        outward = [float(i == axis) for i in range(3)]
        half_spaces += [(tuple(-x for x in outward), -least[axis]), (tuple(outward), most[axis])]
    return a.polyhedron(name, half_spaces)


def model(name, made, primitives):
    return a.model(name, {"steel": made}, a.group(name, primitives=primitives, surface="steel"))


# --- box and rails -------------------------------------------------------------------------------------------------------


def rail(name, side):
    """A channel: web, lips above and below. Its mouth is rounded where the box's sides lean on it."""
    web, lip = sorted((side * d.GAP / 2, side * (d.GAP / 2 + d.WALL))), sorted((side * d.GAP / 2, side * inner()))
    high, end = d.HEIGHT / 2 + d.CLEARANCE, d.STOP
    yield block(f"web_{name}", (0.0, web[0], -high - d.WALL), (end, web[1], high + d.WALL))
    for level, up in d.LEVELS.items():
        z = sorted((up * high, up * (high + d.WALL)))
        yield block(f"lip_{name}_{level}", (0.0, lip[0], z[0]), (end, lip[1], z[1]))
        beside = (0.0, side * (d.GAP / 2 + d.ROUNDING), up * corner()[2])
        yield a.sphere(f"mouth_{name}_{level}", beside, d.ROUNDING)
        across = (0.0, side * (inner() + d.ROUNDING), up * (high + d.ROUNDING))
        yield a.sphere(f"mouth_lip_{name}_{level}", across, d.ROUNDING)


def inner():
    return d.GAP / 2 - d.LIP


def corner():
    return tuple(size / 2 - d.ROUNDING for size in (d.LENGTH, d.WIDTH, d.HEIGHT))


def rails():
    sides = [part for entry in d.SIDES.items() for part in rail(*entry)]
    high = d.HEIGHT / 2 + d.WALL
    back = block("back", (d.STOP, -d.GAP / 2 - d.WALL, -high), (d.STOP + d.WALL, d.GAP / 2 + d.WALL, high))
    return model("rails", surface(RIGID, 0.0, d.FRICTION), [*sides, back])


def box():
    x, y, z = corner()
    half = d.LENGTH / 2, d.WIDTH / 2, d.HEIGHT / 2
    corners = [
        a.sphere(f"{end}_{name}_{level}", (front * x, side * y, up * z), d.ROUNDING)
        for end, front in (("front", 1), ("rear", -1))
        for name, side in d.SIDES.items()
        for level, up in d.LEVELS.items()
    ]
    whole = block("sides", tuple(-h for h in half), half)
    return model("box", surface(d.STIFFNESS, d.DAMPING, d.FRICTION), [whole, *corners])


# --- connector -----------------------------------------------------------------------------------------------------------


def plug():
    front = d.LENGTH / 2
    pins = [
        a.cylinder(f"pin_{name}", (front, s * d.PIN_Y, 0.0), (front + d.PIN_LENGTH, s * d.PIN_Y, 0.0), d.PIN_RADIUS)
        for name, s in d.SIDES.items()
    ]
    contacts = [
        a.ray(
            f"contact_{name}",
            (0, s * d.SPRING_Y, 0),
            (1, 0, 0),
            front + d.SPRING_STROKE,
            response="Axial",
            surface="spring",
        )
        for name, s in d.SIDES.items()
    ]
    made = {
        "steel": surface(d.STIFFNESS, d.DAMPING, d.FRICTION),
        "spring": surface(d.SPRING_STIFFNESS, d.SPRING_DAMPING, 0),
    }
    return a.model("plug", made, a.group("plug", primitives=[*pins, *contacts], surface="steel"))


def socket():
    """Bores with funnels in front of them, and a strip between them against the sprung contacts."""
    mouth = d.STOP + d.SPRING_STROKE - d.FUNNEL_LENGTH
    holes = []
    for name, side in d.SIDES.items():
        begin, throat, end = ((x, side * d.PIN_Y, 0.0) for x in (mouth, mouth + d.FUNNEL_LENGTH, mouth + 0.05))
        funnel = (d.FUNNEL_RADIUS, d.BORE_RADIUS)
        holes.append(a.bore(f"funnel_{name}", begin, throat, funnel, thickness=0.004, mouths=(True, False)))
        holes.append(a.bore(f"bore_{name}", throat, end, d.BORE_RADIUS, mouths=(False, True)))
    strip = block("strip", (d.STOP, -0.03, -0.01), (d.STOP + d.WALL, 0.03, 0.01))
    return model("socket", surface(RIGID, 0.0, d.FRICTION), [*holes, strip])


# --- fixture and jaws ----------------------------------------------------------------------------------------------------


def cone(trial):
    """Cone with its origin at the middle of its base; it points out, along −x."""
    tip = d.CONE_RADIUS - d.CONE_LENGTH * math.tan(d.half_angle(trial))
    part = a.cone("cone", (0, 0, 0), (-d.CONE_LENGTH, 0, 0), (d.CONE_RADIUS, tip))
    return model(f"cone_{trial}", surface(d.GRIP_STIFFNESS, d.GRIP_DAMPING, d.GRIP_FRICTION), [part])


def jaw(name, side, trial):
    """A plane along a line of the cone; it just touches the cone at the jaw's position zero."""
    slope = d.half_angle(trial)
    # Out of the solid, against the outward normal of the cone, which leans to its tip.
    normal = (math.sin(slope), -side * math.cos(slope), 0.0)
    face = a.flat_ground("face", normal, -d.CONE_RADIUS * math.cos(slope))
    return a.group(f"jaw_{name}", primitives=[face], movable=True, bound=None)


def jaws(trial):
    groups = [jaw(name, side, trial) for name, side in d.SIDES.items()]
    made = {"steel": surface(RIGID, 0.0, d.GRIP_FRICTION)}
    return a.model(f"jaws_{trial}", made, a.group(f"jaws_{trial}", groups=groups, surface="steel"))


if __name__ == "__main__":
    trials = [made(trial) for trial in d.TRIALS for made in (cone, jaws)]
    a.main([rails(), box(), plug(), socket(), *trials], HERE)

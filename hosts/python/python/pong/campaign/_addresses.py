"""Addresses of dispersed parameters (docs/campaigns.md), and their setters on a simulation."""

import numpy as np

from ._errors import CampaignError
from ._rigid import displaced

AXES = {"x": 0, "y": 1, "z": 2}
MOTIONS = ("position", "rotation", "velocity", "angular_velocity")
SIX = {"x": 0, "y": 1, "z": 2, "rx": 3, "ry": 4, "rz": 5}
FORMS = (
    "OBJECT.position.x (or rotation, velocity, angular_velocity; y, z)",
    "body.BODY.mass",
    "spring.NUMBER.stiffness.x",
    "gravity.z",
    "surface.MODEL.SURFACE.VALUE",
)


def apply(simulation, job, values):
    """Sets the values of a run in a simulation.

    All values of one thing are set together: one alone, such as a moment of inertia, may be impossible beside the old ones.
    Factors are applied last, so that they act on the other values."""
    motions, changes = {}, {}
    for name, value in zip(job["parameters"], values):
        parts = name.split(".")
        if len(parts) == 3 and parts[1] in MOTIONS and parts[2] in AXES:
            change = motions.setdefault(parts[0], {motion: np.zeros(3) for motion in MOTIONS})
            change[parts[1]][AXES[parts[2]]] += value
        elif parts[0] in KINDS:
            kind = KINDS[parts[0]]
            key, path = kind.parse(name, name.partition(".")[2])
            changes.setdefault((kind, key), []).append((name, path, value))
        else:
            raise CampaignError(f"parameter `{name}`: it names nothing that can be dispersed; write {', '.join(FORMS[:-1])} or {FORMS[-1]}")
    for (kind, key), given in changes.items():
        held = kind.read(simulation, given[0][0], key)
        for name, path, value in sorted(given, key=lambda change: change[1][-1].endswith("_factor")):
            kind.change(held, name, path, value)
        kind.write(simulation, key, held)
    move(simulation, job, motions)


def move(simulation, job, motions):
    """Displaces Objects."""
    states, bodies = simulation.states(), simulation.bodies
    for name, change in motions.items():
        rows = [i for i, body in enumerate(bodies) if body == name or body.startswith(name + "/")]
        if not rows:
            known = sorted({body.split("/")[0] for body in bodies})
            raise CampaignError(f"parameter `{name}`: there is no such Object; name one of: {', '.join(known)}")
        pivot = np.array(job["pivots"].get(name, (0.0, 0.0, 0.0)))
        simulation.set_states(displaced(states[rows], pivot, change), [bodies[i] for i in rows])


def split(name, rest, values, what):
    """Splits an address into the name of a thing and the path of its value: names may contain dots, the paths are
    known."""
    for value in values:
        if rest.endswith("." + value) and len(rest) > len(value) + 1:
            return rest[: -len(value) - 1], value.split(".")
    raise CampaignError(f"parameter `{name}`: {what} has no such value; it has: {', '.join(values)}")


class Body:
    """`body.BODY.mass`, `….mass_factor`, `….inertia.xx`, `….mass_center.x`."""

    VALUES = ("mass", "mass_factor", *(f"inertia.{i}" for i in ("xx", "yy", "zz", "xy", "xz", "yz")), *(f"mass_center.{i}" for i in AXES))

    @classmethod
    def parse(cls, name, rest):
        return split(name, rest, cls.VALUES, "a body")

    @staticmethod
    def read(simulation, name, body):
        if body not in simulation.bodies:
            raise CampaignError(f"parameter `{name}`: there is no body `{body}`; name one of: {', '.join(simulation.bodies)}")
        return simulation.mass(body)

    @staticmethod
    def change(held, name, path, value):
        if path == ["mass"]:
            held["mass"] = value
        elif path == ["mass_factor"]:
            held["mass"] *= value
            held["inertia"] = [[value * moment for moment in row] for row in held["inertia"]]
        elif path[0] == "inertia":
            i, j = (AXES[axis] for axis in path[1])
            held["inertia"][i][j] = held["inertia"][j][i] = value
        else:
            held["mass_center"][AXES[path[1]]] = value

    @staticmethod
    def write(simulation, body, held):
        simulation.set_mass(body, held)


class Spring:
    """`spring.NUMBER.stiffness.x`, `….stiffness_factor`; `damping` and `preload` alike."""

    QUANTITIES = ("stiffness", "damping", "preload")
    VALUES = (*(f"{q}.{axis}" for q in QUANTITIES for axis in SIX), *(f"{q}_factor" for q in QUANTITIES))

    @classmethod
    def parse(cls, name, rest):
        number, path = split(name, rest, cls.VALUES, "a spring")
        if not (number.isascii() and number.isdigit()):
            raise CampaignError(f"parameter `{name}`: `{number}` is no spring; give its number in `springs` of the scene, from 0")
        return int(number), path

    @staticmethod
    def read(simulation, name, number):
        if number >= simulation.springs:
            raise CampaignError(f"parameter `{name}`: the scene has {simulation.springs} springs; count from 0 in their order")
        return simulation.spring(number)

    @staticmethod
    def change(held, name, path, value):
        if len(path) == 2:
            held[path[0]][SIX[path[1]]] = value
        else:
            quantity = path[0].removesuffix("_factor")
            held[quantity] = [value * one for one in held[quantity]]

    @staticmethod
    def write(simulation, number, held):
        simulation.set_spring(number, held)


class Gravity:
    """`gravity.x`."""

    @staticmethod
    def parse(name, rest):
        if rest not in AXES:
            raise CampaignError(f"parameter `{name}`: gravity has no such value; it has: {', '.join(AXES)}")
        return "gravity", [rest]

    @staticmethod
    def read(simulation, name, key):
        return list(simulation.gravity)

    @staticmethod
    def change(held, name, path, value):
        held[AXES[path[0]]] = value

    @staticmethod
    def write(simulation, key, held):
        simulation.set_gravity(held)


class Surface:
    """`surface.MODEL.SURFACE.stiffness`, `….normal.damping`, `….friction.mu`."""

    @staticmethod
    def parse(name, rest):
        parts = rest.split(".")
        if len(parts) not in (3, 4) or len(parts) == 4 and parts[2] not in ("normal", "friction"):
            raise CampaignError(f"parameter `{name}`: write surface.MODEL.SURFACE.VALUE, such as surface.ring.steel.friction.mu")
        return (parts[0], parts[1]), parts[2:]

    @staticmethod
    def read(simulation, name, key):
        return simulation.surface(*key)

    @staticmethod
    def change(held, name, path, value):
        place = held[path[0]] if len(path) == 2 else held
        # A switch, such as `hertz`, cannot be dispersed; an exponent belongs to the law.
        numbers = [key for key, known in place.items() if isinstance(known, float | int) and not isinstance(known, bool)
                   and key != "damping_exponent"]
        if path[-1] not in numbers:
            raise CampaignError(f"parameter `{name}`: the surface has no value `{path[-1]}`; it has: {', '.join(numbers)}")
        place[path[-1]] = value

    @staticmethod
    def write(simulation, key, held):
        simulation.set_surface(*key, held)


KINDS = {"body": Body, "spring": Spring, "gravity": Gravity, "surface": Surface}

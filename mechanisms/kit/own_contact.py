"""MuJoCo's own contact instead of the plugin: the same bodies, joints and motors, with colliding geoms.

Three sets of parameters, by rules that were fixed before anything was compared; the cone is elliptic in all of them.

`DEFAULT`     what MuJoCo takes if nothing is said.
`hard(step)`  as hard as the step allows: a time constant of two steps.
`SPRINGS`     the stiffness K and the damping C of the contact that Pong has, in N/m and N·s/m.

MuJoCo's contact is a constraint. At a depth r it wants the acceleration −b·v − k·d·r, and is regularized by
R = (1 − d)/d·A with A the inverse mass at the contact (`body_invweight0`) and d the impedance. At rest that is the
force k·d²/((1 − d)·A)·r. With `solref` (−s, −q), k = s/d² and b = q/d, so s = K·(1 − d)·A and q = C·(1 − d)·A give the
force K·r + C·v for any constant d, when nothing accelerates. d = 0.5 makes all rates those of K and C themselves,
within what a step of 1 ms carries. Friction is regularized by R/impratio: under a steady force f it creeps with
f/(impratio·C).
"""

import sys
import time
import xml.etree.ElementTree as xml
from dataclasses import dataclass

import mujoco
import numpy as np

from kit.machine import Machine


@dataclass(frozen=True)
class Contact:
    """`solref`: None to derive it from stiffness and damping of each surface.

    `one_point`: only the deepest point of two convex geoms, instead of up to four where faces and edges meet.
    """

    solref: tuple | None
    solimp: tuple
    impratio: float
    one_point: bool = False


DEFAULT = Contact((0.02, 1.0), (0.9, 0.95, 0.001, 0.5, 2.0), 1.0)
SPRINGS = Contact(None, (0.5, 0.5, 0.001, 0.5, 2.0), 100.0)


def hard(step):
    return Contact((2 * step, 1.0), (0.99, 0.999, 0.0001, 0.5, 2.0), 100.0)


@dataclass(frozen=True)
class Surface:
    """Surface of a pair: stiffness N/m, damping N·s/m, coefficient of friction."""

    stiffness: float
    damping: float
    friction: float


def impedance(contact, depth):
    """MuJoCo's d: from the first to the second number of `solimp` as the depth grows by the third."""
    least, most, width, middle, power = contact.solimp
    share = min(1.0, depth / width)
    if share < middle:
        rise = share**power / middle ** (power - 1)
    else:
        rise = 1.0 - (1.0 - share) ** power / (1.0 - middle) ** (power - 1)
    return least + rise * (most - least)


def as_springs(contact, inverse_mass, depth):
    """N/m and N·s/m of a set with a time constant, at rest at a depth; see the head of this file."""
    (constant, ratio), most, d = contact.solref, contact.solimp[1], impedance(contact, depth)
    stiffness, damping = 1.0 / (most * constant * ratio) ** 2, 2.0 / (most * constant)
    return stiffness * d**2 / ((1.0 - d) * inverse_mass), damping * d / ((1.0 - d) * inverse_mass)


class Own(Machine):
    """Replacement of a `Machine`, without energy account and flags.

    `movers`: geom → the surface it has with everything it touches. `grounds`: the geoms that movers touch. Both are names
    of geoms in the text; other geoms touch nothing, nor do movers each other.
    """

    def __init__(self, text, carriers, contact, movers, grounds):
        self.text, self.watchers = _prepared(text, contact, movers, grounds), []
        self.model = mujoco.MjModel.from_xml_string(self.text)
        self.data = mujoco.MjData(self.model)
        self.carriers = [self.model.body(name).id for name in carriers]
        self.step = self.model.opt.timestep
        self.flags = 0
        under = max(self.model.body_invweight0[self.model.geom(name).bodyid[0], 0] for name in grounds)
        for name, surface in movers.items():
            self._set(name, surface, contact, under)
        self.start()

    def _set(self, name, surface, contact, under):
        """Gives a mover priority over its partners (`priority`)."""
        geom = self.model.geom(name)
        geom.friction[:] = (surface.friction, 0.0, 0.0)
        if contact.solref is None:
            inverse_mass = self.model.body_invweight0[geom.bodyid[0], 0] + under
            share = (1.0 - contact.solimp[0]) * inverse_mass
            geom.solref[:] = (-surface.stiffness * share, -surface.damping * share)

    def start(self):
        mujoco.mj_forward(self.model, self.data)

    def advance(self, control=None):
        self.hurry(control)
        for watch in self.watchers:
            watch(self)

    def hurry(self, control=None):
        if control is not None:
            control(self)
        mujoco.mj_step(self.model, self.data)

    def contacts(self):
        return int(self.data.ncon)

    def pushes(self):
        """(geom, geom, position, force on the second) of each contact, along the axes of the world."""
        wrench = np.empty(6)
        for k, contact in enumerate(self.data.contact):
            mujoco.mj_contactForce(self.model, self.data, k, wrench)
            yield contact.geom1, contact.geom2, contact.pos, contact.frame.reshape(3, 3).T @ wrench[:3]

    def wrench(self, carrier):
        body, answer = self.model.body(carrier).id, np.zeros(6)
        origin, bodies = self.data.xpos[body], self.model.geom_bodyid
        for first, second, place, force in self.pushes():
            for geom, sign in ((first, -1.0), (second, 1.0)):
                if bodies[geom] == body:
                    answer += sign * np.r_[force, np.cross(place - origin, force)]
        return answer


def _prepared(text, contact, movers, grounds):
    """Text without the plugin, with colliding geoms."""
    root = xml.fromstring(text)
    root.remove(root.find("extension"))
    root.remove(root.find("sensor"))
    option = root.find("option")
    option.remove(option.find("flag"))
    option.set("cone", "elliptic")
    option.set("impratio", repr(contact.impratio))
    if contact.one_point:
        xml.SubElement(option, "flag", multiccd="disable")
    for geom in root.iter("geom"):
        _let_touch(geom, contact, (geom.get("name") in movers) + 2 * (geom.get("name") in grounds))
    return xml.tostring(root, encoding="unicode")


def _let_touch(geom, contact, side):
    """`side`: 0 collides with nothing, 1 a mover, 2 a ground."""
    geom.set("contype", str(side))
    geom.set("conaffinity", str((0, 2, 1)[side]))
    geom.set("priority", str(int(side == 1)))
    geom.set("solref", " ".join(map(repr, contact.solref or DEFAULT.solref)))
    geom.set("solimp", " ".join(map(repr, contact.solimp)))


def with_geoms(text, geoms, assets=""):
    """MJCF text with additional geoms: body (or `world`) → MJCF."""
    root = xml.fromstring(text)
    bodies = {body.get("name"): body for body in root.iter("body")} | {"world": root.find("worldbody")}
    for body, more in geoms.items():
        bodies[body].extend(xml.fromstring(f"<geoms>{more}</geoms>"))
    if assets:
        root.append(xml.fromstring(f"<asset>{assets}</asset>"))
    return xml.tostring(root, encoding="unicode")


def processor_time(made, seconds, control=None):
    """Processor time per simulated second, of steps without accounts."""
    began = time.process_time()
    for _ in range(round(seconds / made.step)):
        made.hurry(control)
    return (time.process_time() - began) / seconds


def compare(columns):
    """Columns (name → function that yields (what, value)) named on the command line, or all of them."""
    names = sys.argv[1:] or list(columns)
    table({name: list(columns[name]()) for name in names})


def table(columns, width=46):
    """Table of `columns`: name → list of (what, value). A value may be a word."""
    print(f"{'':{width}} " + " ".join(f"{name:>12}" for name in columns), flush=True)
    for rows in zip(*columns.values()):
        values = (f"{value:>12}" if isinstance(value, str) else f"{value:12.5g}" for _, value in rows)
        print(f"{rows[0][0]:{width}} " + " ".join(values), flush=True)

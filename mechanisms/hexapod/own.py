#!/usr/bin/env python3
"""The same hexapod with MuJoCo's own contact beside Pong's: standing, slopes, a walk on the plane.

python3 mechanisms/hexapod/own.py        with the plugin as for mechanisms/run.py: half a minute
"""

import math
import pathlib
import sys
import xml.etree.ElementTree as xml

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import dimensions as d  # noqa: E402
import mujoco  # noqa: E402
import numpy as np  # noqa: E402
import rig  # noqa: E402
import scenes  # noqa: E402

# Set before anything was compared: MuJoCo's defaults with an elliptic cone, and as hard as a step of 1 ms allows.
DEFAULT = {"solref": "0.02 1", "solimp": "0.9 0.95 0.001 0.5 2", "impratio": "1"}
HARD = {"solref": "0.002 1", "solimp": "0.99 0.999 0.0001 0.5 2", "impratio": "100"}
# Added after: which of the differences come from the friction's regularization alone.
FIRM = {**DEFAULT, "impratio": "100"}
STEP, SECONDS = d.TRAINING.step, 10.0


class Own:
    """What the scenes need of a `Machine`, without the plugin."""

    def __init__(self, text, _carriers, values):
        self.model = mujoco.MjModel.from_xml_string(_with_own_contact(text, values))
        self.data = mujoco.MjData(self.model)
        self.step = self.model.opt.timestep
        self.feet = [self.model.geom(f"foot_{i}").id for i in rig.LEGS]

    def start(self):
        mujoco.mj_forward(self.model, self.data)

    @property
    def time(self):
        return self.data.time

    def place(self, body):
        return self.data.body(body).xpos.copy()

    def hurry(self, control=None):
        if control is not None:
            control(self)
        mujoco.mj_step(self.model, self.data)

    def forces(self):
        """On each foot, along the axes of the world, N."""
        forces, wrench = np.zeros((6, 3)), np.empty(6)
        for k, contact in enumerate(self.data.contact):
            mujoco.mj_contactForce(self.model, self.data, k, wrench)
            # Of the first geom on the second; the feet come after the ground.
            forces[self.feet.index(contact.geom2)] += contact.frame.reshape(3, 3).T @ wrench[:3]
        return forces


def _with_own_contact(text, values):
    root = xml.fromstring(text)
    root.remove(root.find("extension"))
    root.remove(root.find("sensor"))
    option = root.find("option")
    option.remove(option.find("flag"))
    option.set("cone", "elliptic")
    option.set("impratio", values["impratio"])
    for geom in root.iter("geom"):
        geom.set("solref", values["solref"])
        geom.set("solimp", values["solimp"])
        geom.set("friction", f"{d.FRICTION} 0 0")
    return xml.tostring(root, encoding="unicode")


def own(values):
    return lambda text, carriers: Own(text, carriers, values)


def settled(made):
    """On level ground, put down just touching: the same start for every contact."""
    hexapod = rig.machine(STEP, made=made)
    for _ in range(round(1.0 / STEP)):
        hexapod.hurry()
    return hexapod


def tilted(share, made):
    """Settled, then the slope rises within two seconds to a share of tan θ = μ; half a second to come to rest."""
    hexapod, steps = settled(made), round(2.0 / STEP)
    for k in range(steps):
        hexapod.model.opt.gravity[:] = rig.slope(math.atan(share * d.FRICTION) * (k + 1) / steps)
        hexapod.hurry()
    for _ in range(round(0.5 / STEP)):
        hexapod.hurry()
    return hexapod


def moves(hexapod, seconds):
    """Way of the body, m; its mean acceleration down the slope, m/s²; forces of the feet in each step, N."""
    start, speed, forces = hexapod.place("body"), hexapod.data.qvel[0], []
    for _ in range(round(seconds / STEP)):
        hexapod.hurry()
        forces.append(np.array(hexapod.forces()))
    way = float(np.linalg.norm(hexapod.place("body") - start))
    return way, (speed - hexapod.data.qvel[0]) / seconds, np.array(forces)


def figures(made):
    """Of one contact: depth of the feet, creep, slide, walk."""
    stands = settled(made)
    yield "sum of loads at rest, N", stands.forces()[:, 2].sum()
    yield "feet are deep, µm", 1e6 * float(np.mean(d.FOOT_RADIUS - rig.feet(stands)[:, 2]))
    for share in (0.5, 0.97):
        yield f"{share} of tan θ = μ: way in {SECONDS:g} s, µm", 1e6 * moves(tilted(share, made), SECONDS)[0]
    for share in (1.03, 1.2):
        angle = math.atan(share * d.FRICTION)
        _, slid, forces = moves(tilted(share, made), 1.0)
        coulomb = d.GRAVITY * (math.sin(angle) - d.FRICTION * math.cos(angle))
        yield f"{share}: acceleration over g(sin θ − μ cos θ)", slid / coulomb
        yield f"{share}: time with no foot loaded", float(np.mean(~forces.any(axis=(1, 2))))
        across = np.linalg.norm(forces[:, :, :2], axis=2).sum()
        yield f"{share}: friction over load, foot by foot", across / forces[:, :, 2].sum()
        yield f"{share}: friction up the slope over load", forces[:, :, 0].sum() / forces[:, :, 2].sum()
    walk = scenes.Walk(STEP, made=made)
    walk.go(2.5)
    start = walk.way()
    walk.go(4 * d.PERIOD)
    yield "walk: speed over stride/period", (walk.way() - start) / (4 * d.STRIDE)
    yield "walk: feet slid, of the way", walk.slip_share()


def main():
    columns = [list(figures(made)) for made in (None, own(DEFAULT), own(FIRM), own(HARD))]
    print(f"{'':46} {'Pong':>12} {'MuJoCo':>12} {'impratio 100':>12} {'hard':>12}")
    for rows in zip(*columns):
        print(f"{rows[0][0]:46} " + " ".join(f"{value:12.5g}" for _, value in rows))


if __name__ == "__main__":
    main()

"""The cube in Pong: eight points or, with round corners, eight spheres, on a rigid plane, in the built-in executive."""

import tempfile
from pathlib import Path

import numpy as np

from validation.cube_tosses.data import ANGULAR_VELOCITY, CORNERS, GRAVITY, ORIENTATION
from validation.cube_tosses.engines.engine import Engine, package
from validation.kit import rotation
from validation.kit.search import Free

TABLE = """(
    format: "pong-model", version: 1, name: "table",
    surfaces: { "steel": (stiffness: inf) },
    root: (name: "table", surface: "steel", primitives: [Plane(name: "top", normal: (0, 0, 1), offset: 0)]),
)"""
# Rigid surfaces leave the laws to the cube.
CUBE = """(
    format: "pong-model", version: 1, name: "cube",
    surfaces: {{ "acrylic": (stiffness: {stiffness!r}, normal: {normal}, friction: {friction}) }},
    root: (name: "cube", surface: "acrylic", primitives: [{corners}]),
)"""
SCENE = """(
    format: "pong-scene", version: 1, name: "toss",
    models: {{ "cube": "cube.ron", "table": "table.ron" }},
    objects: [
        (name: "cube", model: "cube", bodies: [(
            motion: Free, mass: {mass!r}, inertia: Diagonal({inertia!r}, {inertia!r}, {inertia!r}), position: (0, 0, 10),
        )]),
        (name: "table", model: "table", bodies: [(motion: Fixed)]),
    ],
    pairs: [("cube", "table")], gravity: (0, 0, {gravity!r}),
    integrator: RungeKutta4, step: {step!r}, duration: 1,
)"""
# Far above the table: a step there ends all contacts, and what friction remembers of them.
APART = np.array([0, 0, 10, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0], dtype=float)
MU = Free(0.2, 0.05, 0.6)


class Pong(Engine):
    """Base of the laws of Pong: a subclass gives the text of the normal law and of the friction."""

    def normal(self):
        """Text of the normal law in the model file."""
        raise NotImplementedError

    def friction(self):
        """Text of the law of friction in the model file."""
        return f"Bristle(mu: {self.values['mu']!r})"

    def corners(self):
        """Text of the primitives: points, or spheres that touch the faces of the cube from inside."""
        radius = self.body.corner_radius
        for number, corner in enumerate(CORNERS):
            place = corner - radius * np.sign(corner)
            where = "(" + ", ".join(repr(float(component)) for component in place) + ")"
            if radius > 0.0:
                yield f'Sphere(name: "corner_{number}", center: {where}, radius: {radius!r})'
            else:
                yield f'Point(name: "corner_{number}", position: {where})'

    def build(self):
        pong = package("pong", self.title)
        with tempfile.TemporaryDirectory() as folder:
            files = {
                "table.ron": TABLE,
                "cube.ron": CUBE.format(
                    stiffness=self.values["stiffness"],
                    normal=self.normal(),
                    friction=self.friction(),
                    corners=", ".join(self.corners()),
                ),
                "toss.ron": SCENE.format(
                    mass=self.body.mass, inertia=self.body.inertia, gravity=-GRAVITY, step=self.step
                ),
            }
            for name, text in files.items():
                (Path(folder) / name).write_text(text)
            self.simulation = pong.Scene.load(Path(folder) / "toss.ron").build()

    def follow(self, start, frames):
        state = start.copy()
        state[ANGULAR_VELOCITY] = rotation.turned(state[ORIENTATION], state[ANGULAR_VELOCITY])
        self.simulation.set_states(APART[None], ["cube"])
        self.simulation.step()
        self.simulation.set_states(state[None], ["cube"])
        run = self.simulation.run((frames - 1) * self.substeps, every=self.substeps)
        self.peak = float(run.peak_force[0])
        return run.states[:frames, 0, :7].copy()

    def peak_force(self):
        return self.peak


class Linear(Pong):
    """Linear spring and damper (Kelvin–Voigt) that never pulls."""

    name, title = "pong-linear", "Pong, linear"
    free = {"stiffness": Free(2e4, 1e3, 2e5), "damping": Free(60.0, 3.0, 600.0), "mu": MU}
    units = {"stiffness": "N/m", "damping": "N·s/m", "mu": ""}

    def normal(self):
        return f"Linear(damping: {self.values['damping']!r})"


class LinearCoulomb(Linear):
    """Linear spring and damper with regularised Coulomb friction."""

    name, title = "pong-linear-coulomb", "Pong, linear, Coulomb friction"

    def friction(self):
        return f"Coulomb(mu: {self.values['mu']!r}, slip_speed: 1e-3)"


class HuntCrossley(Pong):
    """Law of Hunt and Crossley with exponent 1."""

    name, title = "pong-hunt-crossley", "Pong, Hunt–Crossley"
    free = {"stiffness": Free(2e4, 1e3, 5e5), "dissipation": Free(1.0, 0.05, 20.0), "mu": MU}
    units = {"stiffness": "N/m", "dissipation": "s/m", "mu": ""}
    exponent = 1.0

    def normal(self):
        return f"HuntCrossley(dissipation: {self.values['dissipation']!r}, exponent: {self.exponent!r})"


class Hertz(HuntCrossley):
    """Law of Hunt and Crossley with the exponent of Hertz, 3/2."""

    name, title = "pong-hertz", "Pong, Hertz with dissipation"
    free = {"stiffness": Free(1e6, 2e4, 5e7), "dissipation": Free(1.0, 0.05, 20.0), "mu": MU}
    units = {"stiffness": "N/m^1.5", "dissipation": "s/m", "mu": ""}
    exponent = 1.5


class Power(Pong):
    """Hertzian spring with a damper that grows with the root of the depth."""

    name, title = "pong-power", "Pong, power law, q = 0.5"
    free = {"stiffness": Free(1e6, 2e4, 5e7), "damping": Free(1e3, 10.0, 1e5), "mu": MU}
    units = {"stiffness": "N/m^1.5", "damping": "N·s/m^1.5", "mu": ""}

    def normal(self):
        return f"PowerLaw(exponent: 1.5, damping_exponent: 0.5, damping: {self.values['damping']!r})"

"""The ellipse in Pong: an ellipsoid on a rigid plane that moves in the plane of its two long axes."""

import math
import tempfile
from pathlib import Path

import numpy as np

from validation.kit.search import Free
from validation.planar_impacts.data import GRAVITY, GYRATION, MASS, SEMI_AXES

MODEL = """(
    format: "pong-model", version: 1, name: "{name}",
    surfaces: {{ "{name}": ({surface}) }},
    root: (name: "{name}", surface: "{name}", primitives: [{primitive}]),
)"""
SCENE = """(
    format: "pong-scene", version: 1, name: "impact",
    models: {{ "ellipse": "ellipse.ron", "floor": "floor.ron" }},
    objects: [
        (name: "ellipse", model: "ellipse", bodies: [(motion: Free, mass: {mass!r}, inertia: Diagonal({inertia!r}, {inertia!r}, {inertia!r}), position: (0, 0, 10))]),
        (name: "floor", model: "floor", bodies: [(motion: Fixed)]),
    ],
    pairs: [("ellipse", "floor")], gravity: (0, 0, {gravity!r}), integrator: RungeKutta4, step: {step!r}, duration: 1,
)"""
APART = np.array([0, 0, 10, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0], dtype=float)
STIFFNESS = 1e6  # N/m: the velocities after do not depend on it
STEPS = 100  # in half a period of the whole mass on the spring
LONGEST = 12  # such half periods in an impact

MU = Free(0.2, 0.05, 0.8)
# The bristle: stiffness of the normal stiffness, damping ratio.
BRISTLE = {"k_t": Free(0.7, 0.05, 5.0), "zeta_t": Free(0.5, 0.01, 5.0)}


def linear(values):
    """Linear spring; its damper by the damping ratio of the whole mass."""
    return f"Linear(damping: {2 * values['zeta'] * math.sqrt(STIFFNESS * MASS)!r})"


def hunt_crossley(values):
    """Law of Hunt and Crossley, exponent 1."""
    return f"HuntCrossley(dissipation: {values['dissipation']!r}, exponent: 1.0)"


def power(values):
    """Power law with a linear spring and a free exponent of the damper; its damping is that of a depth of 1 mm."""
    scale = 2 * math.sqrt(STIFFNESS * MASS) / 1e-3 ** values["q"]
    return f"PowerLaw(exponent: 1.0, damping_exponent: {values['q']!r}, damping: {values['zeta'] * scale!r})"


LAWS = {
    "linear": (linear, {"zeta": Free(0.2, 0.02, 1.0)}),
    "Hunt–Crossley": (hunt_crossley, {"dissipation": Free(0.3, 0.02, 3.0)}),
    "power law": (power, {"zeta": Free(0.3, 0.01, 5.0), "q": Free(0.5, 0.0, 1.0)}),
}
# What friction has of its own: text of the law from values, and its free parameters.
FRICTIONS = {
    "bristle, k_t and c_t": BRISTLE,
    "bristle by default": {},
    "Coulomb": {},
}


def friction(kind, values):
    """Text of the law of friction."""
    if kind == "Coulomb":
        return f"Coulomb(mu: {values['mu']!r}, slip_speed: 1e-3)"
    if kind == "bristle by default":
        return f"Bristle(mu: {values['mu']!r})"
    stiffness = values["k_t"] * STIFFNESS
    return f"Bristle(mu: {values['mu']!r}, stiffness: {stiffness!r}, damping: {2 * values['zeta_t'] * math.sqrt(stiffness * MASS)!r})"


class Ellipse:
    """Simulation of impacts with one law."""

    def __init__(self, law, kind):
        self.normal, own = LAWS[law]
        self.kind, self.title = kind, f"Pong, {law}, {kind}"
        self.free = {"mu": MU, **own, **FRICTIONS[kind]}

    def configure(self, values):
        """Takes parameters."""
        import pong

        surface = f"stiffness: {STIFFNESS!r}, normal: {self.normal(values)}, friction: {friction(self.kind, values)}"
        axes = f"({SEMI_AXES[0]!r}, {SEMI_AXES[1]!r}, {SEMI_AXES[1]!r})"
        self.half_period = math.pi * math.sqrt(MASS / STIFFNESS)
        files = {
            "ellipse.ron": MODEL.format(
                name="ellipse",
                surface=surface,
                primitive=f'Ellipsoid(name: "shell", center: (0, 0, 0), semi_axes: {axes})',
            ),
            "floor.ron": MODEL.format(
                name="floor", surface="stiffness: inf", primitive='Plane(name: "top", normal: (0, 0, 1), offset: 0)'
            ),
            "impact.ron": SCENE.format(
                mass=MASS, inertia=MASS * GYRATION**2, gravity=-GRAVITY, step=self.half_period / STEPS
            ),
        }
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                (Path(folder) / name).write_text(text)
            self.simulation = pong.Scene.load(Path(folder) / "impact.ron").build()

    def after(self, impacts):
        """Velocities after the impacts.

        With the sign that the measurement has (jacobians.py), the impacts are those of an ellipse seen from behind: x points the
        other way. The ellipse starts where it just touches, not at the measured height, which is off by up to 0.1 mm.
        """
        out = np.empty_like(impacts.before)
        for number in range(len(impacts)):
            x, y, turning = impacts.before[number]
            start = np.zeros(13)
            # Turning from x to z is turning about −y.
            start[3], start[5] = np.cos(impacts.angle[number] / 2), -np.sin(impacts.angle[number] / 2)
            start[2] = np.hypot(
                SEMI_AXES[0] * np.sin(impacts.angle[number]), SEMI_AXES[1] * np.cos(impacts.angle[number])
            )
            start[7], start[9], start[11] = -x, y, -turning
            state = self._followed(start)
            out[number] = (-state[7], state[9], -state[11])
        return out

    def _followed(self, start):
        """State when the contact has ended."""
        self.simulation.set_states(APART[None], ["ellipse"])
        self.simulation.step()
        self.simulation.set_states(start[None], ["ellipse"])
        for _ in range(LONGEST):
            run = self.simulation.run(STEPS, every=STEPS)
            if run.contacts[-1] == 0:
                break
        return run.states[-1, 0]

"""A block that lands on four feet and slides to rest, moved by Drake (`pip install drake`): explicit and implicit steps.

    python hosts/python/examples/drake_implicit.py

The block has 2 kg, each foot 1e6 N/m and a friction of 0.3. Its wrench comes from Pong. `Block` is a `LeafSystem` with
continuous state, which Drake integrates; Drake's Python has no way to hand its implicit integrators a Jacobian: they
difference the derivatives, at 13 evaluations for each Jacobian. `Tangent` is a `LeafSystem` with discrete state that takes
one linearly implicit Euler step for each update, with `World.tangents` (docs/integrating.md, implicit hosts).

A step is stable if the block is within 1 mm of its rest height at the end, and no faster than 10 mm/s, and accurate if the
place where it stops is also within 2 % of the slide of a run at 20 µs. Prints both and the evaluations of Pong for each
host.
"""

import argparse

import numpy as np
from pydrake.systems.analysis import ResetIntegratorFromFlags, Simulator
from pydrake.systems.framework import LeafSystem

import pong

MASS, SIDES, FOOT, GRAVITY, END = 2.0, (0.2, 0.2, 0.1), 1e6, 9.81, 0.4
INERTIA = MASS / 12.0 * np.array([SIDES[1] ** 2 + SIDES[2] ** 2, SIDES[0] ** 2 + SIDES[2] ** 2, SIDES[0] ** 2 + SIDES[1] ** 2])
HEAD = '(format: "pong-model", version: 1, surfaces: {"s": (stiffness: %s, normal: Linear(damping: %s), friction: Bristle(mu: 0.3))}, '
FEET = ", ".join(
    f'Point(name: "{name}", position: ({x}, {y}, -0.05))'
    for name, x, y in (("a", 0.1, 0.1), ("b", -0.1, 0.1), ("c", -0.1, -0.1), ("d", 0.1, -0.1))
)
BLOCK = HEAD % (FOOT, 400.0) + f'name: "block", root: (name: "block", surface: "s", primitives: [{FEET}]))'
FLOOR = HEAD % ("inf", 0.0) + 'name: "floor", root: (name: "floor", surface: "s", primitives: [Plane(name: "f", normal: (0, 0, 1), offset: 0)]))'
# Position, quaternion, velocity, angular velocity: from 0.5 mm above the floor.
START = np.array([0.0, 0.0, 0.0505, 1.0, 0.0, 0.0, 0.0, 0.2, 0.0, 0.0, 0.0, 0.0, 0.5])


class Contact:
    """A world of block and floor, with a count of its evaluations."""

    def __init__(self):
        builder = pong.WorldBuilder()
        for name, text in (("block", BLOCK), ("floor", FLOOR)):
            builder.create_object(builder.add_model(pong.Model.parse(text, name=name)), name)
        builder.pair("block", "floor")
        self.world, self.evaluations = builder.seal(), 0
        self.states = np.zeros((2, 13))
        self.states[1, 3] = 1.0

    def wrench(self, state):
        """Force and moment on the block about its mass centre, N and N·m, weight included."""
        self.states[0] = state
        self.states[0, 3:7] /= np.linalg.norm(state[3:7])
        self.world.set_states(self.states)
        self.world.evaluate()
        self.evaluations += 1
        wrench = self.world.wrenches()[0]
        wrench[2] -= MASS * GRAVITY
        return wrench

    def commit(self, state):
        self.wrench(state)
        self.world.commit()

    def tangent(self):
        """Stiffness and damping of the block's contacts, 6 × 6 each; zero without contact."""
        tangents = self.world.tangents()
        return [tangents[0].stiffness[0, 0], tangents[0].damping[0, 0]] if tangents else [np.zeros((6, 6))] * 2


def rotation(q):
    w, x, y, z = q / np.linalg.norm(q)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def turning(q, rate):
    """Derivative of a quaternion by time."""
    w, v = q[0], q[1:]
    return 0.5 * np.concatenate([[-rate @ v], w * rate + np.cross(rate, v)])


def inertia(q):
    """Generalised mass along the common axes, 6 × 6."""
    turn = rotation(q)
    mass = np.diag([MASS] * 3 + [0.0] * 3)
    mass[3:, 3:] = turn @ np.diag(INERTIA) @ turn.T
    return mass


def gyroscopic(mass, rate):
    return np.concatenate([np.zeros(3), -np.cross(rate, mass[3:, 3:] @ rate)])


class Block(LeafSystem):
    """Pose and twist of the block as continuous state. What Pong remembers is committed once per step, not part of a context."""

    def __init__(self, contact):
        super().__init__()
        self.contact = contact
        self.DeclareContinuousState(13)
        self.DeclarePerStepPublishEvent(lambda context: contact.commit(context.get_continuous_state_vector().CopyToVector()))

    def DoCalcTimeDerivatives(self, context, derivatives):
        state = context.get_continuous_state_vector().CopyToVector()
        mass = inertia(state[3:7])
        force = self.contact.wrench(state) + gyroscopic(mass, state[10:])
        rates = [state[7:10], turning(state[3:7], state[10:]), np.linalg.solve(mass, force)]
        derivatives.get_mutable_vector().SetFromVector(np.concatenate(rates))


def moved(state, twist, step):
    end = np.concatenate([state[:3] + step * twist[:3], state[3:7] + step * turning(state[3:7], twist[3:]), twist])
    end[3:7] /= np.linalg.norm(end[3:7])
    return end


class Tangent(LeafSystem):
    """Pose and twist of the block as discrete state: a linearly implicit Euler step, or a semi-implicit one without tangent."""

    def __init__(self, contact, step, implicit):
        super().__init__()
        self.contact, self.step, self.implicit = contact, step, implicit
        self.DeclareDiscreteState(13)
        self.DeclarePeriodicDiscreteUpdateEvent(step, 0.0, self.update)

    def update(self, context, discrete):
        state, step = context.get_discrete_state_vector().CopyToVector(), self.step
        mass, twist = inertia(state[3:7]), state[7:]
        force = self.contact.wrench(state) + gyroscopic(mass, state[10:])
        stiffness, damping = self.contact.tangent() if self.implicit else np.zeros((2, 6, 6))
        self.contact.world.commit()
        matrix = mass + step * damping + step * step * stiffness
        change = np.linalg.solve(matrix, step * (force - step * stiffness @ twist))
        discrete.get_mutable_vector().SetFromVector(moved(state, twist + change, step))


def of_drake(scheme, step, accuracy=None):
    contact = Contact()
    simulator = Simulator(Block(contact))
    simulator.get_mutable_context().SetContinuousState(START)
    integrator = ResetIntegratorFromFlags(simulator, scheme, step)
    integrator.set_fixed_step_mode(accuracy is None)
    if accuracy is not None:
        integrator.set_target_accuracy(accuracy)
    simulator.Initialize()
    simulator.AdvanceTo(END)
    return simulator.get_context().get_continuous_state_vector().CopyToVector(), contact.evaluations


def of_tangent(implicit, step):
    contact = Contact()
    simulator = Simulator(Tangent(contact, step, implicit))
    simulator.get_mutable_context().SetDiscreteState(START)
    simulator.Initialize()
    simulator.AdvanceTo(END - 0.5 * step)
    return simulator.get_context().get_discrete_state_vector().CopyToVector(), contact.evaluations


HOSTS = {
    "semi-implicit Euler": lambda step: of_tangent(False, step),
    "linearly implicit Euler by the tangent": lambda step: of_tangent(True, step),
    "Drake, runge_kutta3": lambda step: of_drake("runge_kutta3", step),
    "Drake, implicit_euler": lambda step: of_drake("implicit_euler", step),
}
CONTROLLED = ("runge_kutta3", "implicit_euler", "radau3")


def judged(run, exact):
    """Stable and accurate, and the number of evaluations."""
    try:
        state, evaluations = run()
    except (RuntimeError, pong.PongError):
        return False, False, 0
    speed = np.linalg.norm(state[7:10])
    stable = bool(np.isfinite(state).all() and abs(state[2] - 0.05) < 1e-3 and speed < 0.01)
    slide = np.linalg.norm(exact[:2])
    return stable, stable and np.linalg.norm(state[:2] - exact[:2]) < 0.02 * slide, evaluations


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--steps", type=float, nargs="+", default=[0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0], help="ms")
    parser.add_argument("--exact", type=float, default=0.02, help="step of the run that is taken as exact, ms")
    given = parser.parse_args()
    exact, _ = of_tangent(False, given.exact * 1e-3)
    print(f"slide of {np.linalg.norm(exact[:2]) * 1e3:.3f} mm at {given.exact} ms")
    print("host, step in ms: s stable, a also accurate, - neither; evaluations of Pong")
    for name, host in HOSTS.items():
        cells = []
        for step in given.steps:
            stable, accurate, evaluations = judged(lambda: host(step * 1e-3), exact)
            cells.append(f"{step:g}: {'a' if accurate else 's' if stable else '-'} {evaluations if stable else ''}".strip())
        print(f"{name:40} {', '.join(cells)}", flush=True)
    for scheme in CONTROLLED:
        stable, accurate, evaluations = judged(lambda: of_drake(scheme, 0.1, 1e-3), exact)
        print(f"Drake, {scheme}, error control 1e-3: {'a' if accurate else 's' if stable else '-'} {evaluations}", flush=True)


if __name__ == "__main__":
    main()

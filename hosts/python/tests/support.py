"""Shared parts of the tests: two models, a world of them, states."""

import numpy as np

import pong

BALL = """(
    format: "pong-model", version: 1, name: "ball",
    surfaces: { "rubber": (stiffness: 2e4, normal: Linear(damping: 30), friction: Bristle(mu: 0.6)) },
    root: (name: "ball", surface: "rubber", primitives: [
        Sphere(name: "shell", center: (0, 0, 0), radius: 0.1),
    ]),
)"""
GROUND = """(
    format: "pong-model", version: 1, name: "ground",
    surfaces: { "stone": (stiffness: inf, friction: Bristle(mu: 0.6)) },
    root: (name: "ground", surface: "stone", primitives: [
        Plane(name: "floor", normal: (0, 0, 1), offset: 0),
    ]),
)"""
STIFFNESS, DAMPING, RADIUS = 2e4, 30.0, 0.1
SCENE = """(
    format: "pong-scene", version: 1, name: "drop",
    models: { "ball": "ball.ron", "ground": "ground.ron" },
    objects: [
        (name: "ball", model: "ball", bodies: [
            (motion: Free, mass: 1.0, inertia: Diagonal(4e-3, 4e-3, 4e-3), position: (0.0, 0.0, 0.2)),
        ]),
        (name: "ground", model: "ground", bodies: [(motion: Fixed)]),
    ],
    pairs: [("ball", "ground")],
    gravity: (0.0, 0.0, -9.81),
    integrator: RungeKutta4,
    step: 1e-4,
    duration: 0.3,
    record_every: 10,
    ledger: true,
)"""


def builder(**config):
    made = pong.WorldBuilder(**config)
    for name, text in (("ball", BALL), ("ground", GROUND)):
        made.create_object(made.add_model(pong.Model.parse(text, name=name)), name)
    made.pair("ball", "ground")
    return made


def world(**config):
    return builder(**config).seal()


def states(*rows):
    """A row (position, velocity, angular velocity) for each Interface, without rotation."""
    array = np.zeros((len(rows), 13))
    array[:, 3] = 1.0
    for row, (position, velocity, spin) in zip(array, rows):
        row[:3], row[7:10], row[10:] = position, velocity, spin
    return array


def touching(depth, velocity=(0.0, 0.0, 0.0), spin=(0.0, 0.0, 0.0)):
    """States with the ball at this depth in the ground."""
    return states(((0.0, 0.0, RADIUS - depth), velocity, spin), ((0.0,) * 3, (0.0,) * 3, (0.0,) * 3))


def turned(array, rotation, about):
    """All states rotated by a unit quaternion (w, x, y, z) and translated together."""
    w, v = rotation[0], np.array(rotation[1:])

    def turn(vector):
        return vector + 2 * np.cross(v, np.cross(v, vector) + w * vector)

    out = array.copy()
    for row in out:
        row[:3], row[7:10], row[10:] = turn(row[:3]) + about, turn(row[7:10]), turn(row[10:])
        q = row[3:7].copy()
        row[3] = w * q[0] - v @ q[1:]
        row[4:7] = w * q[1:] + q[0] * v + np.cross(v, q[1:])
    return out, turn


def scene_folder(folder, scene=SCENE):
    """A folder with the scene `drop` and its models."""
    (folder / "ball.ron").write_text(BALL)
    (folder / "ground.ron").write_text(GROUND)
    (folder / "drop.ron").write_text(scene)
    return folder / "drop.ron"

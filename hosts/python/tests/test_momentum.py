"""Inertia from momentum: that of simulated tosses with noise, whatever the scene says; bad input."""

import numpy as np
import pytest

import pong

EDGE = 0.1
CORNERS = [(x, y, z) for x in (-0.05, 0.05) for y in (-0.05, 0.05) for z in (-0.05, 0.05)]
CUBE = """(
    format: "pong-model", version: 1, name: "cube",
    surfaces: {{ "acrylic": (stiffness: 2e4, normal: Linear(damping: 10, ramp: 5e-4), friction: Bristle(mu: 0.2, stiffness: 1.3e4, damping: 30)) }},
    root: (name: "cube", surface: "acrylic", primitives: [{points}]),
)"""
TABLE = """(
    format: "pong-model", version: 1, name: "table", surfaces: { "wood": (stiffness: inf) },
    root: (name: "table", surface: "wood", primitives: [Plane(name: "top", normal: (0, 0, 1), offset: 0)]),
)"""
SCENE = """(
    format: "pong-scene", version: 1, name: "toss", models: {{ "cube": "cube.ron", "table": "table.ron" }},
    objects: [
        (name: "cube", model: "cube", bodies: [(motion: Free, mass: 0.4, inertia: Diagonal({inertia}), position: (0, 0, 0.2))]),
        (name: "table", model: "table", bodies: [(motion: Fixed)]),
    ],
    pairs: [("cube", "table")], gravity: (0, 0, -9.81), integrator: RungeKutta4, step: 6.76e-4, duration: 0.5,
)"""
TIMES = np.arange(60) / 148.0


def scene(folder, name, inertia):
    points = ", ".join(f'Point(name: "p{number}", position: {corner})' for number, corner in enumerate(CORNERS))
    (folder / "cube.ron").write_text(CUBE.format(points=points))
    (folder / "table.ron").write_text(TABLE)
    (folder / name).write_text(SCENE.format(inertia=", ".join(map(str, inertia))))
    return folder / name


def tosses(path, count):
    """Noisy poses of random tosses."""
    random = np.random.default_rng(1)
    batch = pong.Scene.load(path).batch()
    starts = np.full((count, len(batch.bodies), 13), np.nan)
    quaternions = random.normal(size=(count, 4))
    quaternions /= np.linalg.norm(quaternions, axis=1, keepdims=True)
    velocities = random.uniform([-1, -1, -1, -5, -5, -5], [1, 1, -0.5, 5, 5, 5], (count, 6))
    starts[:, batch.bodies.index("cube")] = np.hstack([np.tile([0.0, 0.0, 0.2], (count, 1)), quaternions, velocities])
    states = batch.run(TIMES, starts=starts).states[:, :, batch.bodies.index("cube")]
    place = states[..., :3] + random.normal(scale=3e-4, size=states[..., :3].shape)
    turn = states[..., 3:7] + random.normal(scale=1.5e-3, size=states[..., 3:7].shape)
    turn /= np.linalg.norm(turn, axis=-1, keepdims=True)
    return {
        "record": np.repeat(np.arange(count), len(TIMES)),
        "time": np.tile(TIMES, count),
        "position": place.reshape(-1, 3),
        "orientation": turn.reshape(-1, 4),
    }


def test_inertia_is_that_of_the_tosses(tmp_path):
    truth = 1e-3
    data = tosses(scene(tmp_path, "toss.ron", [truth] * 3), 60)
    # A scene with half of it, and the same geometry: its laws play no part.
    other = scene(tmp_path, "other.ron", [truth / 2] * 3)
    found = pong.inertia_from_momentum(other, data)
    assert found.touches > 20 and found.inertia == pytest.approx(truth, rel=0.06)
    assert found.interval[0] < found.inertia < found.interval[1] and found.factor == pytest.approx(2.0, rel=0.06)
    assert isinstance(found, pong.types.MomentumInertia) and "kg·m²" in str(found)
    assert "Inertia of `cube` from momentum" in found.page
    lines = ["# noise.position = 3e-4", "record,time,x,y,z,qw,qx,qy,qz"]
    rows = zip(data["record"], data["time"], data["position"], data["orientation"])
    lines += [",".join(map(repr, map(float, (record, time, *place, *turn)))) for record, time, place, turn in rows]
    (tmp_path / "toss.csv").write_text("\n".join(lines))
    assert pong.inertia_from_momentum(other, tmp_path / "toss.csv") == found


def test_bad_input_is_refused(tmp_path):
    path = scene(tmp_path, "toss.ron", [1e-3] * 3)
    poses = {"time": [0.0, 0.1], "position": np.zeros((2, 3)), "orientation": [[1, 0, 0, 0]] * 2}
    with pytest.raises(pong.StudyError, match="0 touches of one point.*give at least 10"):
        pong.inertia_from_momentum(path, poses)
    with pytest.raises(pong.StudyError, match="no free body `table`; name one of: cube"):
        pong.inertia_from_momentum(path, poses, body="table")
    with pytest.raises(pong.StudyError, match="in 0 records"):
        pong.inertia_from_momentum(path, {"time": [0.0], "position": [[0.0] * 3]})
    with pytest.raises(pong.BadValueError, match="a row for each time"):
        pong.inertia_from_momentum(path, {**poses, "time": [0.0]})
    long = scene(tmp_path, "long.ron", [1e-3, 1e-3, 1.5e-3])
    with pytest.raises(pong.StudyError, match="is no even rotation; identify it with `fit`"):
        pong.inertia_from_momentum(long, poses)
    (tmp_path / "empty.csv").write_text("time,x,y,z\n")
    with pytest.raises(pong.StudyError, match="no measurement"):
        pong.inertia_from_momentum(path, tmp_path / "empty.csv")

"""Batches and identification: the bits of a simulation, known parameters found again, bad input."""

import numpy as np
import pytest
from support import scene_folder

import pong

TIMES = np.arange(40) * 4e-3


def test_a_batch_has_the_bits_of_a_simulation(tmp_path):
    scene = pong.Scene.load(scene_folder(tmp_path))
    batch = scene.batch(threads=2)
    runs = batch.run(TIMES, starts=np.full((3, len(batch.bodies), 13), np.nan))
    simulation = scene.build()
    steps = round(4e-3 / simulation.step_length)
    for row in range(len(TIMES)):
        assert np.array_equal(runs.states[1, row], simulation.states())
        simulation.step(steps)
    assert runs.failures == {} and runs.peak_force.shape == (3, len(batch.bodies))


def test_a_value_is_found_from_arrays_and_from_an_npz(tmp_path):
    path = scene_folder(tmp_path)
    name = "surface.ball.rubber.stiffness"
    batch = pong.Scene.load(path).batch([name])
    truth = 1.5e4
    states = batch.run(np.arange(80) * 4e-3, values=[[truth]]).states[0, :, batch.bodies.index("ball")]
    data = {"time": np.arange(80) * 4e-3, "position": states[:, :3], "orientation": states[:, 3:7]}
    noise = {"position": 1e-4, "rotation": 1e-3}
    found = pong.fit(path, data, {name: (1e3, 1e5)}, noise=noise, tries=2, output=tmp_path / "out")
    assert found.parameters[0].value == pytest.approx(truth, rel=1e-3)
    assert (tmp_path / "out" / "fit.md").read_text(encoding="utf-8") == found.page
    np.savez(tmp_path / "data.npz", **data)
    again = pong.fit(path, tmp_path / "data.npz", {name: (1e3, 1e5)}, noise=noise, tries=2, threads=1)
    assert again.page == found.page
    pong.plot_fit(found, tmp_path / "fit.svg")


def test_bad_input_is_refused(tmp_path):
    path = scene_folder(tmp_path)
    scene = pong.Scene.load(path)
    with pytest.raises(pong.BadValueError, match="there is no body `box`"):
        scene.batch(["body.box.mass"])
    batch = scene.batch()
    with pytest.raises(pong.BadValueError, match="no state for"):
        batch.run(TIMES, starts=np.zeros((1, len(batch.bodies), 13)))
    assert "increase" in batch.run([0.1, 0.0]).failures[0]
    free = ["surface.ball.rubber.stiffness"]
    with pytest.raises(pong.BadValueError, match="no quantity `height`"):
        pong.fit(path, {"time": [0.0], "height": [1.0]}, free)
    with pytest.raises(pong.BadValueError, match="give \\(2, 3\\)"):
        pong.fit(path, {"time": [0.0, 1.0], "position": [1.0, 2.0]}, free)
    with pytest.raises(pong.StudyError, match="noise of its sensor is not known"):
        pong.fit(path, {"time": [0.0, 1.0], "position": np.zeros((2, 3)), "orientation": [[1, 0, 0, 0]] * 2}, free)
    with pytest.raises(pong.BadValueError, match="there is no `height`"):
        pong.fit(path, {"time": [0.0]}, free, of=["height"])

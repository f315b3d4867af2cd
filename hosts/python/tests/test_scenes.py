"""Scenes in the built-in executive: closed forms, and the numbers of `pong run` bit for bit."""

import math
import os
import pathlib
import subprocess

import numpy as np
import pytest
from support import BALL, SCENE, STIFFNESS, scene_folder

import pong

PONG = os.environ["PONG"]
MODELS = pathlib.Path(os.environ["REPOSITORY"]) / "models"


def test_free_fall_is_a_parabola(tmp_path):
    simulation = pong.Scene.load(scene_folder(tmp_path)).build()
    assert (simulation.bodies, simulation.steps, simulation.record_every) == (["ball", "ground"], 3000, 10)
    simulation.step(1000)
    assert simulation.time == pytest.approx(0.1, rel=1e-15)
    assert simulation.states()[0, 2] == pytest.approx(0.2 - 0.5 * 9.81 * 0.01, rel=1e-13)
    assert not simulation.wrenches().any() and simulation.report().contacts == 0


def test_a_bounce_without_damping_gives_the_closed_form(tmp_path):
    scene = scene_folder(tmp_path, SCENE.replace("(0.0, 0.0, -9.81)", "(0.0, 0.0, 0.0)"))
    (tmp_path / "ball.ron").write_text(BALL.replace("damping: 30", "damping: 0"))
    simulation = pong.Scene.load(scene).build()
    start = np.array([[0, 0, 0.1, 1, 0, 0, 0, 0, 0, -0.5, 0, 0, 0.0]])
    simulation.set_states(start, ["ball"])
    run = simulation.run(every=1)
    # Half a period of √(k/m), depth v·√(m/k), force v·√(k·m); it leaves as fast as it came.
    assert run.peak_force[0] == pytest.approx(0.5 * math.sqrt(STIFFNESS), rel=1e-5)
    assert run.peak_depth[0] == pytest.approx(0.5 / math.sqrt(STIFFNESS), rel=1e-5)
    # The step of first contact sees the spring from its middle on: second order, (ω·h)² = 2e-4, relative.
    assert run.states[-1, 0, 9] == pytest.approx(0.5, rel=1e-5)
    # The trapezoid rule over 222 steps of half a sine: (π/222)²/12 of it.
    assert run.impulse[0, 2] == pytest.approx(1.0, rel=2e-5)
    touched = run.time[run.contacts > 0]
    assert touched[-1] - touched[0] == pytest.approx(math.pi / math.sqrt(STIFFNESS), abs=2e-4)
    assert run.worst_balance < 1e-6 and run.energy["kinetic"] == pytest.approx(0.125, rel=1e-5)


def test_every_instant_is_kept_as_asked(tmp_path):
    scene = pong.Scene.load(scene_folder(tmp_path))
    run = scene.build().run(95, every=10)
    np.testing.assert_allclose(run.time, [*(1e-3 * np.arange(10)), 9.5e-3], rtol=1e-14)
    assert run.states.shape == (11, 2, 13) and run.wrenches.shape == (11, 2, 6) and run.contacts.shape == (11,)
    simulation = scene.build()
    simulation.run(1000)
    assert simulation.run().time[-1] == pytest.approx(0.3, rel=1e-14), "a second run goes on to the end"


def test_another_step_and_integrator(tmp_path):
    scene = pong.Scene.load(scene_folder(tmp_path))
    assert (scene.name, scene.step, scene.duration, scene.integrator) == ("drop", 1e-4, 0.3, "RungeKutta4")
    simulation = scene.build(step=1e-3, integrator="ZeroOrderHold", substeps=2, delay_frames=1)
    assert simulation.integrator == "ZeroOrderHold(substeps: 2, delay_frames: 1)"
    assert simulation.step_length == 1e-3 and simulation.steps == 300
    assert scene.model_files == [tmp_path / "ball.ron", tmp_path / "ground.ron"]


def test_surfaces_and_gravity_can_be_changed(tmp_path):
    simulation = pong.Scene.load(scene_folder(tmp_path)).build()
    values = simulation.surface("ball", "rubber")
    simulation.set_surface("ball", "rubber", values | {"stiffness": 4 * STIFFNESS})
    simulation.set_gravity((0, 0, 0))
    simulation.set_states(np.array([[0, 0, 0.099, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0.0]]), ["ball"])
    simulation.run(0)
    assert simulation.wrenches()[0, 2] == pytest.approx(4 * STIFFNESS * 1e-3, rel=1e-10)
    assert simulation.contacts()["depth"][0] == pytest.approx(1e-3, rel=1e-10)


def run_cli(*arguments):
    done = subprocess.run([PONG, *map(str, arguments)], capture_output=True, encoding="utf-8")
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.parametrize("scene", ["scene_shallow.ron"])
def test_a_run_has_the_bits_of_pong_run(tmp_path, scene):
    file = MODELS / "peg_in_hole" / scene
    run_cli("run", "--quiet", "--log", tmp_path / "cli", file)
    run = pong.Scene.load(file).build().run(log=tmp_path / "python")
    same_tables(tmp_path)
    log = pong.Log(tmp_path / "python")
    assert np.array_equal(log.states["position"], run.states[: log.frame_count, :, :3])
    assert log.is_whole and run.contacts.max() > 0


def test_the_docking_has_the_bits_of_pong_run(tmp_path):
    """The first 2 s of the docking, in which petals have met and slide."""
    text = (MODELS / "idss_docking" / "scene_soft_capture.ron").read_text()
    short = text.replace("duration: 8.0", "duration: 2.0")
    assert short != text
    for name in ("idss_active.ron", "idss_passive.ron"):
        (tmp_path / name).write_bytes((MODELS / "idss_docking" / name).read_bytes())
    (tmp_path / "scene.ron").write_text(short)
    run_cli("run", "--quiet", "--log", tmp_path / "cli", tmp_path / "scene.ron")
    run = pong.Scene.load(tmp_path / "scene.ron").build().run(log=tmp_path / "python")
    same_tables(tmp_path)
    assert run.peak_force[run.bodies.index("target")] > 10.0


def same_tables(folder):
    for table in ("states", "wrenches", "contacts", "energies"):
        cli, own = (np.load(folder / who / f"{table}.npy") for who in ("cli", "python"))
        assert cli.tobytes() == own.tobytes(), table


def test_what_a_run_warns_of_is_what_the_program_warns_of(tmp_path):
    scene = scene_folder(tmp_path, SCENE.replace("step: 1e-4", "step: 5e-2"))
    simulation = pong.Scene.load(scene).build()
    told = subprocess.run([PONG, "run", "--quiet", str(scene)], capture_output=True, encoding="utf-8").stderr
    assert simulation.warnings, "the step is too long for the stiffness"
    for warning in simulation.warnings:
        assert warning in told


def test_advice_gives_the_bounce_that_was_wished_for(tmp_path):
    advice = pong.advise_contact(mass=1.0, speed=0.5, depth=2e-3, restitution=0.6, coupling="stages")
    text = BALL.replace("2e4", repr(advice["stiffness"])).replace("damping: 30", f"damping: {advice['damping']!r}")
    scene = scene_folder(tmp_path, SCENE.replace("(0.0, 0.0, -9.81)", "(0.0, 0.0, 0.0)"))
    (tmp_path / "ball.ron").write_text(text)
    simulation = pong.Scene.load(scene).build(step=1e-5)
    simulation.set_states(np.array([[0, 0, 0.1, 1, 0, 0, 0, 0, 0, -0.5, 0, 0, 0.0]]), ["ball"])
    run = simulation.run(10_000)
    assert run.peak_depth[0] == pytest.approx(2e-3, rel=1e-3)
    assert run.states[-1, 0, 9] == pytest.approx(0.3, rel=1e-3)


def test_cases_with_known_answers_run():
    (case,) = pong.verify(["v1"])
    assert case.id == "V1" and case.passes and case.failure is None and case.title and case.source
    for row in case.rows:
        assert row.passes and abs(row.got - row.expected) <= row.allowed

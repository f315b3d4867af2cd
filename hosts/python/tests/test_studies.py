"""Studies: known answers, and agreement with the program `pong`."""

import os
import signal
import subprocess
import threading
import warnings

import numpy as np
import pytest
from support import BALL, GROUND, SCENE, scene_folder

import pong

PONG = os.environ["PONG"]
# A ball at rest on the ground: 1 kg on 1e5 N/m for 64 ms, with friction and damping of no effect.
RESTING = (
    SCENE.replace("(0.0, 0.0, 0.2)", "(0.0, 0.0, 0.0999019)").replace("step: 1e-4", "step: 1e-3")
    .replace("duration: 0.3", "duration: 0.064").replace("record_every: 10", "record_every: 1")
)


def resting(folder):
    scene = scene_folder(folder, RESTING)
    (folder / "ball.ron").write_text(BALL.replace("stiffness: 2e4", "stiffness: 1e5"))
    return scene


def program(*arguments):
    return subprocess.run([PONG, *map(str, arguments)], capture_output=True, encoding="utf-8")


def test_a_log_agrees_until_a_bit_of_it_is_turned(tmp_path):
    scene = scene_folder(tmp_path)
    run = pong.Scene.load(scene).build().run(every=1, log=tmp_path / "log")
    found = pong.replay(tmp_path / "log")
    assert found.agrees and found.frames == found.compared == 3001 and found.contacts == run.contacts.sum()
    assert found.differences == [] and found.obstacle is None
    assert pong.replay(tmp_path / "log", workers=1).agrees
    # The lowest bit of the force on the ball along z, in a frame of the first bounce.
    wrenches = np.load(tmp_path / "log" / "wrenches.npy", mmap_mode="r+")
    frame = int(np.argmax(run.contacts > 0)) + 20
    changed = np.nextafter(wrenches["force"][frame, 0, 2], np.inf)
    wrenches["force"][frame, 0, 2] = changed
    wrenches.flush()
    found = pong.replay(tmp_path / "log")
    (line,) = found.differences
    assert not found.agrees and found.compared == frame + 1 and repr(float(changed)) in line and "ball" in line, line
    assert pong.replay(tmp_path / "log", tolerance=1e-12).agrees


def test_a_log_without_every_commit_is_told_of(tmp_path):
    pong.Scene.load(scene_folder(tmp_path)).build().run(log=tmp_path / "log")
    found = pong.replay(tmp_path / "log")
    assert not found.agrees and "not exact from frame 1 on: 9 commits" in found.obstacle, found.obstacle
    with pytest.raises(pong.LogError, match="nowhere"):
        pong.replay(tmp_path / "nowhere")
    with pytest.raises(pong.BadValueError, match="tolerance: it is 1; give a number from 0"):
        pong.replay(tmp_path / "log", tolerance=1.0)


def test_the_errors_of_steps_are_those_of_the_program(tmp_path):
    """Order of a method: at half the step RK4 has 1/16 of the error."""
    scene = resting(tmp_path)
    (tmp_path / "ball.ron").write_text(BALL.replace("damping: 30", "damping: 0"))
    found = pong.trade(scene, tmp_path / "out", within=0.05, of=["peak"], levers=["step"], rounds=1)
    assert found.converged and found.name == "drop" and found.page == (tmp_path / "out/trade.md").read_text(encoding="utf-8")
    errors = [level.errors["peak"] for level in found.levels]
    assert len(errors) >= 2 and all(level.error == level.errors["peak"] for level in found.levels)
    assert all(coarse > fine for coarse, fine in zip(errors, errors[1:])), errors
    assert found.cheapest.error + found.uncertainty <= 0.05 and found.cheapest.same_bits is None
    assert 0 < found.cheapest.median_time <= found.cheapest.tail_time
    done = program("trade", scene, "--within", "5%", "--of", "peak", "--levers", "step", "--rounds", "1", "-q", "-o",
                   tmp_path / "told")
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "told/errors.csv").read_bytes() == (tmp_path / "out/errors.csv").read_bytes()


def test_levers_that_change_no_answer_have_the_same_bits(tmp_path):
    found = pong.trade(
        resting(tmp_path), tmp_path / "out", levers=["bounds", "leaves"], leaves=[1, 8], rounds=1, within=0.5
    )
    kept = [level.same_bits for level in found.levels if level.same_bits is not None]
    assert len(kept) >= 5 and all(kept)


def test_a_log_is_studied_with_other_models(tmp_path):
    pong.Scene.load(resting(tmp_path)).build().run(every=1, log=tmp_path / "log")
    (tmp_path / "soft.ron").write_text(BALL.replace("stiffness: 2e4", "stiffness: 5e4"))
    found = pong.trade(
        tmp_path / "log", tmp_path / "out", levers=["alternatives"], rounds=1,
        alternatives={"soft": {"ball": tmp_path / "soft.ron"}},
    )
    plain, soft = found.levels
    # Half the stiffness at the same depths: half the force, to its peak.
    assert plain.errors["peak"] == 0.0 and "soft" in soft.name and soft.errors["peak"] == pytest.approx(0.5, rel=1e-6)
    assert "bit for bit" in found.page


def test_what_cannot_be_studied_is_told(tmp_path):
    scene = resting(tmp_path)

    def told(family, words, **given):
        with pytest.raises(family) as caught:
            pong.trade(scene, tmp_path / "out", **given)
        assert words in str(caught.value) and type(caught.value) is family

    told(pong.BadValueError, "of: there is no `weight`; give any of wrench, impulse, peak, energy, pose", of=["weight"])
    told(pong.BadValueError, "levers: there is no `luck`", levers=["luck"])
    told(pong.BadValueError, "within: it is 2; give a share above 0", within=2.0)
    told(pong.BadValueError, "within: it is NaN", within=float("nan"))
    told(pong.BadValueError, "rounds: it is 0", rounds=0)
    told(pong.BadValueError, "alternatives: a scene names its own", alternatives={"a": {"b": "c"}})
    told(pong.StudyError, "it is -1 s; give a finite time above zero", frame=-1.0)
    with pytest.raises(pong.StudyError, match="name a scene file that can be read"):
        pong.trade(tmp_path / "none.ron", tmp_path / "out")
    assert not (tmp_path / "out").exists()
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        pong.trade(scene, tmp_path / "out", levers=["step"], rounds=1, workers=[100_000])
    assert "100000 is left out" in str(caught[0].message)


def test_tuned_models_answer_the_same(tmp_path):
    """Timings are not tested; the statements about them must be consistent."""
    scene = scene_folder(tmp_path)
    (tmp_path / "ball.ron").write_text(BALL.replace("primitives: [", "groups: [(name: \"inner\", groups: [(name: \"core\", primitives: [")
                                       .replace("radius: 0.1),\n    ]", "radius: 0.1),\n    ])])]"))
    before = pong.Scene.load(scene).build().run()
    tuned = pong.tune(scene, output=tmp_path / "tuned", rounds=2, frames=64)
    assert set(tuned.written) == set(tuned.changes) <= {"ball", "ground"} and tuned.refused == []
    assert ("less time" in tuned.page) == bool(tuned.written)
    again = scene.read_text()
    for name, file in tuned.written.items():
        assert file == tmp_path / "tuned" / f"{name}_tuned.ron" and pong.Model.load(file).hash == pong.Model.load(tmp_path / f"{name}.ron").hash
        again = again.replace(f"{name}.ron", f"tuned/{name}_tuned.ron")
    scene.write_text(again)
    np.testing.assert_array_equal(pong.Scene.load(scene).build().run().states, before.states)


def test_what_cannot_be_tuned_is_told(tmp_path):
    scene = scene_folder(tmp_path)
    (tmp_path / "ball_tuned.ron").write_text("mine")
    with pytest.raises(pong.StudyError, match="ball_tuned.ron: it is there already"):
        pong.tune(scene)
    with pytest.raises(pong.StudyError, match="nowhere.ron"):
        pong.tune([scene, tmp_path / "nowhere.ron"], output=tmp_path / "tuned")
    with pytest.raises(pong.BadValueError, match="rounds: it is 1; give a number from 2"):
        pong.tune(scene, rounds=1)
    assert (tmp_path / "ball_tuned.ron").read_text() == "mine" and not (tmp_path / "tuned").exists()


@pytest.mark.parametrize("study", ["trade", "tune"])
def test_ctrl_c_ends_a_study_and_python_runs_meanwhile(tmp_path, study):
    scene = resting(tmp_path)
    endless = {
        "trade": lambda: pong.trade(scene, tmp_path / "out", rounds=1000),
        "tune": lambda: pong.tune(scene, output=tmp_path / "tuned", duration=1e6),
    }
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        threading.Timer(0.3, lambda: signal.raise_signal(signal.SIGINT)).start()
        with pytest.raises(KeyboardInterrupt):
            endless[study]()
    finally:
        signal.signal(signal.SIGINT, before)
    assert not (tmp_path / "out/trade.md").exists() and not (tmp_path / "tuned").exists()

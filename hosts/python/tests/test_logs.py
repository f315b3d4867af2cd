"""Logs: written by a program that computes frames itself, replayed by `pong replay`, read as views of files."""

import os
import subprocess
import sys

import numpy as np
import pytest
from support import touching, world

import pong

PONG = os.environ["PONG"]


def logged(folder, **options):
    """A slide with every kind of entry of a log."""
    w = world()
    w.start_log(folder, name="slide", step=1e-3, **options)
    for step in range(20):
        if step == 5:
            w.restore_state(w.save_state())
        if step == 8:
            w.set_pair_enabled(w.pairs[0], False)
        if step == 10:
            w.set_pair_enabled(w.pairs[0], True)
        if step == 12:
            w.set_surface(w.models[0], "rubber", w.surface(w.models[0], "rubber") | {"stiffness": 3e4})
        if step == 15:
            w.clear_contact_history("ball")
        given = touching(1e-3, velocity=(0.1, 0, 0))
        given[0, 0] = 1e-4 * step
        w.set_states(given)
        w.evaluate() if step % 2 else w.step()
        if step % 2:
            w.commit([w.pairs[0]] if step % 3 else None)
        w.log_frame(1e-3 * step)
    assert w.stop_log() == 20
    return w


def test_a_log_of_a_program_can_be_replayed(tmp_path):
    logged(tmp_path / "log")
    done = subprocess.run([PONG, "replay", str(tmp_path / "log")], capture_output=True, encoding="utf-8")
    assert done.returncode == 0, done.stdout + done.stderr
    log = pong.Log(tmp_path / "log")
    assert {event["event"] for event in log.events} >= {"pair", "surface", "restore", "clear_contact_history", "commit"}


def test_preloaded_friction_is_in_the_log(tmp_path):
    w = world()
    w.start_log(tmp_path / "log")
    w.set_states(touching(1e-3))
    assert w.preload_friction(w.pairs[0], holding=(3.0, 0, 0)) == 1
    w.step()
    w.log_frame(0.0)
    w.stop_log()
    done = subprocess.run([PONG, "replay", str(tmp_path / "log")], capture_output=True, encoding="utf-8")
    assert done.returncode == 0, done.stdout + done.stderr
    assert pong.Log(tmp_path / "log").wrenches["force"][0, 0, 0] == pytest.approx(3.0, rel=1e-9)


def test_tables_are_views_of_the_files(tmp_path):
    w = logged(tmp_path / "log")
    log = pong.Log(tmp_path / "log")
    assert log.is_whole and log.frame_count == 20 and log.bodies == ["ball", "ground"]
    for table in (log.frames, log.states, log.wrenches, log.contacts):
        base = table
        while not isinstance(base, np.memmap):
            base = base.base
        assert not table.flags.writeable
    np.testing.assert_allclose(log.time, 1e-3 * np.arange(20))
    assert np.array_equal(log.states["position"][-1], w.states()[:, :3])
    assert np.array_equal(log.wrenches["force"][-1], w.wrenches()[:, :3])
    (contact,) = log.contacts_of(19)
    assert {log.primitive(contact["primitive_a"]), log.primitive(contact["primitive_b"])} == {
        "ball/ball/shell",
        "ground/ground/floor",
    }
    assert len(log.contacts_of(8)) == 0, "the pair was off"


def test_a_log_that_was_cut_off_is_read_as_far_as_it_goes(tmp_path):
    logged(tmp_path / "log")
    states = tmp_path / "log" / "states.npy"
    states.write_bytes(states.read_bytes()[: -3 * 13 * 8])
    log = pong.Log(tmp_path / "log")
    assert not log.is_whole and log.frame_count < 20
    assert len(log.frames) == len(log.states) == len(log.wrenches) == log.frame_count


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no pipes and devices among files")
def test_pipes_and_devices_are_refused_at_once(tmp_path):
    """A pipe has no writer, and a device has no end."""
    logged(tmp_path / "log")
    for name in ("run.json", "events.jsonl", "states.npy"):
        file = tmp_path / "log" / name
        content = file.read_bytes()
        for put in (os.mkfifo, lambda file: file.symlink_to("/dev/zero")):
            file.unlink()
            put(file)
            with pytest.raises(pong.LogError, match=f"{name}.*not a regular file"):
                pong.Log(tmp_path / "log")
            with pytest.raises(pong.LogError, match=f"{name}.*not a regular file"):
                pong.replay(tmp_path / "log")
        file.unlink()
        file.write_bytes(content)
    assert pong.Log(tmp_path / "log").is_whole


def test_faults_of_logs_are_told(tmp_path):
    with pytest.raises(pong.LogError, match="nowhere"):
        pong.Log(tmp_path / "nowhere")
    logged(tmp_path / "log")
    w = world()
    with pytest.raises(pong.LogError, match="log"):
        w.start_log(tmp_path / "log")
    logged(tmp_path / "log", overwrite=True)
    w.start_log(tmp_path / "other")
    with pytest.raises(pong.PhaseError, match="stop_log"):
        w.start_log(tmp_path / "third")
    with pytest.raises(pong.PongError, match="frame"):
        w.log_frame(0.0)
    run = tmp_path / "log" / "run.json"
    run.write_text(run.read_text().replace('"pong-log"', '"pang-log"'))
    with pytest.raises(pong.LogError, match="run.json"):
        pong.Log(tmp_path / "log")

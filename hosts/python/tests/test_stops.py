"""Runs that end early: times of the checks, and no effect on the run before."""

import math

import numpy as np
import pytest
from support import SCENE, scene_folder

import pong
from pong import campaign
from pong.campaign import _case, _dispersions, _run, _stops


def plan_of(folder, scene=SCENE, **changes):
    """The ball 0.1 m above the ground, at its own speed."""
    options = {
        "scene": scene_folder(folder, scene),
        "runs": 1,
        "dispersions": [campaign.Uniform("ball.velocity.z", 1.9, 2.1)],
        "criteria": [campaign.Within("near", "ball", "ground", low=(-1, -1, 0), high=(1, 1, 0.25))],
        "look_every": 0.01,
    }
    return campaign.Plan(**options | changes)


def outcome(plan, *values):
    return _case.outcome(_run.checked(plan), 0, np.array(values, dtype=float))


def test_a_body_that_leaves_ends_the_run_at_the_first_look_beyond(tmp_path):
    """Without gravity z = 0.2 + 2t: 0.4 m is passed at 0.1 s, and the check there sees 0.4 m, within rounding."""
    still = SCENE.replace("(0.0, 0.0, -9.81)", "(0.0, 0.0, 0.0)")
    plan = plan_of(tmp_path, still, stops=[campaign.Beyond("gone", "ball", "ground", 0.41)])
    row = outcome(plan, 2.0)
    assert (row["ended_by"], row["time_at_end"]) == ("gone", pytest.approx(0.11, rel=1e-12)) and not row["near"]
    # Beyond that distance all the time, but approaching until it touches and returns.
    plan = plan_of(tmp_path, still, stops=[campaign.Beyond("gone", "ball", "ground", 0.05)], duration=0.5)
    row = outcome(plan, -0.5)
    # First contact at 0.2 s, greatest depth half of π√(m/k) later, k = 2e4 N/m, at 0.2111 s: the check at 0.22 s sees
    # it farther away than that at 0.21 s.
    assert row["ended_by"] == "gone" and row["time_at_end"] == pytest.approx(0.22, rel=1e-12)
    assert row["peak_force.ball"] > 10.0


def test_a_criterion_that_holds_ends_the_run_and_one_that_is_lost_begins_anew(tmp_path):
    """z = 0.2 + vt - gt²/2 is above 0.25 between two known times."""
    plan = plan_of(tmp_path, stops=[campaign.Held("held", "near", 0.05)], duration=1.0)
    assert outcome(plan, 0.0)["time_at_end"] == pytest.approx(0.05, rel=1e-12)
    g, v = 9.81, 1.5
    up, down = ((v + sign * math.sqrt(v * v - 2 * g * 0.05)) / g for sign in (-1, 1))
    assert 0.03 < up < 0.04 < down
    row = outcome(plan, v)
    # Held from the first check after its return.
    back = math.ceil(down / 0.01) * 0.01
    assert (row["ended_by"], row["near"]) == ("held", True) and row["time_at_end"] == pytest.approx(back + 0.05, rel=1e-12)
    # A run that no stop ends is reported as such.
    assert outcome(plan_of(tmp_path, duration=0.02), 0.0)["ended_by"] == "duration"


def test_what_is_before_the_stop_has_the_same_bits(tmp_path):
    stops = [campaign.Held("held", "near", 0.18)]
    stopped = outcome(plan_of(tmp_path, stops=stops, duration=0.25), 0.0)
    assert stopped["ended_by"] == "held" and stopped["peak_force.ball"] > 100.0, "it has touched before"
    whole = outcome(plan_of(tmp_path, duration=stopped["time_at_end"]), 0.0)
    assert {**stopped, "ended_by": ""} == {**whole, "ended_by": ""}


def test_integrator_and_step_of_a_plan(tmp_path):
    plan = plan_of(tmp_path, integrator="SemiImplicitEuler", step=2e-4)
    row = outcome(plan, 0.0)
    simulation = pong.Scene.load(plan.scene).build(integrator="SemiImplicitEuler", step=2e-4)
    run = simulation.run(every=100000)
    assert row["peak_force.ball"] == run.peak_force[0] != outcome(plan_of(tmp_path), 0.0)["peak_force.ball"]
    assert row["time_at_end"] == run.time[-1]


def test_all_stops_look_and_the_first_in_the_list_is_told():
    job = {
        "criteria": [{"name": "near", "body": "a", "of": "b", "low": (-1,) * 3, "high": (1,) * 3, "speed": None}],
        "look_every": 0.1,
        "stops": [
            {"kind": "Beyond", "name": "gone", "body": "a", "of": "b", "distance": 0.5},
            {"kind": "Held", "name": "held", "criterion": "near", "time": 0.2},
        ],
    }
    watch = _stops.Watch(job, ["a", "b"])
    states = np.zeros((2, 13))
    states[:, 3] = 1.0
    for look, apart in enumerate((0.6, 0.6, 0.55)):
        states[0, 0] = apart
        ended = watch(0.1 * look, states)
    assert ended and watch.ended_by == "held", "0.6 m and no farther is not parting"
    states[0, 0] = 0.7
    assert watch(0.3, states) and watch.ended_by == "gone"


def refused(call, *words):
    with pytest.raises(campaign.CampaignError) as caught:
        call()
    for word in words:
        assert word in str(caught.value), str(caught.value)


def test_stops_that_cannot_be_used(tmp_path):
    refused(lambda: campaign.Held("held", "near", 0.0), "stop `held`, time", "above zero")
    refused(lambda: campaign.Beyond("gone", "ball", "ground", math.nan), "stop `gone`, distance", "above zero")
    refused(lambda: plan_of(tmp_path, stops=["held"]), "stops", "Held or Beyond")
    refused(lambda: plan_of(tmp_path, stops=[campaign.Held("held", "far", 1.0)]), "no criterion `far`", "add it to `criteria`")
    twice = [campaign.Held("held", "near", 1.0)] * 2
    refused(lambda: plan_of(tmp_path, stops=twice), "stop `held`", "given twice")
    refused(lambda: plan_of(tmp_path, stops=[campaign.Held("duration", "near", 1.0)]), "no stop ends", "give another")
    refused(lambda: plan_of(tmp_path, look_every=0), "look_every: it is 0")
    refused(lambda: plan_of(tmp_path, integrator="Euler"), "integrator: there is no `Euler`", "SemiImplicitEuler")
    named = [campaign.Within("tunnelled", "ball", "ground", low=(0,) * 3, high=(1,) * 3)]
    refused(lambda: plan_of(tmp_path, criteria=named), "criterion `tunnelled`", "column")
    plan = plan_of(tmp_path, stops=[campaign.Beyond("gone", "bell", "ground", 1.0)])
    refused(lambda: _run.checked(plan), "stop `gone`", "no body `bell`", "ball, ground")


def test_a_plan_with_stops_comes_back_from_its_file(tmp_path):
    stops = [campaign.Held("held", "near", 0.1), campaign.Beyond("gone", "ball", "ground", 2.0)]
    plan = plan_of(tmp_path, stops=stops, integrator="RungeKutta4")
    assert campaign.Plan.from_json(plan.to_json()) == plan
    assert _dispersions.values(campaign.Plan.from_json(plan.to_json())) == _dispersions.values(plan)


# --- `stop` of Simulation.run


def test_a_condition_of_the_caller_is_asked_at_whole_steps(tmp_path):
    simulation = pong.Scene.load(scene_folder(tmp_path)).build()
    asked = []

    def stop(time, states):
        asked.append((time, states[0, 2]))
        return time > 0.0095

    run = simulation.run(stop=stop, stop_every=20, log=tmp_path / "log")
    # The step is 1e-4 s: called every 2 ms, first at the start.
    np.testing.assert_allclose([time for time, _ in asked], [0.0, 0.002, 0.004, 0.006, 0.008, 0.01], atol=1e-15)
    np.testing.assert_allclose([z for _, z in asked], [0.2 - 0.5 * 9.81 * t * t for t, _ in asked], rtol=1e-12)
    assert run.stopped and run.time[-1] == simulation.time and pong.Log(tmp_path / "log").is_whole
    assert not simulation.run(10, stop=lambda time, states: False).stopped


def test_a_condition_that_fails_or_calls_the_simulation(tmp_path):
    simulation = pong.Scene.load(scene_folder(tmp_path)).build()
    with pytest.raises(ZeroDivisionError):
        simulation.run(stop=lambda time, states: 1 / 0)
    with pytest.raises(pong.PhaseError):
        simulation.run(stop=lambda time, states: simulation.time)
    with pytest.raises(pong.BadValueError, match="stop_every: it is 0"):
        simulation.run(stop=lambda time, states: True, stop_every=0)
    with pytest.raises(TypeError):
        simulation.run(stop=3)
    assert simulation.run(10).stopped is False

"""Campaigns: values of runs, changing and failing workers, stored results, refusals, statistics."""

import itertools
import json
import math
import os
import signal
import sys
import threading
import time

import numpy as np
import pyarrow
import pyarrow.parquet
import pytest
from dask.distributed import Client, LocalCluster
from support import SCENE, scene_folder

import pong
from pong import campaign
from pong.campaign import _addresses, _criteria, _dispersions, _rigid, _run, plots

# A short drop: 100 steps, after which some balls have touched.
SHORT = SCENE.replace("duration: 0.3", "duration: 0.02").replace("step: 1e-4", "step: 2e-4").replace("0.0, 0.2)", "0.0, 0.101)")


@pytest.fixture(scope="module")
def cluster():
    with LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None) as made:
        yield made


def plan_of(folder, **changes):
    options = {
        "scene": scene_folder(folder, SHORT),
        "runs": 12,
        "seed": 7,
        "dispersions": [
            campaign.Uniform("ball.position.z", -0.002, 0.002),
            campaign.Normal("ball.velocity.x", 0.0, 0.1),
            campaign.Uniform("surface.ball.rubber.stiffness", 1e4, 3e4),
        ],
        "criteria": [campaign.Within("low", "ball", "ground", low=(-1, -1, 0), high=(1, 1, 0.1))],
    }
    return campaign.Plan(**options | changes)


def run(plan, folder, cluster, **options):
    return campaign.run(plan, folder, scheduler=cluster.scheduler_address, progress=False, **options)


# --- values of runs


def test_values_depend_on_seed_and_run_alone(tmp_path):
    numbers = plan_of(
        tmp_path,
        runs=np.int64(12),
        seed=np.array(7),
        duration=np.float32(0.5),
        dispersions=[campaign.Uniform("ball.position.z", np.float32(-0.5), np.int32(1))],
    )
    assert json.loads(json.dumps(numbers.to_json()))["dispersions"][0]["low"] == -0.5, "numbers of NumPy are Python's"
    few, many = plan_of(tmp_path), plan_of(tmp_path, runs=40)
    assert np.array_equal(_dispersions.values(many)[:12], _dispersions.values(few))
    assert not np.array_equal(_dispersions.values(plan_of(tmp_path, seed=8)), _dispersions.values(few))


def test_dispersions_have_the_distributions_that_they_name(tmp_path):
    for method in ("random", "latin_hypercube"):
        uniform, normal, _ = _dispersions.values(plan_of(tmp_path, runs=4000, method=method)).T
        assert uniform.min() > -0.002 and uniform.max() < 0.002
        # Kolmogorov's distance; a value above 1.95/√n has a probability of 0.1 %, and the seed is fixed.
        for values, cumulative in (
            (uniform, lambda x: (x + 0.002) / 0.004),
            (normal, lambda x: 0.5 * (1 + math.erf(x / 0.1 / math.sqrt(2)))),
        ):
            ordered = np.sort(values)
            expected = np.array([cumulative(x) for x in ordered])
            assert np.abs(expected - (np.arange(4000) + 0.5) / 4000).max() < 1.95 / math.sqrt(4000)


def test_a_latin_hypercube_has_one_value_in_each_share(tmp_path):
    uniform = _dispersions.values(plan_of(tmp_path, runs=50, method="latin_hypercube"))[:, 0]
    shares = np.floor((uniform + 0.002) / 0.004 * 50).astype(int)
    assert sorted(shares) == list(range(50)) and list(shares) != list(range(50))


def test_corners_are_all_combinations_of_ends(tmp_path):
    plan = plan_of(tmp_path, method="corners", runs=0)
    assert plan.runs == 8
    values = _dispersions.values(plan)
    np.testing.assert_allclose(values[:, 1], [-0.3, -0.3, 0.3, 0.3] * 2, rtol=1e-14)
    ends = itertools.product((-0.002, 0.002), (1e4, 3e4))
    assert {(z, k) for z, _, k in values} == set(ends)


def test_an_object_is_displaced_as_one_rigid_body():
    rng = np.random.default_rng(3)
    states = np.zeros((3, 13))
    states[:, :3], states[:, 7:] = rng.normal(size=(3, 3)), rng.normal(size=(3, 6))
    states[:, 3:7] = rng.normal(size=(3, 4))
    states[:, 3:7] /= np.linalg.norm(states[:, 3:7], axis=1, keepdims=True)
    change = {motion: rng.normal(size=3) for motion in _addresses.MOTIONS}
    pivot = rng.normal(size=3)
    out = _rigid.displaced(states, pivot, change)
    # Poses of the other groups relative to the root stay; the pivot moves by the displacement alone.
    for i in (1, 2):
        before, after = (_rigid.in_frame_of(array[0], array[i, :3] - array[0, :3]) for array in (states, out))
        np.testing.assert_allclose(after, before, atol=1e-12)
    at = states[0, :3] + _rigid.in_common(states[0], pivot)
    np.testing.assert_allclose(out[0, :3] + _rigid.in_common(out[0], pivot), at + change["position"], atol=1e-12)
    # A rotation vector of a quarter turn about z maps x to y.
    quarter = {**{motion: np.zeros(3) for motion in _addresses.MOTIONS}, "rotation": np.array([0, 0, math.pi / 2])}
    unit = np.zeros((1, 13))
    unit[0, 0], unit[0, 3] = 1.0, 1.0
    turned = _rigid.displaced(unit, np.array([-1.0, 0, 0]), quarter)[0]
    np.testing.assert_allclose(turned[:3], [0, 1, 0], atol=1e-15)
    np.testing.assert_allclose(_rigid.in_common(turned, np.array([1.0, 0, 0])), [0, 1, 0], atol=1e-15)
    # The addition is the velocity field of a rigid body about the pivot.
    arm = out[2, :3] - (at + change["position"])
    expected = states[2, 7:10] + change["velocity"] + np.cross(change["angular_velocity"], arm)
    np.testing.assert_allclose(out[2, 7:10], expected, atol=1e-12)


def test_a_criterion_holds_in_any_pose():
    rng = np.random.default_rng(4)
    criterion = {"body": "a", "of": "b", "low": (0.1, 0.1, 0.1), "high": (0.3, 0.3, 0.3), "speed": 0.1}
    for _ in range(20):
        q = rng.normal(size=4)
        other = np.concatenate([rng.normal(size=3), q / np.linalg.norm(q), rng.normal(size=6)])
        for place, inside in (((0.2, 0.2, 0.2), True), ((0.2, 0.35, 0.2), False), ((0.05, 0.2, 0.2), False)):
            arm = _rigid.in_common(other, np.array(place))
            own = other.copy()
            own[:3] += arm
            own[7:10] += np.cross(other[10:], arm)
            assert _criteria.met(criterion, ["a", "b"], np.array([own, other])) is inside
            own[7] += 0.2
            assert not _criteria.met(criterion, ["a", "b"], np.array([own, other]))


# --- runs on workers


def test_the_same_results_on_one_and_on_more_workers(tmp_path, cluster):
    plan = plan_of(tmp_path)
    one = run(plan, tmp_path / "one", cluster)
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as two:
        more = run(plan, tmp_path / "two", two, runs_per_task=3)
    assert one.num_rows == 12 and one.equals(more)
    # Run 5, computed from the scene alone.
    simulation = pong.Scene.load(plan.scene).build()
    z, vx, k = _dispersions.values(plan)[5]
    states = simulation.states()[:1]
    states[0, 2] += z
    states[0, 7] += vx
    simulation.set_states(states, ["ball"])
    simulation.set_surface("ball", "rubber", simulation.surface("ball", "rubber") | {"stiffness": k})
    alone = simulation.run()
    row = one.slice(5, 1).to_pylist()[0]
    assert row["run"] == 5 and row["ball.position.z"] == z
    assert row["peak_force.ball"] == alone.peak_force[0] and row["peak_depth.ball"] == alone.peak_depth[0]
    assert row["low"] == (0 <= alone.states[-1, 0, 2] <= 0.1)
    assert 0 < sum(one["low"].to_pylist()) < 12, "the criterion tells runs apart"


def test_a_killed_worker_loses_nothing(tmp_path):
    plan = plan_of(tmp_path, runs=30, duration=0.4)
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as made:
        with Client(made, set_as_default=False) as asked:
            victim = next(iter(asked.run(os.getpid).values()))
        killed = threading.Event()

        def kill():
            while len(list((tmp_path / "out" / "parts").glob("*.parquet"))) < 5:
                time.sleep(0.01)
            # Windows ends a process at once by whatever signal.
            os.kill(victim, getattr(signal, "SIGKILL", signal.SIGTERM))
            killed.set()

        killer = threading.Thread(target=kill)
        killer.start()
        disturbed = run(plan, tmp_path / "out", made)
        killer.join()
        calm = run(plan, tmp_path / "calm", made)
    assert killed.is_set() and disturbed.num_rows == 30 and not campaign.failures(tmp_path / "out")
    assert disturbed.equals(calm)


def test_a_campaign_that_was_stopped_goes_on(tmp_path, cluster, monkeypatch):
    plan = plan_of(tmp_path)
    whole = run(plan, tmp_path / "whole", cluster)
    add, added = campaign._store.Store.add, []

    def stops(self, rows):
        if len(added) == 4:
            raise KeyboardInterrupt
        added.append(rows[0]["run"])
        add(self, rows)

    monkeypatch.setattr(campaign._store.Store, "add", stops)
    with pytest.raises(KeyboardInterrupt):
        run(plan, tmp_path / "part", cluster)
    monkeypatch.setattr(campaign._store.Store, "add", lambda self, rows: (added.append(rows[0]["run"]), add(self, rows)))
    assert campaign.results(tmp_path / "part").num_rows == 4
    assert run(plan, tmp_path / "part", cluster).equals(whole)
    assert sorted(added) == list(range(12)), "no run was done twice"
    # A file that was incomplete at a power failure is ignored.
    (tmp_path / "part" / "parts" / "part-00000099.parquet.half").write_bytes(b"PAR1")
    assert run(plan, tmp_path / "part", cluster).equals(whole)
    assert not (tmp_path / "part" / "parts" / "part-00000099.parquet.half").exists()


def test_damaged_results_are_told_and_done_again(tmp_path, cluster, capsys):
    plan, out = plan_of(tmp_path), tmp_path / "out"
    whole = run(plan, out, cluster)
    assert whole.schema.metadata is None
    for number, content in ((2, b""), (5, (out / "parts" / "part-00000005.parquet").read_bytes()[:100])):
        part = out / "parts" / f"part-{number:08d}.parquet"
        part.write_bytes(content)
        refused(lambda: campaign.results(out), part.name, "cannot be read", "call run again")
        # Another plan is refused, and nothing is moved.
        refused(lambda: run(plan_of(tmp_path, seed=8), out, cluster), "the plan", "changed")
        assert part.read_bytes() == content
        assert run(plan, out, cluster).equals(whole)
        assert part.name in capsys.readouterr().err and (out / "damaged" / part.name).read_bytes() == content
    (out / "failures.jsonl").write_text('{"run": 3\n{"run": 99}\n')
    refused(lambda: campaign.failures(out), "line 1 of failures.jsonl", "take the line out")


def test_results_tell_their_campaign_when_its_file_is_lost(tmp_path, cluster):
    plan, out = plan_of(tmp_path), tmp_path / "out"
    whole = run(plan, out, cluster)
    head = out / "campaign.json"
    text = head.read_text()
    head.write_text("{")
    refused(lambda: run(plan, out, cluster), "cannot be read", "remove campaign.json and call run again")
    head.unlink()
    refused(lambda: run(plan_of(tmp_path, seed=8), out, cluster), "the plan changed", "another folder")
    (out / "parts" / "part-00000007.parquet").unlink()
    assert run(plan, out, cluster).equals(whole) and head.read_text() == text
    # Results without their campaign, as those of earlier versions.
    head.unlink()
    for part in (out / "parts").iterdir():
        pyarrow.parquet.write_table(pyarrow.parquet.read_table(part).replace_schema_metadata(None), part)
    refused(lambda: run(plan, out, cluster), "campaign.json is missing", "bring it back")


def test_a_full_disk_is_told_and_loses_nothing(tmp_path, cluster):
    """A limit on file sizes in this process, which refuses writes as a full disk does."""
    plan, out = plan_of(tmp_path), tmp_path / "out"
    whole = run(plan, out, cluster)
    store, good = campaign._store.Store(out), whole.to_pylist()[0]
    failed = {"run": 1, "error": "RunError", "message": "none" * 100}
    for number in (0, 1):
        (out / "parts" / f"part-{number:08d}.parquet").unlink()
    resource = pytest.importorskip("resource", reason="the system has no limits of a process")
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (100, before[1]))
    try:
        refused(lambda: store.add([good]), "part-00000000.parquet cannot be written", "call run again")
        refused(lambda: store.add([failed]), "failures.jsonl cannot be written", "call run again")
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert (out / "failures.jsonl").read_bytes() and not campaign.failures(out), "a cut line is none"
    store.add([failed])
    assert [row["run"] for row in campaign.failures(out)] == [1]
    (out / "failures.jsonl").unlink()
    assert run(plan, out, cluster).equals(whole)
    assert not list(out.rglob("*.half"))


def test_two_processes_cannot_run_one_campaign(tmp_path, cluster):
    plan = plan_of(tmp_path, runs=2)
    with campaign._store.Store(tmp_path / "out").locked():
        refused(lambda: run(plan, tmp_path / "out", cluster), "another process runs it", "another folder")
    assert run(plan, tmp_path / "out", cluster).num_rows == 2, "free again"


def test_runs_that_fail_are_kept_apart_and_can_be_repeated(tmp_path, cluster):
    """A negative stiffness, refused by the engine: half of these runs fail."""
    plan = plan_of(tmp_path, dispersions=[campaign.Uniform("surface.ball.rubber.stiffness", -1e4, 1.1e4)])
    table = run(plan, tmp_path / "out", cluster)
    failed = campaign.failures(tmp_path / "out")
    values = _dispersions.values(plan)[:, 0]
    assert [row["run"] for row in failed] == list(np.nonzero(values < 0)[0]) and 0 < len(failed) < 12
    assert table["run"].to_pylist() == list(np.nonzero(values > 0)[0])
    for row in failed:
        assert row["error"] == "BadValueError" and "stiffness" in row["message"]
        assert row["surface.ball.rubber.stiffness"] == values[row["run"]]
        assert campaign.repeat(tmp_path / "out", row["run"]) == row
    good = table.slice(0, 1).to_pylist()[0]
    assert campaign.repeat(tmp_path / "out", good["run"], log=tmp_path / "log") == good
    assert pong.Log(tmp_path / "log").is_whole
    told = campaign.summary(tmp_path / "out")
    assert (told.runs, told.finished, told.failed) == (12, len(table), len(failed))
    assert run(plan, tmp_path / "out", cluster).equals(table), "what failed is not tried for ever"


def test_a_worker_that_dies_of_a_run_is_a_failure_of_that_run(tmp_path, monkeypatch):
    plan = plan_of(tmp_path, runs=4)
    told = _run.killed(_run.checked(plan), 3, _dispersions.values(plan)[3], "worker 1 died")
    assert told["run"] == 3 and told["error"] == "KilledWorker" and "ball.position.z" in told


# --- refusals


def refused(call, *words):
    with pytest.raises(campaign.CampaignError) as caught:
        call()
    for word in words:
        assert word in str(caught.value), str(caught.value)


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux has /proc")
def test_a_scene_that_a_worker_cannot_read(tmp_path, cluster, monkeypatch):
    """A path that resolves differently on the worker, which is another process in another folder."""
    scene_folder(tmp_path, SHORT)
    plan = plan_of(tmp_path, scene="/proc/self/cwd/drop.ron")
    monkeypatch.chdir(tmp_path)
    refused(
        lambda: run(plan, tmp_path / "out", cluster),
        "scene `/proc/self/cwd/drop.ron`",
        "cannot be read on the worker",
        "put the scene and its models where every worker finds them",
    )
    assert campaign.results(tmp_path / "out").num_rows == 0


def test_a_scene_or_model_that_changed(tmp_path, cluster):
    plan = plan_of(tmp_path)
    run(plan, tmp_path / "out", cluster)
    model = tmp_path / "ball.ron"
    model.write_text(model.read_text().replace("radius: 0.1", "radius: 0.11"))
    refused(lambda: run(plan, tmp_path / "out", cluster), "the models changed since it began", "another folder")
    refused(lambda: campaign.repeat(tmp_path / "out", 0), "its models", "bring them back")
    scene = tmp_path / "drop.ron"
    scene.write_text(scene.read_text().replace("mass: 1.0", "mass: 2.0"))
    refused(lambda: campaign.repeat(tmp_path / "out", 0), "another than the one that the campaign began with")
    refused(lambda: run(plan_of(tmp_path, seed=9), tmp_path / "out", cluster), "the plan", "changed")


def test_plans_that_cannot_be_run(tmp_path, cluster):
    bad = campaign.Uniform("ball.position.z", 1.0, 0.0)
    refused(lambda: plan_of(tmp_path, dispersions=[bad, bad], runs=0), "the lower first", "given twice", "runs: it is 0")
    refused(lambda: plan_of(tmp_path, method="halton"), "halton", "latin_hypercube")
    refused(lambda: plan_of(tmp_path, seed=-1), "seed")
    for parameter, words in (
        ("bell.position.z", ("bell", "ball, ground")),
        ("ball.position", ("ball.position", "OBJECT.position.x")),
        ("surface.ball.rubber.hardness", ("hardness", "stiffness")),
        ("surface.ball.chalk.stiffness", ("chalk",)),
        # A misspelt name must not be taken for the stiffness of the normal law.
        ("surface.ball.rubber.fiction.stiffness", ("fiction", "surface.ring.steel.friction.mu")),
    ):
        plan = plan_of(tmp_path, dispersions=[campaign.Uniform(parameter, 0.0, 1.0)])
        refused(lambda: run(plan, tmp_path / "out", cluster), *words)
    criteria = [campaign.Within("low", "bell", "ground", low=(0,) * 3, high=(1,) * 3)]
    refused(lambda: run(plan_of(tmp_path, criteria=criteria), tmp_path / "out", cluster), "bell", "ball, ground")
    refused(lambda: run(plan_of(tmp_path, scene=tmp_path / "none.ron"), tmp_path / "out", cluster), "none.ron", "cannot be read")
    refused(lambda: plan_of(tmp_path, dispersions=["ball.position.z"]), "dispersions", "ball.position.z", "Uniform or Normal")
    refused(lambda: plan_of(tmp_path, dispersions=bad), "give a list")
    refused(lambda: plan_of(tmp_path, runs=2.5), "runs: it is 2.5")
    refused(lambda: plan_of(tmp_path, pivots={"ball": (0, 0)}), "pivot of `ball`", "three numbers")
    refused(lambda: campaign.Within("low", "ball", "ground", low=(0, 0), high=(1, 1, 1)), "criterion `low`, low", "three")
    refused(lambda: campaign.Within("low", "ball", "ground", low=(0, 0, 2), high=(1, 1, 1)), "along z", "lower end first")
    refused(lambda: run(plan_of(tmp_path), tmp_path / "out", cluster, runs_per_task=0), "runs_per_task: it is 0")
    refused(lambda: run(plan_of(tmp_path), tmp_path / "out", cluster, workers=-1), "workers: it is -1")
    assert not (tmp_path / "out").exists(), "nothing was begun"
    refused(lambda: campaign.results(tmp_path / "out"), "campaign.json", "name the folder of a campaign")


# --- statistics


def test_wilsons_interval_solves_its_equation():
    """The ends are the p at which the observed share is exactly z standard errors away."""
    z = 1.959963984540054
    for count, of in ((1, 10), (37, 50), (9950, 10000), (3, 7)):
        for p in campaign.wilson(count, of):
            assert abs(count / of - p) == pytest.approx(z * math.sqrt(p * (1 - p) / of), rel=1e-9)
    # For zero of n: z²/(n + z²).
    assert campaign.wilson(0, 100) == (0.0, pytest.approx(z * z / (100 + z * z), rel=1e-12))
    assert campaign.wilson(100, 100)[1] == 1.0
    refused(lambda: campaign.wilson(3, 2), "3 of 2")


def test_intervals_of_quantiles_hold_what_they_promise():
    """Coverage: for a known distribution, at least 95 of 100 intervals contain the quantile."""
    rng = np.random.default_rng(11)
    for share, runs in ((0.5, 40), (0.95, 200)):
        inside = 0
        for _ in range(500):
            low, high = campaign.quantile_interval(rng.exponential(size=runs), share)
            inside += low <= -math.log(1 - share) <= high
        # Three standard errors of 500 trials: 3 %.
        assert inside / 500 > 0.95 - 0.03, share


def test_ends_of_intervals_are_the_order_statistics_of_the_binomial():
    from math import comb

    of, share, miss = 93, 0.9, 0.025
    cumulative = np.cumsum([comb(of, k) * share**k * (1 - share) ** (of - k) for k in range(of + 1)])
    low, high = campaign.quantile_interval(np.arange(1.0, of + 1), share)
    # The l-th of the values in order is missed with P(X < l), the u-th with P(X ≥ u).
    assert cumulative[int(low) - 1] <= miss < cumulative[int(low)]
    assert 1 - cumulative[int(high) - 1] <= miss < 1 - cumulative[int(high) - 2]
    # 1 − 0.95ⁿ ≥ 0.975 from n = 72 on: with fewer runs nothing bounds the 95 % quantile from above.
    assert campaign.quantile_interval(np.arange(71.0), 0.95)[1] == math.inf
    assert campaign.quantile_interval(np.arange(72.0), 0.95)[1] == 71.0


def test_a_summary_and_its_pictures(tmp_path, cluster):
    plan = plan_of(tmp_path, runs=30)
    table = run(plan, tmp_path / "out", cluster, runs_per_task=10)
    told = campaign.summary(tmp_path / "out", quantiles=(0.5, 0.99), quantities=["peak_force.ball"])
    (low,) = told.proportions
    assert low.count == sum(table["low"].to_pylist()) and (low.low, low.high) == campaign.wilson(low.count, 30)
    median, last = told.quantiles
    forces = np.sort(table["peak_force.ball"].to_numpy())
    assert median.value == forces[14] and median.low <= median.value <= median.high
    assert last.high == math.inf and "too few runs" in str(told) and "30 of 30" in str(told)
    refused(lambda: campaign.summary(tmp_path / "out", quantities=["peak"]), "peak", "peak_force.ball")
    figure = plots.distribution(tmp_path / "out", "peak_force.ball")
    assert np.array_equal(np.sort(figure.axes[0].lines[0].get_xdata()), forces)
    figure = plots.envelope(tmp_path / "out", "ball.position.z", "ball.velocity.x", "low")
    met, missed = figure.axes[0].collections
    assert (len(met.get_offsets()), len(missed.get_offsets())) == (low.count, 30 - low.count)
    figure.savefig(tmp_path / "envelope.png")
    assert (tmp_path / "envelope.png").stat().st_size > 1000
    head = json.loads((tmp_path / "out" / "campaign.json").read_text())
    assert head["plan"]["seed"] == 7 and campaign.Plan.from_json(head["plan"]) == plan
    assert isinstance(table, pyarrow.Table)

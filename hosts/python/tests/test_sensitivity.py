"""Sensitivity indices and intervals in three parts: test functions with known indices, plans, closed forms, refusals."""

import json
import math

import numpy as np
import pytest
from dask.distributed import LocalCluster
from support import BALL, GROUND, SCENE, scene_folder

import pong
from pong import campaign
from pong.campaign import _alternatives, _dispersions, _interval, plots

# A ball of 1 kg falls 1 mm onto a spring and leaves it: the peak force is known.
DROP = (
    SCENE.replace("duration: 0.3", "duration: 0.05").replace("step: 1e-4", "step: 2e-4").replace("0.0, 0.2)", "0.0, 0.101)")
)


@pytest.fixture(scope="module")
def cluster():
    with LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None) as made:
        yield made


def refused(call, *words):
    with pytest.raises(campaign.CampaignError) as caught:
        call()
    for word in words:
        assert word in str(caught.value), str(caught.value)


# --- indices of functions


def ishigami(x):
    return np.sin(x[:, 0]) + 7.0 * np.sin(x[:, 1]) ** 2 + 0.1 * x[:, 2] ** 4 * np.sin(x[:, 0])


def ishigami_indices():
    """First-order and total indices in closed form (Ishigami and Homma 1990)."""
    by_0 = 0.5 * (1.0 + 0.1 * math.pi**4 / 5.0) ** 2
    by_1 = 7.0**2 / 8.0
    by_0_and_2 = 8.0 * 0.1**2 * math.pi**8 / 225.0
    whole = by_0 + by_1 + by_0_and_2
    return [(by_0 / whole, (by_0 + by_0_and_2) / whole), (by_1 / whole, by_1 / whole), (0.0, by_0_and_2 / whole)]


# Importance of the variables of the g-function: none is as important as one with 0.
G = np.array([0.0, 1.0, 4.5, 9.0, 99.0, 99.0])


def g_function(x):
    return np.prod((np.abs(4.0 * x - 2.0) + G) / (1.0 + G), axis=1)


def g_indices():
    """First-order and total indices in closed form (Saltelli and Sobol 1995)."""
    parts = 1.0 / (3.0 * (1.0 + G) ** 2)
    whole = np.prod(1.0 + parts) - 1.0
    return [(part / whole, part * np.prod(1.0 + np.delete(parts, i)) / whole) for i, part in enumerate(parts)]


FUNCTIONS = {
    "ishigami": (ishigami, ishigami_indices(), [campaign.Uniform(name, -math.pi, math.pi) for name in "abc"]),
    "g": (g_function, g_indices(), [campaign.Uniform(name, 0.0, 1.0) for name in "abcdef"]),
}


@pytest.mark.parametrize("name", FUNCTIONS)
def test_indices_of_known_functions_are_right_to_a_thousandth(name):
    function, exact, dispersions = FUNCTIONS[name]
    plan = {"samples": 2**15, "seed": 1}
    x = campaign.design(dispersions, **plan)
    assert x.shape == (2**15 * (len(dispersions) + 2), len(dispersions))
    found = campaign.indices_of(function(x), dispersions, **plan)
    for one, (first, total), dispersion in zip(found, exact, dispersions):
        assert one.parameter == dispersion.parameter
        assert abs(one.first - first) < 1e-3 and abs(one.total - total) < 1e-3, one
        assert one.first_low < first < one.first_high and one.total_low < total < one.total_high


def test_intervals_of_indices_cover():
    """A first-order index of a linear function, from few points: its interval holds the value in most of 60 designs."""
    dispersions = [campaign.Uniform("a", 0.0, 1.0), campaign.Normal("b", 0.0, 1.0)]
    # Variances 3 and 1: the indices are 3/4 and 1/4.
    held = 0
    for seed in range(60):
        plan = {"samples": 64, "seed": seed}
        x = campaign.design(dispersions, **plan)
        one = campaign.indices_of(6.0 * x[:, 0] + x[:, 1], dispersions, **plan)[0]
        held += one.first_low < 0.75 < one.first_high
    # Points of a Sobol sequence are spread more evenly than independent ones: their intervals are rather too wide.
    assert held >= 55


def test_effects_of_morris_are_those_of_a_linear_function():
    dispersions = [campaign.Uniform("a", 2.0, 4.0), campaign.Normal("b", 1.0, 0.5), campaign.Uniform("c", 0.0, 1.0)]
    plan = {"method": "morris", "samples": 12, "seed": 3}
    x = campaign.design(dispersions, **plan)
    assert x.shape == (12 * 4, 3) and set(np.round(x[:, 0], 12)) <= {2.0, 2.666666666667, 3.333333333333, 4.0}
    a, b, c = campaign.indices_of(5.0 * x[:, 0] - 4.0 * x[:, 1], dispersions, **plan)
    # A normal distribution counts as the uniform one of the same deviation: it is √12 deviations wide.
    for one, effect in ((a, 10.0), (b, -4.0 * 0.5 * math.sqrt(12.0)), (c, 0.0)):
        assert one.mean == pytest.approx(effect, abs=1e-12) and one.size == pytest.approx(abs(effect), abs=1e-12)
        assert one.deviation == pytest.approx(0.0, abs=1e-12) and one.size_high - one.size_low < 1e-9


def test_effects_of_morris_show_an_interaction():
    dispersions = [campaign.Uniform("a", 0.0, 1.0), campaign.Uniform("b", 0.0, 1.0)]
    plan = {"method": "morris", "samples": 2000, "seed": 1}
    x = campaign.design(dispersions, **plan)
    a, _ = campaign.indices_of(x[:, 0] * x[:, 1], dispersions, **plan)
    # The effect of one is the level of the other: 0, 1/3, 2/3 or 1, each as likely.
    assert a.size_low < 0.5 < a.size_high and abs(a.deviation - math.sqrt(5.0 / 36.0)) < 0.02


def test_blocks_with_a_failed_run_are_left_out():
    function, exact, dispersions = FUNCTIONS["ishigami"]
    plan = {"samples": 2**12, "seed": 1}
    y = function(campaign.design(dispersions, **plan))
    y[[7, 8, 3000]] = np.nan
    for one, (first, total) in zip(campaign.indices_of(y, dispersions, **plan), exact):
        assert abs(one.first - first) < 0.02 and abs(one.total - total) < 0.02
    y[: len(y) - 5] = np.nan
    refused(lambda: campaign.indices_of(y, dispersions, **plan), "1 of 4096 blocks", "look at the failures")


# --- indices of campaigns


def plan_of(folder, scene=DROP, **changes):
    options = {
        "scene": scene_folder(folder, scene),
        "seed": 2,
        "dispersions": [
            campaign.Uniform("ball.velocity.z", -0.5, -0.1),
            campaign.Uniform("ball.velocity.x", -0.01, 0.01),
        ],
    }
    return campaign.Plan(**options | changes)


def test_a_campaign_has_indices(tmp_path, cluster):
    plan = plan_of(tmp_path, method="sobol", samples=8)
    assert plan.runs == 32 and campaign.Plan.from_json(json.loads(json.dumps(plan.to_json()))) == plan
    table = campaign.run(plan, tmp_path / "out", scheduler=cluster.scheduler_address, progress=False)
    assert np.array_equal(np.column_stack([table[name] for name in plan.parameters]), _dispersions.values(plan))
    found = campaign.indices(tmp_path / "out", quantities=["peak_force.ball", "peak_force.ground", "contacts_at_start"])
    assert found.method == "sobol" and (found.runs, found.used) == (32, 32) and found.constant == ["contacts_at_start"]
    speed, slip = found.indices[:2]
    # The ball's speed is what makes its peak force; the sideways one adds a little friction.
    assert speed.parameter == "ball.velocity.z" and speed.total_low < 1.0 < speed.total_high
    assert slip.total < 1e-3
    assert "ball.velocity.z  alone" in str(found) and "contacts_at_start: the same in all runs" in str(found)
    refused(lambda: campaign.indices(tmp_path / "out", quantities=["weight"]), "no such column")
    axes = plots.indices(tmp_path / "out", "peak_force.ball").axes[0]
    assert [text.get_text() for text in axes.get_yticklabels()] == ["ball.velocity.z", "ball.velocity.x"]
    assert sorted(bar.get_width() for bar in axes.patches)[-1] == max(speed.total, speed.first)
    refused(lambda: plots.indices(tmp_path / "out", "contacts_at_start"), "the same in all runs")
    # A run that failed takes its block with it.
    (tmp_path / "out/parts/part-00000005.parquet").unlink()
    assert campaign.indices(tmp_path / "out").used == 28


def test_effects_of_a_campaign_are_in_newtons(tmp_path, cluster):
    plan = plan_of(tmp_path, method="morris", samples=4, seed=5)
    campaign.run(plan, tmp_path / "out", scheduler=cluster.scheduler_address, progress=False)
    speed = campaign.indices(tmp_path / "out", quantities=["peak_force.ball"]).indices[0]
    # A spring of 2e4 N/m and 1 kg after a fall of 1 mm: v·√(k·m) without damping, which takes some percent.
    slow, fast = (math.sqrt((v**2 + 2.0 * 9.81 * 1e-3) * 2e4) for v in (0.1, 0.5))
    assert speed.parameter == "ball.velocity.z" and speed.mean == pytest.approx(slow - fast, rel=0.2)


def test_designs_that_cannot_be_drawn(tmp_path):
    refused(lambda: plan_of(tmp_path, method="sobol"), "samples: it is 0", "power")
    refused(lambda: plan_of(tmp_path, method="sobol", samples=100), "samples: it is 100", "power")
    refused(lambda: plan_of(tmp_path, method="morris", samples=1), "at least 2 trajectories")
    refused(lambda: plan_of(tmp_path, method="sobol", samples=8, runs=30), "runs: they follow from samples")
    refused(lambda: plan_of(tmp_path, method="sobol", samples=2**23), "runs; give less")
    refused(lambda: plan_of(tmp_path, runs=10, samples=8), "the method `random` has none")
    refused(lambda: campaign.design([], samples=8), "there are none")
    refused(lambda: campaign.design([campaign.Uniform("a", 0, 1)], method="fast", samples=8), "no design `fast`")
    refused(lambda: campaign.indices_of([1.0], [campaign.Uniform("a", 0, 1)], samples=8), "one for each of the 24 rows")


def test_indices_need_a_plan_for_them(tmp_path, cluster):
    plan = plan_of(tmp_path, runs=2)
    assert "samples" not in plan.to_json() and "alternative" not in plan.to_json(), "as in earlier versions"
    campaign.run(plan, tmp_path / "out", scheduler=cluster.scheduler_address, progress=False)
    refused(lambda: campaign.indices(tmp_path / "out"), "its method is `random`", "`sobol` or `morris`")


# --- intervals of numbers


def test_tolerance_intervals_need_the_known_numbers_of_runs():
    """Two-sided tolerance intervals with 95 % of all values and 95 % confidence: 93, 153 and 208 values (Wilks 1942)."""
    for least, inner in ((93, 0), (153, 1), (208, 2)):
        values = np.arange(float(least))
        assert campaign.tolerance(values) == (inner, least - 1.0 - inner, 0.95)
        low, _, reached = campaign.tolerance(values[:-1])
        assert low == max(inner - 1, 0) and (reached == 0.95) == (inner > 0)
    assert campaign.tolerance(np.arange(92.0))[2] == pytest.approx(0.9495, abs=1e-4)


def test_tolerance_intervals_cover():
    rng = np.random.default_rng(1)
    held = 0
    for _ in range(400):
        low, high, _ = campaign.tolerance(rng.exponential(size=120))
        held += math.exp(-low) - math.exp(-high) >= 0.95
    assert held >= 0.95 * 400 - 3 * math.sqrt(400 * 0.05 * 0.95)


def test_three_parts_multiply():
    base = np.linspace(100.0, 200.0, 101)
    # First order: the error is halved with the step. At the step of the plan it is 8 %, of the finest 2 %.
    steps = [base[:20] * (1.04 / 1.08), base[:20] * (1.02 / 1.08)]
    found = campaign.three_parts("load", base, steps, {"soft": 0.9 * base[:20], "hard": 1.2 * base[:20]})
    assert (found.input.low, found.input.high, found.median) == (100.0, 200.0, 150.0)
    # What is left at the finest step is 0.02/1.02 of it, taken to both sides.
    assert found.numerical.low == pytest.approx(1.02 / 1.08 - 0.02 / 1.02) and found.numerical.high == pytest.approx(1.0 + 0.02 / 1.02)
    assert "order 1;" in found.numerical.basis and "1.96" not in found.model.basis
    assert (found.model.low, found.model.high) == (pytest.approx(0.9), pytest.approx(1.2))
    assert found.low == pytest.approx(100.0 * found.numerical.low * 0.9)
    assert found.high == pytest.approx(200.0 * found.numerical.high * 1.2)
    assert [one.name for one in found.model.variants] == ["soft", "hard"] and "+20 %" in str(found)
    page = found.markdown("N")
    assert page.count("\n") == 9 and "| – soft | -10 % | -10 % | 20 runs" in page and "| **together** |" in page


def test_runs_that_change_places_are_no_error():
    """Chance decides which of two runs is the hard one: the distribution is the same, and single runs tell it."""
    base = np.array([100.0, 200.0] * 10)
    found = campaign.three_parts("load", base, [base[::-1].copy()], {})
    assert (found.numerical.low, found.numerical.high) == (1.0, 1.0)
    assert found.numerical.variants[0].single in (0.5, 2.0)


def test_steps_that_do_not_converge_are_reported():
    base = np.linspace(100.0, 200.0, 20)
    found = campaign.three_parts("load", base, [base * 1.01, base * 1.05], {})
    assert "no convergence" in found.numerical.basis and found.numerical.high > 1.14


def test_values_without_a_load():
    base = np.array([0.0, 100.0, 110.0, 120.0, np.nan])
    found = campaign.three_parts("load", base, [base * 1.1], {})
    only = found.numerical.variants[0]
    assert (only.runs, only.left_out) == (4, 1) and only.high == pytest.approx(1.1)
    refused(lambda: campaign.three_parts("load", np.zeros(5), [np.zeros(5)], {}), "not above zero")
    refused(lambda: campaign.three_parts("load", np.ones(5), [np.full(5, np.nan)], {}), "no run came to its end in both")
    refused(lambda: campaign.tolerance([1.0]), "there are 1 values")


# --- intervals of scenes


def test_an_interval_has_the_runs_that_show_it(tmp_path, cluster):
    laws = campaign.OtherLaws("power_law", force=60.0, damping_exponent=1.0)
    smooth = campaign.OtherLaws("no_friction", friction="None")
    plan = plan_of(tmp_path, runs=12)
    options = {"alternatives": [laws, smooth], "pairs": 4, "scheduler": cluster.scheduler_address, "progress": False}
    found = campaign.interval(plan, "peak_force.ball", tmp_path / "out", **options)
    names = ["half_step", "no_friction", "plan", "power_law", "quarter_step"]
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == names
    rows = {name: campaign.results(tmp_path / "out" / name) for name in names}
    assert [rows[name].num_rows for name in names] == [4, 4, 12, 4, 4]
    peaks = rows["plan"]["peak_force.ball"].to_numpy()
    assert (found.input.low, found.input.high) == (peaks.min(), peaks.max())
    # The same inputs: the first runs of the plan.
    for name in names:
        assert rows[name]["ball.velocity.z"].to_pylist()[:4] == rows["plan"]["ball.velocity.z"].to_pylist()[:4]
    # Runge-Kutta at 0.2 ms: the peak of a bounce of 22 ms is right to a thousandth.
    assert 0.998 < found.numerical.low <= 1.0 <= found.numerical.high < 1.002
    assert found.model.variants[0].folder == str(tmp_path / "out/power_law")
    again = campaign.interval(plan, "peak_force.ball", tmp_path / "out", **options)
    assert again == found
    row = campaign.repeat(tmp_path / "out/power_law", 2)
    assert row == rows["power_law"].slice(2, 1).to_pylist()[0]


@pytest.mark.parametrize(("exponent", "damping_exponent"), [(1.0, 0.0), (1.0, 1.0), (1.0, 0.25), (1.5, 1.5), (1.5, 0.5)])
def test_other_laws_store_and_lose_the_same(tmp_path, exponent, damping_exponent):
    """A ball hits the ground so fast that the force becomes the one at which the laws agree."""
    speed, mass, stiffness, damping = 0.3, 1.0, 2e4, 2.0
    force = speed * math.sqrt(mass * stiffness)
    scene = scene_folder(tmp_path, DROP.replace("-9.81", "0.0").replace("step: 2e-4", "step: 1e-5"))
    (tmp_path / "ball.ron").write_text(BALL.replace("damping: 30", f"damping: {damping}"))

    def restitution(path):
        simulation = pong.Scene.load(path).build()
        states = simulation.states()[:1]
        states[0, 2], states[0, 9] = 0.1001, -speed
        simulation.set_states(states, ["ball"])
        done = simulation.run()
        return done.states[-1, 0, 9] / speed, done.peak_force[0]

    law = campaign.OtherLaws("law", force=force, exponent=exponent, damping_exponent=damping_exponent)
    path = _alternatives.written(scene, law, tmp_path / "law")
    (before, peak), (after, other) = restitution(scene), restitution(path)
    assert before == pytest.approx(math.exp(-0.5 * math.pi * damping / math.sqrt(mass * stiffness)), rel=1e-3)
    # To first order in the damping.
    assert 1.0 - after == pytest.approx(1.0 - before, rel=0.05)
    depth = speed * math.sqrt(mass / stiffness)
    assert peak == pytest.approx(force, rel=0.03)
    # The same energy at the same depth, so a force (p + 1)/2 times as large.
    assert other == pytest.approx(0.5 * (exponent + 1.0) * stiffness * depth, rel=0.03)


def test_other_friction_is_written(tmp_path):
    scene = scene_folder(tmp_path, DROP)
    path = _alternatives.written(scene, campaign.OtherLaws("c", friction="Coulomb", slip_speed=1e-3), tmp_path / "c")
    data = pong.model.read(tmp_path / "c/ball.ron")
    assert data["surfaces"]["rubber"]["friction"] == {"Coulomb": {"mu": 0.6, "slip_speed": 1e-3}}
    assert "Linear" in data["surfaces"]["rubber"]["normal"]
    pong.Scene.load(path).build()
    path = _alternatives.written(scene, campaign.OtherLaws("n", friction="None"), tmp_path / "n")
    assert pong.Scene.load(path).build().surface("ball", "rubber")["friction"] == {"law": "None"}


def test_alternatives_that_cannot_be_run(tmp_path, cluster):
    plan = plan_of(tmp_path, runs=4)
    law = campaign.OtherLaws("law", force=60.0)

    def interval(**changes):
        given = {"plan": plan, "alternatives": [law], "pairs": 2} | changes
        return lambda: campaign.interval(given.pop("plan"), "peak_force.ball", tmp_path / "out", progress=False, **given)

    refused(lambda: campaign.OtherLaws("a"), "it changes no law")
    refused(lambda: campaign.OtherLaws("a", force=-1.0), "force is -1.0")
    refused(lambda: campaign.OtherLaws("a", force=1.0, exponent=2.0), "exponent is 2.0; give 1.0 or 1.5")
    refused(lambda: campaign.OtherLaws("a", force=1.0, damping_exponent=1.2), "damping_exponent is 1.2")
    refused(lambda: campaign.OtherLaws("a", friction="Coulomb"), "slip_speed belongs to Coulomb")
    refused(interval(pairs=5), "pairs: it is 5", "1 to 4")
    refused(interval(halvings=3), "halvings: it is 3")
    refused(interval(alternatives=["law"]), "give an OtherLaws")
    refused(interval(alternatives=[law, law]), "its name is that of a folder, once")
    refused(interval(alternatives=[campaign.OtherLaws("half_step", force=1.0)]), "give another")
    refused(interval(plan=plan_of(tmp_path, runs=4, method="latin_hypercube")), "are not independent")
    stiff = [campaign.Uniform("surface.ball.rubber.stiffness", 1e4, 2e4)]
    refused(interval(plan=plan_of(tmp_path, runs=4, dispersions=stiff)), "its unit is another", "take it out")
    (tmp_path / "ball.ron").write_text(BALL.replace("Linear(damping: 30)", "HuntCrossley(dissipation: 0.1, exponent: 1.0)"))
    refused(interval(), "no surface of the scene", "leave it out")


def test_other_models_of_a_scene_are_alternatives(tmp_path, cluster):
    scene = scene_folder(tmp_path, DROP.replace("    ledger: true,", '    ledger: true,\n    alternatives: [(name: "soft", models: { "ball": "soft.ron" })],'))
    (tmp_path / "soft.ron").write_text(BALL.replace("stiffness: 2e4", "stiffness: 1e4"))
    (tmp_path / "other").mkdir()
    (tmp_path / "other/ball.ron").write_text(BALL.replace("stiffness: 2e4", "stiffness: 4e4"))
    (tmp_path / "other/ground.ron").write_text(GROUND)
    (tmp_path / "other/drop.ron").write_text(DROP)
    plan = campaign.Plan(scene=scene, runs=3, dispersions=[campaign.Uniform("ball.velocity.z", -0.5, -0.4)])
    alternatives = [campaign.OtherModels("soft"), campaign.OtherScene("hard", tmp_path / "other/drop.ron")]
    options = {"halvings": 0, "pairs": 2, "alternatives": alternatives, "scheduler": cluster.scheduler_address}
    found = campaign.interval(plan, "peak_force.ball", tmp_path / "out", progress=False, **options)
    soft, hard = found.model.variants
    # The peak force is as the root of the stiffness.
    assert soft.low == pytest.approx(math.sqrt(0.5), rel=0.05) and hard.high == pytest.approx(math.sqrt(2.0), rel=0.05)
    assert (found.model.low, found.model.high) == (soft.low, hard.high) and found.numerical.basis == "no finer step was run"


def test_factors_of_a_variant_are_those_of_its_ranks():
    one = _interval.variant("v", np.array([1.0, 2.0, 4.0, 8.0]), np.array([2.2, 1.0, 4.0]), {"v": "there"})
    assert (one.low, one.high, one.folder, one.runs) == (1.0, 1.1, "there", 3)
    assert (one.single, one.single_run) == (2.2, 0)

"""A few approaches of the example of docs/campaigns.md; `python hosts/python/examples/docking_envelope.py` runs all."""

import os
import pathlib
import re
import sys

import numpy as np

from pong import campaign
from pong.campaign import _case, _dispersions, _run

ROOT = pathlib.Path(os.environ["REPOSITORY"])
sys.path.insert(0, str(ROOT / "hosts/python/examples"))
import docking_envelope  # noqa: E402


def test_the_approach_of_the_scene_itself_is_captured():
    plan = docking_envelope.plan(1)
    row = _case.outcome(_run.checked(plan), 0, np.zeros(len(plan.dispersions)))
    assert row["captured"] and 300.0 < row["peak_force.target"] < 2000.0
    assert row["ended_by"] == "held" and row["time_at_end"] < 8.0 and row["contacts_at_start"] == 0
    # From half a metre aside it misses the target, which is recognised before the end.
    row = _case.outcome(_run.checked(plan), 0, np.array([0.5, 0.5, 0, 0, 0, 0, 0.0]))
    assert not row["captured"] and row["ended_by"] == "parted" and row["time_at_end"] < 16.0


def test_a_few_approaches(tmp_path):
    plan = docking_envelope.plan(4, duration=6.0)
    table = campaign.run(plan, tmp_path / "out", workers=1, progress=False)
    assert table.num_rows == 4 and not campaign.failures(tmp_path / "out")
    forces = table["peak_force.target"].to_numpy()
    assert (forces > 1.0).sum() >= 2 and len(set(forces)) == 4, "petals have met, each approach in its own way"
    assert campaign.summary(tmp_path / "out").proportions[0].of == 4
    lateral, tilt, roll = docking_envelope.offsets(table)
    assert lateral.max() <= 0.2 * 2**0.5 and tilt.max() <= 8 * 2**0.5 and roll.max() <= 8


def test_no_approach_begins_in_contact():
    """The first of them; of all 10,000 the campaign tells it. (Four corners of the plan would: petals meet tip to tip.)"""
    plan = docking_envelope.plan(300)
    job = _run.checked(plan)
    simulation = _case.build(job)
    start = simulation.states()
    for values in _dispersions.values(plan):
        simulation.set_states(start, simulation.bodies)
        _case.apply(simulation, job, values)
        assert simulation.run(0).contacts[0] == 0, values


def test_the_reference_has_the_same_approaches_with_the_scenes_own_integrator():
    training, reference = (docking_envelope.plan(9, reference=reference) for reference in (False, True))
    assert np.array_equal(_dispersions.values(training), _dispersions.values(reference))
    assert (reference.integrator, reference.step) == (None, None) and reference.stops == training.stops


def test_the_plan_of_the_page_can_be_run(monkeypatch):
    page = (ROOT / "docs/campaigns.md").read_text(encoding="utf-8")
    program = re.search(r"```python\n(.*?)```", page, re.S)[1]
    monkeypatch.chdir(ROOT)
    names = {}
    exec(program.split("if __name__")[0], names)
    assert _run.checked(names["plan"])["parameters"] == names["plan"].parameters
    for file in re.findall(r"hosts/python/\S+\.py", page):
        assert (ROOT / file).exists()

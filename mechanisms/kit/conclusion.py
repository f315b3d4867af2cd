"""Conclusions of a mechanism's campaign: probability, agreement with the prediction, quantiles, the worst case."""

import json
import math

import numpy as np
from kit.campaign import go_on
from kit.rows import Fact, Row

QUANTILES = (0.5, 0.95, 0.99)
TOLD = 20  # disagreements that are printed


def command(study, home, given):
    """Runs the command `mechanisms/run.py NAME --campaign DIR`; `home`: folder of the mechanism."""
    rows = go_on(study, given.campaign, given.runs, given.seed, given.workers)
    conclude(study, rows)
    worst = max(rows, key=lambda row: badness(study, row))
    print(f"worst: {said(study, worst)}")
    if given.keep:
        keep(study, worst, given.seed, home / "worst_case.json")


def conclude(study, rows):
    from pong.campaign import wilson

    count = int(sum(row["success"] for row in rows))
    low, high = wilson(count, len(rows))
    print(
        f"{len(rows)} runs, {count} {study.success}: {count / len(rows):.4f}, with 95 % confidence {low:.4f} to {high:.4f}"
    )
    flags = [sum(row[name] for row in rows) for name in ("tunnelled", "failed")]
    print(f"flagged as tunnelled: {flags[0]:.0f}; not computed: {flags[1]:.0f}")
    if study.predicts:
        agreement(study, rows)
    table(study, rows)


def agreement(study, rows):
    """Counts cases near the limit of the prediction separately."""
    rows = [row for row in rows if not row["failed"]]
    near = [row for row in rows if abs(row["margin"]) < study.band]
    clear = [row for row in rows if abs(row["margin"]) >= study.band]
    wrong = [row for row in clear if (row["margin"] > 0) != row["success"]]
    wrong_near = [row for row in near if (row["margin"] > 0) != row["success"]]
    expected = sum(row["margin"] > 0 for row in clear)
    print(f"beyond {study.band:g} of the limit: {len(clear)} runs, {expected} predicted to have {study.success};")
    print(f"   {len(clear) - len(wrong)} came out as predicted, {len(wrong)} did not")
    print(f"nearer to it: {len(near)} runs, {len(near) - len(wrong_near)} as predicted")
    for row in sorted(wrong, key=lambda row: -abs(row["margin"]))[:TOLD]:
        print(f"   not as predicted: {said(study, row)}")
    if wrong_near:
        print(f"   farthest from the limit among the nearer ones: {max(abs(row['margin']) for row in wrong_near):.4f}")


def table(study, rows):
    """Quantiles as a Markdown table; a dash for a bound that needs more runs."""
    from pong.campaign import quantile_interval

    print("| quantity |" + "".join(f" {share * 100:g} % |" for share in QUANTILES))
    print("|---|" + "---|" * len(QUANTILES))
    for name, (what, unit, factor) in study.quantities.items():
        values = np.array([row[name] for row in rows if not math.isnan(row[name])]) * factor
        cells = []
        for share in QUANTILES:
            # The value is an order statistic, as its bounds are, without interpolation between two runs.
            value = np.quantile(values, share, method="inverted_cdf")
            bounds = (f"{bound:.4g}" if math.isfinite(bound) else "–" for bound in quantile_interval(values, share))
            cells.append(f" {value:.4g} ({' to '.join(bounds)}) |")
        print(f"| {what}{', ' + unit if unit else ''} |" + "".join(cells))


def badness(study, row):
    if study.worst is not None:
        return study.worst(row)
    load = row[next(iter(study.quantities))]
    return (row["failed"], 1.0 - row["success"], 0.0 if math.isnan(load) else load)


def said(study, row):
    name, (what, unit, factor) = next(iter(study.quantities.items()))
    values = ", ".join(f"{key} {row[key]:.5g}" for key in study.dispersed)
    margin = f", margin {row['margin']:.4f}" if study.predicts else ""
    outcome = study.success if row["success"] else f"not {study.success}"
    return f"run {row['run']:.0f}, {outcome}{margin}, {what} {row[name] * factor:.5g} {unit}: {values}"


# --- the worst case, kept -------------------------------------------------------------------------------------------------


def keep(study, row, seed, path):
    came = {name: row[name] for name in ("success", *study.quantities) if not math.isnan(row[name])}
    found = {"run": int(row["run"]), "seed": seed, "values": {name: row[name] for name in study.dispersed}}
    path.write_text(json.dumps({**found, "came": came}, indent=1) + "\n", encoding="utf-8")


def again(study, home):
    """The stored case, run again: rows for the thorough checks of a mechanism."""
    kept = json.loads((home / "worst_case.json").read_text(encoding="utf-8"))
    came = study.attempt(kept["values"])
    yield Fact(
        f"worst case of the campaign, run {kept['run']}: the same outcome", came["success"] == kept["came"]["success"]
    )
    for name in sorted(kept["came"].keys() & study.quantities.keys()):
        what, unit, factor = study.quantities[name]
        # Other compilers may round differently, and an impact amplifies that.
        yield Row(f"its {what}", came[name] * factor, kept["came"][name] * factor, 1e-6, unit)

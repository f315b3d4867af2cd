"""Planar impacts of an ellipse: `python3 -m validation.planar_impacts --help` lists the options."""

import argparse
import json
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

from validation.kit import plots
from validation.kit.progress import Progress
from validation.kit.search import minimise
from validation.kit.statistics import interval, paired
from validation.kit.tables import markdown, versions
from validation.planar_impacts import data, jacobians, rigid
from validation.planar_impacts.with_pong import FRICTIONS, LAWS, Ellipse

FOUND = Path(__file__).with_name("found.json")
EVALUATIONS = 60


def arguments():
    parser = argparse.ArgumentParser(
        prog="python3 -m validation.planar_impacts",
        description="Impacts of an ellipse on a plane (MCube Lab, MIT): the sign of the published Jacobians, the published"
        f" predictions, rigid bodies, and Pong. The data set has no licence; get it from {data.ORIGIN}.",
    )
    parser.add_argument("folder", type=Path, help=f"folder with {' and '.join(data.FILES)}")
    parser.add_argument("--out", type=Path, metavar="DIR", help="writes tables.md and errors.svg there")
    parser.add_argument(
        "--identify", action="store_true", help=f"finds the parameters again and writes them to {FOUND.name}"
    )
    parser.add_argument(
        "--evaluations",
        type=int,
        default=EVALUATIONS,
        help="of --identify, for each law, beside those of earlier searches (%(default)s)",
    )
    parser.add_argument("--laws", help=f"only these laws, by comma: {', '.join(LAWS)}")
    return parser


def main():
    given = arguments().parse_args()
    chosen = laws(given)
    try:
        impacts, notes = data.load(given.folder)
    except data.DataError as error:
        sys.exit(f"error: {error}")
    for note in notes:
        print(f"note: {note}")
    if given.identify:
        return identify(impacts, chosen, given.evaluations)
    report(impacts, chosen, given.out)


def laws(given):
    """Laws of the normal force and of friction that are asked for."""
    chosen = given.laws.split(",") if given.laws else list(LAWS)
    for law in chosen:
        if law not in LAWS:
            sys.exit(f"error: {law}: there is no such law; there are {', '.join(LAWS)}")
    return [(law, kind) for law in chosen for kind in FRICTIONS]


def identify(impacts, chosen, evaluations):
    """Finds the parameters of each law on the training impacts; a law with known parameters goes on from them."""
    measured = jacobians.corrected(impacts).part(data.training(impacts))
    found = json.loads(FOUND.read_text()) if FOUND.exists() else {}
    for law, kind in chosen:
        engine, progress = Ellipse(law, kind), Progress(f"{law}, {kind}", evaluations)

        def error(values, engine=engine):
            engine.configure(values)
            return data.error(measured, engine.after(measured)).mean()

        known = found.get(engine.title, {"values": {}, "evaluations": 0})
        free = {name: replace(one, start=known["values"].get(name, one.start)) for name, one in engine.free.items()}
        result = minimise(error, free, evaluations, lambda values, error: progress.advance(f"{error:.4f}"))
        progress.close()
        values = {name: float(f"{value:.6g}") for name, value in result.values.items()}
        found[engine.title] = {
            "values": values,
            "error": round(result.error, 6),
            "evaluations": known["evaluations"] + result.evaluations,
            "at_bound": result.at_bound,
        }
        print(f"{engine.title}: {result.error:.4f} of {len(measured)} training impacts, {values}", flush=True)
        FOUND.write_text(json.dumps(found, indent=1, ensure_ascii=False) + "\n")


def signs(impacts):
    """Lines about the sign of the Jacobians."""
    found = jacobians.signs(impacts)
    yield "Δω = a·h·Δv_x + b·l·Δv_y, arms h and l of the published Jacobians; whatever the impulse is, a = b = 1/k²:"
    yield f"    a = {found.tangential.text(0)}, b = {found.normal.text(0)}, 1/k² = {found.expected:.0f} 1/m²; R² {found.explained:.2f}"
    opposite = found.tangential.high < 0 < found.normal.low
    yield "    the tangential Jacobian has the wrong sign" if opposite else "    both signs agree"


def grid(impacts):
    """Restitution and friction of the rigid model with the least error on the training impacts."""
    measured = impacts.part(data.training(impacts))
    pairs = [(e, mu) for e in np.arange(0.45, 0.725, 0.025) for mu in np.arange(0.05, 0.375, 0.025)]
    return min(pairs, key=lambda pair: data.error(measured, rigid.after(measured, *pair)).mean())


def report(impacts, chosen, out):
    """Prints the tables."""
    lines = [versions(("pong", "numpy")) + "\n"]

    def say(text):
        print(text, flush=True)
        lines.append(text + "\n")

    say("\n".join(signs(impacts)) + "\n")
    right, rows = jacobians.corrected(impacts), data.test(impacts)
    named = [(f"published: {name}", data.error(impacts, velocities)) for name, velocities in impacts.predicted.items()]
    for title, one in (("as published", impacts), ("sign corrected", right)):
        named.append((f"bound: the best impulse of each impact, {title}", data.error(one, jacobians.best_impulse(one))))
        e, mu = grid(one)
        named.append((f"rigid (Routh), e {e:.3g}, μ {mu:.3g}, {title}", data.error(one, rigid.after(one, e, mu))))
    named = [(name, errors[rows]) for name, errors in named]
    found = json.loads(FOUND.read_text())
    tested = right.part(rows)
    chosen = [(law, kind) for law, kind in chosen if Ellipse(law, kind).title in found]
    progress = Progress("Pong", len(chosen))
    for law, kind in chosen:
        engine = Ellipse(law, kind)
        engine.configure(found[engine.title]["values"])
        named.append((engine.title, data.error(tested, engine.after(tested))))
        progress.advance(engine.title)
    progress.close()
    reference = next((errors for name, errors in named if name.startswith("rigid") and name.endswith("corrected")))
    say(
        markdown(
            [f"model, {len(rows)} test impacts", "error", "less that of rigid bodies"],
            [[name, interval(errors).text(3), paired(errors, reference).text(3, sign=True)] for name, errors in named],
        )
    )
    say(
        markdown(
            ["law", "parameters", "at a bound"],
            [
                [
                    name,
                    ", ".join(f"{key} {value:.3g}" for key, value in one["values"].items()),
                    ", ".join(one["at_bound"]),
                ]
                for name, one in found.items()
            ],
        )
    )
    if out:
        out.mkdir(parents=True, exist_ok=True)
        (out / "tables.md").write_text("\n".join(lines))
        if not plots.intervals(
            out / "errors.svg",
            [("Impacts of an ellipse", [(name, interval(errors)) for name, errors in named])],
            "error, with 95 % interval",
        ):
            print("no plot: matplotlib is not installed")


if __name__ == "__main__":
    main()

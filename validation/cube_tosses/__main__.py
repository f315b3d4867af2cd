"""Cube tosses: `python3 -m validation.cube_tosses --help` lists the options."""

import argparse
import sys
import time
from pathlib import Path

import numpy as np

from validation.cube_tosses import data, facts, identify, protocol, study
from validation.cube_tosses.engines.engine import MissingEngine
from validation.cube_tosses.engines.table import ENGINES
from validation.kit import plots, rotation
from validation.kit.progress import Progress
from validation.kit.statistics import interval
from validation.kit.tables import markdown, versions


def arguments():
    parser = argparse.ArgumentParser(
        prog="python3 -m validation.cube_tosses",
        description="Four engines against 550 measured tosses of a cube: the published figures again, whole tosses, the first"
        " 0.15 s after the touch, and facts that need no law of contact. Without options: everything, in minutes.",
    )
    parser.add_argument(
        "--out", type=Path, metavar="DIR", help="writes tables.md, errors.svg and distributions.svg there"
    )
    parser.add_argument("--engines", help=f"only these, by comma: {', '.join(ENGINES)}")
    parser.add_argument("--tosses", type=int, metavar="N", help="only the first N test tosses: a smoke run")
    parser.add_argument(
        "--part", choices=["facts", "published", "whole", "touch", "steps", "noise"], action="append", help="only these parts"
    )
    parser.add_argument(
        "--identify",
        action="append",
        metavar="ENGINE/BODY/WINDOW",
        help=f"finds parameters again and writes them to {identify.FOUND.name}; bodies: {', '.join(identify.BODIES)}; windows: {', '.join(identify.WINDOWS)}",
    )
    parser.add_argument("--evaluations", type=int, default=identify.EVALUATIONS, help="of --identify (%(default)s)")
    parser.add_argument(
        "--data", type=Path, default=data.FILE, metavar="FILE", help="the tosses (those of the repository)"
    )
    return parser


def main():
    parser = arguments()
    given = parser.parse_args()
    chosen = given.engines.split(",") if given.engines else None
    unknown = sorted(set(chosen or ()) - set(ENGINES))
    if unknown:
        parser.error(f"{unknown[0]}: there is no such engine; there are {', '.join(ENGINES)}")
    if given.tosses is not None and given.tosses < 1:
        parser.error(f"--tosses {given.tosses}: at least one toss is needed")
    try:
        tosses = data.load(given.data)
        if given.identify:
            return find(tosses, given, parser)
        return report(tosses, given, chosen)
    except (data.DataError, MissingEngine) as error:
        sys.exit(f"error: {error}")


def find(tosses, given, parser):
    """Finds parameters, each search from what is known already."""
    for text in given.identify:
        parts = text.split("/")
        if (
            len(parts) != 3
            or parts[0] not in ENGINES
            or parts[1] not in identify.BODIES
            or parts[2] not in identify.WINDOWS
        ):
            parser.error(f"--identify {text}: give ENGINE/BODY/WINDOW, such as pong-linear/inertia/touch")
        progress = Progress(text, given.evaluations)
        entry = identify.identify(
            tosses,
            *parts,
            given.evaluations,
            identify.known(*parts),
            note=lambda values, error: progress.advance(f"e_q {error:.4f}"),
        )
        seconds = progress.close()
        identify.save([entry])
        values = ", ".join(
            f"{name} {value:.6g}"
            for name, value in {**entry.values, "inertia": entry.inertia, "corner radius": entry.corner_radius}.items()
        )
        bounds = f"; at a bound: {', '.join(entry.at_bound)}" if entry.at_bound else ""
        print(
            f"{text}: e_q {entry.error:.4f} of the training tosses after {entry.evaluations} evaluations, {seconds:.0f} s: {values}{bounds}",
            flush=True,
        )


def report(tosses, given, chosen):
    """Runs the parts and prints their tables."""
    began = time.monotonic()
    parts = given.part or ["facts", "published", "whole", "touch", "steps", "noise"]
    count = given.tosses or len(tosses)
    test = list(protocol.TEST)[:count]
    lines, groups, missing = [f"{versions()}\n"], [], set()

    def say(text):
        print(text, flush=True)
        lines.append(text + "\n")

    if "facts" in parts:
        say("## Facts without a law of contact\n")
        say("\n".join(f"* {line}" for line in facts.lines(tosses)))
        try:
            without, with_flag = facts.inertia_of_bullet()
            say(
                f"* inertia in pybullet: {1e3 * without:.3f} g·m² by `loadURDF` alone, {1e3 * with_flag:.3f} with URDF_USE_INERTIA_FROM_FILE; the file says 0.810\n"
            )
        except MissingEngine as error:
            missing.add(str(error))
    if "published" in parts:
        cases = protocol.whole_tosses(tosses, range(count))
        made = [
            one
            for one in study.published_runs()
            if not chosen or one[2]["engine"] in {name.split("-")[0] for name in chosen}
        ]
        results, absent, seconds = study.follow_all(made, cases, "published parameters")
        missing.update(absent)
        say(f"## Published parameters, {len(cases)} whole tosses, {seconds:.0f} s\n")
        say(
            markdown(
                ["engine", "e_q", "the authors' log"],
                [[one.title, interval(one.e_q).text(4), f"{one.entry['e_q']:.4f}"] for one in results],
            )
        )
    for part, title in (
        ("whole", "Whole tosses, the published protocol"),
        ("touch", "The first 0.15 s after the touch, corrected start"),
    ):
        if part in parts:
            cases = identify.WINDOWS[part](tosses, test)
            results, absent, seconds = study.follow_all(
                list(study.found(part, chosen)) + carried(part, chosen), cases, title
            )
            missing.update(absent)
            say(f"## {title}: {len(cases)} test tosses, {seconds:.0f} s\n")
            for text, of_body in study.by_body(results):
                say(f"### {text}\n")
                say(study.comparison(of_body))
                own = [one for one in of_body if one.entry.window == part]
                say(study.parameters(own) if own else "The parameters are those of the first 0.15 s.\n")
                groups.append((text if len(parts) == 1 else f"{title}: {text[0].lower()}{text[1:]}", of_body))
                if part == "whole":
                    say(
                        "same face at the end: "
                        + ", ".join(f"{one.title} {100 * one.same_face.mean():.0f} %" for one in of_body)
                        + "\n"
                    )
    if "steps" in parts:
        say("## Steps: distance from a run at 0.017 ms, the first 0.15 s, medians\n")
        say(steps(tosses, test))
    if "noise" in parts:
        say("## Noise of the start: Pong's linear law against itself, started a little off\n")
        say(noise(tosses, test))
    for text in sorted(missing):
        say(f"left out: {text}")
    print(f"{time.monotonic() - began:.0f} s")
    if given.out:
        write(given.out, lines, groups)


def carried(part, chosen):
    """Parameters of the first 0.15 s, used over whole tosses: with other bodies than the published one, and with it where an
    engine has none of whole tosses.
    """
    if part != "whole":
        return []
    own = {entry.engine for _, _, entry in study.found("whole", chosen)}
    return [one for one in study.found("touch", chosen) if one[2].body != "published" or one[2].engine not in own]


def reference_entry():
    """Parameters of Pong's linear law, with the inertia found."""
    return next(
        one for one in identify.load() if (one.engine, one.body, one.window) == ("pong-linear", "inertia", "touch")
    )


# Noise of a start: place (m), orientation (rad), velocity (m/s) and angular velocity (rad/s), standard deviations of one axis.
START_NOISE = (5e-4, np.radians(0.3), 0.01, 0.1)


def noise(tosses, test):
    """Table of the error that a perfect model would have, because starts are known with noise only."""
    random, engine, rows = np.random.default_rng(1), reference_entry().made(), []
    for title, window in (("first 0.15 s", "touch"), ("whole toss", "whole")):
        errors = []
        for case in identify.WINDOWS[window](tosses, test[:100]):
            poses, start = engine.poses(case), case.start.copy()
            place, turn, velocity, spin = (deviation * random.normal(size=3) for deviation in START_NOISE)
            start[data.POSITION] += place
            start[data.ORIENTATION] = rotation.product(rotation.of_rotation_vector(turn), start[data.ORIENTATION])
            start[data.VELOCITY] += velocity
            start[data.ANGULAR_VELOCITY] += spin
            off = engine.poses(protocol.Case(case.number, start, case.measured))
            errors.append(protocol.errors(protocol.Case(case.number, start, poses), off).e_q)
        rows.append([title, interval(np.array(errors)).text(4), f"{np.median(errors):.4f}"])
    return markdown(["window", "e_q", "median e_q"], rows)


def steps(tosses, test):
    """Table of the error that steps cause, of Pong's linear law."""
    entry = reference_entry()
    cases = protocol.after_touch(tosses, test[:100])
    reference = [entry.made(substeps=400).poses(case) for case in cases]
    rows = []
    for substeps in (2, 5, 10, 40):
        engine = entry.made(substeps=substeps)
        apart = [
            protocol.errors(protocol.Case(case.number, case.start, poses), engine.poses(case))
            for case, poses in zip(cases, reference)
        ]
        rows.append(
            [
                f"{1e3 * engine.step:.3f}",
                f"{100 * np.median([one.place for one in apart]):.2f}",
                f"{np.degrees(np.median([one.turn for one in apart])):.2f}",
            ]
        )
    return markdown(["step, ms", "place, % of the edge", "rotation, °"], rows)


def write(folder, lines, groups):
    """Writes the tables and, with matplotlib, the plots."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "tables.md").write_text("\n".join(lines))
    if groups:
        named = [(title, [(one.title, interval(one.e_q)) for one in results]) for title, results in groups]
        drawn = plots.intervals(folder / "errors.svg", named, "e_q, mean of the test tosses with 95 % interval")
        drawn = drawn and plots.distributions(
            folder / "distributions.svg", [(one.title, one.e_q) for one in groups[-1][1]], "e_q of a toss"
        )
        if not drawn:
            print("no plots: matplotlib is not installed")
    print(f"{folder}: {', '.join(sorted(path.name for path in folder.iterdir()))}")


if __name__ == "__main__":
    main()

"""Runs of engines over tosses, and the tables that come of them."""

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from validation.cube_tosses import identify, protocol
from validation.cube_tosses.engines.engine import MissingEngine
from validation.cube_tosses.engines.table import make
from validation.kit.progress import Progress
from validation.kit.statistics import interval, paired
from validation.kit.tables import markdown

PUBLISHED = Path(__file__).with_name("published.json")
BODY_TEXT = {
    "published": "Published body",
    "inertia": "Inertia found",
    "round": "Inertia found, round corners, table where the cubes rest",
}


@dataclass
class Result:
    """Errors of one engine over the same cases as all others of a table."""

    title: str
    entry: identify.Entry | None
    e_q: np.ndarray
    place: np.ndarray  # of the edge
    turn: np.ndarray  # rad
    same_face: np.ndarray
    peak: np.ndarray | None  # N


def run(title, engine, cases, entry=None, progress=None):
    """Follows all cases with an engine."""
    errors, faces, peaks = [], [], []
    for case in cases:
        poses = engine.poses(case)
        errors.append(protocol.errors(case, poses))
        faces.append(protocol.same_face(case, poses))
        peaks.append(engine.peak_force())
        if progress:
            progress.advance(title)
    return Result(
        title,
        entry,
        np.array([one.e_q for one in errors]),
        np.array([one.place for one in errors]),
        np.array([one.turn for one in errors]),
        np.array(faces),
        None if None in peaks else np.array(peaks),
    )


def follow_all(made, cases, heading):
    """Results of engines, given as (title, function that makes the engine, entry); missing engines are told and left out."""
    progress, results, missing = Progress(heading, len(made) * len(cases)), [], []
    for title, maker, entry in made:
        try:
            results.append(run(title, maker(), cases, entry, progress))
        except MissingEngine as error:
            missing.append(str(error))
    seconds = progress.close()
    return results, missing, seconds


def published_runs():
    """The published runs, and those engines of today that have their parameters, as (title, maker, run)."""
    for one in json.loads(PUBLISHED.read_text())["runs"]:
        for name in one["as"]:
            engine = make(name)

            def maker(engine=engine, values=one["values"]):
                engine.configure(values)
                return engine

            yield engine.title, maker, one


def found(window, chosen=None):
    """Engines with found parameters, as (title, maker, entry)."""
    for entry in identify.load():
        if entry.window == window and (not chosen or entry.engine in chosen):
            yield make(entry.engine).title, entry.made, entry


def by_body(results):
    """Results with the same body, as (text, results)."""
    for body, text in BODY_TEXT.items():
        of_body = [one for one in results if one.entry.body == body]
        if of_body:
            yield text, of_body


def comparison(results, reference=0):
    """Table of errors with intervals; differences are paired, against the result `reference`."""
    rows = []
    for number, one in enumerate(results):
        apart = "" if number == reference else paired(one.e_q, results[reference].e_q).text(4, sign=True)
        rows.append(
            [
                one.title,
                interval(one.e_q).text(4),
                f"{100 * one.place.mean():.2f}",
                f"{np.degrees(one.turn.mean()):.2f}",
                f"{np.median(one.e_q):.4f}",
                apart,
            ]
        )
    head = [
        "engine, law",
        "e_q",
        "place, % of the edge",
        "rotation, °",
        "median e_q",
        f"e_q less that of {results[reference].title}",
    ]
    return markdown(head, rows)


def parameters(results):
    """Table of the found parameters."""
    rows = []
    for one in results:
        entry = one.entry
        units = make(entry.engine).units
        values = ", ".join(
            f"{name} {value:.4g} {units[name].split(';')[0] if len(units[name]) < 12 else ''}".rstrip()
            for name, value in entry.values.items()
        )
        body = f"{entry.inertia:.6f}" + (
            f", r = {1e3 * entry.corner_radius:.1f} mm, table at {1e3 * entry.table:.2f} mm"
            if entry.corner_radius
            else ""
        )
        near = entry.within_error.get("stiffness", [])
        span = f"{near[0]:.3g} to {near[1]:.3g}" if near else ""
        force = entry.within_error.get("peak_force")
        peak = f"{force[0]:.0f} to {force[1]:.0f}" if force else ""
        rows.append([one.title, values, body, ", ".join(entry.at_bound), span, peak])
    return markdown(
        [
            "engine, law",
            "parameters",
            "inertia, kg·m²",
            "at a bound",
            "stiffnesses of the search within one standard error",
            "their median peak forces, N",
        ],
        rows,
    )

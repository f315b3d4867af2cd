"""Checks of loads cases: a changed number reaches what follows from it, and the loads of a bounce are those of a spring."""

import contextlib
import csv
import importlib.util
import io
import math
import multiprocessing
import pathlib
import sys
import tempfile
from dataclasses import dataclass
from types import SimpleNamespace

from kit import loads, parameters
from kit.rows import Fact, Limit, Row

DIMENSIONS = """from dataclasses import dataclass

@dataclass(frozen=True)
class Law:
    stiffness: float
    damping: float

MASS, INERTIA = 2.0, (1.0, 2.0, 3.0)
WEIGHT = 10.0 * MASS
SOFT = Law(100.0, 5.0)
HALF = SOFT.stiffness / 2
COUNT = 3
LENGTH = 0.5
"""
CASE = """[parameters]
MASS = 3
"SOFT.stiffness" = 300.0
INERTIA = [4, 5, 6.5]
[cases.fast]
speed = 0.12
"""


def rows(thrown, mass, stiffness):
    """`thrown(speed)`: a ball that touches a plane and moves into it, kg, N/m."""
    with tempfile.TemporaryDirectory() as folder:
        yield from constants(pathlib.Path(folder))
    with tempfile.TemporaryDirectory() as folder:
        yield from bounce(thrown, mass, stiffness, pathlib.Path(folder))


def constants(home):
    (home / "dimensions.py").write_text(DIMENSIONS, encoding="utf-8")
    (home / "build.py").write_text("import dimensions as d\nprint(d.LENGTH)\n", encoding="utf-8")
    (home / "case.toml").write_text(CASE, encoding="utf-8")
    before = sys.modules.get("dimensions"), dict(parameters._changed), parameters.installed()
    try:
        changed, cases = parameters.read(home / "case.toml")
        parameters.install(home, changed | parameters.settings(["COUNT=4"]))
        d = sys.modules["dimensions"]
        yield Fact("a changed constant, and one that follows from it", (d.MASS, d.WEIGHT) == (3.0, 30.0))
        yield Fact("a field of a constant, and what follows from it", (d.SOFT.stiffness, d.SOFT.damping, d.HALF) == (300.0, 5.0, 150.0))
        yield Fact("the others, and those of the command line", (d.INERTIA, d.COUNT, d.LENGTH) == ((4.0, 5.0, 6.5), 4, 0.5))
        with multiprocessing.get_context("spawn").Pool(1, parameters.again, parameters.installed()) as pool:
            yield Fact("a worker of a campaign has them, too", pool.apply(weight) == 30.0)
        yield Fact("cases of the file", cases == {"fast": {"speed": 0.12}})
        for wrong in ("MAS=3", "MASS='a'", "COUNT=1.5", "INERTIA=[1, 2]", "SOFT.mass=1", "LENGTH=0.6"):
            yield Fact(f"refused: {wrong}", _refused(wrong, home))
            parameters._changed.clear()
    finally:
        sys.modules.pop("dimensions", None)
        if before[0] is not None:
            sys.modules["dimensions"] = before[0]
        parameters._changed.clear()
        parameters._changed.update(before[1])
        parameters._installed[:] = before[2]


def weight():
    import dimensions

    return dimensions.WEIGHT


def bounce(thrown, mass, stiffness, folder):
    """A ball on a spring: the peak is v·√(k·m), a quarter of a period after touch."""

    @dataclass(frozen=True)
    class Case:
        speed: float = 0.5

    def run_case(case, watch):
        made = thrown(case.speed)
        watch(made, lambda: "bounce")
        made.run(0.05)

    def predicted(case):
        return {("ball", "force"): 0.0}

    mechanism = SimpleNamespace(Case=Case, LOADED=("ball",), run_case=run_case, predicted=predicted)
    found = loads.run(mechanism, {"slow": {"speed": 0.5}, "fast": {"speed": 1.0}}, folder)
    for wrong in ({"sped": 0.5}, {"level": "training"}):
        yield Fact(f"loads: a case is refused: {wrong}", _exits(loads.case_of, mechanism, "wrong", wrong))
    peaks = {(row[0], row[2]): dict(zip(loads.TABLE, row)) for row in found}
    rate, step = math.sqrt(stiffness / mass), 1e-3
    for name, speed in (("slow", 0.5), ("fast", 1.0)):
        one = peaks[name, "force"]
        yield Row(f"loads, {name}: peak force of a bounce", one["peak"], speed * mass * rate, 2e-3, "N")
        yield Limit(f"loads, {name}: time of the peak off by", abs(one["time"] - 0.5 * math.pi / rate), step, "s")
        yield Fact(f"loads, {name}: the contact", one["contact"] == "ball/ball/shell on ground/ground/floor")
    with open(folder / "fast.csv", newline="", encoding="utf-8") as file:
        history = list(csv.DictReader(file))
    greatest = max(float(row["force.ball"]) for row in history)
    yield Fact("loads: the history has the peak", greatest == peaks["fast", "force"]["peak"])
    end = (peaks["fast", "force"]["last"], peaks["fast", "force"]["predicted"])
    yield Fact("loads: nothing touches at the end, as predicted", end == (0.0, 0.0))
    yield Fact("loads: the plot is drawn where Matplotlib is", (folder / "fast.png").exists() == _has("matplotlib"))
    yield Fact("loads: the table is written", (folder / "loads.csv").exists())


def _has(module):
    return importlib.util.find_spec(module) is not None


def _refused(text, home):
    return _exits(lambda: parameters.install(home, parameters.settings([text])))


def _exits(function, *arguments):
    try:
        with contextlib.redirect_stderr(io.StringIO()):
            function(*arguments)
    except SystemExit:
        return True
    return False

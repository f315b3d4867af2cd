#!/usr/bin/env python3
"""Runs a mechanism and compares its outcome with predictions.

    python3 mechanisms/run.py NAME              the short checks
    python3 mechanisms/run.py NAME --thorough   all of them: minutes
    python3 mechanisms/run.py NAME --log DIR    a response log of the scene that the mechanism shows
    python3 mechanisms/run.py NAME --log DIR --drawn    with bodies that touch nothing, for viewers and films
    python3 mechanisms/run.py NAME --campaign DIR --runs 1000      dispersed runs; rows go to DIR, what is there stays
    python3 mechanisms/run.py NAME --loads DIR --case FILE         loads of the cases of a file (kit/loads.py)
    python3 mechanisms/run.py NAME --loads-check                   loads of a changed mechanism beside closed forms
    python3 mechanisms/run.py NAME --interface DIR                 linear interfaces of the mated joint, for structural models
    python3 mechanisms/run.py NAME --set CHASER_MASS=13e3 …        any of these with another number (kit/parameters.py)

`--interface` needs the program `pong` in the folder BUILD_DIR or in PATH. Needs mujoco, numpy, the wheel pong (docs/python.md) and the plugin (docs/mujoco.md): its file in the variable PLUGIN, or
the wheel pong_mujoco; for campaigns the wheel pong with [campaign] (docs/campaigns.md).
`bash ci/mechanisms NAME` installs and builds these. Exit code 1 if anything is off.
"""

import argparse
import os
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROWS_PER_SECOND = 50  # of a log


def main():
    names = sorted(path.parent.name for path in HERE.glob("*/outcome.py"))
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("name", choices=names)
    parser.add_argument("--thorough", action="store_true", help="all checks")
    parser.add_argument(
        "--log", type=pathlib.Path, metavar="DIR", help="writes a response log, and checks nothing else"
    )
    parser.add_argument("--drawn", action="store_true", help="the log shows bodies that touch nothing, too")
    parser.add_argument("--campaign", type=pathlib.Path, metavar="DIR", help="dispersed runs: checks nothing else")
    parser.add_argument("--runs", type=int, default=1000, help="of the campaign")
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", action="store_true", help="the worst case goes to worst_case.json of the mechanism")
    parser.add_argument("--case", type=pathlib.Path, metavar="FILE", help="loads-case file: parameters and cases")
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE", help="a constant of dimensions.py")
    parser.add_argument("--loads", type=pathlib.Path, metavar="DIR", help="loads of the cases: checks nothing else")
    parser.add_argument("--loads-check", action="store_true", help="loads beside closed forms: checks nothing else")
    parser.add_argument("--interface", type=pathlib.Path, metavar="DIR", help="linear interfaces: checks nothing else")
    given = parser.parse_args()
    sys.path[:0] = [str(HERE / given.name), str(HERE)]
    if given.loads_check:
        sys.exit(check_loads(given, parser))
    cases = take_parameters(given)
    if given.loads:
        sys.exit(run_loads(given, cases, parser))
    if given.campaign:
        sys.exit(run_campaign(given, parser))
    if given.interface:
        sys.exit(write_interfaces(given, parser))
    import outcome

    if given.log:
        if not hasattr(outcome, "shown"):
            parser.error(f"{given.name} has no scene to show: its outcome.py lacks the function `shown`")
        sys.exit(write_log(outcome, given))
    from kit.rows import show
    from kit.rules import Tally

    tally = Tally()
    off = sum(show(title, tally.watch(title, rows)) for title, rows in outcome.rows(given.thorough))
    mechanism = given.name != "kit"  # what they share has no rules to keep
    if mechanism:
        print("\n".join(tally.lines()))
    if given.thorough and mechanism and tally.missing():
        sys.exit(f"{given.name}: no check of {', '.join(tally.missing())}")
    if off:
        sys.exit(f"{given.name}: {off} of its checks do not hold")
    print(f"{given.name}: all checks hold")


def take_parameters(given):
    """Replaces constants as the loads-case file and the command line say, and returns the cases of the file."""
    from kit import parameters

    changed, cases = parameters.read(given.case)
    changed |= parameters.settings(given.set)
    if changed:
        parameters.install(HERE / given.name, changed)
    return cases


def run_loads(given, cases, parser):
    from kit import loads

    if not (HERE / given.name / "loads.py").exists():
        parser.error(f"{given.name} has no loads: it lacks the file loads.py")
    import loads as mechanism

    print("\n".join(loads.shown(loads.run(mechanism, cases, given.loads))))


def check_loads(given, parser):
    from kit import loads_check
    from kit.rows import show

    home = HERE / given.name
    if not (home / loads_check.FILE).exists():
        parser.error(f"{given.name} has no loads to check: it lacks the file {loads_check.FILE}")
    off = show(f"loads with changed numbers: {loads_check.FILE}", loads_check.rows(home))
    return f"{given.name}: {off} of its loads do not hold" if off else 0


def run_campaign(given, parser):
    home = HERE / given.name
    if not (home / "campaign.py").exists():
        parser.error(f"{given.name} has no campaign: it lacks the file campaign.py")
    import campaign
    from kit import conclusion

    conclusion.command(campaign.STUDY, home, given)


def write_log(outcome, given):
    """Runs the scene that the mechanism shows. The log's own contact world must give the same wrenches."""
    from kit.record import Recorder

    folder, drawn = given.log, getattr(outcome, "DRAWN", ()) if given.drawn else ()
    rows_per_second = getattr(outcome, "ROWS_PER_SECOND", ROWS_PER_SECOND)
    recorders = []

    def prepare(machine):
        every = round(1.0 / (rows_per_second * machine.step))
        recorders.append(Recorder(machine, folder, every, drawn))
        machine.watchers.append(recorders[0])

    outcome.shown(prepare)
    (recorder,) = recorders
    print(f"{folder}: {recorder.close()} rows; wrenches differ from the plugin's by {recorder.off:.1e} at most")
    return 0 if recorder.off <= 1e-9 else "the log does not show what the plugin computed"


def write_interfaces(given, parser):
    """Runs the mechanism until it holds, writes that state as a log, and its interfaces as cards and as CSV."""
    if not (HERE / given.name / "interface.py").exists():
        parser.error(f"{given.name} has no interface: it lacks the file interface.py")
    import interface
    from kit.record import Follower

    followers = []

    def prepare(machine):
        followers.append(Follower(machine))
        machine.watchers.append(followers[0])

    interface.held(prepare)
    state = given.interface / "state"
    followers[0].write(state)
    pong = pathlib.Path(os.environ.get("BUILD_DIR", "")) / "pong"
    for name, (of, on) in interface.SETS.items():
        for end in ("bdf", "csv"):
            out = given.interface / f"{name}.{end}"
            command = [pong if pong.exists() else "pong", "interface", state, "--of", of, "--on", on, "--out", out]
            shown = None if end == "bdf" else subprocess.DEVNULL
            subprocess.run(command, check=True, stdout=shown, stderr=shown)
    return 0


if __name__ == "__main__":
    main()

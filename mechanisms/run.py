#!/usr/bin/env python3
"""Runs a mechanism and holds what comes out against what is predicted.

    python3 mechanisms/run.py NAME              the short checks
    python3 mechanisms/run.py NAME --thorough   all of them: minutes

Needs mujoco, numpy and the plugin (docs/mujoco.md): its file in the variable PLUGIN, or the wheel pong_mujoco.
`bash ci/mechanisms NAME` installs and builds these. Exit code 1 if anything is off.
"""

import argparse
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent


def main():
    names = sorted(path.parent.name for path in HERE.glob("*/outcome.py"))
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("name", choices=names)
    parser.add_argument("--thorough", action="store_true", help="all checks")
    given = parser.parse_args()
    sys.path[:0] = [str(HERE / given.name), str(HERE)]
    import outcome
    from kit.rows import show

    off = sum(show(title, rows) for title, rows in outcome.rows(given.thorough))
    if off:
        sys.exit(f"{given.name}: {off} of its checks do not hold")
    print(f"{given.name}: all checks hold")


if __name__ == "__main__":
    main()

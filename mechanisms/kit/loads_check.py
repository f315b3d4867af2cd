"""Check of a mechanism's loads: its constants are replaced as loads_case.toml says, and the loads at the end are predicted.

A changed number must reach model, controller and closed form: then the loads agree with the closed forms of the changed
mechanism, and these differ from those of the unchanged one.
"""

import multiprocessing

from kit import loads, parameters
from kit.rows import Fact, Row

WITHIN = 0.01  # of a closed form, unless a mechanism says another `WITHIN`
MOVED = 0.02  # by how much of itself a closed form must have followed the changed numbers
FILE = "loads_case.toml"


def rows(home):
    """Rows of a mechanism in a folder. Nothing may have imported its `dimensions` before."""
    changed, cases = parameters.read(home / FILE)
    parameters.install(home, changed)
    import loads as mechanism

    case = loads.case_of(mechanism, mechanism.CHECKED, cases[mechanism.CHECKED])
    history = loads.history_of(mechanism, case)
    closed = loads.predicted(mechanism, case)
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        before = pool.apply(unchanged, (cases[mechanism.CHECKED],))
    names = ", ".join(changed)
    units, within = dict(loads.QUANTITIES), getattr(mechanism, "WITHIN", WITHIN)
    for (body, quantity), value in closed.items():
        yield Row(f"{quantity} on {body} at the end", history.last(body, quantity), value, within, units[quantity])
    followed = [key for key, value in closed.items() if abs(value - before[key]) > MOVED * abs(before[key])]
    yield Fact(f"closed forms follow {names}: {len(followed)} of {len(closed)}", bool(followed))
    yield from getattr(mechanism, "more_rows", tuple)()


def unchanged(fields):
    """Closed forms of the mechanism as its files have it, in a process of its own."""
    import loads as mechanism

    return loads.predicted(mechanism, loads.case_of(mechanism, mechanism.CHECKED, fields))

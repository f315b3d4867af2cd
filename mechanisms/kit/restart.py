"""Restart of a machine in the middle of a run, which must continue to the same bits."""

import copy


def same_bits(begin, control, before, after):
    """Runs for `before` s, then for `after` s, repeats the latter in another machine, and compares the bits of both ends.

    `begin()` makes a machine. All that `control` remembers must be saved by `copy.deepcopy`.
    """
    first = begin()
    first.run(before, control)
    middle, control_then = first.save(), copy.deepcopy(control)
    first.run(after, control)
    second = begin()
    second.restore(middle)
    second.run(after, control_then)
    return first.save().tobytes() == second.save().tobytes()

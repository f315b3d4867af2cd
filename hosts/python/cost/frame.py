"""Nanoseconds of a frame through Python: set states of two Objects, step, read wrenches. Compared with frame.c."""

import sys
import time

import numpy as np

import pong


def main(model_a, model_b, height, frames):
    builder = pong.WorldBuilder()
    for name, model in (("a", model_a), ("b", model_b)):
        builder.create_object(builder.add_model(model), name)
    builder.pair("a", "b")
    world = builder.seal()
    roots = [world.interface("a"), world.interface("b")]
    if len(world.interfaces) != 2:
        sys.exit("the models have movable groups; name two of one group each")
    assert roots == world.interfaces
    states, wrenches = np.zeros((2, 13)), np.zeros((2, 6))
    states[:, 3] = 1.0
    best = float("inf")
    for _ in range(10):
        begin = time.perf_counter_ns()
        for frame in range(frames):
            states[0, 2] = height + 1e-9 * (frame % 1000)
            world.set_states(states)
            world.step()
            world.wrenches(wrenches)
        best = min(best, (time.perf_counter_ns() - begin) / frames)
    print(f"{best:.0f} {wrenches[0, 2]:.17g}")


main(sys.argv[1], sys.argv[2], float(sys.argv[3]), int(sys.argv[4]))

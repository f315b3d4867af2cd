"""Time of a whole frame of Pong with one pair of solids, by the kinds of the two bodies.

    python3 solids_frames.py

`frame` is the shortest time of `World.evaluate()` over many calls, so that other programs count little: the call from
Python, relative motion, volume, cells, forces with friction, and wrenches. `cells` are contacts that push.
"""

import json
import pathlib
import time

import numpy as np
import solids_pong

CALLS = 5000
HALF, DEPTH = 0.1, 1e-4  # half edge of a box, overlap, m
TILT = (0.99, 0.08, 0.06, 0.0)  # so that a corner is lowest
SOFT = solids_pong.surface(1e7, "Linear(damping: 1000)", 0.5)


def unit(quaternion):
    return np.array(quaternion) / np.linalg.norm(quaternion)


def lowest(vertices, quaternion):
    """Height of the lowest of turned vertices above the origin of their frame, m."""
    w, vector = quaternion[0], np.array(quaternion[1:])
    turned = vertices + 2 * np.cross(vector, np.cross(vector, vertices) + w * np.array(vertices))
    return turned[:, 2].min()


def cases():
    """Name, both primitives, and position and quaternion of the first body."""
    cube, slab = solids_pong.box((HALF,) * 3), solids_pong.box((0.5, 0.5, HALF), (0, 0, -HALF))
    below = solids_pong.box((HALF,) * 3, (0, 0, -HALF))
    corners = np.array([(x, y, z) for x in (-HALF, HALF) for y in (-HALF, HALF) for z in (-HALF, HALF)])
    flat, tilted = (0.0, 0.0, HALF - DEPTH), unit(TILT)
    on_corner = (0.03, 0.02, -lowest(corners, tilted) - DEPTH)
    tube = solids_pong.mesh(*solids_pong.tube(0.5 * HALF, HALF, -HALF, HALF))
    peg = solids_pong.box((0.4 * HALF, 0.4 * HALF, HALF))
    yield "box, far from a box", cube, slab, (0.0, 0.0, 5.0), solids_pong.UNTURNED
    yield "box on a plane, flat", cube, solids_pong.plane(), flat, solids_pong.UNTURNED
    yield "box on a plane, corner", cube, solids_pong.plane(), on_corner, tilted
    yield "box on a larger box, flat", cube, slab, flat, solids_pong.UNTURNED
    yield "box on an equal box, flush", cube, below, flat, solids_pong.UNTURNED
    yield "box on a larger box, corner", cube, slab, on_corner, tilted
    yield "mesh (square tube) on a plane, flat", tube, solids_pong.plane(), flat, solids_pong.UNTURNED
    yield "mesh (square tube) on a box, flat", tube, slab, flat, solids_pong.UNTURNED
    yield "box in a square tube, along a wall", peg, tube, (0.1 * HALF + DEPTH, 0.0, HALF), solids_pong.UNTURNED
    data = json.loads((pathlib.Path(__file__).parent / "solids_pairs.json").read_text(encoding="utf-8"))
    for case in data["cases"]:
        if case["first"].startswith("hull") and case["overlap"]:
            shape = data["shapes"][case["first"]]
            hull = solids_pong.mesh(shape["vertices"], shape["triangles"])
            for pose in case["poses"]:
                yield case["name"], hull, hull, pose, None


def timed(first, second, pose, quaternion):
    """Shortest time of a frame, s, and number of cells."""
    pair = solids_pong.Pair(first, SOFT, second, SOFT)
    if quaternion is None:
        pair.world.set_states(position=[pose[:3], pose[7:10]], orientation=[unit(pose[3:7]), unit(pose[10:])])
        pair.world.evaluate()
        cells = int((pair.world.contacts()["weight"] > 0).sum())
    else:
        pair.wrench(pose, quaternion)
        cells = pair.faces
    pair.world.commit()
    evaluate, clock = pair.world.evaluate, time.perf_counter_ns
    best = min(-clock() + (evaluate(), clock())[1] for _ in range(CALLS))
    return best * 1e-9, cells


def main():
    rows = {}
    for name, *case in cases():
        rows.setdefault(name, []).append(timed(*case))
    print("| pair | frame, µs | cells |")
    print("|---|---|---|")
    for name, found in rows.items():
        seconds, cells = np.mean(found, axis=0)
        print(f"| {name} | {1e6 * seconds:.2f} | {cells:.1f} |")


if __name__ == "__main__":
    main()

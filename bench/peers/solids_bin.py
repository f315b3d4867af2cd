"""Wall time of a thousand boxes that fall into a bin and come to rest, in MuJoCo.

    python3 solids_bin.py [--boxes N] [--cone elliptic|pyramidal] [--solver Newton|CG|PGS] [--fall S] [--rest S]
        [--most S]

The time step is 2 ms. Boxes with edges of 0.1 m start in layers at random orientations above an open bin, whose floor
is 1.3 m wide. A row of the table is a tenth of a second of simulated time: wall time and processor time for each
simulated second (equal on a quiet machine), contacts, kinetic energy. The run has three phases: the fall, a time in
which the boxes come to rest, and the rest. It ends early after `--most` seconds of wall time. At its end a few more
steps are timed with each of MuJoCo's solvers, all from the state that the run reached.
"""

import argparse
import time

import mujoco
import numpy as np

STEP = 2e-3  # s
EDGE = 0.1  # of a box, m
DENSITY = 1000.0  # kg/m³
LAYER = 7  # boxes along a side of a layer
SPACING = 0.18  # of the boxes at the start: more than the diagonal of a box, m
FLOOR = 0.65  # half the width of the bin, m
WALL = 1.5  # half the height of its walls, m
SEED = 3
STEPS_OF_EACH_SOLVER = 10
SOLVERS = {
    "Newton": mujoco.mjtSolver.mjSOL_NEWTON,
    "CG": mujoco.mjtSolver.mjSOL_CG,
    "PGS": mujoco.mjtSolver.mjSOL_PGS,
}


def scene(boxes, cone, solver):
    """MJCF of a bin and boxes above it."""
    random = np.random.default_rng(SEED)
    half = EDGE / 2
    parts = [f'<geom type="box" size="{FLOOR} {FLOOR} 0.1" pos="0 0 -0.1"/>']
    for x, y in ((1, 0), (-1, 0), (0, 1), (0, -1)):
        size = (0.1, FLOOR + 0.2) if x else (FLOOR + 0.2, 0.1)
        at = FLOOR + 0.1
        parts.append(f'<geom type="box" size="{size[0]} {size[1]} {WALL}" pos="{x * at} {y * at} {WALL}"/>')
    for i in range(boxes):
        x, y, z = i % LAYER, i // LAYER % LAYER, i // LAYER**2
        place = ((x - (LAYER - 1) / 2) * SPACING, (y - (LAYER - 1) / 2) * SPACING, 0.12 + z * SPACING)
        quaternion = random.standard_normal(4)
        parts.append(
            f'<body pos="{place[0]} {place[1]} {place[2]}" quat="{" ".join(map(str, quaternion))}"><freejoint/>'
            f'<geom type="box" size="{half} {half} {half}" density="{DENSITY}"/></body>'
        )
    return (
        f'<mujoco><option timestep="{STEP}" cone="{cone}" solver="{solver}"/><size memory="2G"/>'
        f"<worldbody>{''.join(parts)}</worldbody></mujoco>"
    )


def kinetic_energy(model, data):
    """Kinetic energy of all boxes, J."""
    mujoco.mj_energyVel(model, data)
    return float(data.energy[1])


def timed_steps(model, data, steps):
    """Runs steps; returns wall time and processor time for each simulated second."""
    wall, processor = time.perf_counter(), time.process_time()
    for _ in range(steps):
        mujoco.mj_step(model, data)
    simulated = steps * STEP
    return (time.perf_counter() - wall) / simulated, (time.process_time() - processor) / simulated


def run(arguments):
    """Runs the phases and prints the table; returns wall and processor times per simulated second, by phase."""
    model = mujoco.MjModel.from_xml_string(scene(arguments.boxes, arguments.cone, arguments.solver))
    data = mujoco.MjData(model)
    print(
        f"mujoco {mujoco.__version__}, {arguments.boxes} boxes, {arguments.cone} cone, {arguments.solver},"
        f" step {STEP} s, one thread\n"
    )
    print("| from, s | phase | wall / processor s per simulated s | contacts | last iterations | energy, J |")
    print("|---|---|---|---|---|---|")
    steps = round(0.1 / STEP)
    times, spent = {}, 0.0
    while True:
        at = data.time
        phase = "fall" if at < arguments.fall - 1e-9 else "between" if at < arguments.rest - 1e-9 else "rest"
        if spent > arguments.most or at > arguments.rest + 0.3 - 1e-9:
            break
        wall, processor = timed_steps(model, data, steps)
        spent += wall * steps * STEP
        times.setdefault(phase, []).append((wall, processor))
        iterations = int(data.solver_niter.max())
        print(
            f"| {at:.1f} | {phase} | {wall:.2f} / {processor:.2f} | {data.ncon} | {iterations} |"
            f" {kinetic_energy(model, data):.3g} |",
            flush=True,
        )
    each_solver(model, data)
    return times


def each_solver(model, data):
    """Times a few steps of each solver from the state that the run reached."""
    state = np.zeros(mujoco.mj_stateSize(model, mujoco.mjtState.mjSTATE_INTEGRATION))
    mujoco.mj_getState(model, data, state, mujoco.mjtState.mjSTATE_INTEGRATION)
    print(f"\n{STEPS_OF_EACH_SOLVER} steps from {data.time:.1f} s on:")
    for name, solver in SOLVERS.items():
        mujoco.mj_setState(model, data, state, mujoco.mjtState.mjSTATE_INTEGRATION)
        model.opt.solver = solver
        wall, processor = timed_steps(model, data, STEPS_OF_EACH_SOLVER)
        iterations = int(data.solver_niter.max())
        print(
            f"{name}: {wall:.2f} s of wall time per simulated second ({processor:.2f} s of processor time),"
            f" {iterations} iterations",
            flush=True,
        )
    print()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--boxes", type=int, default=1000)
    parser.add_argument("--cone", choices=("pyramidal", "elliptic"), default="pyramidal")
    parser.add_argument("--solver", choices=SOLVERS, default="Newton")
    parser.add_argument("--fall", type=float, default=1.0, help="end of the fall, simulated s")
    parser.add_argument("--rest", type=float, default=3.0, help="start of the rest, simulated s")
    parser.add_argument("--most", type=float, default=900.0, help="most wall time, s")
    arguments = parser.parse_args()
    print()
    for phase, each in run(arguments).items():
        wall, processor = np.mean(each, axis=0)
        print(f"{phase}: {wall:.2f} s of wall time per simulated second ({processor:.2f} s of processor time)")


if __name__ == "__main__":
    main()

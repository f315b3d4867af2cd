"""Wall time of a thousand boxes that fall into a bin and come to rest, in Pong and in MuJoCo.

    python3 solids_bin.py --engine pong|mujoco [--boxes N] [--fall S] [--rest S] [--most S]
        [--step S] [--stiffness K] [--damping C] [--threads N]                              of Pong
        [--cone elliptic|pyramidal] [--solver Newton|CG|PGS]                                of MuJoCo

Boxes with edges of 0.1 m and 1 kg start in layers at random orientations above an open bin, whose floor is 1.3 m wide.
All friction coefficients are 1. A row of the table is a tenth of a second of simulated time: wall time and processor
time for each simulated second (equal on a quiet machine), contacts, kinetic energy, and how deep the contacts are. The
run has three phases: the fall, a time in which the boxes come to rest, and the rest. It ends early after `--most`
seconds of wall time. MuJoCo's step is 2 ms, its default; at the end of its run a few more steps are timed with each of
its solvers, all from the state that the run reached.
"""

import argparse
import pathlib
import tempfile
import time

import numpy as np

EDGE = 0.1  # of a box, m
DENSITY = 1000.0  # kg/m³
LAYER = 7  # boxes along a side of a layer
SPACING = 0.18  # of the boxes at the start: more than the diagonal of a box, m
FLOOR = 0.65  # half the width of the bin, m
WALL = 1.5  # half the height of its walls, m
FRICTION = 1.0  # MuJoCo's default
GRAVITY = 9.81  # m/s²
SEED = 3
STEPS_OF_EACH_SOLVER = 10


def starts(boxes):
    """Positions (m) and quaternions (w, x, y, z) of the boxes at the start."""
    random = np.random.default_rng(SEED)
    for i in range(boxes):
        x, y, z = i % LAYER, i // LAYER % LAYER, i // LAYER**2
        place = ((x - (LAYER - 1) / 2) * SPACING, (y - (LAYER - 1) / 2) * SPACING, 0.12 + z * SPACING)
        quaternion = random.standard_normal(4)
        yield place, (quaternion / np.linalg.norm(quaternion)).tolist()


def bin_parts():
    """Half edges and centres of the floor and the walls of the bin, m."""
    yield (FLOOR, FLOOR, 0.1), (0.0, 0.0, -0.1)
    at = FLOOR + 0.1
    for x, y in ((1, 0), (-1, 0), (0, 1), (0, -1)):
        size = (0.1, FLOOR + 0.2) if x else (FLOOR + 0.2, 0.1)
        yield (*size, WALL), (x * at, y * at, WALL)


def mean_and_most(depth):
    """Mean and largest of the depths of contacts, m."""
    return (float(depth.mean()), float(depth.max())) if len(depth) else (0.0, 0.0)


class PongBin:
    """The bin in Pong: its built-in executive runs a scene."""

    def __init__(self, arguments):
        import pong

        self.step_length, self.stiffness = arguments.step, arguments.stiffness
        self.title = (
            f"pong, {arguments.boxes} boxes, K {arguments.stiffness:g} N/m³ of each surface,"
            f" damping {arguments.damping:g} N·s/m per face, step {arguments.step} s,"
            f" {arguments.threads} thread{'s' * (arguments.threads > 1)}"
        )
        self.note = "pairs"
        with tempfile.TemporaryDirectory() as folder:
            self.write_models(pathlib.Path(folder), arguments)
            began = time.perf_counter()
            scene = pong.Scene.parse(self.scene(arguments), name="bin", folder=folder)
            self.simulation = scene.build(workers=arguments.threads - 1)
        self.title += f"; loaded in {time.perf_counter() - began:.1f} s"
        self.advice = [*self.simulation.warnings, *self.simulation.notes]

    @staticmethod
    def write_models(folder, arguments):
        import solids_pong

        law = f"Linear(damping: {arguments.damping!r})"
        surface = solids_pong.surface(arguments.stiffness, law, FRICTION, EDGE**2)
        box = solids_pong.model("box", surface, solids_pong.box((EDGE / 2,) * 3))
        parts = [solids_pong.box(half, center, f"part {i}") for i, (half, center) in enumerate(bin_parts())]
        (folder / "box.ron").write_text(box, encoding="utf-8")
        (folder / "bin.ron").write_text(solids_pong.model("bin", surface, *parts), encoding="utf-8")

    @staticmethod
    def scene(arguments):
        """A scene in which every box may touch every other one and the bin."""
        mass = DENSITY * EDGE**3
        inertia = ", ".join([repr(mass * EDGE**2 / 6)] * 3)
        objects = ['(name: "bin", model: "bin", bodies: [(motion: Fixed)])']
        objects += [
            f'(name: "{i}", model: "box", bodies: [(motion: Free, mass: {mass!r}, inertia: Diagonal({inertia}),'
            f" position: {place}, orientation: {tuple(quaternion)})])"
            for i, (place, quaternion) in enumerate(starts(arguments.boxes))
        ]
        names = ["bin", *range(arguments.boxes)]
        pairs = [f'("{a}", "{b}")' for i, a in enumerate(names) for b in names[i + 1 :]]
        return (
            f'(format: "pong-scene", version: 1, name: "bin", models: {{ "box": "box.ron", "bin": "bin.ron" }},'
            f" objects: [{', '.join(objects)}], pairs: [{', '.join(pairs)}], gravity: (0.0, 0.0, {-GRAVITY}),"
            f" integrator: SemiImplicitEuler, step: {arguments.step!r}, duration: 100.0)"
        )

    def steps(self, count):
        self.simulation.step(count)

    def facts(self):
        """Number of contacts, pairs that touch, kinetic energy (J), and mean and largest depth (m)."""
        contacts = self.simulation.contacts()
        pushing = contacts[contacts["weight"] > 0]
        states = self.simulation.states()[1:]
        mass = DENSITY * EDGE**3
        energy = 0.5 * mass * (states[:, 7:10] ** 2).sum() + mass * EDGE**2 / 12 * (states[:, 10:] ** 2).sum()
        depth = pushing["depth"]
        pairs = len(np.unique(pushing["pair"]))
        return len(pushing), pairs, float(energy), *mean_and_most(depth)

    def finish(self):
        pass


class MujocoBin:
    """The bin in MuJoCo."""

    def __init__(self, arguments):
        import mujoco

        self.engine, self.step_length = mujoco, 2e-3
        self.model = mujoco.MjModel.from_xml_string(self.scene(arguments))
        self.data = mujoco.MjData(self.model)
        self.title = (
            f"mujoco {mujoco.__version__}, {arguments.boxes} boxes, {arguments.cone} cone, {arguments.solver},"
            f" step {self.step_length} s, one thread"
        )
        self.note = "last iterations"
        self.advice = []

    def scene(self, arguments):
        """MJCF of the bin and the boxes above it."""
        half = EDGE / 2
        parts = [
            f'<geom type="box" size="{" ".join(map(str, size))}" pos="{" ".join(map(str, at))}"/>'
            for size, at in bin_parts()
        ]
        parts += [
            f'<body pos="{" ".join(map(str, place))}" quat="{" ".join(map(str, quaternion))}"><freejoint/>'
            f'<geom type="box" size="{half} {half} {half}" density="{DENSITY}"/></body>'
            for place, quaternion in starts(arguments.boxes)
        ]
        return (
            f'<mujoco><option timestep="{self.step_length}" cone="{arguments.cone}" solver="{arguments.solver}"/>'
            f'<size memory="2G"/><worldbody>{"".join(parts)}</worldbody></mujoco>'
        )

    def steps(self, count):
        for _ in range(count):
            self.engine.mj_step(self.model, self.data)

    def facts(self):
        """Number of contacts, iterations of the last step, kinetic energy (J), and mean and largest depth (m)."""
        self.engine.mj_energyVel(self.model, self.data)
        depth = np.maximum(0.0, -self.data.contact.dist)
        iterations = int(self.data.solver_niter.max())
        return self.data.ncon, iterations, float(self.data.energy[1]), *mean_and_most(depth)

    def finish(self):
        """Times a few steps of each solver from the state that the run reached."""
        part = self.engine.mjtState.mjSTATE_INTEGRATION
        state = np.zeros(self.engine.mj_stateSize(self.model, part))
        self.engine.mj_getState(self.model, self.data, state, part)
        print(f"\n{STEPS_OF_EACH_SOLVER} steps from {self.data.time:.1f} s on:")
        for name in ("Newton", "CG", "PGS"):
            self.engine.mj_setState(self.model, self.data, state, part)
            self.model.opt.solver = getattr(self.engine.mjtSolver, f"mjSOL_{name.upper()}")
            wall, processor = timed(self, STEPS_OF_EACH_SOLVER)
            iterations = int(self.data.solver_niter.max())
            print(
                f"{name}: {wall:.2f} s of wall time per simulated second ({processor:.2f} s of processor time),"
                f" {iterations} iterations",
                flush=True,
            )


def timed(engine, steps):
    """Runs steps; returns wall time and processor time for each simulated second."""
    wall, processor = time.perf_counter(), time.process_time()
    engine.steps(steps)
    simulated = steps * engine.step_length
    return (time.perf_counter() - wall) / simulated, (time.process_time() - processor) / simulated


def run(engine, arguments):
    """Runs the phases and prints the table; returns wall and processor times per simulated second, by phase."""
    print(engine.title, *engine.advice, sep="\n", end="\n\n")
    print(
        f"| from, s | phase | wall / processor s per simulated s | contacts | {engine.note} | energy, J |"
        " depth, mean / most, mm |"
    )
    print("|---|---|---|---|---|---|---|")
    steps = round(0.1 / engine.step_length)
    times, spent = {}, 0.0
    for row in range(round(10 * arguments.rest) + 3):
        at = row / 10
        phase = "fall" if at < arguments.fall else "between" if at < arguments.rest else "rest"
        if spent > arguments.most:
            break
        wall, processor = timed(engine, steps)
        spent += wall * steps * engine.step_length
        times.setdefault(phase, []).append((wall, processor))
        contacts, note, energy, mean, most = engine.facts()
        print(
            f"| {at:.1f} | {phase} | {wall:.2f} / {processor:.2f} | {contacts} | {note} | {energy:.3g} |"
            f" {1e3 * mean:.3f} / {1e3 * most:.2f} |",
            flush=True,
        )
    engine.finish()
    return times


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--engine", choices=("pong", "mujoco"), required=True)
    parser.add_argument("--boxes", type=int, default=1000)
    parser.add_argument("--fall", type=float, default=1.0, help="end of the fall, simulated s")
    parser.add_argument("--rest", type=float, default=3.0, help="start of the rest, simulated s")
    parser.add_argument("--most", type=float, default=900.0, help="most wall time, s")
    parser.add_argument("--step", type=float, default=1e-3, help="step of Pong, s")
    parser.add_argument("--stiffness", type=float, default=1.2e8, help="K of Pong's surfaces, N/m³")
    parser.add_argument("--damping", type=float, default=400.0, help="of a face in Pong, N·s/m")
    parser.add_argument("--threads", type=int, default=1, help="threads of Pong")
    parser.add_argument("--cone", choices=("pyramidal", "elliptic"), default="pyramidal")
    parser.add_argument("--solver", choices=("Newton", "CG", "PGS"), default="CG")
    arguments = parser.parse_args()
    engine = (PongBin if arguments.engine == "pong" else MujocoBin)(arguments)
    print()
    for phase, each in run(engine, arguments).items():
        wall, processor = np.mean(each, axis=0)
        print(f"{phase}: {wall:.2f} s of wall time per simulated second ({processor:.2f} s of processor time)")


if __name__ == "__main__":
    main()

"""Time of one pair of boxes or hulls in MuJoCo, Bullet and ODE, at the poses of solids_pairs.json.

    python3 solids_pairs.py [ROUNDS]

A scene holds every pair of a case many times, in random order. The table gives the processor time of one pair, and how
many of its poses have a contact. Engines that are not installed are left out and named.
"""

import ctypes
import importlib.metadata
import json
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
PAIRS = 1024  # in a scene
SPACING = 4.0  # between the pairs of a scene for Bullet, m
ROUNDS = 30
SEED = 7


class Unavailable(Exception):
    """An engine that is not installed, and why."""


def words(numbers):
    """Numbers as text for MJCF."""
    return " ".join(repr(float(x)) for x in np.ravel(numbers))


def time_of(action):
    """Processor time of a call in this thread, s."""
    start = time.thread_time_ns()
    action()
    return 1e-9 * (time.thread_time_ns() - start)


class MuJoCo:
    """`mj_collision` over explicit pairs of geoms: bounding spheres, then the function of the pair of types."""

    def __init__(self, name, as_mesh, flags=""):
        try:
            import mujoco
        except ImportError as error:
            raise Unavailable(f"{name}: {error} (pip install mujoco)") from error
        self.mujoco, self.name, self.as_mesh, self.flags = mujoco, name, as_mesh, flags

    def suits(self, shape):
        return self.as_mesh or "half" in shape

    def load(self, shape, poses):
        if self.as_mesh:
            asset, geom = f'<asset><mesh name="s" vertex="{words(shape["vertices"])}"/></asset>', 'type="mesh" mesh="s"'
        else:
            asset, geom = "", f'type="box" size="{words(shape["half"])}"'
        bodies, pairs = [], []
        for i, pose in enumerate(poses):
            for side, at in enumerate((pose[:7], pose[7:])):
                bodies.append(
                    f'<body mocap="true" pos="{words(at[:3])}" quat="{words(at[3:])}"><geom name="g{i}_{side}" {geom}'
                    ' contype="0" conaffinity="0"/></body>'
                )
            pairs.append(f'<pair geom1="g{i}_0" geom2="g{i}_1"/>')
        text = (
            f'<mujoco><option>{self.flags}</option><size memory="256M"/>{asset}<worldbody>{"".join(bodies)}'
            f"</worldbody><contact>{''.join(pairs)}</contact></mujoco>"
        )
        self.model = self.mujoco.MjModel.from_xml_string(text)
        self.data = self.mujoco.MjData(self.model)
        self.mujoco.mj_kinematics(self.model, self.data)

    def seconds(self):
        return time_of(lambda: self.mujoco.mj_collision(self.model, self.data))

    def contacts(self):
        """Number of contacts of each pair, and the depth of its deepest one, m."""
        contact = self.data.contact
        below = contact.dist < 0
        pair = contact.geom.min(axis=1)[below] // 2
        depths = np.zeros(PAIRS)
        np.maximum.at(depths, pair, -contact.dist[below])
        return np.bincount(pair, minlength=PAIRS), depths

    def close(self):
        del self.model, self.data


class Bullet:
    """`performCollisionDetection`: bounding boxes, broad phase and narrow phase, through Python."""

    name = "Bullet"

    def __init__(self):
        try:
            import pybullet
        except ImportError as error:
            raise Unavailable(f"Bullet: {error} (pip install pybullet)") from error
        self.bullet = pybullet

    def suits(self, shape):
        return True

    def load(self, shape, poses):
        b = self.bullet
        b.connect(b.DIRECT)
        if "half" in shape:
            made = b.createCollisionShape(b.GEOM_BOX, halfExtents=shape["half"])
        else:
            made = b.createCollisionShape(b.GEOM_MESH, vertices=shape["vertices"])
        side = int(np.ceil(len(poses) ** (1 / 3)))
        self.bodies = []
        for i, pose in enumerate(poses):
            cell = SPACING * np.array([i % side, i // side % side, i // side**2])
            for at in (pose[:7], pose[7:]):
                w, x, y, z = at[3:]
                self.bodies.append(b.createMultiBody(1, made, -1, np.add(at[:3], cell).tolist(), [x, y, z, w]))

    def seconds(self):
        return time_of(self.bullet.performCollisionDetection)

    def contacts(self):
        """Number of contacts of each pair, and the depth of its deepest one, m."""
        counts, depths = np.zeros(PAIRS, dtype=int), np.zeros(PAIRS)
        for i in range(PAIRS):
            points = self.bullet.getContactPoints(self.bodies[2 * i], self.bodies[2 * i + 1])
            found = [-point[8] for point in points if point[8] < 0]
            counts[i], depths[i] = len(found), max(found, default=0.0)
        return counts, depths

    def close(self):
        self.bullet.disconnect()


class Ode:
    """`dCollide`, with setting both poses."""

    name = "ODE"

    def __init__(self):
        self.folder = tempfile.TemporaryDirectory()
        made = pathlib.Path(self.folder.name) / "solids_ode.so"
        command = ["gcc", "-O2", "-shared", "-fPIC", "-o", str(made), str(HERE / "solids_ode.c"), "-lode"]
        built = subprocess.run(command, check=False, capture_output=True, text=True)
        if built.returncode:
            raise Unavailable("ODE: gcc finds no ode/ode.h or libode (apt-get install libode-dev)")
        self.library = ctypes.CDLL(str(made))
        self.library.collide.restype = ctypes.c_double

    def suits(self, shape):
        return True

    def load(self, shape, poses):
        self.poses = np.ascontiguousarray(poses, dtype=np.float64)
        self.found = np.zeros(len(poses), dtype=np.int32)
        if "half" in shape:
            self.library.boxes(pointer(2 * np.array(shape["half"])))
            return
        points, triangles = np.array(shape["vertices"]), np.array(shape["triangles"])
        a, b, c = (points[triangles[:, i]] for i in range(3))
        normals = np.cross(b - a, c - a)
        normals /= np.linalg.norm(normals, axis=1)[:, None]
        self.planes = np.column_stack([normals, (normals * a).sum(axis=1)]).copy()
        self.points = points.copy()
        self.polygons = np.column_stack([np.full(len(triangles), 3), triangles]).astype(np.uint32).copy()
        self.library.hulls(
            pointer(self.planes), len(self.planes), pointer(self.points), len(points), pointer(self.polygons)
        )

    def seconds(self):
        return self.library.collide(pointer(self.poses), len(self.poses), pointer(self.found))

    def contacts(self):
        """Number of contacts of each pair; depths are not read."""
        return self.found, np.full(PAIRS, np.nan)

    def close(self):
        pass


def pointer(array):
    return array.ctypes.data_as(ctypes.c_void_p)


def engines():
    """Engines that are installed."""
    ccd = '<flag multiccd="{}"/>'
    wanted = (
        lambda: MuJoCo("MuJoCo box", False),
        lambda: MuJoCo("MuJoCo mesh, one contact", True, ccd.format("disable")),
        lambda: MuJoCo("MuJoCo mesh, multiccd", True, ccd.format("enable")),
        Bullet,
        Ode,
    )
    for make in wanted:
        try:
            yield make()
        except Unavailable as error:
            print(error, file=sys.stderr)


def row(engine, shape, case, rounds, random):
    """One row of the table."""
    which = random.permutation(np.arange(PAIRS) % len(case["poses"]))
    poses = np.array(case["poses"])[which]
    engine.load(shape, poses)
    engine.seconds()
    times = [engine.seconds() / PAIRS for _ in range(rounds)]
    counts, depths = engine.contacts()
    engine.close()
    hits, poses_hit = counts > 0, np.zeros(len(case["poses"]), dtype=bool)
    poses_hit[which[hits]] = True
    per_hit = counts[hits].mean() if hits.any() else 0
    deepest = np.median(depths[hits]) if hits.any() else 0
    depth = "–" if not hits.any() or np.isnan(deepest) else f"{deepest:.3g}"
    expected = len(case["poses"]) if case["overlap"] else 0
    return (
        f"| {case['name']} | {engine.name} | {1e6 * min(times):.3g} / {1e6 * np.median(times):.3g} |"
        f" {poses_hit.sum()} of {len(case['poses'])}{'' if poses_hit.sum() == expected else ' (!)'} |"
        f" {per_hit:.2f} | {depth} |"
    )


def main():
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else ROUNDS
    known = json.loads((HERE / "solids_pairs.json").read_text(encoding="utf-8"))
    present = list(engines())
    versions = [f"{name} {importlib.metadata.version(name)}" for name in ("mujoco", "pybullet") if name in sys.modules]
    print(f"{', '.join(versions)}; {rounds} rounds of {PAIRS} pairs; (!): other hits than by construction\n")
    print("| pair | engine | µs per pair, shortest / middle | poses with contact | contacts per hit | depth, m |")
    print("|---|---|---|---|---|---|")
    for case in known["cases"]:
        shape = known["shapes"][case["first"]]
        for engine in present:
            if engine.suits(shape):
                print(row(engine, shape, case, rounds, np.random.default_rng(SEED)), flush=True)


if __name__ == "__main__":
    main()

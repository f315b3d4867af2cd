"""Solids of Pong and hydroelastic contact of Drake at the same poses: force against depth, stiffness against tilt, damping.

    python3 solids_drake.py

A compliant body of Drake has a pressure that rises linearly from 0 at its surface to the hydroelastic modulus E at its
middle. So a box with the least half edge h carries E/h per volume: K = E/h is its foundation modulus, N/m³. Against a
rigid body a flat face of area A at depth d has the force K·A·d, and a tilt of θ gives the moment K·I·θ with the
second moment of area I. The tables compare Drake, and Pong's solids with the same K, with these closed forms.
"""

import importlib.metadata
import math
import pathlib
import tempfile

import numpy as np
import solids_pong as pong
from pydrake.geometry import (
    AddCompliantHydroelasticProperties,
    AddContactMaterial,
    AddRigidHydroelasticProperties,
    Box,
    ConvertVolumeToSurfaceMesh,
    HalfSpace,
    Mesh,
    ProximityProperties,
    Sphere,
)
from pydrake.math import RigidTransform, RotationMatrix
from pydrake.multibody.math import SpatialVelocity
from pydrake.multibody.plant import AddMultibodyPlantSceneGraph, ContactModel, CoulombFriction
from pydrake.multibody.tree import SpatialInertia, UnitInertia
from pydrake.systems.framework import DiagramBuilder

MODULUS = 1e6  # hydroelastic modulus, Pa
DISSIPATION = 2.0  # of Hunt and Crossley, s/m
EDGE = 0.2  # of the block, m
RADIUS = 0.1  # of the ball, m
BALL_RESOLUTION = 0.01  # length of the edges of the ball's mesh, m
PEG, PEG_LENGTH = 0.1, 0.2  # edge and length of the peg, m
HOLE_DEPTH, CLEARANCE = 0.15, 1e-3  # depth of the hole; hole less peg, m
FOUNDATION = MODULUS / (EDGE / 2)  # of the block, N/m³
GROUND, BELOW = Box(1.0, 1.0, EDGE), RigidTransform([0, 0, -EDGE / 2])  # a flat body as thick as the block
SMOOTH = CoulombFriction(0.0, 0.0)


def properties(resolution=None):
    """Properties of a compliant body, or of a rigid one without `resolution`."""
    made = ProximityProperties()
    if resolution is None:
        AddRigidHydroelasticProperties(1.0, made)
        AddContactMaterial(dissipation=0.0, friction=SMOOTH, properties=made)
    else:
        AddCompliantHydroelasticProperties(resolution, MODULUS, made)
        AddContactMaterial(dissipation=DISSIPATION, friction=SMOOTH, properties=made)
    return made


class DrakePair:
    """A free body and a fixed one, without gravity or friction; the answer is the wrench on the free body."""

    def __init__(self, shape, made, ground, ground_made, ground_pose=RigidTransform()):
        builder = DiagramBuilder()
        self.plant, _ = AddMultibodyPlantSceneGraph(builder, time_step=0.0)
        self.plant.set_contact_model(ContactModel.kHydroelastic)
        inertia = SpatialInertia(1.0, np.zeros(3), UnitInertia(0.01, 0.01, 0.01))
        self.body = self.plant.AddRigidBody("body", inertia)
        self.geometry = self.plant.RegisterCollisionGeometry(self.body, RigidTransform(), shape, "body", made)
        world = self.plant.world_body()
        self.plant.RegisterCollisionGeometry(world, ground_pose, ground, "ground", ground_made)
        self.plant.Finalize()
        self.diagram = builder.Build()
        self.context = self.diagram.CreateDefaultContext()
        self.own = self.plant.GetMyMutableContextFromRoot(self.context)

    def wrench(self, place, rotation=RotationMatrix(), velocity=(0.0, 0.0, 0.0), about=None):
        """Force on the body and moment about a point (default: its origin), both in the world."""
        self.plant.SetFreeBodyPose(self.own, self.body, RigidTransform(rotation, place))
        moving = SpatialVelocity(w=np.zeros(3), v=np.array(velocity))
        self.plant.SetFreeBodySpatialVelocity(self.own, self.body, moving)
        results = self.plant.get_contact_results_output_port().Eval(self.own)
        about = np.array(place if about is None else about)
        force, moment = np.zeros(3), np.zeros(3)
        for i in range(results.num_hydroelastic_contacts()):
            info = results.hydroelastic_contact_info(i)
            surface, on_a = info.contact_surface(), info.F_Ac_W()
            sign = 1 if surface.id_M() == self.geometry else -1
            force += sign * on_a.translational()
            arm = surface.centroid() - about
            moment += sign * (on_a.rotational() + np.cross(arm, on_a.translational()))
        return force, moment

    def ball_surface(self):
        """Vertices (m) and triangles of the surface of the mesh that Drake made of the body."""
        query = self.plant.get_geometry_query_input_port().Eval(self.own)
        surface = ConvertVolumeToSurfaceMesh(query.inspector().maybe_get_hydroelastic_mesh(self.geometry))
        triangles = [[face.vertex(i) for i in range(3)] for face in surface.triangles()]
        return np.array(surface.vertices()), np.array(triangles)


class PongPair(pong.Pair):
    """That pair in Pong."""

    def wrench(self, place, rotation=RotationMatrix(), velocity=(0.0, 0.0, 0.0), about=None):
        return super().wrench(place, rotation.ToQuaternion().wxyz(), velocity, about)


def table(title, first, *columns):
    """Prints the heading of a table."""
    print(f"\n{title}\n\n| {' | '.join([first, *columns])} |\n|{'---|' * (len(columns) + 1)}")


def line(*values):
    print("| " + " | ".join(f"{v:.6g}" if isinstance(v, float) else str(v) for v in values) + " |")


def names_of(pairs, *quantities):
    """A column for each quantity of each engine."""
    return [f"{name}{quantity}" for name in pairs for quantity in quantities]


def block_on_ground(title, pairs, foundation):
    """Force against depth, and moment against tilt at one depth."""
    table(f"{title}: force over K·A·d, upright", "depth, m", "K·A·d, N", *names_of(pairs, ""))
    for depth in (1e-6, 1e-5, 1e-4, 1e-3, 1e-2):
        flat = foundation * EDGE**2 * depth
        line(depth, flat, *(pair.wrench([0, 0, EDGE / 2 - depth])[0][2] / flat for pair in pairs.values()))
    depth, second = 1e-3, EDGE**4 / 12
    table(
        f"{title}: tilt about the middle of the lower face, {depth} m deep; moment over K·I·θ, and lateral force",
        "θ, rad",
        "K·I·θ, N·m",
        *names_of(pairs, "", ", N"),
    )
    for angle in (1e-6, 1e-5, 1e-4, 1e-3, 5e-3):
        rotation = RotationMatrix.MakeYRotation(angle)
        pivot = np.array([0, 0, -depth])
        place = pivot + rotation @ np.array([0, 0, EDGE / 2])
        flat = foundation * second * angle
        values = []
        for pair in pairs.values():
            force, moment = pair.wrench(place, rotation, about=pivot)
            values += [-moment[1] / flat, float(force[0])]
        line(angle, flat, *values)


def block_damping(title, pairs):
    """Ratio of the force to that at rest, against the velocity."""
    table(
        f"{title}: damping, dissipation {DISSIPATION} s/m, 1e-3 m deep; force over that at rest",
        "velocity up, m/s",
        "1 − d·v",
        *names_of(pairs, ""),
    )
    place = [0, 0, EDGE / 2 - 1e-3]
    rest = {name: pair.wrench(place)[0][2] for name, pair in pairs.items()}
    for velocity in (-0.2, -0.1, 0.0, 0.1, 0.2, 0.6):
        ratios = (pair.wrench(place, velocity=(0, 0, velocity))[0][2] / rest[name] for name, pair in pairs.items())
        line(velocity, max(0.0, 1 - DISSIPATION * velocity), *ratios)


def flush_blocks(pairs):
    """Lateral force of equal compliant blocks, one on the other, against the lateral offset."""
    depth = 1e-3
    table(
        f"compliant block on an equal one, {depth} m deep: offset",
        "offset, m",
        *names_of(pairs, ": normal force, N", ": lateral force, N"),
    )
    for offset in (-1e-2, -1e-3, -1e-4, -1e-6, 0.0, 1e-6, 1e-4, 1e-3, 1e-2):
        values = []
        for pair in pairs.values():
            force, _ = pair.wrench([offset, 0, EDGE - depth])
            values += [force[2], float(force[0])]
        line(offset, *values)


def ball_on_block(pairs):
    """Force of a ball on a rigid flat body against depth, beside the integral of its linear pressure."""
    table("ball on a rigid block: force over the closed form of a round ball", "depth, m", "closed form, N", *pairs)
    for depth in (1e-5, 1e-4, 1e-3, 5e-3, 1e-2):
        low, high = RADIUS - depth, RADIUS
        closed = 2 * math.pi * MODULUS * ((high**2 - low**2) / 2 - (high**3 - low**3) / (3 * RADIUS))
        line(depth, closed, *(pair.wrench([0, 0, RADIUS - depth])[0][2] / closed for pair in pairs.values()))


def obj_text(vertices, faces):
    lines = [f"v {x} {y} {z}" for x, y, z in vertices] + [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in faces]
    return "\n".join(lines) + "\n"


def peg_in_hole(pairs):
    """Force against offset to one wall, and moment against tilt, of a peg whose lower end is in the hole."""
    insertion = 0.1
    foundation = MODULUS / (PEG / 2)
    middle = PEG_LENGTH / 2 - insertion
    table(
        f"peg in hole, {insertion} m inserted, clearance {CLEARANCE} m: offset to one wall; force over K·A·d, and moment"
        " about the middle of the contact",
        "depth, m",
        "K·A·d, N",
        *names_of(pairs, "", ", N·m"),
    )
    for depth in (1e-5, 1e-4, 1e-3):
        flat, values = foundation * PEG * insertion * depth, []
        for pair in pairs.values():
            force, moment = pair.wrench([CLEARANCE / 2 + depth, 0, middle], about=[0, 0, -insertion / 2])
            values += [-force[0] / flat, float(moment[1])]
        line(depth, flat, *values)
    table(
        "peg in hole: tilt about the middle of the insertion; moment over the closed form, and force",
        "θ, rad",
        "beyond the clearance at the ends, m",
        "closed form, N·m",
        *names_of(pairs, "", ", N"),
    )
    for angle in (0.009, 0.0101, 0.011, 0.012, 0.015):
        rotation = RotationMatrix.MakeYRotation(angle)
        pivot = np.array([0, 0, -insertion / 2])
        place = pivot + rotation @ np.array([0, 0, PEG_LENGTH / 2 - insertion / 2])
        # Each side: K·PEG·∫ s·(θ·s − c/2) ds over the lever s, from c/(2θ) to insertion/2; first order in θ.
        start, end = min(CLEARANCE / 2 / angle, insertion / 2), insertion / 2
        whole = (end**3 - start**3) / 3 * angle - CLEARANCE / 4 * (end**2 - start**2)
        closed = 2 * foundation * PEG * whole
        values = []
        for pair in pairs.values():
            force, moment = pair.wrench(place, rotation, about=pivot)
            values += [-moment[1] / closed if closed else float(moment[1]), float(np.linalg.norm(force))]
        line(angle, angle * end - CLEARANCE / 2, closed, *values)


def blocks():
    """Tables of the block."""
    block, rigid = Box(EDGE, EDGE, EDGE), properties()
    half = (EDGE / 2,) * 3
    own, soft, hard = pong.box(half), pong.surface(FOUNDATION, pong.hunt_crossley(DISSIPATION)), pong.surface()
    below = pong.box((0.5, 0.5, EDGE / 2), (0, 0, -EDGE / 2))
    on_rigid = {
        "Drake": DrakePair(block, properties(EDGE), HalfSpace(), rigid),
        "Pong, plane": PongPair(own, soft, pong.plane(), hard),
        "Pong, solid ground": PongPair(own, soft, below, hard),
    }
    block_on_ground("compliant block on a rigid ground", on_rigid, FOUNDATION)
    block_damping("compliant block on a rigid ground", on_rigid)
    on_soft = {
        "Drake": DrakePair(block, properties(EDGE), GROUND, properties(1.0), BELOW),
        "Pong, solid ground": PongPair(own, soft, below, soft),
    }
    block_on_ground("compliant block on a compliant ground of the same modulus", on_soft, FOUNDATION / 2)
    on_equal = {
        "Drake": DrakePair(block, properties(EDGE), block, properties(EDGE)),
        "Pong": PongPair(own, soft, own, soft),
    }
    flush_blocks(on_equal)


def ball():
    """Table of the ball: Drake's mesh, and the same facets in Pong."""
    rigid, soft = properties(), pong.surface(MODULUS / RADIUS)
    below = pong.box((0.5, 0.5, EDGE / 2), (0, 0, -EDGE / 2))
    drake = DrakePair(Sphere(RADIUS), properties(BALL_RESOLUTION), GROUND, rigid, BELOW)
    vertices, triangles = drake.ball_surface()
    pairs = {
        f"Drake, {len(triangles)} facets": drake,
        "Pong, the same facets": PongPair(pong.mesh(vertices, triangles), soft, below, pong.surface()),
    }
    ball_on_block(pairs)


def peg():
    """Tables of the peg."""
    vertices, faces = pong.tube((PEG + CLEARANCE) / 2, PEG, -HOLE_DEPTH, 0.0)
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "hole.obj"
        path.write_text(obj_text(vertices, faces), encoding="utf-8")
        drake = DrakePair(Box(PEG, PEG, PEG_LENGTH), properties(PEG), Mesh(str(path), 1.0), properties())
        own = pong.box((PEG / 2, PEG / 2, PEG_LENGTH / 2))
        soft = pong.surface(MODULUS / (PEG / 2), pong.hunt_crossley(DISSIPATION))
        peg_in_hole({"Drake": drake, "Pong": PongPair(own, soft, pong.mesh(vertices, faces), pong.surface())})


def main():
    version = importlib.metadata.version("drake")
    print(
        f"drake {version}, pong {importlib.metadata.version('pong')}; modulus {MODULUS:g} Pa, block {EDGE} m,"
        f" ball {RADIUS} m, peg {PEG} m"
    )
    blocks()
    ball()
    peg()


if __name__ == "__main__":
    main()

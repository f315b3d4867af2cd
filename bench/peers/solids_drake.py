"""Hydroelastic contact of Drake at given poses: normal force against depth, stiffness against tilt, and damping.

    python3 solids_drake.py

A compliant body of Drake has a pressure that rises linearly from 0 at its surface to the hydroelastic modulus E at its
middle. So a box with the least half edge h carries E/h per volume: K = E/h is its foundation modulus, N/m³. Against a
rigid body a flat face of area A at depth d has the force K·A·d, and a tilt of θ gives the moment K·I·θ with the
second moment of area I. The tables compare Drake with these closed forms.
"""

import importlib.metadata
import math
import pathlib
import tempfile

import numpy as np
from pydrake.geometry import (
    AddCompliantHydroelasticProperties,
    AddContactMaterial,
    AddRigidHydroelasticProperties,
    Box,
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


class Pair:
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
        self.faces = sum(
            results.hydroelastic_contact_info(i).contact_surface().num_faces()
            for i in range(results.num_hydroelastic_contacts())
        )
        return force, moment


def heading(title, *columns):
    print(f"\n{title}\n\n| {' | '.join(columns)} |\n|{'---|' * len(columns)}")


def line(*values):
    print("| " + " | ".join(f"{v:.6g}" if isinstance(v, float) else str(v) for v in values) + " |")


def block_on_ground(name, pair, foundation):
    """Force against depth, and moment against tilt at one depth."""
    heading(f"{name}: force against depth, upright", "depth, m", "force, N", "K·A·d, N", "ratio", "polygons")
    for depth in (1e-6, 1e-5, 1e-4, 1e-3, 1e-2):
        force, _ = pair.wrench([0, 0, EDGE / 2 - depth])
        flat = foundation * EDGE**2 * depth
        line(depth, force[2], flat, force[2] / flat, pair.faces)
    depth, second = 1e-3, EDGE**4 / 12
    heading(
        f"{name}: tilt about the middle of the lower face, {depth} m deep",
        "θ, rad",
        "force, N",
        "moment, N·m",
        "K·I·θ, N·m",
        "ratio",
        "lateral force, N",
    )
    for angle in (1e-6, 1e-5, 1e-4, 1e-3, 5e-3):
        rotation = RotationMatrix.MakeYRotation(angle)
        pivot = np.array([0, 0, -depth])
        place = pivot + rotation @ np.array([0, 0, EDGE / 2])
        force, moment = pair.wrench(place, rotation, about=pivot)
        flat = -foundation * second * angle
        line(angle, force[2], moment[1], flat, moment[1] / flat, float(force[0]))


def block_damping(name, pair):
    """Ratio of the force to that at rest, against the velocity."""
    heading(
        f"{name}: damping, dissipation {DISSIPATION} s/m, 1e-3 m deep",
        "velocity up, m/s",
        "force, N",
        "over that at rest",
        "1 − d·v",
    )
    place = [0, 0, EDGE / 2 - 1e-3]
    rest = pair.wrench(place)[0][2]
    for velocity in (-0.2, -0.1, 0.0, 0.1, 0.2, 0.6):
        force = pair.wrench(place, velocity=(0, 0, velocity))[0][2]
        line(velocity, force, force / rest, max(0.0, 1 - DISSIPATION * velocity))


def ball_on_block(pair):
    """Force of a ball on a rigid flat body against depth, beside the integral of its linear pressure."""
    heading("ball on a rigid block: force against depth", "depth, m", "force, N", "closed form, N", "ratio", "polygons")
    for depth in (1e-5, 1e-4, 1e-3, 5e-3, 1e-2):
        force, _ = pair.wrench([0, 0, RADIUS - depth])
        low, high = RADIUS - depth, RADIUS
        closed = 2 * math.pi * MODULUS * ((high**2 - low**2) / 2 - (high**3 - low**3) / (3 * RADIUS))
        line(depth, force[2], closed, force[2] / closed, pair.faces)


def hole_text():
    """OBJ of a square hole in a block, open above and below, as one closed mesh."""
    inner, outer = (PEG + CLEARANCE) / 2, PEG
    vertices = [
        (x * half, y * half, z)
        for z in (-HOLE_DEPTH, 0.0)
        for half in (inner, outer)
        for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))
    ]
    faces = []
    for i in range(4):
        j = (i + 1) % 4
        low_in, low_out, up_in, up_out = (lambda k, base=base: base + k for base in (0, 4, 8, 12))
        faces += [(low_in(j), low_in(i), up_in(i)), (low_in(j), up_in(i), up_in(j))]
        faces += [(low_out(i), low_out(j), up_out(j)), (low_out(i), up_out(j), up_out(i))]
        faces += [(up_in(i), up_out(i), up_out(j)), (up_in(i), up_out(j), up_in(j))]
        faces += [(low_in(j), low_out(j), low_out(i)), (low_in(j), low_out(i), low_in(i))]
    lines = [f"v {x} {y} {z}" for x, y, z in vertices] + [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in faces]
    return "\n".join(lines) + "\n"


def peg_in_hole(pair):
    """Force against offset to one wall, and moment against tilt, of a peg whose lower end is in the hole."""
    insertion = 0.1
    foundation = MODULUS / (PEG / 2)
    middle = PEG_LENGTH / 2 - insertion
    heading(
        f"peg in hole, {insertion} m inserted, clearance {CLEARANCE} m: offset to one wall",
        "depth, m",
        "force, N",
        "K·A·d, N",
        "ratio",
        "moment about the middle of the contact, N·m",
    )
    for depth in (1e-5, 1e-4, 1e-3):
        force, moment = pair.wrench([CLEARANCE / 2 + depth, 0, middle], about=[0, 0, -insertion / 2])
        flat = -foundation * PEG * insertion * depth
        line(depth, force[0], flat, force[0] / flat, float(moment[1]))
    heading(
        "peg in hole: tilt about the middle of the insertion",
        "θ, rad",
        "beyond the clearance at the ends, m",
        "force, N",
        "moment, N·m",
        "closed form, N·m",
        "ratio",
    )
    for angle in (0.009, 0.0101, 0.011, 0.012, 0.015):
        rotation = RotationMatrix.MakeYRotation(angle)
        pivot = np.array([0, 0, -insertion / 2])
        place = pivot + rotation @ np.array([0, 0, PEG_LENGTH / 2 - insertion / 2])
        force, moment = pair.wrench(place, rotation, about=pivot)
        # Each side: K·PEG·∫ s·(θ·s − c/2) ds over the lever s, from c/(2θ) to insertion/2; first order in θ.
        start, end = min(CLEARANCE / 2 / angle, insertion / 2), insertion / 2
        whole = (end**3 - start**3) / 3 * angle - CLEARANCE / 4 * (end**2 - start**2)
        closed = -2 * foundation * PEG * whole
        over = angle * end - CLEARANCE / 2
        ratio = moment[1] / closed if closed else float("nan")
        line(angle, over, float(np.linalg.norm(force)), moment[1], closed, ratio)


def flush_blocks():
    """Lateral force of equal compliant blocks, one on the other, against the lateral offset."""
    block = Box(EDGE, EDGE, EDGE)
    pair = Pair(block, properties(EDGE), block, properties(EDGE))
    depth = 1e-3
    heading(
        "compliant block on an equal one, 1e-3 m deep: offset",
        "offset, m",
        "normal force, N",
        "lateral force, N",
        "polygons",
    )
    for offset in (-1e-2, -1e-3, -1e-4, -1e-6, 0.0, 1e-6, 1e-4, 1e-3, 1e-2):
        force, _ = pair.wrench([offset, 0, EDGE - depth])
        line(offset, force[2], float(force[0]), pair.faces)


def main():
    version = importlib.metadata.version("drake")
    print(f"drake {version}; modulus {MODULUS:g} Pa, block {EDGE} m, ball {RADIUS} m, peg {PEG} m")
    block, rigid = Box(EDGE, EDGE, EDGE), properties()
    ground = Pair(block, properties(EDGE), HalfSpace(), rigid)
    block_on_ground("compliant block on a rigid ground", ground, FOUNDATION)
    block_damping("compliant block on a rigid ground", ground)
    compliant_ground = Pair(block, properties(EDGE), GROUND, properties(1.0), BELOW)
    block_on_ground("compliant block on a compliant ground of the same modulus", compliant_ground, FOUNDATION / 2)
    flush_blocks()
    ball_on_block(Pair(Sphere(RADIUS), properties(BALL_RESOLUTION), GROUND, rigid, BELOW))
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "hole.obj"
        path.write_text(hole_text(), encoding="utf-8")
        peg_in_hole(Pair(Box(PEG, PEG, PEG_LENGTH), properties(PEG), Mesh(str(path), 1.0), rigid))


if __name__ == "__main__":
    main()

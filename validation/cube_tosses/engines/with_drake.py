"""The cube in Drake, as the published programs set it up: a box with point contact on a half space."""

import logging

import numpy as np

from validation.cube_tosses.data import ANGULAR_VELOCITY, HALF_EDGE, ORIENTATION, POSITION, VELOCITY
from validation.cube_tosses.engines.engine import Engine, package
from validation.kit import rotation
from validation.kit.search import Free

CUBE = """<robot name="cube"><link name="base">
  <inertial><mass value="{mass!r}"/><inertia ixx="{inertia!r}" iyy="{inertia!r}" izz="{inertia!r}" ixy="0" ixz="0" iyz="0"/></inertial>
  <collision><geometry><box size="{edge!r} {edge!r} {edge!r}"/></geometry></collision>
</link></robot>"""


class Drake(Engine):
    """Drake with the lagged approximation of contact and dissipation after Hunt and Crossley."""

    name, title = "drake", "Drake, lagged"
    free = {"stiffness": Free(1e4, 1e3, 1e5), "dissipation": Free(0.5, 0.02, 10.0), "mu": Free(0.12, 0.02, 1.0)}
    units = {"stiffness": "N/m", "dissipation": "s/m", "mu": "of the table; the cube has 0.5"}
    approximation = "kLagged"

    def build(self):
        package("pydrake", self.title)
        # Drake warns that half spaces touch no deformable bodies; there are none here.
        logging.getLogger("drake").setLevel(logging.ERROR)
        from pydrake.geometry import HalfSpace, ProximityProperties
        from pydrake.math import RigidTransform
        from pydrake.multibody.parsing import Parser
        from pydrake.multibody.plant import AddMultibodyPlantSceneGraph, CoulombFriction, DiscreteContactApproximation
        from pydrake.systems.analysis import Simulator
        from pydrake.systems.framework import DiagramBuilder

        builder = DiagramBuilder()
        self.plant, _ = AddMultibodyPlantSceneGraph(builder, self.step)
        self.plant.set_discrete_contact_approximation(getattr(DiscreteContactApproximation, self.approximation))
        properties = ProximityProperties()
        properties.AddProperty("material", "point_contact_stiffness", self.values["stiffness"])
        properties.AddProperty("material", "hunt_crossley_dissipation", self.values["dissipation"])
        properties.AddProperty("material", "coulomb_friction", CoulombFriction(self.values["mu"], self.values["mu"]))
        text = CUBE.format(mass=self.body.mass, inertia=self.body.inertia, edge=2 * HALF_EDGE)
        Parser(self.plant).AddModelsFromString(text, "urdf")
        self.plant.RegisterCollisionGeometry(
            self.plant.world_body(), RigidTransform(), HalfSpace(), "table", properties
        )
        self.plant.Finalize()
        self.simulator = Simulator(builder.Build())

    def follow(self, start, frames):
        context = self.simulator.get_mutable_context()
        context.SetTime(0.0)
        self.simulator.Initialize()
        own = self.plant.GetMyMutableContextFromRoot(context)
        turning = rotation.turned(start[ORIENTATION], start[ANGULAR_VELOCITY])
        self.plant.SetPositions(own, np.concatenate([start[ORIENTATION], start[POSITION]]))
        self.plant.SetVelocities(own, np.concatenate([turning, start[VELOCITY]]))
        poses = np.empty((frames, 7))
        for frame in range(frames):
            if frame > 0:
                # A quarter of a step short of the frame: the step that leads to it is done, the next one is not.
                self.simulator.AdvanceTo((frame * self.substeps - 0.25) * self.step)
            positions = self.plant.GetPositions(own)
            poses[frame, ORIENTATION], poses[frame, POSITION] = positions[:4], positions[4:]
        return poses


class DrakeSap(Drake):
    """Drake with its SAP solver, which makes no use of the dissipation after Hunt and Crossley."""

    name, title = "drake-sap", "Drake, SAP"
    approximation = "kSap"


class DrakeTamsi(Drake):
    """Drake with the TAMSI solver of the published programs."""

    name, title = "drake-tamsi", "Drake, TAMSI"
    approximation = "kTamsi"

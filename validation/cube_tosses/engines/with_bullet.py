"""The cube in Bullet, as the published programs set it up: a box on a large box, from URDF files."""

import atexit
import contextlib
import ctypes
import os
import sys
import tempfile
from pathlib import Path

import numpy as np

from validation.cube_tosses.data import ANGULAR_VELOCITY, GRAVITY, HALF_EDGE, ORIENTATION, POSITION, VELOCITY
from validation.cube_tosses.engines.engine import Engine, package
from validation.kit import rotation
from validation.kit.search import Free

CUBE = """<robot name="cube"><link name="base">
  <inertial><mass value="{mass!r}"/><inertia ixx="{inertia!r}" iyy="{inertia!r}" izz="{inertia!r}" ixy="0" ixz="0" iyz="0"/></inertial>
  <collision><geometry><box size="{edge!r} {edge!r} {edge!r}"/></geometry></collision>
</link></robot>"""
TABLE = """<robot name="table"><link name="base">
  <contact><lateral_friction value="1"/></contact>
  <inertial><mass value="0"/><inertia ixx="0" iyy="0" izz="0" ixy="0" ixz="0" iyz="0"/></inertial>
  <collision><origin xyz="0 0 -0.5"/><geometry><box size="5 5 1"/></geometry></collision>
</link></robot>"""


def quietly(name, of):
    """Imports a package that writes to the terminal when it is loaded."""
    sys.stdout.flush()
    with contextlib.ExitStack() as undo:
        nowhere = os.open(os.devnull, os.O_WRONLY)
        undo.callback(os.close, nowhere)
        for stream in (1, 2):
            kept = os.dup(stream)
            undo.callback(os.close, kept)
            undo.callback(os.dup2, kept, stream)
            os.dup2(nowhere, stream)
        # Text that C has buffered goes nowhere, too.
        undo.callback(ctypes.CDLL(None).fflush, None)
        return package(name, of)


class Bullet(Engine):
    """Bullet with the inertia of the file."""

    name, title = "bullet", "Bullet"
    free = {"stiffness": Free(2e3, 100.0, 1e5), "damping": Free(30.0, 1.0, 1e3), "mu": Free(0.4, 0.05, 1.5)}
    units = {"stiffness": "N/m", "damping": "N·s/m", "mu": "of the table; Bullet multiplies it by 0.5 of the cube"}
    # Without the flag Bullet takes the inertia of a solid box of the same mass.
    reads_inertia = True

    def build(self):
        self.bullet = quietly("pybullet", self.title)
        if not hasattr(self, "client"):
            self.client = self.bullet.connect(self.bullet.DIRECT)
            self.folder = tempfile.TemporaryDirectory()
            atexit.register(self.folder.cleanup)
        text = CUBE.format(mass=self.body.mass, inertia=self.body.inertia, edge=2 * HALF_EDGE)
        (Path(self.folder.name) / "cube.urdf").write_text(text)
        (Path(self.folder.name) / "table.urdf").write_text(TABLE)

    def load(self):
        """Makes cube and table anew: nothing of an earlier run is left."""
        bullet, at = self.bullet, {"physicsClientId": self.client}
        bullet.resetSimulation(**at)
        bullet.setGravity(0, 0, -GRAVITY, **at)
        flags = bullet.URDF_USE_INERTIA_FROM_FILE if self.reads_inertia else 0
        self.cube = bullet.loadURDF(str(Path(self.folder.name) / "cube.urdf"), flags=flags, **at)
        table = bullet.loadURDF(str(Path(self.folder.name) / "table.urdf"), useFixedBase=True, **at)
        bullet.changeDynamics(
            table,
            -1,
            lateralFriction=self.values["mu"],
            contactStiffness=self.values["stiffness"],
            contactDamping=self.values["damping"],
            **at,
        )
        bullet.setTimeStep(self.step, **at)

    def inertia_in_use(self):
        """Principal moments of inertia that Bullet computes with, kg·m²."""
        self.load()
        return self.bullet.getDynamicsInfo(self.cube, -1, physicsClientId=self.client)[2]

    def follow(self, start, frames):
        bullet, at = self.bullet, {"physicsClientId": self.client}
        self.load()
        w, x, y, z = start[ORIENTATION]
        bullet.resetBasePositionAndOrientation(self.cube, start[POSITION], [x, y, z, w], **at)
        turning = rotation.turned(start[ORIENTATION], start[ANGULAR_VELOCITY])
        bullet.resetBaseVelocity(self.cube, start[VELOCITY], turning, **at)
        poses = np.empty((frames, 7))
        for frame in range(frames):
            place, (x, y, z, w) = bullet.getBasePositionAndOrientation(self.cube, **at)
            poses[frame] = (*place, w, x, y, z)
            for _ in range(self.substeps if frame + 1 < frames else 0):
                bullet.stepSimulation(**at)
        return poses


class BulletAsPublished(Bullet):
    """Bullet as the published programs call it: without the flag that makes it read the inertia of the file."""

    name, title = "bullet-published", "Bullet as published"
    reads_inertia = False

"""The cube in MuJoCo, as the published programs set it up: a box on a large box with direct `solref`."""

import numpy as np

from validation.cube_tosses.data import CORNERS, GRAVITY, HALF_EDGE
from validation.cube_tosses.engines.engine import Engine, package
from validation.kit.search import Free

MODEL = """<mujoco>
  <option timestep="{step!r}" gravity="0 0 {gravity!r}" cone="{cone}"><flag refsafe="disable"/></option>
  <compiler inertiafromgeom="false"/>
  <worldbody>
    <body name="cube">
      <inertial pos="0 0 0" mass="{mass!r}" diaginertia="{inertia!r} {inertia!r} {inertia!r}"/>
      <freejoint/>
      {geoms}
    </body>
    <geom type="box" pos="0 0 -0.2" size="5 5 0.2" solref="{minus_stiffness!r} {minus_damping!r}" friction="{mu!r} .001 .001"/>
  </worldbody>
</mujoco>"""


class Mujoco(Engine):
    """MuJoCo with its elliptic cone of friction."""

    name, title = "mujoco", "MuJoCo, elliptic cone"
    free = {"stiffness": Free(3e3, 100.0, 2e5), "damping": Free(50.0, 3.0, 1e3), "mu": Free(0.2, 0.05, 0.6)}
    units = {"stiffness": "1/s²", "damping": "1/s", "mu": ""}
    cone = "elliptic"

    def geoms(self):
        """Text of the cube's geoms: a box, or spheres that touch its faces from inside."""
        friction, radius = f'friction="{self.values["mu"]!r} .001 .001"', self.body.corner_radius
        if radius == 0.0:
            return f'<geom type="box" size="{HALF_EDGE} {HALF_EDGE} {HALF_EDGE}" {friction}/>'
        places = CORNERS - radius * np.sign(CORNERS)
        return "".join(f'<geom type="sphere" size="{radius!r}" pos="{x} {y} {z}" {friction}/>' for x, y, z in places)

    def build(self):
        self.mujoco = package("mujoco", self.title)
        text = MODEL.format(
            step=self.step,
            gravity=-GRAVITY,
            cone=self.cone,
            mass=self.body.mass,
            inertia=self.body.inertia,
            geoms=self.geoms(),
            minus_stiffness=-self.values["stiffness"],
            minus_damping=-self.values["damping"],
            mu=self.values["mu"],
        )
        self.model = self.mujoco.MjModel.from_xml_string(text)
        self.state = self.mujoco.MjData(self.model)

    def follow(self, start, frames):
        self.mujoco.mj_resetData(self.model, self.state)
        # Free joints have the angular velocity along the axes of the body, as the data do.
        self.state.qpos[:], self.state.qvel[:] = start[:7], start[7:]
        poses = np.empty((frames, 7))
        for frame in range(frames):
            poses[frame] = self.state.qpos
            if frame + 1 < frames:
                self.mujoco.mj_step(self.model, self.state, self.substeps)
        return poses


class MujocoPyramidal(Mujoco):
    """MuJoCo with the pyramid of friction that the published programs had."""

    name, title = "mujoco-pyramidal", "MuJoCo, pyramidal cone"
    cone = "pyramidal"

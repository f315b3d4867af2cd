#!/usr/bin/env python3
"""Builds active.ron and indicator.ron through the modelling toolkit: python build.py [FOLDER] [--blend FILE], with
Blender as a Python module. The passive half is models/common_berthing/passive.ron as it is; guides, standoffs and stops
are drawn by that model's own script. New are latches with rollers, duckhead bumpers, and plungers that slide.
"""

import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
MODELS = HERE.parent.parent / "models"
sys.path.insert(0, str(HERE.parent))
from kit.files import module_of  # noqa: E402


def _own(name):
    """A file of this folder, imported under a unique name: the models' scripts have one called `dimensions` as well."""
    return module_of(HERE / f"{name}.py", f"berthing_{name}")


d = _own("dimensions")
sys.modules["dimensions"] = d
linkage = _own("linkage")
sys.modules["dimensions"] = d.common
sys.path[:0] = [str(MODELS / "common_berthing"), str(MODELS)]
# Their `build` and not this file, which is __main__.
import authoring as a  # noqa: E402
import build as common_build  # noqa: E402
import scenes  # noqa: E402

common = d.common


def surfaces_of_active():
    """Surfaces of the models; standoffs have little loss, and a roller transmits only the friction of its bearing."""
    of_standoff = common_build.rough(
        common.STANDOFF_STIFFNESS, d.STANDOFF_DAMPING, common.STANDOFF_FRICTION, common.STANDOFF_STICKING
    )
    return {**common_build.SURFACES_OF_ACTIVE, "standoff": of_standoff}


def duckhead():
    """Bill of a bumper: round, across the fin that it meets."""
    x = common.RING_INNER - common.BUMPER_CLEARANCE - common.BUMPER_RADIUS
    ends = [(x, side * d.BILL_HALF_WIDTH, common.BUMPER_Z) for side in (-1, 1)]
    return a.capsule("bill", *ends, common.BUMPER_RADIUS)


def stowed(azimuth_deg):
    """Pose of a coupler, which carries the roller, when its latch is stowed."""
    pose = linkage.pose(d.STOWED)
    radius = d.CRANK_PIVOT[0] + d.CRANK * math.cos(pose.crank)
    z = d.CRANK_PIVOT[1] + d.CRANK * math.sin(pose.crank)
    raised = scenes.about_axis(1, -math.degrees(pose.coupler))
    return common.radial(radius, azimuth_deg, z), scenes.product(scenes.about_axis(2, azimuth_deg), raised)


def latch(i, azimuth_deg):
    """Coupler of a linkage, from its pin on the crank; only its roller makes contact."""
    along, across = d.ROLLER_AT
    ends = [(along, side * d.ROLLER_HALF_WIDTH, across) for side in (-1, 1)]
    position, orientation = stowed(azimuth_deg)
    roller = a.capsule("roller", *ends, d.ROLLER_RADIUS)
    return a.group(
        f"latch_{i}", primitives=[roller], surface="latch", movable=True, bound="Sphere", position=position,
        orientation=orientation,
    )  # fmt: skip


def active():
    def quadrant(i):
        latch_az, guide_az, standoff_azs = common_build.azimuths(i)
        part = common_build.part
        supports = [part(f"support_{k}", az, [common_build.standoff(), common_build.stop()])
                    for k, az in enumerate(standoff_azs)]  # fmt: skip
        guide = part("guide", guide_az, common_build.posts(), surface="guide")
        bumper = part("bumper", guide_az, [duckhead()], surface="bumper")
        return [guide, bumper, *supports, latch(i, latch_az)]

    rolling = a.pair("latch", "passive/ring", friction=a.bristle(d.ROLLER_FRICTION, damping=common.STICKING_DAMPING))
    root = a.group("active", groups=common_build.quadrants(quadrant), surface="ring")
    return a.model("active", surfaces_of_active(), root, pairs=[rolling])


def plunger():
    """A plunger on a spring of the host; the frame is at its tip."""
    tip = a.sphere("tip", (0.0, 0.0, -d.PLUNGER_TIP_RADIUS), d.PLUNGER_TIP_RADIUS)
    place = (common.PLUNGER_RADIUS, 0.0, common.PLUNGER_TIP_Z)
    return a.group("plunger", primitives=[tip], surface="tip", movable=True, position=place)


def indicator():
    """One of four indicators, at azimuth 0. Without friction: the paddle's edge rolls, and the plunger points at its
    target."""
    surfaces = {
        "paddle": a.surface(common.PADDLE_STIFFNESS, a.linear(common.PADDLE_DAMPING, ramp=common.DAMPING_RAMP)),
        "tip": a.surface(d.TIP_STIFFNESS, a.linear(d.TIP_DAMPING, ramp=common.DAMPING_RAMP)),
    }
    return a.model("indicator", surfaces, a.group("indicator", groups=[plunger(), common_build.paddle()]))


if __name__ == "__main__":
    a.main([active(), indicator()], HERE)

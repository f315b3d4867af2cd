#!/usr/bin/env python3
"""Builds the contact models of hard capture: pads, pushers and hooks of the active side, the flange of the passive one.

python build.py [FOLDER] [--blend FILE] with Blender as a Python module. The petals and latches of soft capture are
models/idss_docking. Both models have the frames of that: z out of the vehicle; the active origin in the hard plane, the
passive one in the face of its soft-capture ring.
"""

import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent), str(HERE.parents[1] / "models")]
sys.path.append(str(HERE.parents[1] / "models/idss_docking"))
import authoring as a  # noqa: E402
import dimensions as d  # noqa: E402
import geometry as g  # noqa: E402
import numpy as np  # noqa: E402
from kit.files import module_of  # noqa: E402

UP, DOWN = (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)
STEP = 360.0 / d.HOOKS
SURFACES = {
    "pad": a.surface(
        d.HARD_PAD_STIFFNESS, normal=a.linear(damping=d.HARD_PAD_DAMPING, ramp=1e-4), friction=a.bristle(mu=0.2)
    ),
    "hook": a.surface(d.HOOK_STIFFNESS, normal=a.linear(damping=d.HOOK_DAMPING, ramp=1e-4)),
    "pusher": a.surface(d.PUSHER_STIFFNESS, normal=a.linear(damping=0.0)),
}


def hook_frame(azimuth):
    """Frame with x towards the docking axis, y along the ring, z out of the vehicle."""
    inwards = g.on_circle(-1.0, azimuth)
    return inwards, g.cross(UP, inwards), UP


def hook(i):
    """Hook with its origin on the pivot and the arm along x. Only the edge at its tip makes contact; the arm is visual."""
    half, arm = d.HOOK_HALF_WIDTH, d.HOOK_ARM
    box = [
        ((1.0, 0.0, 0.0), arm),
        ((-1.0, 0.0, 0.0), 0.015),
        ((0.0, 1.0, 0.0), half),
        ((0.0, -1.0, 0.0), half),
        (UP, 0.025),
        (DOWN, 0.0),
    ]
    return a.group(
        f"hook_{i}",
        primitives=[a.segment("tip", (arm, -half, 0.0), (arm, half, 0.0)), a.polyhedron("arm", box)],
        bound="Sphere",
        surface="hook",
        movable=True,
        position=g.on_circle(d.HOOK_PIVOT_RADIUS, i * STEP, d.HOOK_PIVOT_HEIGHT),
        orientation=g.quaternion_of_axes(*hook_frame(i * STEP)),
    )


def active():
    pads = [a.point(f"pad_{i}", g.on_circle(d.HARD_PAD_RADIUS, i * STEP)) for i in range(d.HOOKS)]
    pushers = [
        a.ray(
            f"pusher_{i}",
            g.on_circle(d.PUSHER_RADIUS, i * 360.0 / d.PUSHERS),
            UP,
            d.PUSHER_LENGTH,
            reach=0.02,
            response="Axial",
        )
        for i in range(d.PUSHERS)
    ]
    parts = [
        a.group("pads", primitives=pads, bound="Above", surface="pad"),
        a.group("pushers", primitives=pushers, bound="Above", surface="pusher"),
        *[hook(i) for i in range(d.HOOKS)],
    ]
    return a.model("hard_active", SURFACES, a.group("vehicle", groups=parts, bound="Aabb", surface="pad"))


def sector(i):
    """A twelfth of the flange; its ends are internal faces."""
    outwards, azimuth = g.on_circle(1.0, i * STEP), i * STEP
    ends = [g.cross(UP, g.on_circle(1.0, azimuth + STEP / 2)), g.cross(g.on_circle(1.0, azimuth - STEP / 2), UP)]
    walls = [
        (outwards, d.FLANGE_RADII[1]),
        (g.scaled(outwards, -1.0), -d.FLANGE_RADII[0]),
        (UP, d.HARD_FACE),
        (DOWN, d.FLANGE_THICKNESS - d.HARD_FACE),
        *[(end, 0.0) for end in ends],
    ]
    return a.polyhedron(f"sector_{i:02}", walls, inactive=(4, 5))


def passive():
    flange = a.group("flange", primitives=[sector(i) for i in range(d.HOOKS)], bound="Above")
    surfaces = {"flange": a.surface(float("inf"), friction=a.bristle(mu=0.2))}
    return a.model("hard_passive", surfaces, a.group("vehicle", groups=[flange], bound="Aabb", surface="flange"))


def soft_passive():
    """Soft model of models/idss_docking, with the strikers' outer faces inactive: the ring is behind them.

    If they made contact, a latch far off the middle would be pushed outwards there and wedge between bar and ring.
    """
    mine, sys.modules["dimensions"] = sys.modules["dimensions"], d.IDSS
    interface = module_of(d.ROOT / "models/idss_docking/build.py", "idss_build")
    sys.modules["dimensions"] = mine
    made = interface.passive()
    for group in made.root.groups:
        for primitive in group.primitives if group.name.startswith("striker_") and group.name[-1].isdigit() else ():
            if primitive.name == "bar":
                primitive.fields["inactive_faces"] = [outer_wall(primitive.fields)]
    made.name = "soft_passive"
    return made


def outer_wall(fields):
    """Number of the face of a striker's bar whose vertices are furthest from the docking axis."""
    reach = [min(np.hypot(*fields["vertices"][i][:2]) for i in face) for face in fields["faces"]]
    return int(np.argmax(reach))


if __name__ == "__main__":
    a.main([active(), passive(), soft_passive()], HERE)

"""The scene of the docking interfaces (docs/scene_format.md): soft capture, until the rings hold each other.

Values of the bodies are those of c_examples/docking_dynamics.c, which goes on where this ends: there the attenuation stiffens
after capture. What differs: a latch hangs on a stiff joint, and its spring has no preload against a stop but a rate
that gives as much where the striker has pushed it aside.
"""

from dimensions import *  # noqa: F403
from geometry import quaternion_of_axes, rounded
from scene_text import about_axis, numbers, on, product, scene, spring, turned

# --- bodies ----------------------------------------------------------------------------------------------------------
CHASER_MASS, CHASER_INERTIA, CHASER_CENTER = 12e3, (76e3, 76e3, 24e3), (0.0, 0.0, -4.5)
TARGET_MASS, TARGET_INERTIA, TARGET_CENTER = 420e3, (1.2e8, 1.2e8, 1.2e8), (0.0, 0.0, -20.0)
RING_MASS, RING_INERTIA = 57.0, (11.0, 11.0, 20.0)
LATCH_MASS, LATCH_INERTIA = 1.0, (1e-3, 1e-3, 1e-3)  # with the slide that carries it

# --- springs: along x, y, z, then about them -------------------------------------------------------------------------
ATTENUATION = (200.0, 200.0, 2000.0, 200.0, 200.0, 200.0)
ATTENUATION_DAMPING = (100.0, 100.0, 500.0, 60.0, 60.0, 60.0)
LATCH_JOINT = (600.0, 2e5, 2e5, 1e3, 1e3, 1e3)
LATCH_JOINT_DAMPING = (5.0, 200.0, 200.0, 0.6, 0.6, 0.6)

# --- the approach ----------------------------------------------------------------------------------------------------
SPEED = 0.10
ASIDE = (0.05, 0.0, 0.0)  # of the middle of the ring's face
GAP = 0.16  # between the two faces; petals meet at about 0.14
ROLL_DEG, PITCH_DEG = 2.0, 1.0
STEP = "5e-4"
DURATION = 8.0


def texts():
    return {"scene_soft_capture.ron": soft_capture()}


def free(place, mass, inertia, group=None, center=None, orientation=None, velocity=None):
    given = [f'group: "{group}"'] if group else []
    given += ["motion: Free", f"mass: {mass!r}", f"inertia: Diagonal{numbers(inertia)}"]
    given += [f"mass_center: {numbers(center)}"] if center else []
    given += [f"position: {numbers(place)}"] if place else []
    given += [f"orientation: {numbers(orientation)}"] if orientation else []
    given += [f"linear_velocity: {numbers(velocity)}"] if velocity else []
    return f"({', '.join(given)}),"


def latches():
    return [(f"latch_{i}", latch_tip(azimuth), latch_frame(azimuth)) for i, azimuth in enumerate(ACTIVE_PETALS)]


def chaser():
    """Vehicle, ring and latches, all with one velocity; the ring and its latches start at their model poses."""
    attitude = product(about_axis(2, ROLL_DEG), about_axis(0, PITCH_DEG))
    face = (ASIDE[0], ASIDE[1], -GAP)
    place = tuple(f - e for f, e in zip(face, turned(attitude, (0.0, 0.0, RING_EXTENSION))))
    ahead = (0.0, 0.0, SPEED)
    lines = ['(name: "chaser", model: "idss_active", bodies: [']
    lines += ["    " + free(place, CHASER_MASS, CHASER_INERTIA, center=CHASER_CENTER, orientation=attitude, velocity=ahead)]
    lines += ["    " + free(None, RING_MASS, RING_INERTIA, group="ring", velocity=ahead)]
    lines += ["    " + free(None, LATCH_MASS, LATCH_INERTIA, group=name, velocity=ahead) for name, _, _ in latches()]
    return lines + ["]),"]


def target():
    """Target at rest, its port at the common origin, looking along -z."""
    body = free((0.0, 0.0, 0.0), TARGET_MASS, TARGET_INERTIA, center=TARGET_CENTER, orientation=(0.0, 1.0, 0.0, 0.0))
    return [f'(name: "target", model: "idss_passive", bodies: [{body.rstrip(",")}]),']


def springs():
    lines = [spring(on("chaser", (0.0, 0.0, RING_EXTENSION)), on("chaser/ring"), ATTENUATION, ATTENUATION_DAMPING)]
    for name, tip, axes in latches():
        place = on("chaser/ring", rounded(tip), quaternion_of_axes(*axes))
        lines.append(spring(place, on(f"chaser/{name}"), LATCH_JOINT, LATCH_JOINT_DAMPING))
    return lines


def soft_capture():
    about = [
        "A chaser of 12 t closes on a station of 420 t at 0.1 m/s, 50 mm aside, rolled by 2 degrees and pitched by 1. Petals",
        "align its ring, latches snap behind the strikers, the attenuation takes up the way and the latches hold against it.",
        "Written by build.py.",
    ]
    pairs = [("chaser", "target")]
    models = ("idss_active", "idss_passive")
    return scene("soft_capture", about, models, [*chaser(), *target()], pairs, DURATION, 20, springs=springs(), step=STEP)

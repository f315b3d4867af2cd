#!/usr/bin/env python3
"""Builds both halves of a Common Berthing Mechanism and scenes of its berthing.

Made through the modelling toolkit: python build.py [FOLDER] [--blend FILE] with Blender as a Python module. It writes
active.ron, passive.ron, indicator.ron, arm.ron and the scenes (scenes.py). Every dimension stands in dimensions.py; README.md says
where each comes from.

Parts are drawn in a frame of their own at an azimuth: x outwards, y along the circumference, z as of the ring.
"""

import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]
import authoring as a  # noqa: E402
import geometry as g  # noqa: E402
import scenes  # noqa: E402
from dimensions import *  # noqa: E402, F403

SLOPE = math.tan(math.radians(FLARE_DEG))


def rough(stiffness, damping, friction=FRICTION, sticking=STICKING_DAMPING):
    return a.surface(stiffness, a.linear(damping, ramp=DAMPING_RAMP), a.bristle(friction, damping=sticking))


SURFACES_OF_ACTIVE = {
    "ring": rough(RING_STIFFNESS, RING_DAMPING),
    "guide": rough(GUIDE_STIFFNESS, GUIDE_DAMPING),
    "latch": rough(LATCH_STIFFNESS, LATCH_DAMPING),
    "bumper": rough(BUMPER_STIFFNESS, BUMPER_DAMPING, sticking=0.0),
    "standoff": rough(STANDOFF_STIFFNESS, STANDOFF_DAMPING, STANDOFF_FRICTION, STANDOFF_STICKING),
}
SURFACES_OF_INDICATOR = {
    "paddle": rough(PADDLE_STIFFNESS, PADDLE_DAMPING, sticking=0.0),
    "plunger": a.surface(PLUNGER_STIFFNESS, a.linear(PLUNGER_DAMPING, ramp=DAMPING_RAMP)),
}
SURFACES_OF_PASSIVE = {"ring": rough(RING_STIFFNESS, 0.0, sticking=0.0)}


def part(name, azimuth_deg, primitives, **rest):
    """A group whose x points outwards at an azimuth. Parts are compact: bounding spheres cost least."""
    orientation = scenes.about_axis(2, azimuth_deg)
    return a.group(name, primitives=primitives, bound="Sphere", orientation=orientation, **rest)


def quadrants(make):
    """Four groups of the parts that `make` gives for a quadrant."""
    return [a.group(f"quadrant_{i}", groups=make(i)) for i in range(4)]


def azimuths(i):
    """Azimuths of a quadrant: its latch, its guide, its two standoffs."""
    return LATCH_AZIMUTHS[i], GUIDE_AZIMUTHS[i], STANDOFF_AZIMUTHS[2 * i : 2 * i + 2]


def box(name, least, most):
    half_spaces = []
    for axis in range(3):
        outward = tuple(float(i == axis) for i in range(3))
        half_spaces += [(g.scaled(outward, -1.0), -least[axis]), (outward, most[axis])]
    return a.polyhedron(name, half_spaces)


# --- passive half ----------------------------------------------------------------------------------------------------

def fin():
    """A guide: straight at the root, then narrower by 30° on both sides; its inner face leans outwards."""
    low = -FIN_HEIGHT
    half_spaces = [((0.0, 0.0, 1.0), 0.0), ((0.0, 0.0, -1.0), FIN_HEIGHT), ((1.0, 0.0, 0.0), RING_OUTER)]
    for side in (-1, 1):
        half_spaces.append(((0.0, side, 0.0), FIN_HALF_WIDTH))
        half_spaces.append(g.plane((0.0, side, -SLOPE), (0.0, side * FIN_HALF_WIDTH, -FIN_STRAIGHT)))
    half_spaces.append(((-1.0, 0.0, 0.0), -RING_INNER))
    lean = (-(FIN_HEIGHT - FIN_STRAIGHT), 0.0, -FIN_LEAN)
    half_spaces.append(g.plane(lean, (RING_INNER + FIN_LEAN, 0.0, low)))
    return a.polyhedron("fin", half_spaces)


def fitting():
    return box(
        "fitting",
        (FITTING_INNER, -FITTING_HALF_WIDTH, FITTING_BOTTOM),
        (FITTING_OUTER, FITTING_HALF_WIDTH, FITTING_TOP),
    )


def plate():
    return box("plate", (RING_INNER, -PLATE_HALF_WIDTH, 0.0), (RING_OUTER, PLATE_HALF_WIDTH, PLATE_THICKNESS))


def passive():
    def quadrant(i):
        latch_az, guide_az, standoff_azs = azimuths(i)
        plates = [part(f"striker_{k}", az, [plate()]) for k, az in enumerate(standoff_azs)]
        return [part("guide", guide_az, [fin()]), part("capture", latch_az, [fitting()]), *plates]

    return a.model("passive", SURFACES_OF_PASSIVE, a.group("passive", groups=quadrants(quadrant), surface="ring"))


# --- active half -----------------------------------------------------------------------------------------------------

def posts():
    """The two edges between which a fin enters: upright, then flared."""
    near = FIN_HALF_WIDTH + GUIDE_CLEARANCE
    wide = near + (POST_TOP - POST_THROAT) * SLOPE
    lines = []
    for side, where in ((-1, "clockwise"), (1, "counter")):
        throat = (RING_MIDDLE, side * near, POST_THROAT)
        lines.append(a.segment(f"upright_{where}", (RING_MIDDLE, side * near, POST_FOOT), throat))
        lines.append(a.segment(f"flare_{where}", throat, (RING_MIDDLE, side * wide, POST_TOP)))
    return lines


def bumper():
    return a.sphere("bumper", (RING_INNER - BUMPER_CLEARANCE - BUMPER_RADIUS, 0.0, BUMPER_Z), BUMPER_RADIUS)


def standoff():
    origin = (STANDOFF_RADIUS, 0.0, -STANDOFF_SOCKET)
    length = STANDOFF_SOCKET + STANDOFF_STROKE
    return a.ray("standoff", origin, (0.0, 0.0, 1.0), length, response="Axial", surface="standoff")


def stop():
    return a.point("stop", (STOP_RADIUS, 0.0, 0.0))


def latch(i, azimuth_deg):
    """Tip of a four-bar latch, a roller; modelled stowed. The host moves it as the bars do."""
    tip = a.sphere("tip", (0.0, 0.0, 0.0), TIP_RADIUS)
    place = radial(STOWED_RADIUS, azimuth_deg, STOWED_Z)
    return part(f"latch_{i}", azimuth_deg, [tip], surface="latch", movable=True, position=place)


def active():
    def quadrant(i):
        latch_az, guide_az, standoff_azs = azimuths(i)
        supports = [part(f"support_{k}", az, [standoff(), stop()]) for k, az in enumerate(standoff_azs)]
        guides = [part("guide", guide_az, posts(), surface="guide"), part("bumper", guide_az, [bumper()], surface="bumper")]
        return [*guides, *supports, latch(i, latch_az)]

    return a.model("active", SURFACES_OF_ACTIVE, a.group("active", groups=quadrants(quadrant), surface="ring"))


# --- ready-to-latch indicator ------------------------------------------------------------------------------------------

def plunger():
    """The sliding part. A separate body: its wrench is the indicator's signal."""
    ray = a.ray("rod", (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), PLUNGER_LENGTH, response="Axial")
    place = (PLUNGER_RADIUS, 0.0, PLUNGER_TIP_Z - PLUNGER_LENGTH)
    return a.group("plunger", primitives=[ray], surface="plunger", movable=True, position=place)


def paddle():
    """The turning part: the edge at its end, in the frame of its hinge."""
    edge = a.segment("edge", (PADDLE_LENGTH, -PADDLE_HALF_WIDTH, 0.0), (PADDLE_LENGTH, PADDLE_HALF_WIDTH, 0.0))
    return a.group(
        "paddle", primitives=[edge], surface="paddle", movable=True, position=HINGE,
        orientation=scenes.paddle_attitude(PADDLE_DEG),
    )


def indicator():
    """One of four indicators, at azimuth 0; its root is fixed to the active ring, whose frame it shares but for the
    azimuth."""
    return a.model("indicator", SURFACES_OF_INDICATOR, a.group("indicator", groups=[plunger(), paddle()]))


def arm():
    """Frame of the arm's tip, without contact: scenes name no pair with it."""
    tip = a.point("tip", (0.0, 0.0, 0.0))
    return a.model("arm", {"none": a.surface(1.0)}, a.group("arm", primitives=[tip], surface="none"))


if __name__ == "__main__":
    a.main([active(), passive(), indicator(), arm()], HERE, scenes.texts())

"""Contact models of the end effector, the grapple fixture and the payload: one description of each, from dimensions.

build.py makes model files of those with the committed dimensions, through the modelling toolkit. Rigs that change a
dimension give the same description to the plugin as text.
"""

import math
import pathlib
from dataclasses import dataclass

from dimensions import CAMS, FRICTION, LARGE_FIXTURE, LIP, PADS, PLUNGERS, SEAT, TEETH, Fixture, Snare, training
from kit import ron

HERE = pathlib.Path(__file__).resolve().parent


@dataclass(frozen=True)
class Surface:
    """N/m (None: rigid, with the stiffness of the pair's other surface), N·s/m."""

    stiffness: float | None
    damping: float = 0.0
    friction: float = 0.0
    bristle_damping: float | None = None

    def data(self):
        if self.stiffness is None:
            return ron.rigid(self.friction)
        return ron.elastic(self.stiffness, self.damping, self.friction, self.bristle_damping)


@dataclass(frozen=True)
class Part:
    """A primitive: its kind, name, and (field, value) pairs under the names of the model format."""

    kind: str
    name: str
    fields: tuple

    def data(self):
        return ron.primitive(self.kind, self.name, **dict(self.fields))


def part(kind, name, **fields):
    return Part(kind, name, tuple(fields.items()))


@dataclass(frozen=True)
class Model:
    """Model with `links`: names of movable groups below the root, each of which carries `parts`; without them the root
    does."""

    name: str
    surface: Surface
    parts: tuple
    links: tuple = ()

    def text(self):
        parts = [one.data() for one in self.parts]
        groups = [(link, parts) for link in self.links]
        return ron.model(self.name, self.surface.data(), parts, groups)


def around(count, radius, first_deg=0.0):
    """Points on a circle about z."""
    angles = [math.radians(first_deg + 360.0 * i / count) for i in range(count)]
    return [(radius * math.cos(a), radius * math.sin(a)) for a in angles]


def turned(azimuth_deg, x, y, z):
    """Point given by its outward, tangential and axial coordinates at an azimuth."""
    a = math.radians(azimuth_deg)
    return (x * math.cos(a) - y * math.sin(a), x * math.sin(a) + y * math.cos(a), z)


# --- snare and fixture -------------------------------------------------------------------------------------------------


def chain(length, radius, count, surface, name="cable"):
    """Chain of capsules, each on its own movable group; the root is empty and fixed to the start of the chain."""
    wire = part("Capsule", "wire", ends=((0, 0, 0), (length, 0, 0)), radius=radius)
    return Model(name, surface, (wire,), tuple(f"link_{i:02}" for i in range(count)))


def cable(snare):
    """The last link is a tendon, without contact."""
    surface = Surface(snare.contact_stiffness, snare.contact_damping, snare.friction)
    return chain(snare.length / snare.links, snare.radius, snare.links - 1, surface, f"cable_{snare.links}")


def fixture(fixture, friction=FRICTION):
    """Shaft, cone and knob along −z from the payload. Rigid: the stiffness is that of the cable."""
    cone = -fixture.shaft_length
    knob = cone - fixture.cone_length
    tip = knob - fixture.knob_length
    radii = (fixture.shaft_radius, fixture.knob_radius)
    parts = (
        part("Cylinder", "shaft", ends=((0, 0, 0.05), (0, 0, cone)), radius=radii[0]),
        part("Cone", "cone", ends=((0, 0, cone), (0, 0, knob)), radii=radii),
        part("Cylinder", "knob", ends=((0, 0, knob), (0, 0, tip)), radius=radii[1]),
    )
    return Model("fixture" if fixture == Fixture() else "fixture_large", Surface(None, friction=friction), parts)


# --- shell and payload -------------------------------------------------------------------------------------------------


def pads(count=PADS.count, first_deg=0.0, height=SEAT, friction=FRICTION):
    """Balls with their tops at `height`."""
    balls = tuple(
        part("Sphere", f"pad_{i:02}", center=(x, y, height - PADS.radius), radius=PADS.radius)
        for i, (x, y) in enumerate(around(count, PADS.circle, first_deg))
    )
    return Model("pads", Surface(PADS.stiffness, PADS.damping, friction), balls)


def plate(friction=FRICTION):
    """Half space below the payload's face z = 0."""
    return Model("plate", Surface(None, friction=friction), (part("Plane", "face", normal=(0, 0, -1), offset=0),))


FACES = ((0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6), (0, 4, 6, 2), (1, 3, 7, 5))


def wedge(name, azimuth_deg, circle, half_length, low, high):
    """A radial prism; `low` and `high`: (half width, height), of which the first is lower."""
    corners = tuple(
        turned(azimuth_deg, radius, side * half, z)
        for radius in (circle - half_length, circle + half_length)
        for half, z in (low, high)
        for side in (-1, 1)
    )
    return part("Polyhedron", name, vertices=corners, faces=FACES)


def teeth(friction=FRICTION, height=SEAT):
    """The shell's half: the flanks meet the tangent of the pitch circle at the flank angle from the axis."""
    slope = TEETH.depth * math.tan(math.radians(TEETH.flank_deg))
    low = (TEETH.half_width + slope, height - TEETH.depth)
    high = (TEETH.half_width - slope, height + TEETH.depth)
    wedges = tuple(
        wedge(f"tooth_{i:02}", 360.0 * i / TEETH.count, TEETH.circle, TEETH.half_length, low, high)
        for i in range(TEETH.count)
    )
    return Model("teeth", Surface(None, friction=friction), wedges)


def crowns(friction=FRICTION):
    """The payload's half: a ball for each flank, in contact in the pitch plane when the payload is seated."""
    flank = math.radians(TEETH.flank_deg)
    out, up = TEETH.half_width + TEETH.crown * math.cos(flank), TEETH.crown * math.sin(flank)
    balls = tuple(
        part(
            "Sphere",
            f"flank_{2 * i + k:02}",
            center=turned(360.0 * i / TEETH.count, TEETH.circle, side * out, up),
            radius=TEETH.crown,
        )
        for i in range(TEETH.count)
        for k, side in enumerate((-1, 1))
    )
    return Model("crowns", Surface(TEETH.stiffness, TEETH.damping, friction, 100.0), balls)


def cam_azimuths():
    return [CAMS.first_deg + 360.0 * i / CAMS.count for i in range(CAMS.count)]


def cams(friction=FRICTION):
    """Cams on the payload's plate, pointing at the shell."""
    tip = CAMS.half_root - CAMS.height * math.tan(math.radians(CAMS.flank_deg))
    wedges = tuple(
        wedge(f"cam_{i}", azimuth, CAMS.circle, CAMS.half_length, (tip, -CAMS.height), (CAMS.half_root, 0.0))
        for i, azimuth in enumerate(cam_azimuths())
    )
    return Model("cams", Surface(None, friction=friction), wedges)


def roller_place():
    """Distance of a roller's axis from the middle of a seated cam, along the circumference, m."""
    flank = math.radians(CAMS.flank_deg)
    side = CAMS.half_root - CAMS.sunk * math.tan(flank)
    return side + (CAMS.roller + CAMS.clearance) / math.cos(flank)


def rollers(friction=FRICTION):
    """Rollers on the shell, two for each cam, with radial axes; shorter than the cams, so that flanks carry them."""
    half = 0.5 * CAMS.half_length
    capsules = tuple(
        part(
            "Capsule",
            f"roller_{2 * i + k}",
            ends=tuple(
                turned(azimuth, CAMS.circle + out, side * roller_place(), SEAT - CAMS.sunk) for out in (-half, half)
            ),
            radius=CAMS.roller,
        )
        for i, azimuth in enumerate(cam_azimuths())
        for k, side in enumerate((-1, 1))
    )
    return Model("rollers", Surface(CAMS.stiffness, CAMS.damping, friction), capsules)


def lip(friction=FRICTION):
    """A polygon of bars with spherical ends, whose sides preserve the aperture."""
    corners = around(LIP.pieces, (LIP.aperture + LIP.radius) / math.cos(math.pi / LIP.pieces))
    bars = tuple(
        part("Capsule", f"edge_{i:02}", ends=((*a, LIP.height), (*b, LIP.height)), radius=LIP.radius)
        for i, (a, b) in enumerate(zip(corners, corners[1:] + corners[:1]))
    )
    return Model("lip", Surface(LIP.stiffness, LIP.damping, friction), bars)


def plungers():
    """Plungers on an axial slide; when latched, their tips are at the seat."""
    rods = tuple(
        part(
            "Ray",
            f"rod_{i}",
            origin=(x, y, SEAT - PLUNGERS.length),
            direction=(0, 0, 1),
            length=PLUNGERS.length,
            response="Axial",
        )
        for i, (x, y) in enumerate(around(PLUNGERS.count, PLUNGERS.circle, PLUNGERS.first_deg))
    )
    return Model("plungers", Surface(PLUNGERS.stiffness, PLUNGERS.damping), rods)


# --- files -------------------------------------------------------------------------------------------------------------


def committed():
    """Models in files beside this one, by file name."""
    snares = [cable(Snare()), cable(training(Snare()))]
    fixtures = [fixture(Fixture()), fixture(LARGE_FIXTURE)]
    seat = [pads(), plate(), teeth(), crowns(), cams(), rollers(), lip(), plungers()]
    return {f"{model.name}.ron": model for model in snares + fixtures + seat}


def sources(objects):
    """Model sources for the plugin: name → file or text key, and the texts, for Objects given as models."""
    files = {model: name for name, model in committed().items()}
    texts = sorted({model.text() for model in objects.values() if model not in files})
    keys = {text: f"text{i + 1}" for i, text in enumerate(texts)}
    return {name: files.get(model) or keys[model.text()] for name, model in objects.items()}, texts

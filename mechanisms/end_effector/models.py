"""Contact models of the end effector as text."""

from kit import ron


def chain(length, radius, count, surface):
    """Links of capsules, each on a movable group of its own; the root has nothing and stays where the chain begins."""
    ends = ((0, 0, 0), (length, 0, 0))
    wire = ron.primitive("Capsule", "wire", ends=ends, radius=radius)
    return ron.model("cable", surface, groups=[(f"link_{i:02}", [wire]) for i in range(count)])


def cable(snare):
    """The last link is a tendon, without contact."""
    surface = ron.elastic(snare.contact_stiffness, snare.contact_damping, snare.friction)
    return chain(snare.length / snare.links, snare.radius, snare.links - 1, surface)


def fixture(fixture, friction):
    """Shaft, cone and knob along −z from the payload. Rigid: the stiffness is that of the cable."""
    cone = -fixture.shaft_length
    knob = cone - fixture.cone_length
    tip = knob - fixture.knob_length
    radii = (fixture.shaft_radius, fixture.knob_radius)
    parts = [
        ron.primitive("Cylinder", "shaft", ends=((0, 0, 0.05), (0, 0, cone)), radius=radii[0]),
        ron.primitive("Cone", "cone", ends=((0, 0, cone), (0, 0, knob)), radii=radii),
        ron.primitive("Cylinder", "knob", ends=((0, 0, knob), (0, 0, tip)), radius=radii[1]),
    ]
    return ron.model("fixture", ron.rigid(friction), parts)

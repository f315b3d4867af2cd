"""Contact models of the end effector as text (docs/model_format.md)."""


def surfaces(stiffness, damping, friction):
    law = f", friction: Bristle(mu: {friction!r})" if friction else ""
    return f'"steel": (stiffness: {stiffness!r}, normal: Linear(damping: {damping!r}){law})'


RIGID = '"steel": (stiffness: inf)'


def _text(name, surfaces, root):
    return f'(format: "pong-model", version: 1, name: "{name}", surfaces: {{ {surfaces} }}, root: {root})'


def cable(snare):
    """One capsule a link, each on a movable group of its own; the root has nothing and stays with the world."""
    pitch = snare.length / snare.links
    stiffness = surfaces(snare.contact_stiffness, snare.contact_damping, snare.friction)
    links = ", ".join(
        f'(name: "link_{i:02}", movable: true, surface: "steel", primitives: ['
        f'Capsule(name: "wire", ends: ((0, 0, 0), ({pitch!r}, 0, 0)), radius: {snare.radius!r})])'
        for i in range(snare.links - 1)
    )
    return _text("cable", stiffness, f'(name: "cable", groups: [{links}])')


def fixture(fixture, friction):
    """Shaft, cone and knob along −z from the payload. Rigid: the stiffness is that of the cable."""
    cone, knob = -fixture.shaft_length, -fixture.shaft_length - fixture.cone_length
    parts = [
        f'Cylinder(name: "shaft", ends: ((0, 0, 0.05), (0, 0, {cone!r})), radius: {fixture.shaft_radius!r})',
        f'Cone(name: "cone", ends: ((0, 0, {cone!r}), (0, 0, {knob!r})), radii: ({fixture.shaft_radius!r}, {fixture.knob_radius!r}))',
        f'Cylinder(name: "knob", ends: ((0, 0, {knob!r}), (0, 0, {knob - fixture.knob_length!r})), radius: {fixture.knob_radius!r})',
    ]
    rigid = f'"steel": (stiffness: inf, friction: Bristle(mu: {friction!r}))' if friction else RIGID
    return _text("fixture", rigid, f'(name: "fixture", surface: "steel", primitives: [{", ".join(parts)}])')

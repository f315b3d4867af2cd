"""Solids of Pong for the comparisons in this folder: models as text, and the wrench of a pair at given poses."""

import numpy as np
import pong

BOX_FACES = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
UNTURNED = (1.0, 0.0, 0.0, 0.0)  # quaternion w, x, y, z


def rows(values):
    """Rows of numbers as tuples of RON."""
    return ", ".join("(" + ", ".join(repr(x) for x in row) + ")" for row in np.asarray(values).tolist())


def surface(foundation=None, law="Linear(damping: 0)", friction=None, area=1.0):
    """A surface with the foundation modulus `foundation` (N/m³); without one a rigid surface. `law` is the normal law of
    a contact of the area `area` (m²), and `friction` the coefficient."""
    bristle = "" if friction is None else f", friction: Bristle(mu: {friction!r})"
    if foundation is None:
        return f"(stiffness: inf{bristle})"
    return f"(stiffness: {foundation * area!r}, area: {area!r}, normal: {law}{bristle})"


def hunt_crossley(dissipation):
    """A normal law with the dissipation of Hunt and Crossley, s/m."""
    return f"HuntCrossley(dissipation: {dissipation!r}, exponent: 1.0)"


def box(half, center=(0.0, 0.0, 0.0), name="box"):
    """A box with the half edges `half` (m) as a primitive."""
    signs = np.array([(x, y, z) for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)])
    corners = np.array(center) + signs * np.array(half)
    faces = ", ".join(str(list(face)) for face in BOX_FACES)
    return f'Polyhedron(name: "{name}", vertices: [{rows(corners)}], faces: [{faces}])'


def mesh(vertices, triangles):
    """A closed mesh with outward triangles as a primitive."""
    return f'TriangleMesh(name: "mesh", vertices: [{rows(vertices)}], triangles: [{rows(triangles)}])'


def tube(inner, outer, low, high):
    """Vertices (m) and triangles of a square tube along z between two heights, by the half widths of hole and tube."""
    vertices = [
        (x * half, y * half, z)
        for z in (low, high)
        for half in (inner, outer)
        for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))
    ]
    triangles = []
    for i in range(4):
        j = (i + 1) % 4
        low_in, low_out, up_in, up_out = (lambda k, base=base: base + k for base in (0, 4, 8, 12))
        triangles += [(low_in(j), low_in(i), up_in(i)), (low_in(j), up_in(i), up_in(j))]
        triangles += [(low_out(i), low_out(j), up_out(j)), (low_out(i), up_out(j), up_out(i))]
        triangles += [(up_in(i), up_out(i), up_out(j)), (up_in(i), up_out(j), up_in(j))]
        triangles += [(low_in(j), low_out(j), low_out(i)), (low_in(j), low_out(i), low_in(i))]
    return vertices, triangles


def plane():
    """The half space z ≤ 0 as a primitive."""
    return 'Plane(name: "plane", normal: (0.0, 0.0, 1.0), offset: 0.0)'


def model(name, surface_text, *primitives):
    """The text of a model whose closed parts are solids."""
    return (
        f'(format: "pong-model", version: 1, name: "{name}", surfaces: {{ "surface": {surface_text} }},'
        f' root: (name: "{name}", surface: "surface", contact: Solid, primitives: [{", ".join(primitives)}]))'
    )


class Pair:
    """A body and a fixed one; the answer is the wrench on the body."""

    def __init__(self, shape, surface_text, ground, ground_surface):
        builder = pong.WorldBuilder()
        for name, text, primitive in (("body", surface_text, shape), ("ground", ground_surface, ground)):
            builder.create_object(builder.add_model(pong.Model.parse(model(name, text, primitive))), name)
        builder.pair("body", "ground")
        self.world = builder.seal()

    def wrench(self, place, rotation=UNTURNED, velocity=(0.0, 0.0, 0.0), about=None):
        """Force on the body and moment about a point (default: its origin), both in the common frame. No earlier frame
        counts. `rotation` is a quaternion (w, x, y, z)."""
        self.world.clear_contact_history("body")
        still = (0.0, 0.0, 0.0)
        self.world.set_states(
            position=[place, still], orientation=[rotation, UNTURNED], linear_velocity=[velocity, still]
        )
        self.world.evaluate()
        wrench = self.world.wrenches()[0]
        about = np.array(place if about is None else about)
        force = wrench[:3].copy()
        self.faces = int((self.world.contacts()["normal_force"] > 0).sum())
        return force, wrench[3:] + np.cross(np.array(place) - about, force)

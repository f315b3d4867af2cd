# SPDX-License-Identifier: GPL-3.0-or-later
"""Faulty scenes: each function makes one and is named after the rule it breaks (with `_` for `-`).

`FAULTY` maps every rule to a snapshot. Each scene is right but for its one fault.
"""

import math
from dataclasses import replace

from support import STEEL, author, np, scene
from core.author import box, changed, cylinder, mesh
from core.marks import Part
from core.model import Tagged
from core.snapshot import Mesh

FAULTY = {}
TURN = math.pi / 4
SQUARE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]


def faulty(make):
    """Registers a scene: a function that returns an authored scene or a snapshot."""
    made = make()
    FAULTY[make.__name__.strip("_").replace("_", "-")] = made.snapshot() if isinstance(made, author.Scene) else made
    return make


def good():
    """A scene without a fault: a block in a group, with a ball beside it."""
    s = scene()
    arm = s.group("arm", location=(1.0, 0.0, 0.0))
    s.mesh("block", "Polyhedron", box((1.0, 1.0, 1.0)), above=arm)
    s.primitive("ball", "Sphere", above=arm, radius=0.1)
    return s


def part(s, name):
    return next(thing for thing in s.objects if thing.name == name)


def with_change(name, **more):
    s = good()
    changed(part(s, name), **more)
    return s


def one(kind, shape=None, **more):
    """A scene of one primitive."""
    s = scene()
    if shape is None:
        s.primitive("thing", kind, **more)
    else:
        s.mesh("thing", kind, shape, **more)
    return s


def solid(change):
    """A scene with a box whose vertices and faces are modified by `change`."""
    vertices, faces = box((1.0, 1.0, 1.0)).vertices.copy(), [list(map(int, f)) for f in BOX_FACES]
    return one("Polyhedron", mesh(*change(vertices, faces)))


BOX_FACES = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]


# --- the tree ------------------------------------------------------------------------------------------------------


@faulty
def no_root():
    return with_change("model", role="group")


@faulty
def several_roots():
    s = good()
    other = s.empty("other", "root", above=None)
    s.primitive("tip", "Point", above=other)
    return s


@faulty
def nested_root():
    s = good()
    changed(part(s, "arm"), role="root")
    s.group("hand", surface="steel")
    s.primitive("tip", "Point", above=part(s, "hand"))
    return s


@faulty
def outside_root():
    s = good()
    s.objects.append(replace(part(s, "ball"), name="lost", parent=None))
    return s


@faulty
def unknown_parent():
    return with_change("ball", parent="ghost")


@faulty
def parent_loop():
    s = good()
    a = s.empty("a", "none", above=None)
    s.empty("b", "none", above=a)
    changed(a, parent="b")
    return s


@faulty
def repeated_object():
    s = good()
    s.objects.append(replace(part(s, "ball")))
    return s


@faulty
def parent_type():
    return with_change("ball", parent_type="BONE")


@faulty
def hidden_object():
    return with_change("ball", hidden=True)


@faulty
def excluded_object():
    return with_change("ball", excluded=True)


@faulty
def constraint():
    return with_change("arm", constraints=["Copy Location"])


@faulty
def edit_mode():
    return good().snapshot(edit_mode="block")


@faulty
def unit_scale():
    return good().snapshot(unit_scale=0.0)


@faulty
def collection_instance():
    return with_change("arm", instance_of="wheels")


@faulty
def unknown_role():
    return with_change("ball", role="friend")


@faulty
def mark_version():
    return with_change("ball", version=99)


@faulty
def group_type():
    return with_change("arm", type="LATTICE")


@faulty
def empty_group():
    s = good()
    s.group("nothing")
    return s


@faulty
def groups_and_primitives():
    s = good()
    s.primitive("stray", "Point")
    return s


@faulty
def group_below_primitive():
    s = scene()
    ball = s.primitive("ball", "Sphere", radius=0.1)
    s.primitive("tip", "Point", above=s.group("arm", above=ball))
    return s


@faulty
def unknown_bound():
    return with_change("arm", bound="Capsule")


@faulty
def bound_above():
    return with_change("arm", bound="Above", movable=True)


def _named(name):
    s = good()
    part(s, "ball").mark.name = name
    return s


@faulty
def empty_name():
    return _named(" ")


@faulty
def slash_in_name():
    return _named("left/right")


@faulty
def repeated_name():
    return _named("block")


@faulty
def no_surface():
    return with_change("model", surface="")


@faulty
def unknown_surface():
    return with_change("arm", surface="steal")


# --- transforms ----------------------------------------------------------------------------------------------------


@faulty
def transform_not_finite():
    return with_change("arm", location=(math.nan, 0.0, 0.0))


@faulty
def zero_scale():
    return with_change("ball", scale=(1.0, 0.0, 1.0))


@faulty
def zero_rotation():
    return with_change("ball", rotation=(0.0, 0.0, 0.0, 0.0))


@faulty
def unknown_rotation_mode():
    return with_change("ball", rotation_mode="XXY")


def _stretched():
    """A group scaled along x, with a rotated object below it."""
    s = scene()
    return s, s.group("stretched", scale=(2.0, 1.0, 1.0))


@faulty
def sheared_group():
    s, stretched = _stretched()
    turned = s.group("turned", above=stretched, rotation_mode="XYZ", rotation=(0.0, 0.0, TURN))
    s.primitive("tip", "Point", above=turned)
    return s


@faulty
def sheared_sphere():
    s, stretched = _stretched()
    s.primitive("ball", "Sphere", above=stretched, radius=0.1, rotation_mode="XYZ", rotation=(0.0, 0.0, TURN))
    return s


@faulty
def sheared_ellipsoid():
    s, stretched = _stretched()
    turned = {"rotation_mode": "XYZ", "rotation": (0.0, 0.0, TURN)}
    s.primitive("egg", "Ellipsoid", above=stretched, semi_axes=(0.1, 0.2, 0.3), **turned)
    return s


# --- kinds ---------------------------------------------------------------------------------------------------------


@faulty
def primitive_type():
    return with_change("ball", type="CURVE")


@faulty
def no_mesh():
    return with_change("block", mesh=None)


@faulty
def no_kind():
    return with_change("ball", kind="")


@faulty
def unknown_kind():
    return with_change("ball", kind="Torus")


@faulty
def needs_mesh():
    return one("Polyhedron")


@faulty
def sheared_round():
    s, stretched = _stretched()
    turned = {"rotation_mode": "XYZ", "rotation": (0.0, 0.0, TURN)}
    s.primitive("pin", "Cylinder", above=stretched, radius=0.1, length=0.3, **turned)
    return s


@faulty
def axis_not_shown():
    """A pin whose mesh lies along x."""
    pin = cylinder(0.1, -0.3, 0.3, 16)
    pin.vertices = pin.vertices[:, [2, 0, 1]]
    return one("Cylinder", pin, length=0.6, radius=0.1)


@faulty
def pieces_not_round():
    """Modifiers that split one piece into two, but make no pins."""
    dented = mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0.1, 0.1, 1)], [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
    two = mesh([*dented.vertices, *(dented.vertices + (3, 0, 0))], [[0, 2, 1], [0, 1, 3], [4, 6, 5], [4, 5, 7]])
    return one("Cylinder", two, stored_mesh=dented, modifiers=["Array"], length=1.0, radius=0.1)


@faulty
def uneven_round():
    return one("Cylinder", radius=0.1, length=0.3, scale=(1.0, 2.0, 1.0))


@faulty
def no_radius():
    return one("Sphere")


@faulty
def size_range():
    return one("Sphere", radius=1e-31)


@faulty
def no_semi_axes():
    return one("Ellipsoid", semi_axes=(0.1, 0.0, 0.1))


@faulty
def no_length():
    return one("Ray")


@faulty
def negative_reach():
    return one("Ray", length=0.1, reach=-0.01)


@faulty
def unknown_response():
    return one("Ray", length=0.1, response="Sideways")


@faulty
def thickness():
    return one("TriangleMesh", mesh(SQUARE, [[0, 1, 2, 3]]), thickness=0.0)


@faulty
def no_custom_kind():
    return one("Custom")


@faulty
def custom_place():
    return one("Custom", custom_kind="torus", location=(1.0, 0.0, 0.0))


@faulty
def no_vertices():
    return one("Point", mesh([]))


@faulty
def no_edges():
    return one("LineSegment", mesh([(0, 0, 0), (1, 0, 0)]))


@faulty
def no_faces():
    return one("TriangleMesh", mesh([(0, 0, 0), (1, 0, 0)], edges=[(0, 1)]))


@faulty
def zero_length():
    return one("LineSegment", mesh([(0, 0, 0), (0, 0, 0), (1, 0, 0)], edges=[(0, 1), (1, 2)]))


@faulty
def plane_faces():
    return one("Plane", box((1.0, 1.0, 1.0)))


# --- meshes --------------------------------------------------------------------------------------------------------


@faulty
def not_finite():
    return one("Point", mesh([(0.0, math.inf, 0.0)]))


@faulty
def index_out_of_range():
    return one("TriangleMesh", Mesh(np.zeros((2, 3)), np.zeros((0, 2), int), np.array([0, 1, 2]), np.array([0, 3])))


@faulty
def too_few_vertices():
    return one("TriangleMesh", mesh(SQUARE, [[0, 1, 2], [2, 3]], edges=[]))


@faulty
def repeated_index():
    return one("TriangleMesh", mesh(SQUARE, [[0, 1, 2, 1]], edges=[]))


@faulty
def not_a_triangle():
    return one("Triangle", mesh(SQUARE, [[0, 1, 2, 3]]))


@faulty
def self_crossing_face():
    return one("TriangleMesh", mesh(SQUARE, [[0, 1, 3, 2]]))


@faulty
def sliver_triangle():
    return one("TriangleMesh", mesh([(0, 0, 0), (1, 0, 0), (2, 0, 0)], [[0, 1, 2]]))


@faulty
def duplicate_triangle():
    s = scene()
    for name, side in (("left", 0.0), ("right", 1.0)):
        group = s.group(name, location=(side, 0.0, 0.0))
        s.mesh(f"{name}_sheet", "TriangleMesh", mesh(np.array(SQUARE[:3]) - (side, 0, 0), [[0, 1, 2]]), above=group)
    return s


@faulty
def too_few_faces():
    return one("Polyhedron", mesh(SQUARE, [[0, 1, 2], [0, 2, 3]]))


@faulty
def open_polyhedron():
    return solid(lambda vertices, faces: (vertices, faces[1:]))


@faulty
def inside_out():
    return solid(lambda vertices, faces: (vertices, [face[::-1] for face in faces]))


@faulty
def zero_volume():
    return solid(lambda vertices, faces: (vertices * (1.0, 1.0, 1e-8), faces))


TETRAHEDRON = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]


@faulty
def zero_length_edge():
    """Two of four vertices coincide: without the edge between them no solid is left."""
    return one("Polyhedron", mesh([(0, 0, 0), (0, 0, 0), (1, 0, 0), (0, 0, 1)], TETRAHEDRON))


@faulty
def sliver_face():
    """A face without width; where it joins another, no solid is left."""
    return one("Polyhedron", mesh([(0, 0, 0), (1, 0, 0), (0.5, 1e-10, 0), (0, 0, 1)], TETRAHEDRON))


@faulty
def face_not_planar():
    def bent(vertices, faces):
        vertices[7] += (0.01, 0.0, 0.01)
        return vertices, faces

    return solid(bent)


@faulty
def not_convex():
    """A box with a pit: four triangles down from its top."""

    def pitted(vertices, faces):
        a, b, c, d = faces[1]
        return [*vertices, (0.0, 0.0, 0.2)], [faces[0], *faces[2:], [a, b, 8], [b, c, 8], [c, d, 8], [d, a, 8]]

    return solid(pitted)


@faulty
def face_not_convex():
    """A dent in the base of a spire, so shallow that no vertex is in front of any plane."""
    base = [(0.0, 0.0, 0.0), (2.0, 0.0, 0.0), (2.0, 2.0, 0.0), (1.0, 1.95, 0.0), (0.0, 2.0, 0.0)]
    sides = [[i, (i + 1) % 5, 5] for i in range(5)]
    return one("Polyhedron", mesh([*base, (1.0, 1.0, 2e-5)], [[4, 3, 2, 1, 0], *sides]))


@faulty
def rounded_away():
    """A valid slab, modelled 1 km from its group's origin, as rounded by Blender."""
    c, s = math.cos(0.3), math.sin(0.3)
    turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]) @ np.array([[1, 0, 0], [0, c, -s], [0, s, c]])
    shape = box((1.0, 1.0, 1.0))
    shape.vertices = (shape.vertices @ turn.T + (1000.0, 777.0, 333.0)).astype(np.float32).astype(np.float64)
    return one("Polyhedron", shape)


# --- parts and faces -----------------------------------------------------------------------------------------------


def _with_part(**fields):
    return one("", mesh(SQUARE, [[0, 1, 2, 3]]), parts=[Part("part", **fields)])


@faulty
def left_over_part():
    s = one("Polyhedron", box((1, 1, 1)))
    part(s, "thing").left_over = [Part("pong_Point_0f", "Point", vertices=[0])]
    return s


@faulty
def parts_and_modifiers():
    stored = mesh(SQUARE, [[0, 1, 2, 3]])
    parts = [Part("part", "Point", vertices=[0])]
    return one("", box((1, 1, 1)), stored_mesh=stored, modifiers=["Solidify"], parts=parts)


@faulty
def part_kind():
    return _with_part(kind="Sphere", vertices=[0])


@faulty
def empty_part():
    return _with_part(kind="Triangle")


@faulty
def part_elements():
    return _with_part(kind="Point", vertices=[0], faces=[0])


@faulty
def part_out_of_range():
    return _with_part(kind="Point", vertices=[4])


@faulty
def part_repeats():
    return _with_part(kind="Point", vertices=[1, 1])


@faulty
def inactive_faces_kind():
    return one("TriangleMesh", mesh(SQUARE, [[0, 1, 2, 3]]), inactive_faces=[0])


@faulty
def inactive_out_of_range():
    return one("Polyhedron", box((1, 1, 1)), inactive_faces=[6])


@faulty
def inactive_and_modifiers():
    stored = mesh(SQUARE, [[0, 1, 2, 3]])
    return one("Polyhedron", box((1, 1, 1)), stored_mesh=stored, modifiers=["Solidify"], inactive_faces=[0])


# --- mesh files ----------------------------------------------------------------------------------------------------


@faulty
def file_kind():
    return one("Point", file="points.obj")


@faulty
def mesh_file_outside():
    return one("Polyhedron", box((1, 1, 1)), file="../block.obj")


@faulty
def mesh_file_kind():
    return one("Polyhedron", box((1, 1, 1)), file="block.ply")


@faulty
def file_holds_triangles():
    return one("Polyhedron", box((1, 1, 1)), file="block.stl")


@faulty
def file_twice():
    s = one("Polyhedron", box((1, 1, 1)), file="block.obj")
    s.mesh("other", "Polyhedron", box((1, 1, 1), (3, 0, 0)), file="block.obj")
    return s


@faulty
def file_scale():
    return one("Polyhedron", box((1, 1, 1)), file="block.obj", file_scale=0.0)


@faulty
def file_pieces():
    a, b = box((1, 1, 1)), box((1, 1, 1), (3, 0, 0))
    faces = [*np.array(BOX_FACES).tolist(), *(np.array(BOX_FACES) + 8).tolist()]
    return one("Polyhedron", mesh([*a.vertices, *b.vertices], faces), file="blocks.obj")


# --- solids --------------------------------------------------------------------------------------------------------


def _solid(kind="TriangleMesh", shape=None, **more):
    s = one(kind, box((1, 1, 1)) if shape is None else shape, **more)
    changed(s.root, contact="Solid")
    return s


def _turned_box():
    return mesh(box((1, 1, 1)).vertices, [face[::-1] for face in BOX_FACES])


def _open_box():
    return mesh(box((1, 1, 1)).vertices, BOX_FACES[:-1])


@faulty
def unknown_contact():
    return with_change("arm", contact="Automatic")


@faulty
def solid_corner():
    s = _solid("Polyhedron")
    changed(part(s, "thing"), parts=[Part("feet", "Point", vertices=[0, 1])])
    return s


@faulty
def open_solid():
    return _solid(shape=_open_box())


@faulty
def solid_thickness():
    return _solid(shape=_open_box(), thickness=0.9)


@faulty
def solid_volume():
    return _solid(shape=_turned_box())


@faulty
def solid_two_sided():
    return _solid(two_sided=True)


def _walled():
    """Two halves of a bar in two groups of one body, joined by an internal face."""
    s = scene()
    changed(s.root, contact="Solid")
    for group, name, x, wall in (("a", "left", 0.0, 5), ("b", "right", 1.0, 4)):
        above = s.group(group)
        s.mesh(name, "Polyhedron", box((1, 1, 1), (x, 0, 0)), above=above, inactive_faces=[wall])
    return s


@faulty
def solid_surfaces():
    s = _walled()
    s.root.settings.surfaces = {**STEEL, "ice": {"stiffness": 1e5}}
    changed(part(s, "right"), surface="ice")
    return s


@faulty
def solid_contact():
    s = _walled()
    changed(part(s, "b"), contact="Marked")
    return s


# --- surfaces ------------------------------------------------------------------------------------------------------


def _with_surface(pairs=(), **fields):
    s = good()
    s.root.settings.surfaces = {**STEEL, "odd": fields} if fields else dict(STEEL)
    s.root.settings.pairs = list(pairs)
    return s


@faulty
def missing_field():
    return _with_surface(friction={"Bristle": {"mu": 0.2}})


@faulty
def unknown_field():
    return _with_surface(stiffness=1e6, stiffnes=1e6)


@faulty
def wrong_type():
    return _with_surface(stiffness="hard")


@faulty
def not_positive():
    return _with_surface(stiffness=0.0)


@faulty
def stiffness_range():
    return _with_surface(stiffness=1e101)


@faulty
def foundation_range():
    return _with_surface(stiffness=1e6, area=1e-99)


@faulty
def foundation_law():
    return _with_surface(stiffness=math.inf, foundation=1e9)


@faulty
def too_large():
    return _with_surface(stiffness=1e6, friction=Tagged("Bristle", {"mu": 1e101}))


@faulty
def negative():
    return _with_surface(stiffness=1e6, friction=Tagged("Bristle", {"mu": -0.2}))


@faulty
def exponent():
    return _with_surface(stiffness=1e6, normal=Tagged("HuntCrossley", {"exponent": 2.0}))


@faulty
def damping_exponent():
    return _with_surface(stiffness=1e6, normal=Tagged("PowerLaw", {"exponent": 1.0, "damping_exponent": 1.5}))


@faulty
def either_or():
    law = {"damping": 1.0, "restitution": {"e": 0.5, "mass": 1.0}}
    return _with_surface(stiffness=1e6, normal={"Linear": law})


@faulty
def restitution_range():
    return _with_surface(stiffness=1e6, normal={"Linear": {"restitution": {"e": 1.5, "mass": 1.0}}})


@faulty
def restitution_of_rigid():
    return _with_surface(stiffness=math.inf, normal={"Linear": {"restitution": {"e": 0.5, "mass": 1.0}}})


@faulty
def restitution_without_stiffness():
    law = {"Linear": {"restitution": {"e": 0.5, "mass": 1.0}}}
    return _with_surface([{"surfaces": ("steel", "steel"), "normal": law}])


@faulty
def repeated_pair():
    return _with_surface([{"surfaces": ("steel", "ice"), "stiffness": 1.0}, {"surfaces": ("ice", "steel")}])

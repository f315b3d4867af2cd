# SPDX-License-Identifier: GPL-3.0-or-later
"""Property groups of marks and model settings, and their conversion to and from the core's classes.

`Object.pong` is what an object is to the engine, `Object.pong_model` what belongs to a whole model, on its root. They
are on the object, never on its mesh, which others may share.
"""

import bpy

from ..core.marks import KINDS, VERSION, Mark, ModelSettings, Part
from ..core.round_shape import ROUND_KINDS
from . import elements, numbers, spec, surfaces
from .changes import OVERRIDABLE, changed, watched
from .references import unique_name

ROLES = [
    ("none", "None", "The engine does not see this object, but what hangs below it"),
    ("root", "Root", "The whole model; its origin is that of the model"),
    ("group", "Group", "Holds groups or primitives"),
    ("primitive", "Primitive", "Touches others"),
]
KIND_TIPS = {
    "Point": "An empty's origin, or every vertex of a mesh",
    "LineSegment": "Every edge of a mesh",
    "Ray": "A plunger: from an empty along its z axis, or every edge from its first vertex to its second",
    "Sphere": "A ball around the object's origin",
    "Ellipsoid": "An ellipsoid around the object's origin, along its axes",
    "Plane": "Everything behind a plane: through an empty's origin across its z axis, or that of a mesh's only face",
    "Triangle": "Every face of a mesh, all of them triangles",
    "TriangleMesh": "All faces of a mesh, cut into triangles",
    "Polyhedron": "A convex solid; each connected piece of a mesh is one of its own",
    "Capsule": "A bar with ball ends, such as a link of a cable: along the object's z axis, around its origin",
    "Cylinder": "A round solid with flat ends: along the object's z axis, around its origin",
    "Cone": "A solid with a radius at each end, one of which may be zero: along the object's z axis",
    "Bore": "The wall of a round or tapered hole, open at both ends: along the object's z axis",
}
KIND_ITEMS = [("NONE", "None", "Nothing")] + [(kind, kind, KIND_TIPS.get(kind, "")) for kind in KINDS]
# Files of Blender hold the numbers.
BOUND_ITEMS = [
    ("Default", "Default", "A box for a movable group and around other volumes; otherwise none", 0, 4),
    ("Aabb", "Box", "Box along the axes of the movable group", 0, 0),
    ("Sphere", "Sphere", "Ball", 0, 1),
    ("Obb", "Oriented Box", "Box that fits best", 0, 2),
    ("Above", "None", "No volume of its own: what it holds counts to the group above", 0, 3),
]
CONTACT_ITEMS = [
    ("Default", "As Above", "That of the group above; of a root, Marked", 0),
    ("Solid", "Solid", "Closed meshes and polyhedra touch other solids and planes by the volume that they share", 1),
    ("Marked", "Marked", "Points, segments, rays and round parts touch faces; faces alone touch nothing", 2),
    ("Automatic", "Automatic", "Of a root: Solid if all shapes are closed and no corner, edge or part is marked by hand; "
                               "otherwise Marked", 3),
]
# Blender shows lengths in the scene's unit, without trailing zeros: 0.25 mm.
LENGTH = {"subtype": "DISTANCE", "unit": "LENGTH", "min": 0.0, "precision": 6}


def shown_size(mark):
    """Display size of an empty with a mark of its kind; None for kinds without size."""
    sizes = {"Sphere": mark.radius, "Ellipsoid": max(mark.semi_axes), "Ray": mark.length}
    sizes.update(dict.fromkeys(ROUND_KINDS, mark.length / 2.0))
    return sizes.get(mark.kind) or None


def show_size(obj):
    """Gives an empty the size of its mark, so that scaling it differs from its mark."""
    size = shown_size(obj.pong) if obj.type == "EMPTY" else None
    if size is not None:
        obj.empty_display_size = size


def _show_size(mark):
    show_size(mark.id_data)


@watched
class PONG_PG_part(bpy.types.PropertyGroup):
    """Some elements of a mesh as primitives of one kind."""

    name: bpy.props.StringProperty(name="Name")
    kind: bpy.props.EnumProperty(name="Kind", items=KIND_ITEMS)
    surface: bpy.props.StringProperty(name="Surface", description="Empty: that of the object")
    attribute: bpy.props.StringProperty(options={"HIDDEN"})  # of the mesh


@watched
class PONG_PG_mark(bpy.types.PropertyGroup):
    """Properties of one object for the engine; core/marks.py gives the data that each kind takes from its object."""

    role: bpy.props.EnumProperty(name="Role", items=ROLES)
    version: bpy.props.IntProperty(default=0, options={"HIDDEN"})  # 0: never marked
    label: bpy.props.StringProperty(name="Name", description="In the model. Empty: the object's name")
    surface: bpy.props.StringProperty(name="Surface", description="Empty: that of the group above")
    movable: bpy.props.BoolProperty(name="Movable", description="A rigid body of its own, whose state the host gives")
    bound: bpy.props.EnumProperty(name="Bound", items=BOUND_ITEMS, default="Default",
                                    description="Bounding volume around all below")
    custom_bound: bpy.props.StringProperty(name="Custom Bound", description="A registered kind of volume instead")
    leaf_size: bpy.props.IntProperty(name="Leaf Size", min=0, description="Most elements of a leaf. 0: no limit")
    contact: bpy.props.EnumProperty(name="Contact", items=CONTACT_ITEMS, default="Default",
                                    description="What makes the shapes below touch others")
    order: bpy.props.IntProperty(name="Order", min=0, description="Place among siblings, from 1. 0: behind, by name")
    kind: bpy.props.EnumProperty(name="Kind", items=KIND_ITEMS)
    radius: numbers.number("radius_64", name="Radius", shown=_show_size, **LENGTH)
    semi_axes: numbers.vector("semi_axes_64", name="Semi-axes", shown=_show_size,
                              **{**LENGTH, "subtype": "XYZ_LENGTH"})
    radii: numbers.vector("radii_64", (0.0, 0.0), name="Radii", description="At the end at -z and at the one at +z",
                          **{**LENGTH, "subtype": "NONE"})
    length: numbers.number("length_64", name="Length", description="Free length of the plunger; of a round part from end to "
                           "end of its axis, without the balls of a capsule", shown=_show_size, **LENGTH)
    # The flag of a number comes after it: Blender sets those of an override in this order.
    reach: numbers.number("reach_64", name="Reach", description="How far behind the origin a surface is still hit", **LENGTH)
    use_reach: numbers.given("reach_64", name="Reach")
    response: bpy.props.EnumProperty(name="Response", items=[
        ("Normal", "Normal", "The force acts along the surface's normal"),
        ("Axial", "Axial", "The force acts along the ray")])
    thickness: numbers.number("thickness_64", name="Thickness",
                              description="How far behind its front a triangle still pushes forward, and behind its "
                                          "wall a bore", **LENGTH)
    use_thickness: numbers.given("thickness_64", default=0.01, name="Thickness")
    mouths: bpy.props.BoolVectorProperty(
        name="Mouths", size=2, default=(True, True),
        description="Whether the hole ends in an edge that pushes, at -z and at +z. Off where it goes on as another bore")
    two_sided: bpy.props.BoolProperty(name="Two-sided", description="Two surfaces back to back")
    inactive: bpy.props.StringProperty(options={"HIDDEN"})  # attribute of the mesh
    file: bpy.props.StringProperty(name="File", description="Write the mesh to this OBJ or STL file beside the model")
    file_scale: numbers.number("file_scale_64", default=1.0, name="File Scale", min=0.0, precision=6,
                               description="Metres in one unit of that file")
    custom_kind: bpy.props.StringProperty(name="Registered As", description="Kind that is registered with the engine")
    parameters: numbers.listed("parameters_64", name="Parameters")
    parts: bpy.props.CollectionProperty(type=PONG_PG_part)
    active_part: bpy.props.IntProperty()


@watched
class PONG_PG_model(bpy.types.PropertyGroup):
    """Settings of a whole model, on its root."""

    label: bpy.props.StringProperty(name="Model", description="Name of the model. Empty: the root's")
    entry_memory: bpy.props.BoolProperty(
        name="Entry Memory", default=True,
        description="Points and sphere centres remember through which face they entered a polyhedron")
    surfaces: bpy.props.CollectionProperty(type=surfaces.PONG_PG_surface)
    active_surface: bpy.props.IntProperty()
    pairs: bpy.props.CollectionProperty(type=surfaces.PONG_PG_pair)
    active_pair: bpy.props.IntProperty()
    filters: bpy.props.CollectionProperty(type=surfaces.PONG_PG_filter)
    active_filter: bpy.props.IntProperty()


# In the mark and in the property group.
SAME = (
    "role", "surface", "order", "movable", "bound", "custom_bound", "leaf_size", "contact", "response", "two_sided", "file",
    "custom_kind",
)
# Stored in full precision, and left out if not given.
NUMBERS = ("radius", "length", "reach", "thickness", "file_scale")
LISTS = {"semi_axes": tuple, "radii": tuple, "parameters": list}


def read_mark(obj):
    """The mark of an object, as the core has it."""
    group = obj.pong
    mark = Mark(version=group.version or VERSION, name=group.label, kind=_kind(group))
    for field in SAME:
        setattr(mark, field, getattr(group, field))
    mark.mouths = tuple(group.mouths)
    for field, value in read_numbers(obj).items():
        setattr(mark, field, value)
    if obj.type == "MESH":
        mark.inactive_faces = elements.indices(obj.data, group.inactive, "faces") if group.inactive else []
        mark.parts = [_part(obj.data, part) for part in group.parts]
    return mark


def read_numbers(obj):
    """Given numbers of an object's mark."""
    group, found = obj.pong, {}
    for field in NUMBERS:
        if field + numbers.SUFFIX in group:
            found[field] = float(group[field + numbers.SUFFIX])
    for field, make in LISTS.items():
        if field + numbers.SUFFIX in group:
            found[field] = make(float(value) for value in group[field + numbers.SUFFIX])
    return found


def write_numbers(obj, values):
    """Sets numbers of an object's mark; those at the defaults of a mark are removed."""
    for field, value in values.items():
        key = field + numbers.SUFFIX
        default = getattr(DEFAULTS, field)
        if value is None or value == default or (field in LISTS and not any(value)):
            obj.pong.pop(key, None)
        else:
            obj.pong[key] = [float(item) for item in value] if field in LISTS else float(value)
    show_size(obj)
    changed()


DEFAULTS = Mark()


def _kind(holder):
    return "" if holder.kind == "NONE" else holder.kind


def _part(mesh, part):
    chosen = {name: elements.indices(mesh, part.attribute, name) for name in elements.DOMAINS}
    return Part(name=part.name, kind=_kind(part), surface=part.surface, **chosen)


def left_over(obj):
    """(attribute, part) of marked elements that no object of the mesh names, left by joined objects."""
    mesh = obj.data
    ours = elements.attributes(mesh)
    if not ours:
        return []
    users = [obj] if mesh.users <= 1 else [other for other in bpy.data.objects if other.data == mesh]
    named = {name for user in users for name in attributes_of(user.pong)}
    found = []
    for attribute, sort, stem in ours:
        chosen = elements.indices(mesh, attribute, sort) if attribute not in named else []
        if chosen:
            found.append((attribute, Part(name=stem.lower(), kind=stem, **{sort: chosen})))
    return found


def adopt(obj, taken):
    """Makes parts (or inactive faces) of attributes left by joined objects; `taken` are names of parts."""
    group = obj.pong
    for attribute, part in left_over(obj):
        if part.kind == elements.INACTIVE:
            group.inactive = group.inactive or attribute
            if group.inactive != attribute:
                elements.mark(obj.data, group.inactive, "faces", part.faces)
                elements.forget(obj.data, attribute)
            continue
        made = group.parts.add()
        made.name = unique_name(part.name, taken)
        made.kind = part.kind if part.kind in KINDS else "NONE"
        made.attribute = attribute
        taken.add(made.name)
    changed()


def write_mark(obj, mark):
    """Sets the mark of an object."""
    group = obj.pong
    clear_mark(obj)
    group.version = mark.version
    group.label = mark.name
    group.kind = mark.kind or "NONE"
    for field in SAME:
        setattr(group, field, getattr(mark, field))
    group.mouths = mark.mouths
    write_numbers(obj, {field: getattr(mark, field) for field in (*NUMBERS, *LISTS)})
    if mark.inactive_faces:
        group.inactive = elements.new_attribute(elements.INACTIVE)
        elements.mark(obj.data, group.inactive, "faces", mark.inactive_faces)
    for part in mark.parts:
        add_part(obj, part)


def add_part(obj, part):
    """Marks elements of a mesh as a part."""
    made = obj.pong.parts.add()
    made.name, made.kind, made.surface = part.name, part.kind or "NONE", part.surface
    made.attribute = elements.new_attribute(part.kind or "part")
    for name in elements.DOMAINS:
        chosen = getattr(part, name)
        if chosen:
            elements.mark(obj.data, made.attribute, name, chosen)
    obj.pong.active_part = len(obj.pong.parts) - 1
    changed()
    return made


def remove_part(obj, index):
    part = obj.pong.parts[index]
    elements.forget(obj.data, part.attribute)
    obj.pong.parts.remove(index)
    obj.pong.active_part = max(0, min(obj.pong.active_part, len(obj.pong.parts) - 1))
    changed()


def attributes_of(group):
    """Attributes of the mesh that a mark names."""
    return [name for name in (group.inactive, *(part.attribute for part in group.parts)) if name]


def clear_mark(obj):
    """Removes an object's mark, with the attributes of its parts that no other object of the mesh names."""
    group = obj.pong
    if obj.type == "MESH" and not obj.data.library:
        users = [other for other in bpy.data.objects if other.data == obj.data] if obj.data.users > 1 else [obj]
        shared = {name for other in users if other != obj for name in attributes_of(other.pong)}
        for name in set(attributes_of(group)) - shared:
            elements.forget(obj.data, name)
    group.parts.clear()
    for name in group.bl_rna.properties.keys():
        if name not in ("rna_type", "name", "parts"):
            group.property_unset(name)
    for key in list(group.keys()):
        if key.endswith(numbers.SUFFIX):
            del group[key]
    changed()


def read_settings(root):
    """The settings of a model, as the core has them."""
    group = root.pong_model
    pairs = [{"surfaces": (pair.first, pair.second), **spec.from_plain(spec.read(pair))} for pair in group.pairs]
    return ModelSettings(
        name=group.label,
        entry_memory=group.entry_memory,
        surfaces={surface.name: spec.from_plain(spec.read(surface)) for surface in group.surfaces},
        pairs=pairs,
        filters=[(groups.first, groups.second) for groups in group.filters],
    )


def write_settings(root, settings):
    """Sets the model settings of a root."""
    group = root.pong_model
    group.label = settings.name
    group.entry_memory = settings.entry_memory
    group.surfaces.clear()
    group.pairs.clear()
    for name, fields in settings.surfaces.items():
        surfaces.add_surface(group, name, fields)
    for fields in settings.pairs:
        surfaces.add_pair(group, fields)
    group.filters.clear()
    for groups in settings.filters:
        surfaces.add_filter(group, *groups)


@bpy.app.handlers.persistent
def _compare_overrides(*_arguments):
    """Blender stores for an override the differences from its original, and ignores properties never set there."""
    for obj in bpy.data.objects:
        if obj.override_library is not None and obj.override_library.reference is not None:
            for each in (obj, obj.override_library.reference):  # a group is there once one of its values is set
                each.pong.active_part = each.pong.active_part
                each.pong_model.active_surface = each.pong_model.active_surface


CLASSES = (*surfaces.CLASSES, PONG_PG_part, PONG_PG_mark, PONG_PG_model)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Object.pong = bpy.props.PointerProperty(type=PONG_PG_mark, name="Pong", override=OVERRIDABLE)
    bpy.types.Object.pong_model = bpy.props.PointerProperty(
        type=PONG_PG_model, name="Pong Model", override=OVERRIDABLE)
    bpy.app.handlers.save_pre.append(_compare_overrides)


def unregister():
    bpy.app.handlers.save_pre.remove(_compare_overrides)
    del bpy.types.Object.pong_model
    del bpy.types.Object.pong
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Property groups of surfaces, of pairs of surfaces and of filters."""

import json

import bpy

from ..core.schema import SOLID_NUMBERS
from ..core.surfaces import derived
from . import spec
from .changes import changed, watched
from .spec import FIELDS

OF_PARTNER = "Of What It Meets"
NORMAL_LAWS = [
    ("DEFAULT", "Undamped", "A linear spring without damping", None),
    ("Linear", "Linear", "Spring and damper in parallel that never pull", {"damping": 0.0}),
    ("HuntCrossley", "Hunt-Crossley", "Damping that grows with depth", {"dissipation": 0.0, "exponent": 1.0}),
    ("PowerLaw", "Power Law", "Spring and damper by powers of the depth: the rebound depends on speed and mass",
     {"exponent": 1.5, "damping_exponent": 1.0, "damping": 0.0}),
    ("Custom", "Custom", "A law that is registered with the engine", {"name": "", "parameters": []}),
]
FRICTION_LAWS = [
    ("DEFAULT", "None Given", "No friction", None),
    ("None", "None", "No friction, of a rigid surface neither", {}),
    ("Bristle", "Bristle", "A bristle that sticks and slips", {"mu": 0.2}),
    ("Coulomb", "Coulomb", "Regularised: creeps under any load", {"mu": 0.2, "slip_speed": 0.001}),
    ("Custom", "Custom", "A law that is registered with the engine", {"name": "", "parameters": []}),
]
SERIES = [("DEFAULT", "Of both in series", "What the rule for two springs in series gives", None)]
# In a pair "no friction" differs from "the result of both surfaces".
PAIR_FRICTION_LAWS = SERIES + [("None", "None", "No friction between the two", {})] + FRICTION_LAWS[2:]
PAIR_NORMAL_LAWS = SERIES + NORMAL_LAWS[1:]
# A rigid surface takes no share of the deformation: values it does not give are decided by the partner.
RIGID_NORMAL_LAWS = [("DEFAULT", OF_PARTNER, "Law and damping of the surface that it meets", None)] + NORMAL_LAWS[1:]
RIGID_FRICTION_LAWS = [
    ("DEFAULT", OF_PARTNER, "Friction of the surface that it meets", None),
    ("None", "None", "No friction with anything", {}),
] + FRICTION_LAWS[2:]
AREA_M2 = 0.01  # of a contact of solids, where a surface begins to give a foundation or an area
SOFT = 1e6  # N/m, of a surface that was made rigid by a script or a file
FIRST_FRICTION = {"Bristle": {"mu": 0.2}}  # of a new surface


def _rigid(self):
    return spec.value_at(spec.read(self), ("stiffness",), 0.0) == float("inf")


def _set_rigid(self, rigid):
    """Removes stiffness, its area and default friction when a surface becomes rigid, and restores them when it is soft again."""
    if rigid == _rigid(self):
        return
    fields = spec.read(self)
    if rigid:
        soft = {name: fields.pop(name) for name in SOLID_NUMBERS if name in fields}
        soft["stiffness"] = fields.get("stiffness", SOFT)
        if fields.get("friction") == FIRST_FRICTION:
            soft["friction"] = fields.pop("friction")
        self.soft = json.dumps(soft)
        spec.write(self, {**fields, "stiffness": float("inf")})
    else:
        soft = json.loads(self.soft) if self.soft else {}
        spec.write(self, {**soft, **fields, "stiffness": soft.get("stiffness", SOFT)})


def shares_friction(self):
    """True if a rigid surface changes the friction of its partner."""
    return self.rigid and self.friction not in ("DEFAULT", "None")


def _exponent(self):
    return 1 if spec.value_at(spec.read(self), ("normal", FIELDS, "exponent"), 1.0) == 1.5 else 0


def _set_exponent(self, index):
    spec.put(self, ("normal", FIELDS, "exponent"), (1.0, 1.5)[index])


def _restitution(self):
    return spec.value_at(spec.read(self), ("normal", FIELDS, "restitution")) is not None


# Field replaced by the restitution of each law, and its companion field.
RESTITUTIONS = {
    "Linear": ("damping", {"mass": 1.0}),
    "HuntCrossley": ("dissipation", {"speed": 0.1}),
    "PowerLaw": ("damping", {"speed": 0.1, "mass": 1.0}),
}


def _derived(self, law, name):
    """The value of a law that the engine derives; 0 where nobody can tell, as for a pair without a stiffness."""
    value = (derived(spec.from_plain(spec.read(self))).get(law) or {}).get(name)
    return value if isinstance(value, (int, float)) else 0.0


def _set_restitution(self, on):
    """Switches between restitution and damping (or dissipation); what acts stays the same."""
    if on == _restitution(self):
        return
    law = next(iter(spec.read(self).get("normal") or {}), None)
    replaced, impact = RESTITUTIONS.get(law, RESTITUTIONS["HuntCrossley"])
    spec.put(self, ("normal", FIELDS, replaced), None if on else _derived(self, "normal", replaced))
    spec.put(self, ("normal", FIELDS, "restitution"), {"e": 0.5, **impact} if on else None)


def _bristle_given(key, other, start=None):
    """View of a bristle's damping, or of a mass for it; at most one is given. It starts with the damping that acts, or `start`."""

    def get(self):
        return spec.value_at(spec.read(self), ("friction", FIELDS, key)) is not None

    def set_(self, on):
        if on != get(self):
            begin = _derived(self, "friction", key) if start is None else start
            spec.put(self, ("friction", FIELDS, key), begin if on else None)
            if on:
                spec.put(self, ("friction", FIELDS, other), None)

    return {"get": get, "set": set_}


def _per_area(key, other, start):
    """View of the foundation or the area of a surface; at most one of them is given. It starts with what acts on `AREA_M2`."""

    def get(self):
        return spec.value_at(spec.read(self), (key,)) is not None

    def set_(self, on):
        if on != get(self):
            begin = start(spec.value_at(spec.read(self), ("stiffness",), SOFT), spec.value_at(spec.read(self), (other,)))
            spec.put(self, (key,), begin if on else None)
            if on:
                spec.put(self, (other,), None)

    return {"get": get, "set": set_}


def _stiffness_unit(self):
    return "N/m^1.5" if _exponent(self) else "N/m"


def _damping_unit(self):
    power = 1.0 + spec.value_at(spec.read(self), ("normal", FIELDS, "damping_exponent"), 0.0)
    return "N·s/m" if power == 1.0 else f"N·s/m^{power:.12g}"


# A number of both: unit, path, label, description. Scripts set `name`, in SI; panels show `name_text`, with its unit.
NUMBERS = {
    "stiffness": (_stiffness_unit, ("stiffness",), "Stiffness", "Force over depth of one contact"),
    "damping": (_damping_unit, ("normal", FIELDS, "damping"), "Damping",
                "Force over the speed at which a contact deepens; of a power law over that and a power of the depth"),
    "damping_exponent": ("", ("normal", FIELDS, "damping_exponent"), "Damping Exponent",
                         "Power of the depth that the damping goes with, 0 to the exponent of the spring"),
    "ramp": ("m", ("normal", FIELDS, "ramp"), "Ramp", "Depth over which the damping sets in"),
    "restitution": ("", ("normal", FIELDS, "restitution", "e"), "Restitution", "Rebound speed over impact speed"),
    "mass": ("kg", ("normal", FIELDS, "restitution", "mass"), "Mass", "Effective mass that one contact stops"),
    "speed": ("m/s", ("normal", FIELDS, "restitution", "speed"), "Speed", "Speed of the impact"),
    "dissipation": ("s/m", ("normal", FIELDS, "dissipation"), "Dissipation", "Damping over stiffness times depth"),
    "mu": ("", ("friction", FIELDS, "mu"), "μ", "Kinetic coefficient of friction"),
    "static_excess": ("", ("friction", FIELDS, "static_excess"), "Static Excess", "Breaks away at (1 + a)·μ"),
    "bristle_stiffness": ("N/m", ("friction", FIELDS, "stiffness"), "Bristle Spring",
                          "Stiffness of the bristle; two thirds of the normal stiffness unless given"),
    "bristle_damping": ("N·s/m", ("friction", FIELDS, "damping"), "Bristle Damper",
                        "Damping of the bristle: 0 is undamped; unless given, critical for the mass of the restitution, "
                        "or with the damping ratio of the normal law"),
    "bristle_mass": ("kg", ("friction", FIELDS, "mass"), "Bristle Mass", "Mass for which the bristle's damping is critical"),
    "rolling": ("m", ("friction", FIELDS, "rolling"), "Rolling", "Resistance to rolling: the moment over the normal force. Not for solids"),
    "spinning": ("m", ("friction", FIELDS, "spinning"), "Spinning",
                 "Resistance to spinning about the normal: the moment over the normal force. Not for solids"),
    "slip_speed": ("m/s", ("friction", FIELDS, "slip_speed"), "Slip Speed", "Speed at which the full force is reached"),
}


# Of a surface, not of a pair.
NUMBERS_OF_SURFACE = {
    "foundation": ("N/m^3", ("foundation",), "Foundation", "Stiffness of solids per area of contact"),
    "area": ("m^2", ("area",), "Area", "Area over which a solid has the stiffness; instead of a foundation"),
}


class Laws:
    """Common part of surfaces and pairs."""

    spec: bpy.props.StringProperty(options={"HIDDEN"})
    soft: bpy.props.StringProperty(options={"HIDDEN"})  # what becoming rigid has put away
    use_stiffness: spec.given("stiffness", default=1e6, name="Stiffness", description="Give a stiffness for the pair")
    rigid: bpy.props.BoolProperty(
        description="All the yield is the other's; so are damping and friction, unless they are given here",
        name="Rigid", get=_rigid, set=_set_rigid)
    use_ramp: spec.given("normal", FIELDS, "ramp", default=1e-4, name="Ramp")
    use_restitution: bpy.props.BoolProperty(name="From Restitution", get=_restitution, set=_set_restitution,
                                            description="Find the damping from the rebound speed over the impact speed")
    exponent: bpy.props.EnumProperty(name="Exponent", get=_exponent, set=_set_exponent, items=[
        ("LINEAR", "1", "Linear in depth", 0), ("HERTZ", "1.5", "Hertz: the stiffness is in N/m^1.5", 1)])
    normal_name: spec.text("normal", FIELDS, "name", name="Law")
    normal_parameters: spec.numbers("normal", FIELDS, "parameters", name="Parameters")
    use_static_excess: spec.given("friction", FIELDS, "static_excess", name="Static Excess")
    use_bristle_stiffness: spec.given("friction", FIELDS, "stiffness", default=1e5, name="Bristle Spring")
    use_bristle_damping: bpy.props.BoolProperty(name="Bristle Damper", **_bristle_given("damping", "mass"))
    use_bristle_mass: bpy.props.BoolProperty(name="Bristle Mass", **_bristle_given("mass", "damping", 1.0))
    use_rolling: spec.given("friction", FIELDS, "rolling", default=0.001, name="Rolling")
    use_spinning: spec.given("friction", FIELDS, "spinning", default=0.001, name="Spinning")
    friction_name: spec.text("friction", FIELDS, "name", name="Law")
    friction_parameters: spec.numbers("friction", FIELDS, "parameters", name="Parameters")


def _add_numbers(group, numbers):
    """Gives a property group its numbers, and their texts with units."""
    for name, (unit, path, label, tip) in numbers.items():
        most = 1.0 if name == "restitution" else None
        limit = {} if most is None else {"max": most}
        group.__annotations__[name] = spec.number(*path, name=label, description=tip, min=0.0, **limit)
        group.__annotations__[f"{name}_text"] = spec.quantity(unit, *path, name=label, description=tip, most=most)


_add_numbers(Laws, NUMBERS)
watched(Laws)


def _renamed(self, _context):
    """Renames this surface in all marks, parts and pairs that use it."""
    from .references import rename_surface

    old, self.known_as = self.known_as, self.name
    if old and old != self.name:
        rename_surface(self.id_data, old, self.name)
    changed()


class PONG_PG_surface(Laws, bpy.types.PropertyGroup):
    """One surface of a model."""

    name: bpy.props.StringProperty(name="Name", update=_renamed)
    known_as: bpy.props.StringProperty(options={"HIDDEN"})  # the name that others still use
    use_foundation: bpy.props.BoolProperty(
        name="Foundation", description="Give the stiffness of solids per area",
        **_per_area("foundation", "area", lambda stiffness, area: stiffness / (area or AREA_M2)))
    use_area: bpy.props.BoolProperty(
        name="Area", description="Give the area over which a solid has the stiffness",
        **_per_area("area", "foundation", lambda stiffness, foundation: stiffness / foundation if foundation else AREA_M2))
    normal: spec.law("normal", NORMAL_LAWS, RIGID_NORMAL_LAWS, name="Normal Force")
    friction: spec.law("friction", FRICTION_LAWS, RIGID_FRICTION_LAWS, name="Friction")


_add_numbers(PONG_PG_surface, NUMBERS_OF_SURFACE)
watched(PONG_PG_surface)


@watched
class PONG_PG_pair(Laws, bpy.types.PropertyGroup):
    """Values for two surfaces when they touch each other."""

    first: bpy.props.StringProperty(name="Surface")
    second: bpy.props.StringProperty(name="Surface", description="May belong to another model")
    normal: spec.law("normal", PAIR_NORMAL_LAWS, name="Normal Force")
    friction: spec.law("friction", PAIR_FRICTION_LAWS, name="Friction")


@watched
class PONG_PG_filter(bpy.types.PropertyGroup):
    """Two groups of a model that never touch each other."""

    first: bpy.props.StringProperty(name="Group", description="Path in the model, or a name that only one group has")
    second: bpy.props.StringProperty(name="Group", description="Path in the model, or a name that only one group has")


def add_surface(settings, name, fields):
    """Adds a surface to model settings; `fields` as the core has them."""
    surface = settings.surfaces.add()
    surface.known_as = name
    surface.name = name
    spec.write(surface, spec.to_plain(fields))
    return surface


def add_pair(settings, fields):
    pair = settings.pairs.add()
    fields = dict(fields)
    pair.first, pair.second = fields.pop("surfaces")
    spec.write(pair, spec.to_plain(fields))
    return pair


def add_filter(settings, first, second):
    groups = settings.filters.add()
    groups.first, groups.second = first, second
    return groups


CLASSES = (PONG_PG_surface, PONG_PG_pair, PONG_PG_filter)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Model file -> `Model`, every number kept to the last bit.

What is wrong with the file is told as the engine tells it (`ModelFaults`). Only notation, fields, types and names are
judged here, not the shapes: a model whose polyhedron is open can be read, looked at and mended.
"""

from __future__ import annotations

from pathlib import Path

from .model import Group, Model, Primitive
from .read_values import Fault, ModelFaults, Unreadable, ValueReader
from .ron_tree import Map, Node, RonError, Struct, Tuple, describe, parse
from .schema import PRIMITIVES, names

GROUP_FIELDS = ["name", "movable", "pose", "bound", "leaf_size", "surface", "groups", "primitives"]
MODEL_FIELDS = ["format", "version", "name", "entry_memory", "surfaces", "pairs", "root"]
KINDS_WITH_FILE = {"TriangleMesh": "triangles", "Polyhedron": "faces"}


def read_file(path) -> Model:
    """Reads a model file; raises `ModelFaults`, or `OSError` if there is no such file."""
    path = Path(path)
    try:
        text = path.read_bytes().decode("utf-8")
    except UnicodeDecodeError as error:
        cause = f"it is no UTF-8: byte {error.start}"
        raise ModelFaults([Fault(str(path), 1, 1, "model", "unreadable", cause, "save it as UTF-8")]) from None
    return read_text(text, str(path))


def read_text(text: str, file: str = "model") -> Model:
    """Reads the text of a model file; raises `ModelFaults`."""
    reader = ModelReader(text, file)
    try:
        model = reader.document(parse(text))
    except RonError as error:
        cure = "correct the notation; nothing behind this place was read"
        reader.fault(error.at, "model", error.rule, error.cause, cure)
    except Unreadable:
        pass
    if reader.faults:
        raise ModelFaults(reader.faults)
    return model


class ModelReader(ValueReader):
    """The levels of a model file, one method each."""

    def attempt(self, read, node: Node | None, *arguments, default=None):
        """`read(node, …)`, or `default` where there is no node or it is of no use."""
        if node is None:
            return default
        try:
            return read(node, *arguments)
        except Unreadable:
            return default

    def attempt_required(self, owner: Node, fields: dict, name: str, path: str, read, *arguments):
        try:
            return read(self.required(owner, fields, name, path), *arguments)
        except Unreadable:
            return None

    def document(self, node: Node) -> Model:
        fields = self.open(node, "model", MODEL_FIELDS)
        self.check_format(node, fields)
        name = self.attempt_required(node, fields, "name", "model", self.text_value, "model")
        if name == "":
            self.fault(fields["name"].at, "model", "empty-name", "the model has no name", "name it")
        memory = self.attempt(self.boolean, self.optional(fields, "entry_memory"), "model", default=True)
        surfaces = self.attempt_required(node, fields, "surfaces", "model", self.surfaces) or {}
        self.model_name = name
        pairs = self.attempt(self.pairs, self.optional(fields, "pairs"), surfaces, default=[])
        self.defined = surfaces
        root = self.attempt_required(node, fields, "root", "model", self.root)
        return Model(name, surfaces, root, pairs, memory)

    def check_format(self, node: Node, fields: dict[str, Node]) -> None:
        for name, expected, shown in (("format", "pong-model", '"pong-model"'), ("version", 1.0, "1")):
            found = self.attempt_required(node, fields, name, "model", lambda n: n)
            if found is not None and (found.value != expected or isinstance(found.value, bool)):
                shown_value = f'"{found.value}"' if isinstance(found.value, str) else describe(found.value)
                cause = f"the {name} is {shown_value}"
                self.fault(found.at, "model", name, cause, f"write {name}: {shown}")

    # --- surfaces ------------------------------------------------------------------------------------------------

    def surfaces(self, node: Node) -> dict[str, dict]:
        if isinstance(node.value, Map):
            entries = node.value.entries
        else:
            self.wrong_type(node, "surfaces", 'a map of surfaces { "steel": (stiffness: …), … }')
        surfaces: dict[str, dict] = {}
        for key, value in entries:
            name = self.attempt(self.text_value, key, "surfaces")
            if name is None:
                continue
            path = f"surfaces/{name}"
            if name == "":
                self.fault(key.at, path, "empty-name", "a surface without a name", "name it")
            if name in surfaces:
                cause = f'the surface "{name}" is defined twice'
                self.fault(key.at, path, "repeated-surface", cause, "keep one of them or rename one")
            surfaces[name] = self.attempt(self.surface, value, path, default={})
        return surfaces

    def surface(self, node: Node, path: str) -> dict:
        fields = self.open(node, path, ["stiffness", "normal", "friction"])
        surface = {"stiffness": self.attempt_required(node, fields, "stiffness", path, self.stiffness, path)}
        normal = self.attempt(self.normal_law, self.optional(fields, "normal"), path)
        if normal is not None:
            surface["normal"] = normal
            self.check_restitution(fields["normal"], normal, surface["stiffness"], path)
        friction = self.attempt(self.friction_law, self.optional(fields, "friction"), path)
        if friction is not None or ("friction" in fields and surface["stiffness"] == float("inf")):
            # A rigid surface that says none is another than one that leaves it to what it meets.
            surface["friction"] = friction
        return surface

    def stiffness(self, node: Node, path: str) -> float:
        value = self.any_number(node, path)
        if not value > 0.0:
            rule = "not-finite" if value != value else "not-positive"
            self.refuse(node, path, rule, f"the stiffness is {value}", "it must be above zero; `inf` is rigid")
        if value != float("inf"):
            self.in_range(node, path, "stiffness", value, ", or `inf`")
        return value

    def check_restitution(self, node: Node, law, stiffness: float | None, path: str) -> None:
        if law.name == "Linear" and "restitution" in law.fields and stiffness == float("inf"):
            cause = "a rigid surface has no damping that a restitution could set"
            cure = "give the damping, or the restitution on the softer surface or in `pairs`"
            self.fault(node.at, path, "restitution-of-rigid", cause, cure)

    def pairs(self, node: Node, surfaces: dict) -> list[dict]:
        pairs, seen = [], set()
        for index, item in enumerate(self.list_items(node, "pairs")):
            path = f"pairs[{index}]"
            pair = self.attempt(self.pair, item, path, surfaces)
            if pair is None:
                continue
            if frozenset(pair["surfaces"]) in seen:
                cause = f"the pair {pair['surfaces']} is listed twice"
                self.fault(item.at, path, "repeated-pair", cause, "keep one entry")
            seen.add(frozenset(pair["surfaces"]))
            pairs.append(pair)
        return pairs

    def pair(self, node: Node, path: str, surfaces: dict) -> dict:
        fields = self.open(node, path, ["surfaces", "stiffness", "normal", "friction"])
        names = self.required(node, fields, "surfaces", path)
        pair = {"surfaces": self.pair_names(names, path, surfaces)}
        if stiffness := self.optional(fields, "stiffness"):
            pair["stiffness"] = self.finite_stiffness(stiffness, path, "stiffness of a pair")
        if normal := self.optional(fields, "normal"):
            pair["normal"] = self.normal_law(normal, path)
            if "restitution" in pair["normal"].fields and pair["normal"].name == "Linear" and "stiffness" not in pair:
                cause = "a restitution of the pair needs the stiffness of the pair"
                cure = "add `stiffness: …` to this entry"
                self.refuse(normal, path, "restitution-without-stiffness", cause, cure)
        if "friction" in fields:
            # Here `None` has a meaning of its own: no friction between these two.
            node = fields["friction"]
            value = node.value
            some = isinstance(value, Tuple) and value.name == "Some" and len(value.items) == 1
            pair["friction"] = self.friction_law(value.items[0] if some else node, path)
        return pair

    def pair_names(self, node: Node, path: str, surfaces: dict) -> tuple[str, str]:
        if not isinstance(node.value, Tuple) or len(node.value.items) != 2 or node.value.name:
            self.wrong_type(node, path, 'two names ("steel", "rubber")')
        pair = tuple(self.text_value(item, path) for item in node.value.items)
        # `model/surface` is that surface of the model of that name.
        own = {*surfaces, *(f"{getattr(self, 'model_name', None)}/{surface}" for surface in surfaces)}
        if not any(name in own for name in pair):
            cause = f'neither "{pair[0]}" nor "{pair[1]}" is defined in this file'
            cure = "at least one must be; the other may be another model's"
            self.fault(node.at, path, "unknown-surface", cause, cure)
        return pair

    # --- groups and primitives -----------------------------------------------------------------------------------

    def root(self, node: Node) -> Group:
        return self.group(node, "", "root", set(), is_root=True)

    def group(self, node: Node, above: str, nameless: str, siblings: set, is_root: bool = False) -> Group:
        path = joined(above, authored_name(node) or nameless)
        fields = self.open(node, path, GROUP_FIELDS)
        name = self.name(node, fields, path, siblings)
        movable = self.attempt(self.boolean, self.optional(fields, "movable"), path)
        if is_root and movable is False:
            cure = "leave `movable` out; a model that never moves is given a constant state"
            self.fault(fields["movable"].at, path, "root-not-movable", "the root is always movable", cure)
        group = Group(name or "", movable=bool(movable) and not is_root)
        self.pose(fields, path, group, is_root)
        group.bound = self.attempt(self.bound, self.optional(fields, "bound"), path)
        if group.bound == "Above" and (is_root or group.movable):
            cause = "a movable group moves by itself and cannot do without a bounding volume"
            cure = "give it `Aabb`, `Sphere` or `Obb`, or leave `bound` out"
            self.fault(fields["bound"].at, path, "bound-above", cause, cure)
        group.leaf_size = self.attempt(self.leaf_size, self.optional(fields, "leaf_size"), path)
        group.surface = self.surface_name(self.optional(fields, "surface"), path)
        self.contents(node, fields, path, group)
        return group

    def pose(self, fields: dict[str, Node], path: str, group: Group, is_root: bool) -> None:
        node = self.optional(fields, "pose")
        if node is None:
            return
        if is_root:
            cure = "remove it; the host sets where the root is, or put a group below the root"
            cause = "the root has no group above that its pose could refer to"
            self.fault(node.at, path, "root-pose", cause, cure)
        parts = self.attempt(self.open, node, path, ["position", "orientation"], default={})
        group.position = self.attempt(self.vector, self.optional(parts, "position"), path)
        group.orientation = self.attempt(self.rotation, self.optional(parts, "orientation"), path)

    def bound(self, node: Node, path: str) -> str | None:
        kind = self.variant(node, path, ["Aabb", "Sphere", "Obb", "Above", "Custom"])
        if kind != "Custom":
            return None if kind == "Aabb" else kind
        if not isinstance(node.value, Tuple) or len(node.value.items) != 1:
            self.wrong_type(node, path, 'Custom("kind")')
        return f"Custom:{self.text_value(node.value.items[0], path)}"

    def leaf_size(self, node: Node, path: str) -> int | None:
        size = self.number(node, path)
        if size >= 1.0 and size == int(size):
            return int(size)
        cause = f"the size of a leaf is {size:g}"
        self.fault(node.at, path, "leaf-size", cause, "give a whole number of elements, at least 1")
        return None

    def name(self, node: Node, fields: dict, path: str, siblings: set) -> str | None:
        name = self.attempt_required(node, fields, "name", path, self.text_value, path)
        if name is None:
            return None
        at = fields["name"].at
        if name == "":
            self.fault(at, path, "empty-name", "the name is empty", "name it")
        if "/" in name:
            cure = "a `/` separates the names of a path; use another sign"
            self.fault(at, path, "slash-in-name", f'the name "{name}" contains a `/`', cure)
        if name in siblings:
            cause = f'the name "{name}" is taken by a sibling'
            self.fault(at, path, "repeated-name", cause, "names are unique within a group; rename one")
        siblings.add(name)
        return name

    def surface_name(self, node: Node | None, path: str) -> str | None:
        name = self.attempt(self.text_value, node, path)
        if name is not None and name not in self.defined:
            cure = f"choose from: {', '.join(self.defined)}"
            self.fault(node.at, path, "unknown-surface", f'there is no surface "{name}"', cure)
        return name

    def contents(self, node: Node, fields: dict[str, Node], path: str, group: Group) -> None:
        groups, primitives = self.optional(fields, "groups"), self.optional(fields, "primitives")
        if groups and primitives:
            cause, cure = (
                "a group holds groups or primitives, never both",
                "put the primitives into a group of their own",
            )
            self.fault(fields["primitives"].at, path, "groups-and-primitives", cause, cure)
        siblings: set[str] = set()
        for index, item in enumerate(self.attempt(self.list_items, groups, path, default=[])):
            group.groups.append(self.attempt(self.group, item, path, f"groups[{index}]", siblings))
        for index, item in enumerate(self.attempt(self.list_items, primitives, path, default=[])):
            group.primitives.append(self.attempt(self.primitive, item, path, index, siblings))
        if not group.groups and not group.primitives:
            cure = "give it `groups: [..]` or `primitives: [..]`, or remove it"
            self.fault(node.at, path, "empty-group", "a group without contents", cure)

    def primitive(self, node: Node, above: str, index: int, siblings: set) -> Primitive:
        path = joined(above, authored_name(node) or f"primitives[{index}]")
        kind = self.variant(node, path, PRIMITIVES)
        wanted = PRIMITIVES[kind]
        fields = self.open(node, path, ["name", "surface", *names(wanted)])
        name = self.name(node, fields, path, siblings)
        surface = self.surface_name(self.optional(fields, "surface"), path)
        values = self.read_fields(node, fields, wanted, path)
        if kind in KINDS_WITH_FILE:
            self.check_shape(node, fields, values, path, KINDS_WITH_FILE[kind])
        return Primitive(kind, name or "", values, surface)

    def check_shape(self, node: Node, fields: dict, values: dict, path: str, faces: str) -> None:
        inline = [name for name in ("vertices", faces) if name in values]
        if "file" in values and inline:
            cause = f"`file` and `vertices`/`{faces}` both give the shape"
            self.fault(fields["file"].at, path, "either-or", cause, "keep one of them")
        elif "file" not in values and len(inline) < 2:
            cause = "the shape is missing"
            cure = f'add `file: "…"`, or `vertices` and `{faces}`'
            self.fault(node.at, path, "missing-field", cause, cure)


def joined(above: str, name: str) -> str:
    return f"{above}/{name}" if above else name


def authored_name(node: Node) -> str | None:
    if isinstance(node.value, Struct):
        for name, _, value in node.value.fields:
            if name == "name" and isinstance(value.value, str):
                return value.value
    return None

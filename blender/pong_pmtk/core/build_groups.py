# SPDX-License-Identifier: GPL-3.0-or-later
"""Groups: frames, names, surfaces, and hierarchy.

A group's frame is a rotation and a place; what else its transform does (scale, mirror) is handed down as `rest` and
baked into what hangs below. Unmarked objects between a group and its contents only add their transforms.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from . import transforms
from .build_primitives import build_primitive
from .marks import BOUNDS, CONTACTS
from .model import Group, Primitive
from .naming import natural
from .scene import Scene
from .shape import Origin, Place, origin_of
from .snapshot import SnapshotObject
from .transforms import Affine, Local, TransformFault


@dataclass
class Item:
    """An object below a group, with its transform in the group's frame; `local` if that is its own."""

    thing: SnapshotObject
    affine: Affine
    local: Local | None


class GroupBuilder:
    def __init__(self, scene: Scene, surfaces: dict):
        self.scene, self.findings, self.surfaces = scene, scene.findings, surfaces
        self.origins: dict[int, Origin] = {}
        self.files: dict[str, bytes] = {}

    def group(self, thing: SnapshotObject, rest: np.ndarray, above_surface: str | None) -> Group:
        """A group without its pose; `rest` is the part of its transform outside the group's frame."""
        where, mark = self.scene.where(thing), thing.mark
        group = Group(thing.model_name, movable=mark.movable and mark.role != "root")
        if thing.type != "EMPTY":
            cause = f"a group that is a {thing.type.lower()}: what it shows would not be exported"
            self.findings.error("group-type", where, cause, "use an empty, and hang the object below it")
        group.bound = self.bound(thing)
        group.leaf_size = mark.leaf_size or None
        group.contact = self.contact(thing)
        group.surface = self.surface(thing)
        items = self.items(thing, Affine(rest, np.zeros(3)), transforms.is_identity(rest))
        self.contents(thing, group, items, group.surface or above_surface)
        return group

    def contents(self, thing: SnapshotObject, group: Group, items: list[Item], surface: str | None) -> None:
        where = self.scene.where(thing)
        below = [item for item in items if item.thing.mark.role == "group"]
        primitives = [item for item in items if item.thing.mark.role == "primitive"]
        if below and primitives:
            both = f'"{below[0].thing.name}" and "{primitives[0].thing.name}"'
            cause = f"a group holds groups or primitives, never both: {both}"
            self.findings.error("groups-and-primitives", where, cause, "put the primitives into a group of their own", fix="group-primitives")
        if not items and not any(child.name in self.scene.carrying for child in self.scene.children[thing.name]):
            self.findings.error(
                "empty-group", where, "a group without contents", "hang something below it, or unmark it"
            )
        for item in below:
            built = self.posed_group(item, surface)
            if built is not None:
                self.check_name(group.groups, built.name, item.thing)
                group.groups.append(built)
        for item in primitives:
            for primitive, origin in self.primitives(item, surface):
                self.check_name(group.primitives, primitive.name, item.thing)
                group.primitives.append(primitive)
                self.origins[id(primitive)] = origin

    def posed_group(self, item: Item, surface: str | None) -> Group | None:
        """A group with its pose in the frame of its parent."""
        thing, where = item.thing, self.scene.where(item.thing)
        signs = np.sign(np.asarray(thing.transform.scale) * np.asarray(thing.transform.delta_scale))
        frame = transforms.frame_of(item.affine.linear, signs)
        if frame is None:
            culprit = self.scaled_parent(thing)
            cause = f'it is sheared: it is turned below "{culprit}", which is scaled differently along its axes'
            cure = f'apply the scale of "{culprit}"'
            self.findings.error("sheared-group", where, cause, cure, fix="apply-scale")
            return None
        self.tell_rest(thing, frame.rest)
        rest = frame.rest
        plain = item.local is not None and (item.local.scale == 1.0).all()
        if np.allclose(rest, np.eye(3), rtol=0.0, atol=transforms.SCALE_TOLERANCE):
            rest = np.eye(3)
        group = self.group(thing, rest, surface)
        group.position = tuple(np.asarray(self.scene.metres(origin_of(item.affine, item.local))).tolist())
        if plain and item.local.quaternion is not None:
            group.orientation = item.local.quaternion
        else:
            group.orientation = transforms.matrix_quaternion(frame.rotation)
        return group

    def tell_rest(self, thing: SnapshotObject, rest: np.ndarray) -> None:
        where, scale = self.scene.where(thing), np.diag(rest)
        if np.prod(scale) < 0.0:
            cause = "it is mirrored: all below it is mirrored, and its faces turned round"
            self.findings.warn("mirrored-group", where, cause, "apply its scale to be sure", fix="apply-scale")
        elif np.abs(scale - 1.0).max() > transforms.SCALE_TOLERANCE:
            cause = f"it is scaled by {tuple(float(f'{s:.6g}') for s in scale)}, which is baked into all below it"
            self.findings.warn("scaled-group", where, cause, "apply its scale to be sure", fix="apply-scale")

    def scaled_parent(self, thing: SnapshotObject) -> str:
        """The nearest object above (or itself) whose scale differs along its axes."""
        here: SnapshotObject | None = self.scene.by_name.get(thing.parent) if thing.parent else None
        while here is not None:
            if np.ptp(np.abs(here.transform.scale)) > transforms.SCALE_TOLERANCE * np.max(np.abs(here.transform.scale)):
                return here.name
            here = self.scene.by_name.get(here.parent) if here.parent else None
        return thing.name

    def items(self, thing: SnapshotObject, affine: Affine, direct: bool) -> list[Item]:
        """Groups and primitives below an object down to the next groups, in the order they are written."""
        found = self.gather(thing, affine, direct, thing.mark.role == "primitive")
        return sorted(found, key=lambda item: sort_key(item.thing))

    def gather(self, above: SnapshotObject, affine: Affine, direct: bool, in_primitive: bool) -> list[Item]:
        found = []
        for thing in self.scene.children[above.name]:
            where = self.scene.where(thing)
            if thing.name not in self.scene.carrying:
                continue
            if thing.mark.role == "root":
                cause = "a root below another root"
                self.findings.error("nested-root", where, cause, "mark it as a group, or take it out of the tree")
                continue
            try:
                local = transforms.local_transform(thing)
            except TransformFault as fault:
                self.findings.error(fault.rule, where, fault.cause, fault.cure)
                continue
            here = affine @ local.matrix
            plain = local if direct and not local.has_parent_inverse else None
            if thing.mark.role == "group" and in_primitive:
                cause = f'a group below the primitive "{above.name}"'
                self.findings.error("group-below-primitive", where, cause, "parent it to the group above")
                continue
            if thing.mark.role in ("group", "primitive"):
                found.append(Item(thing, here, plain))
            if thing.mark.role != "group":
                found += self.gather(thing, here, False, in_primitive or thing.mark.role == "primitive")
        return found

    def primitives(self, item: Item, surface: str | None) -> list[tuple[Primitive, Origin]]:
        thing = item.thing
        place = Place(self.scene, thing, item.affine, item.local, self.scaled_parent(thing))
        own = self.surface(thing)
        made = build_primitive(place, own, self.files)
        for primitive, _ in made:
            self.check_surface(thing, primitive, own, surface)
        return made

    def check_surface(self, thing: SnapshotObject, primitive: Primitive, own: str | None, above: str | None) -> None:
        if primitive.surface is not None and primitive.surface != own and primitive.surface not in self.surfaces:
            self.unknown_surface(thing, primitive.surface)
        if (primitive.surface or above) is None:
            cause = "it has no surface, and no group above names one"
            if not any(f.rule == "no-surface" and f.object == thing.name for f in self.findings):
                self.findings.error(
                    "no-surface", self.scene.where(thing), cause, "assign a surface to it or to its group"
                )

    def surface(self, thing: SnapshotObject) -> str | None:
        name = thing.mark.surface
        if name and name not in self.surfaces:
            self.unknown_surface(thing, name)
        return name or None

    def unknown_surface(self, thing: SnapshotObject, name: str) -> None:
        cure = f"choose from: {', '.join(self.surfaces)}" if self.surfaces else "define surfaces on the root"
        self.findings.error("unknown-surface", self.scene.where(thing), f'there is no surface "{name}"', cure)

    def bound(self, thing: SnapshotObject) -> str | None:
        if thing.mark.custom_bound:
            return f"Custom:{thing.mark.custom_bound}"
        if thing.mark.bound == "Default":
            return None
        if thing.mark.bound not in BOUNDS:
            cause = f'its bounding volume is "{thing.mark.bound}"'
            self.findings.error("unknown-bound", self.scene.where(thing), cause, f"choose from: {', '.join(BOUNDS)}")
        if thing.mark.bound == "Above" and (thing.mark.movable or thing.mark.role == "root"):
            cause = "it moves by itself and cannot do without a bounding volume"
            self.findings.error("bound-above", self.scene.where(thing), cause, "give it a box, a sphere or an oriented box")
        return thing.mark.bound

    def contact(self, thing: SnapshotObject) -> str | None:
        """`contact` of a group as in a model file. That of an automatic root is chosen when the model is complete."""
        mark, allowed = thing.mark, CONTACTS if thing.mark.role == "root" else CONTACTS[:-1]
        if mark.contact not in allowed:
            cause = f'its contact is "{mark.contact}"'
            self.findings.error("unknown-contact", self.scene.where(thing), cause, f"choose from: {', '.join(allowed)}")
        return mark.contact if mark.contact in ("Solid", "Marked") else None

    def check_name(self, siblings, name: str, thing: SnapshotObject) -> None:
        check_name(self.scene, name, thing)
        if name in self.names_of(siblings):
            cause = f'the name "{name}" is taken by a sibling'
            cure = "names are unique within a group; give it another"
            self.findings.error("repeated-name", self.scene.where(thing), cause, cure, fix="rename")

    def names_of(self, siblings) -> set[str]:
        """Names of siblings, cached, to avoid walking all of them for each new one."""
        known = getattr(self, "_known", None)
        if known is None or known[0] is not siblings:
            known = self._known = (siblings, set())
        known[1].update(sibling.name for sibling in siblings[len(known[1]) :])
        return known[1]


def check_name(scene: Scene, name: str, thing: SnapshotObject) -> None:
    if not name.strip():
        scene.findings.error("empty-name", scene.where(thing), "its name is empty", "name it", fix="rename")
    if "/" in name:
        cause = f'the name "{name}" contains a `/`, which separates the names of a path'
        scene.findings.error("slash-in-name", scene.where(thing), cause, "use another sign", fix="rename")


def sort_key(thing: SnapshotObject) -> tuple:
    order = thing.mark.order
    return (order <= 0, order if order > 0 else 0, natural(thing.model_name), natural(thing.name))


def build_root(scene: Scene, root: SnapshotObject, surfaces: dict):
    """The root group, the source objects of its primitives, and mesh files by name.

    Where the root stands is up to the host: only its scale counts.
    """
    builder = GroupBuilder(scene, surfaces)
    check_name(scene, root.model_name, root)
    rest = np.eye(3)
    try:
        local = transforms.local_transform(root)
        rest = np.diag(local.scale)
        builder.tell_rest(root, rest)
    except TransformFault as fault:
        scene.findings.error(fault.rule, scene.where(root), fault.cause, fault.cure)
    return builder.group(root, rest, None), builder.origins, builder.files

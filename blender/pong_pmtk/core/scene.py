# SPDX-License-Identifier: GPL-3.0-or-later
"""Tree of a snapshot, and faults of the scene as a whole, found before any geometry is examined."""

from __future__ import annotations

from collections import defaultdict

import numpy as np

from .exact import meant
from .finding import Findings
from .instances import with_instances
from .marks import ROLES, VERSION
from .naming import natural
from .snapshot import Snapshot, SnapshotObject

# Other parent types (a bone, a vertex) give positions that only Blender knows.
PARENT_TYPES = ("OBJECT",)


class Scene:
    """A snapshot with its tree: parents, children, paths."""

    def __init__(self, snapshot: Snapshot, findings: Findings):
        self.findings = findings
        self.snapshot = with_instances(snapshot, findings)
        self.by_name: dict[str, SnapshotObject] = {}
        self.repeated: list[SnapshotObject] = []
        for thing in self.snapshot.objects:
            if thing.name in self.by_name:
                self.repeated.append(thing)
            self.by_name.setdefault(thing.name, thing)
        self.children: dict[str | None, list[SnapshotObject]] = defaultdict(list)
        for thing in self.by_name.values():
            self.children[thing.parent].append(thing)
        for below in self.children.values():
            below.sort(key=lambda thing: natural(thing.name))
        self.carrying = self._carrying()
        self.metres_per_unit = float(_unit(self.snapshot.unit_scale))

    def path(self, thing: SnapshotObject) -> str:
        names, seen = [], set()
        here: SnapshotObject | None = thing
        while here is not None and here.name not in seen:
            seen.add(here.name)
            names.append(here.name)
            here = self.by_name.get(here.parent) if here.parent else None
        return "/".join(reversed(names))

    def where(self, thing: SnapshotObject) -> tuple[str, str]:
        return thing.name, self.path(thing)

    def metres(self, lengths):
        """Lengths of the scene in metres; a unit of 1/n metre divides, which keeps decimals short."""
        scale = self.metres_per_unit
        if scale == 1.0:
            return lengths
        lengths = np.asarray(lengths, dtype=np.float64)
        whole = round(1.0 / scale)
        return lengths / whole if whole and 1.0 / whole == scale else lengths * scale

    def below(self, thing: SnapshotObject) -> list[SnapshotObject]:
        """The object and all below it."""
        found = [thing]
        for here in found:
            found += self.children[here.name]
        return found

    def _carrying(self) -> set[str]:
        """Names of the objects that are marked or have marked descendants: their transforms matter."""
        carrying: set[str] = set()
        for thing in self.by_name.values():
            here = thing if thing.mark.role != "none" else None
            while here is not None and here.name not in carrying:
                carrying.add(here.name)
                here = self.by_name.get(here.parent) if here.parent else None
        return carrying


def _unit(scale: float) -> float:
    return float(meant(scale))


def roots(snapshot: Snapshot) -> list[str]:
    """Names of the roots of a scene, each a separate model."""
    return [thing.name for thing in snapshot.objects if thing.mark.role == "root"]


def find_root(scene: Scene, wanted: str) -> SnapshotObject | None:
    """The root to build, if the tree is valid; faults are noted."""
    findings = scene.findings
    check_tree(scene)
    found = sorted((t for t in scene.by_name.values() if t.mark.role == "root"), key=lambda t: natural(t.name))
    scene_itself = ("", scene.snapshot.source)
    if not found:
        cure = "mark the empty that holds the model as root"
        findings.error("no-root", scene_itself, "no object is marked as the root of a model", cure)
    elif wanted and wanted not in (root.name for root in found):
        findings.error("unknown-root", scene_itself, f'no root is called "{wanted}"', f"choose from: {_names(found)}")
    elif not wanted and len(found) > 1:
        outer = [root for root in found if not _root_above(scene, root)]
        if len(outer) > 1:
            cause = f"there are {len(outer)} roots: {_names(outer)}"
            findings.error("several-roots", scene_itself, cause, "name the one to export")
        found = outer
    if findings.errors:
        return None
    return next((root for root in found if root.name == wanted), found[0])


def _names(things) -> str:
    return ", ".join(thing.name for thing in things)


def _root_above(scene: Scene, thing: SnapshotObject) -> SnapshotObject | None:
    here = scene.by_name.get(thing.parent) if thing.parent else None
    while here is not None:
        if here.mark.role == "root":
            return here
        here = scene.by_name.get(here.parent) if here.parent else None
    return None


def check_tree(scene: Scene) -> None:
    """Names, parents, units: the requirements of the tree itself."""
    findings = scene.findings
    for thing in scene.repeated:
        cause = f'two objects are called "{thing.name}"'
        findings.error("repeated-object", scene.where(thing), cause, "rename one of them", fix="rename")
    if not (np.isfinite(scene.metres_per_unit) and scene.metres_per_unit > 0.0):
        cause = f"the scene's unit scale is {scene.snapshot.unit_scale}"
        findings.error("unit-scale", ("", scene.snapshot.source), cause, "set it above zero: 1.0 for metres")
    for thing in scene.by_name.values():
        if thing.parent and thing.parent not in scene.by_name:
            cause = f'its parent "{thing.parent}" is not in the scene'
            findings.error("unknown-parent", scene.where(thing), cause, "link the parent to the scene or clear it")
        elif _in_loop(scene, thing):
            findings.error("parent-loop", scene.where(thing), "it is among its own parents", "clear its parent")


def _in_loop(scene: Scene, thing: SnapshotObject) -> bool:
    seen, here = set(), thing
    while here.parent and here.parent in scene.by_name:
        here = scene.by_name[here.parent]
        if here.name == thing.name:
            return True
        if here.name in seen:
            return False
        seen.add(here.name)
    return False


def check_scene(scene: Scene, root: SnapshotObject) -> None:
    """Marks outside the tree, and every object in use below the root."""
    findings, snapshot = scene.findings, scene.snapshot
    inside = {thing.name for thing in scene.below(root)}
    for thing in scene.by_name.values():
        if thing.name in inside or thing.mark.role in ("none", "root") or _root_above(scene, thing):
            continue
        if not any(collection in snapshot.instance_offsets for collection in thing.collections):
            cause = f"it is marked as a {thing.mark.role} but hangs below no root"
            if thing.linked_from:  # nothing of it can be changed here
                findings.hint("outside-root", scene.where(thing), f"{cause}: it is not exported", "unmark it in its own file")
                continue
            findings.error("outside-root", scene.where(thing), cause, "parent it to a group of the model, or unmark it")
    if snapshot.edit_mode in inside:
        thing = scene.by_name[snapshot.edit_mode]
        cause = "it is being edited, and its mesh may be stale"
        findings.error("edit-mode", scene.where(thing), cause, "leave edit mode", fix="leave-edit-mode")
    for thing in scene.below(root):
        check_object(scene, thing)


def check_object(scene: Scene, thing: SnapshotObject) -> None:
    """Influences that move or hide an object besides the exported numbers."""
    findings, where, mark = scene.findings, scene.where(thing), thing.mark
    if mark.role not in ROLES:
        findings.error("unknown-role", where, f'its role is "{mark.role}"', f"choose from: {', '.join(ROLES)}")
    if mark.version > VERSION:
        cause = f"its mark is of version {mark.version}, this toolkit knows up to {VERSION}"
        findings.error("mark-version", where, cause, "update the toolkit")
    for part in thing.left_over:
        elements = next(sort for sort in ("vertices", "edges", "faces") if getattr(part, sort))
        cause = f"its mesh brought marks of another object along: {len(getattr(part, elements))} {elements} ({part.kind})"
        cure = "take them over as a part, or remove their attribute of the mesh; its surface is to be given anew"
        more = {elements: getattr(part, elements)}
        findings.error("left-over-part", where, cause, cure, fix="adopt-parts", **more)
    marked = mark.role in ("root", "group", "primitive")
    if marked and thing.excluded:
        cure = "include its collection in the view layer, or unmark it"
        findings.error("excluded-object", where, "all its collections are excluded from the view layer", cure)
    elif marked and thing.hidden:
        cure = "show it, or unmark it"
        findings.error("hidden-object", where, "it is hidden, and hidden objects are not evaluated", cure, fix="unhide")
    if thing.name not in scene.carrying:
        if mark.role == "none" and thing.mesh is not None and thing.parent:
            findings.hint(
                "unmarked-mesh", where, "a mesh without a mark: it is not exported", "mark it, or leave it as it is"
            )
        return
    if thing.parent and thing.parent_type not in PARENT_TYPES and mark.role != "root":
        cause = f"it is parented to a {thing.parent_type.lower()} of its parent, not to the object"
        findings.error("parent-type", where, cause, "parent it to the object")
    if thing.constraints:
        cause = f"constraints move it: {', '.join(thing.constraints)}"
        findings.error("constraint", where, cause, "apply them (Object > Apply > Visual Transform) and remove them")
    if thing.drivers:
        cause = "drivers set some of its values"
        findings.warn("driver", where, cause, f"the values at frame {scene.snapshot.frame} are exported")
    if thing.animated:
        cause = "it is animated"
        findings.warn("animation", where, cause, f"its place at frame {scene.snapshot.frame} is exported")
    if thing.linked_from:
        findings.hint("linked-object", where, f"it comes from {thing.linked_from}", "what that file says is exported")

# SPDX-License-Identifier: GPL-3.0-or-later
"""Collection instances: an empty that shows a collection is replaced by copies of that collection's objects."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .finding import Findings
from .snapshot import Snapshot, SnapshotObject

DEPTH_LIMIT = 8


def with_instances(snapshot: Snapshot, findings: Findings) -> Snapshot:
    """The snapshot with every instancing empty replaced by an empty and copies below it.

    A copy is called `<empty>.<object>`. Empties of collections that the snapshot does not hold stay and are refused.
    """
    objects, depth = list(snapshot.objects), 0
    while any(thing.instance_of for thing in objects):
        depth += 1
        expanded: list[SnapshotObject] = []
        for thing in objects:
            expanded += _expanded(snapshot, thing, findings, depth)
        objects = expanded
    return replace(snapshot, objects=objects) if depth else snapshot


def _expanded(snapshot: Snapshot, empty: SnapshotObject, findings: Findings, depth: int) -> list[SnapshotObject]:
    collection = empty.instance_of
    if not collection:
        return [empty]
    plain = replace(empty, instance_of="")
    if empty.excluded and empty.mark.role == "none":
        return [plain]
    members = [thing for thing in snapshot.objects if collection in thing.collections]
    if collection not in snapshot.instance_offsets or not members or depth > DEPTH_LIMIT:
        if _matters(snapshot, empty):
            cause = f'it shows the collection "{collection}", whose objects cannot be reached'
            cure = "make its instances real (Object > Apply > Make Instances Real)"
            findings.error("collection-instance", (empty.name, empty.name), cause, cure, fix="make-instances-real")
        return [plain]
    names = {thing.name for thing in members}
    offset = np.eye(4)
    offset[:3, 3] = -np.asarray(snapshot.instance_offsets[collection], dtype=np.float64)
    return [plain, *(_copy(thing, empty, names, offset) for thing in members)]


def _matters(snapshot: Snapshot, empty: SnapshotObject) -> bool:
    by_name = {thing.name: thing for thing in snapshot.objects}
    here, steps = empty, 0
    while here is not None and steps <= len(by_name):
        if here.mark.role != "none":
            return True
        here, steps = by_name.get(here.parent) if here.parent else None, steps + 1
    return False


def _copy(thing: SnapshotObject, empty: SnapshotObject, names: set[str], offset: np.ndarray) -> SnapshotObject:
    name = f"{empty.name}.{thing.name}"
    shown_as = f"{empty.called or empty.name}.{thing.called or thing.name}"
    mark = replace(thing.mark, name=thing.mark.name or shown_as)
    # A copy within an instanced collection exists only to be copied again.
    seen = {"hidden": empty.hidden, "excluded": empty.excluded, "collections": empty.collections}
    shown = replace(thing, name=name, mark=mark, **seen)
    if thing.parent in names:
        return replace(shown, parent=f"{empty.name}.{thing.parent}")
    # The collection's space is a child of the empty, whatever the object's parent outside of it.
    inverse = thing.transform.parent_inverse
    matrix = offset if inverse is None or thing.parent is None else offset @ np.asarray(inverse, dtype=np.float64)
    moved = None if np.array_equal(matrix, np.eye(4)) else matrix
    return replace(
        shown, parent=empty.name, parent_type="OBJECT", transform=replace(thing.transform, parent_inverse=moved)
    )

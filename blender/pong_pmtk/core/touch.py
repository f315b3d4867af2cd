# SPDX-License-Identifier: GPL-3.0-or-later
"""Contact of closed shapes: the choice for an automatic root, and sentences for the panel about what touches."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import combinations

from .model import Group, Model
from .scene import Scene
from .snapshot import SnapshotObject

SHAPES = ("Polyhedron", "TriangleMesh", "Triangle")  # solids in a group with `contact: Solid`, if they are closed
CORNERS = ("Point", "LineSegment")  # refused there
CURE = "choose Solid or Marked as contact of the root; points and segments at the corners of a solid are left out"


def is_of_solids(rule: str) -> bool:
    """True for the loader's rules about `contact: Solid`."""
    return rule.startswith("solid-") or rule == "open-solid"


def choose(scene: Scene, root: SnapshotObject, model: Model) -> None:
    """Makes the shapes of an automatic root solids unless the author has marked by hand what touches. Whether all of
    them are closed is judged by the engine (engine_check.py)."""
    if root.mark.contact != "Automatic" or not any(_shapes(model.root, "Marked")):
        return
    by_hand = _by_hand(scene, root, model.root)
    if by_hand:
        tell_marked(scene, root, f"{by_hand}, so the author says what touches")
    else:
        model.root.contact = "Solid"


def tell_marked(scene: Scene, root: SnapshotObject, cause: str) -> None:
    """Finding on an automatic root whose shapes keep `contact: Marked`."""
    scene.findings.hint("not-solid", scene.where(root), f"its shapes touch as marked: {cause}", CURE)


def _shapes(group: Group, above: str):
    """Shapes without a `contact` of their own."""
    if (group.contact or above) != above:
        return
    yield from (primitive for primitive in group.primitives if primitive.kind in SHAPES)
    for below in group.groups:
        yield from _shapes(below, above)


def _by_hand(scene: Scene, root: SnapshotObject, group: Group) -> str:
    """Name of the first corner, edge or part that is marked by hand; "" if there is none."""
    corner = _corner(group)
    if corner:
        return corner
    parts = [(thing.name, part.name) for thing in scene.below(root) for part in thing.mark.parts if part.faces]
    return f'faces of "{parts[0][0]}" are marked as the part "{parts[0][1]}"' if parts else ""


def _corner(group: Group) -> str:
    if group.contact == "Marked":
        return ""
    for primitive in group.primitives:
        if primitive.kind in CORNERS:
            return f'"{primitive.name}" is a {primitive.kind}'
    return next(filter(None, map(_corner, group.groups)), "")


# --- sentences -----------------------------------------------------------------------------------------------------


@dataclass
class _Body:
    """A rigid body of a model: numbers of its solids, planes and other primitives."""

    path: tuple[str, ...]
    solids: int = 0
    planes: int = 0
    others: int = 0
    chains: list[tuple[str, ...]] = field(default_factory=list)  # names from the root to each group with primitives

    @property
    def name(self) -> str:
        return "/".join(self.path)


LISTED_PAIRS = 6


def sentences(model: Model) -> list[str]:
    """Sentences for the panel: the contents of each rigid body, and the pairs of bodies of this model that touch by volume."""
    bodies = _bodies(model.root)
    told = [f"{body.name}: {_contents(body)}" for body in bodies]
    if not any(body.solids for body in bodies):
        return [*told, "Points, segments, rays and round parts touch faces; faces alone touch nothing"]
    pairs = [
        (a, b) for a, b in combinations(bodies, 2)
        if (a.solids and (b.solids or b.planes) or a.planes and b.solids) and not _are_filtered(model, a, b)
    ]  # fmt: skip
    told += [f"{a.name} – {b.name}: by shared volume" for a, b in pairs[:LISTED_PAIRS]]
    if len(pairs) > LISTED_PAIRS:
        told.append(f"and {len(pairs) - LISTED_PAIRS} more pairs")
    told.append("Solids touch solids and planes of other bodies and models by the volume that they share,")
    return [*told, "and points, segments, rays and round parts on their faces"]


def _contents(body: _Body) -> str:
    counts = ((body.solids, "solid shape"), (body.planes, "plane"), (body.others, "marked primitive"))
    return ", ".join(f"{count} {what}{'s' * (count != 1)}" for count, what in counts if count) or "nothing"


def _bodies(root: Group) -> list[_Body]:
    found: list[_Body] = []

    def walk(group: Group, chain: tuple[str, ...], contact: str, body: _Body | None) -> None:
        if body is None or group.movable:
            body = _Body(chain)
            found.append(body)
        if group.primitives:
            body.chains.append(chain)
        contact = group.contact or contact
        for primitive in group.primitives:
            if contact == "Solid" and primitive.kind in SHAPES:
                body.solids += 1
            elif primitive.kind == "Plane":
                body.planes += 1
            else:
                body.others += 1
        for below in group.groups:
            walk(below, (*chain, below.name), contact, body)

    walk(root, (root.name,), "Marked", None)
    return [body for body in found if body.solids or body.planes or body.others]


def _are_filtered(model: Model, a: _Body, b: _Body) -> bool:
    """True if a filter keeps the whole bodies apart."""
    return any(_holds(f, a) and _holds(g, b) or _holds(g, a) and _holds(f, b) for f, g in model.filters)


def _holds(named: str, body: _Body) -> bool:
    """True if all primitives of the body are below a filter's group, which is given by its path or its name."""
    names = tuple(named.split("/"))
    if len(names) == 1:
        return all(named in chain for chain in body.chains)
    return all(chain[1 : 1 + len(names)] == names for chain in body.chains)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Findings: faults and oddities of a scene, their locations, and cures. The rules: docs/modelling_rules.md."""

from __future__ import annotations

from dataclasses import dataclass, field

SEVERITIES = ("error", "warning", "hint")

# Errors refuse the export; warnings and hints do not. Names never change their meaning.
LISTED_ELEMENTS = 1000


@dataclass
class Finding:
    """One finding. `elements` hold indices of the stored mesh (of the evaluated one where `evaluated`)."""

    severity: str
    rule: str
    object: str  # name of the object; "" for the scene
    path: str  # names of the objects from the root down
    cause: str
    cure: str
    vertices: list[int] = field(default_factory=list)
    edges: list[int] = field(default_factory=list)
    faces: list[int] = field(default_factory=list)
    evaluated: bool = False  # the indices are those after modifiers: they cannot be selected in edit mode
    fix: str = ""  # name of a repair that the interface offers: see FIXES

    def __str__(self) -> str:
        return f"{self.path or 'scene'}: {self.severity} [{self.rule}] {self.cause}; {self.cure}"


FIXES = {
    "adopt-parts": "take the marked elements over as parts of the object",
    "align-axis": "turn the object so that its z axis is that of the part it shows",
    "apply-scale": "apply the object's scale to its mesh and to the sizes of its mark",
    "apply-transform": "apply rotation and scale to the mesh",
    "clear-parent-inverse": "keep the place, clear the parent's inverse matrix",
    "convert-to-mesh": "convert the object to a mesh",
    "delete-loose": "delete vertices and edges without faces",
    "dissolve-degenerate": "dissolve edges and faces without extent",
    "fit-ellipsoid": "make it an ellipsoid with the semi-axes of the mesh",
    "fit-length": "take the length that is shown",
    "fit-round": "take the length and the radii that are shown",
    "fit-sphere": "take the radius that is shown",
    "group-primitives": "put the primitives into a group of their own",
    "leave-edit-mode": "leave edit mode",
    "make-instances-real": "make the instances real",
    "merge-by-distance": "merge vertices that are the same place",
    "recalculate-normals": "turn all normals outward",
    "rename": "give it a name of its own",
    "separate-loose": "separate the pieces into objects",
    "set-origin": "move the object's origin into its geometry",
    "triangulate": "cut the faces into triangles",
    "unmark-copy": "take the mark of the copy away; the object stays",
    "unhide": "show the object",
}


class Findings(list):
    """The findings of one build, in the order they were made."""

    def add(self, severity: str, rule: str, where: tuple[str, str], cause: str, cure: str, **more) -> None:
        """`where` is (object name, path); `more` are further fields of the finding."""
        for key in ("vertices", "edges", "faces"):
            more[key] = [int(i) for i in list(more.get(key, ()))[:LISTED_ELEMENTS]]
        self.append(Finding(severity, rule, where[0], where[1], cause, cure, **more))

    def error(self, rule: str, where: tuple[str, str], cause: str, cure: str, **more) -> None:
        self.add("error", rule, where, cause, cure, **more)

    def warn(self, rule: str, where: tuple[str, str], cause: str, cure: str, **more) -> None:
        self.add("warning", rule, where, cause, cure, **more)

    def hint(self, rule: str, where: tuple[str, str], cause: str, cure: str, **more) -> None:
        self.add("hint", rule, where, cause, cure, **more)

    @property
    def errors(self) -> list[Finding]:
        return [finding for finding in self if finding.severity == "error"]

# SPDX-License-Identifier: GPL-3.0-or-later
"""Capsules, cylinders, cones and bores with Blender's own objects: marked, shown, edited, scaled, exported and opened again."""

import sys
import tempfile
from pathlib import Path

import bpy
import numpy as np
from pong_pmtk.core.read import read_file
from pong_pmtk.core.write import write_text
from pong_pmtk.scene import fixes, session
from pong_pmtk.store import marks
from pong_pmtk.store.state import state
from pong_pmtk.ui import overlay

from .scenes import InBlender, activate, mark, new, root

KINDS = ("Capsule", "Cylinder", "Cone", "Bore")
MODELS = Path(__file__).resolve().parents[3] / "models"


def pin(parent, radius=0.1, depth=0.5):
    """Blender's own cylinder, which has 32 sides and its middle at its origin."""
    bpy.ops.mesh.primitive_cylinder_add(radius=radius, depth=depth)
    obj = bpy.context.object
    obj.name, obj.parent = "pin", parent
    activate(obj)
    return obj


class RoundParts(InBlender):
    def findings(self, rule):
        bpy.ops.pong.check()
        return [item for item in state(bpy.context).findings if item.rule == rule]

    def test_a_mesh_that_is_marked_has_its_size(self):
        obj = pin(root())
        obj.location = (1.0, 2.0, 3.0)
        bpy.ops.pong.mark(kind="Cylinder")
        part = self.primitives()["pin"]
        self.assertEqual(part.kind, "Cylinder")
        np.testing.assert_allclose(part.fields["ends"], [(1.0, 2.0, 2.75), (1.0, 2.0, 3.25)], atol=1e-6)
        self.assertAlmostEqual(part.fields["radius"], 0.1, places=6)
        bpy.ops.pong.mark(kind="Bore")
        self.assertEqual(tuple(marks.read_mark(obj).radii), (0.1, 0.1))

    def test_a_cone_with_a_tip(self):
        bpy.ops.mesh.primitive_cone_add(radius1=0.2, radius2=0.0, depth=0.4)
        obj = bpy.context.object
        obj.name, obj.parent = "tip", root()
        activate(obj)
        bpy.ops.pong.mark(kind="Cone")
        np.testing.assert_allclose(self.primitives()["tip"].fields["radii"], (0.2, 0.0), atol=1e-6)
        self.assertEqual(self.rules(), set())

    def test_an_empty_begins_with_sizes_that_are_shown(self):
        top = root()
        for kind in KINDS:
            obj = new(kind, parent=top)
            obj.empty_display_size = 0.25
            activate(obj)
            bpy.ops.pong.mark(kind=kind)
            obj.location.x = 3.0 * KINDS.index(kind)
            mark_ = marks.read_mark(obj)
            self.assertEqual((mark_.length, mark_.radius or mark_.radii[0]), (0.5, 0.125))
        self.assertEqual(self.rules(), set())

    def test_numbers_that_are_typed_are_exported_and_shown(self):
        obj = mark(new("socket", parent=root()), kind="Bore", length=0.5, radii=(0.1, 0.2))
        obj.pong.length, obj.pong.radii, obj.pong.mouths = 0.3, (0.01, 0.02), (True, False)
        obj.pong.use_thickness, obj.pong.thickness = True, 0.005
        self.assertAlmostEqual(obj.empty_display_size, 0.15)
        fields = self.primitives()["socket"].fields
        self.assertEqual(fields, {
            "ends": ((0.0, 0.0, -0.15), (0.0, 0.0, 0.15)), "radii": (0.01, 0.02), "thickness": 0.005, "mouths": (True, False),
        })

    def test_a_length_that_is_typed_counts_after_import_too(self):
        obj = self.opened("Cylinder", "radius: 0.1")
        obj.pong.length = 0.5
        low, high = np.array(self.primitives()["part"].fields["ends"])
        np.testing.assert_allclose([np.linalg.norm(high - low), *(low + high) / 2], [0.5, 0.2, 0.25, 0.3], atol=1e-12)

    def opened(self, kind, sizes):
        text = (f'(format: "pong-model", version: 1, name: "m", surfaces: {{ "s": (stiffness: 1e6) }}, root: (name: "m", '
                f'surface: "s", primitives: [{kind}(name: "part", ends: ((0.1, 0.2, 0.3), (0.3, 0.3, 0.3)), {sizes})]))')
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "m.ron"
            path.write_text(text)
            session.load(bpy.context, path)
        return bpy.data.objects["part"]

    def test_blenders_apply_scale_is_told_and_mended(self):
        obj = pin(root())
        bpy.ops.pong.mark(kind="Cylinder")
        obj.scale = (2.0, 2.0, 3.0)
        self.assertEqual(self.findings("size-not-shown"), [])
        activate(obj)
        bpy.ops.object.transform_apply(location=False, rotation=False, scale=True)
        (found,) = self.findings("size-not-shown")
        self.assertEqual(found.fix, "fit-round")
        bpy.ops.pong.findings_fix(rule="")
        np.testing.assert_allclose([obj.pong.length, obj.pong.radius], [1.5, 0.2], rtol=1e-6)
        self.assertEqual(self.rules(), set())

    def test_the_toolkits_own_repair_scales_the_mark(self):
        top = root()
        for kind in KINDS:
            scale = (2.0, 2.0, 2.0) if kind == "Capsule" else (2.0, 2.0, 3.0)
            sizes = {"radius": 0.1} if kind in ("Capsule", "Cylinder") else {"radii": (0.1, 0.05)}
            obj = mark(new(kind, parent=top, scale=scale), kind=kind, length=0.5, **sizes)
            before = {name: part.fields for name, part in self.primitives().items()}[kind]
            fixes.run(bpy.context, "apply-scale", obj)
            after = self.primitives()[kind].fields
            for name, value in before.items():
                np.testing.assert_allclose(after[name], value, rtol=1e-12, atol=1e-15)
            self.assertEqual(tuple(obj.scale), (1.0, 1.0, 1.0))

    def test_a_scale_that_leaves_no_round_part_is_refused(self):
        obj = mark(new("pin", parent=root(), scale=(1.0, 2.0, 1.0)), kind="Cylinder", length=0.5, radius=0.1)
        self.assertEqual(self.rules(), {"uneven-round"})
        with self.assertRaisesRegex(fixes.FixFault, "around its z axis"):
            fixes.run(bpy.context, "apply-scale", obj)

    def test_they_are_drawn_over_the_scene_as_they_are_changed(self):
        obj = mark(new("pin", parent=root()), kind="Cylinder", length=0.5, radius=0.1)
        state(bpy.context).show_round = True
        for length in (0.5, 0.8):
            obj.pong.length = length
            overlay.refresh(bpy.context)
            lines = overlay._shown[bpy.context.scene.name]["show_round"]
            self.assertAlmostEqual(float(np.ptp(lines[:, 2])), length, places=6)
        state(bpy.context).show_round = False

    def test_a_build_script_writes_them_as_it_says(self):
        sys.path.insert(0, str(MODELS))
        try:
            import authoring
        finally:
            sys.path.remove(str(MODELS))
        a, b = (0.1, 0.2, 0.3), (0.4, 0.2, 0.7)
        parts = [
            authoring.capsule("link", a, b, 0.01), authoring.cylinder("pin", a, b, 0.02),
            authoring.cone("nose", a, b, (0.02, 0)), authoring.bore("hole", a, b, 0.03),
            authoring.bore("funnel", a, b, (0.03, 0.05), thickness=0.01, mouths=(False, True)),
        ]
        made = authoring.model("m", {"s": authoring.surface(1e6)}, authoring.group("m", primitives=parts, surface="s"))
        top = authoring.insert(bpy.context, made)
        with tempfile.TemporaryDirectory() as folder:
            self.assertTrue(authoring.export(bpy.context, made, top, folder))
            read = read_file(Path(folder) / "m.ron")
        self.assertEqual(write_text(read), write_text(made))
        found = {part.name: part for part in read.root.primitives}
        self.assertEqual(found["hole"].fields, {"ends": (a, b), "radii": (0.03, 0.03)})
        self.assertEqual(found["funnel"].fields["mouths"], (False, True))

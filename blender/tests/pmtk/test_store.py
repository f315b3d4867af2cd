# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks, settings and numbers survive a .blend file."""

import math
import tempfile
from pathlib import Path

import bpy
import numpy as np
from pong_pmtk.core.marks import Mark, ModelSettings, Part
from pong_pmtk.core.model import Tagged
from pong_pmtk.store import elements, exact, marks, presets, spec

from .scenes import CUBE, InBlender, activate, edit, mark, mesh, new, root


def saved_and_opened():
    with tempfile.TemporaryDirectory() as folder:
        path = str(Path(folder) / "scene.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.ops.wm.open_mainfile(filepath=path)


class Marks(InBlender):
    FULL = Mark(
        role="primitive", name="tip/1", surface="rubber", order=7, movable=True, bound="Obb", custom_bound="torus",
        kind="TriangleMesh", radius=1 / 3, semi_axes=(0.1, math.pi, 1e-9), length=12345678.9012, reach=0.0,
        response="Axial", thickness=0.1 + 0.2, two_sided=True, inactive_faces=[1, 5], file="a.obj", file_scale=0.001,
        custom_kind="ring", parameters=[1.0, 1 / 7],
        parts=[Part("pads", "Polyhedron", "ice", [], [], [0, 2]), Part("feet", "Point", "", [3], [], [])],
    )  # fmt: skip

    def test_every_field_survives_saving_in_full_precision(self):
        mark(new("a", mesh(CUBE)), **vars(self.FULL))
        saved_and_opened()
        self.assertEqual(marks.read_mark(bpy.data.objects["a"]), self.FULL)

    def test_clearing_leaves_nothing(self):
        obj = mark(new("a", mesh(CUBE)), **vars(self.FULL))
        marks.clear_mark(obj)
        self.assertEqual(marks.read_mark(obj), Mark())
        self.assertFalse([name for name in obj.data.attributes.keys() if name.startswith(elements.PREFIX)])

    def test_marks_are_of_the_object_not_of_a_shared_mesh(self):
        shared = mesh(CUBE)
        first, second = new("a", shared), new("b", shared)
        mark(first, kind="Polyhedron", parts=[Part("one", "Polyhedron", faces=[0])])
        mark(second, parts=[Part("two", "Polyhedron", faces=[4, 5])])
        self.assertEqual(marks.read_mark(first).parts[0].faces, [0])
        self.assertEqual(marks.read_mark(second).parts[0].faces, [4, 5])

    def test_what_is_typed_is_what_was_meant(self):
        obj = new("a")
        obj.pong.radius = 0.3
        self.assertEqual(marks.read_mark(obj).radius, 0.3)

    def test_an_optional_number_can_be_given_and_left_out(self):
        obj = new("a")
        self.assertIsNone(marks.read_mark(obj).thickness)
        obj.pong.use_thickness = True
        self.assertEqual(marks.read_mark(obj).thickness, 0.01)
        obj.pong.use_thickness = False
        self.assertIsNone(marks.read_mark(obj).thickness)

    def test_parts_follow_their_elements_through_editing(self):
        obj = mark(new("a", mesh(CUBE)), parts=[Part("top", "Polyhedron", faces=[1])])
        edit(obj)
        elements.select(obj.data, {"faces": [0]})
        bpy.ops.mesh.delete(type="ONLY_FACE")
        self.assertEqual(marks.read_mark(obj).parts[0].faces, [0])  # it was number 1
        bpy.ops.object.mode_set(mode="OBJECT")
        self.assertEqual(marks.read_mark(obj).parts[0].faces, [0])

    def test_marks_survive_without_the_toolkit(self):
        import pong_pmtk

        mark(new("a"), kind="Sphere", radius=0.7)
        pong_pmtk.unregister()
        try:
            saved_and_opened()
        finally:
            pong_pmtk.register()
        self.assertEqual(marks.read_mark(bpy.data.objects["a"]), Mark(role="primitive", kind="Sphere", radius=0.7))


class Settings(InBlender):
    FULL = ModelSettings(
        name="m",
        entry_memory=False,
        surfaces={
            "a": {"stiffness": 1 / 3, "normal": Tagged("Linear", {"damping": 0.1, "ramp": 1e-4}),
                  "friction": Tagged("Bristle", {"mu": 0.2, "static_excess": 0.0})},
            "b": {"stiffness": math.inf},
            "f": {"stiffness": 1e5, "foundation": 1e9 / 3,
                  "friction": Tagged("Bristle", {"mu": 0.2, "rolling": 1 / 3e3, "spinning": 1e-4})},
            "g": {"stiffness": 1e5, "area": 1 / 700},
            "c": {"stiffness": 2e5, "normal": Tagged("HuntCrossley", {"restitution": {"e": 0.5, "speed": 0.1},
                                                                      "exponent": 1.5})},
            "e": {"stiffness": 2e9, "normal": Tagged("PowerLaw", {"exponent": 1.5, "damping_exponent": 0.5,
                                                                  "damping": 1 / 3})},
            "d": {"stiffness": 1.0, "friction": Tagged("Custom", {"name": "x", "parameters": (1.0, 0.1)})},
        },
        pairs=[{"surfaces": ("a", "b"), "friction": None}, {"surfaces": ("a", "a"), "stiffness": 5.0}],
        filters=[("arm", "base/hinge")],
    )  # fmt: skip

    def test_every_field_survives_saving(self):
        marks.write_settings(new("root"), self.FULL)
        saved_and_opened()
        self.assertEqual(marks.read_settings(bpy.data.objects["root"]), self.FULL)

    def test_properties_are_views_of_the_fields(self):
        marks.write_settings(new("root"), self.FULL)
        surface = bpy.data.objects["root"].pong_model.surfaces["a"]
        self.assertEqual((surface.normal, surface.friction, surface.rigid), ("Linear", "Bristle", False))
        self.assertAlmostEqual(surface.ramp, 1e-4)
        surface.mu, surface.use_ramp, surface.use_restitution = 0.7, False, True
        surface.restitution, surface.mass = 0.25, 100.0
        fields = spec.from_plain(spec.read(surface))
        self.assertEqual(fields["friction"].fields["mu"], 0.7)
        self.assertEqual(fields["normal"], Tagged("Linear", {"restitution": {"e": 0.25, "mass": 100.0}}))
        self.assertFalse(surface.use_bristle_damping or surface.use_bristle_mass)
        surface.use_bristle_damping = True  # critical for the mass of the restitution
        critical = 2 * math.sqrt(2 / 3 * surface.stiffness * 100.0)
        self.assertAlmostEqual(spec.read(surface)["friction"]["Bristle"]["damping"], critical, delta=1e-6 * critical)
        surface.use_bristle_mass = True  # instead of the damping
        surface.bristle_mass = 2.5
        self.assertEqual(spec.read(surface)["friction"]["Bristle"], {"mu": 0.7, "static_excess": 0.0, "mass": 2.5})
        surface.use_bristle_mass = False
        self.assertEqual(spec.read(surface)["friction"]["Bristle"], {"mu": 0.7, "static_excess": 0.0})
        surface.rigid, surface.friction = True, "DEFAULT"
        self.assertEqual(spec.read(surface)["stiffness"], math.inf)
        self.assertNotIn("friction", spec.read(surface))

    def test_a_surface_has_a_foundation_or_an_area(self):
        marks.write_settings(new("root"), ModelSettings(surfaces={"a": {"stiffness": 1e5}}))
        surface = bpy.data.objects["root"].pong_model.surfaces["a"]
        surface.use_foundation = True  # of the stiffness over 0.01 m²
        self.assertEqual(surface.foundation_text, "1e7 N/m^3")
        surface.foundation_text = "0.02 N/mm^3"
        self.assertEqual(spec.read(surface), {"stiffness": 1e5, "foundation": 2e7})
        surface.use_area = True  # in place of the foundation, with the same effect
        self.assertEqual(spec.read(surface), {"stiffness": 1e5, "area": 0.005})
        surface.area_text = "2 cm²"
        self.assertAlmostEqual(spec.read(surface)["area"], 2e-4)
        surface.rigid = True  # a rigid surface has neither; what it had comes back
        self.assertEqual(spec.read(surface), {"stiffness": math.inf})
        surface.rigid = False
        self.assertAlmostEqual(spec.read(surface)["area"], 2e-4)
        surface.friction, surface.use_rolling = "Bristle", True
        surface.rolling_text = "0.2 mm"
        self.assertEqual(spec.read(surface)["friction"]["Bristle"]["rolling"], 2e-4)

    def test_of_a_pair_no_friction_is_not_the_same_as_none_given(self):
        marks.write_settings(new("root"), self.FULL)
        first, second = bpy.data.objects["root"].pong_model.pairs
        self.assertEqual((first.friction, second.friction), ("None", "DEFAULT"))
        first.friction, second.friction = "DEFAULT", "None"
        pairs = marks.read_settings(bpy.data.objects["root"]).pairs
        self.assertNotIn("friction", pairs[0])
        self.assertIsNone(pairs[1]["friction"])

    def test_a_renamed_surface_keeps_its_users(self):
        top = root()
        below = mark(new("a", mesh(CUBE), top), surface="steel", parts=[Part("p", "Point", "steel", [0])])
        top.pong_model.surfaces["steel"].name = "iron"
        self.assertEqual((top.pong.surface, below.pong.surface, below.pong.parts[0].surface), ("iron",) * 3)


class Exact(InBlender):
    def test_full_numbers_survive_saving_and_belong_to_object_and_mesh(self):
        shared = mesh(CUBE)
        first, second = new("a", shared), new("b", shared)
        vertices = np.random.default_rng(1).random((8, 3))
        exact.write(first, {"location": np.array([0.1, 1 / 3, 0.0]), "offset": 0.1 + 0.2, "vertices": vertices})
        saved_and_opened()
        found = exact.read(bpy.data.objects["a"])
        np.testing.assert_array_equal(found["location"], [0.1, 1 / 3, 0.0])
        np.testing.assert_array_equal(found["vertices"], vertices)
        self.assertEqual((float(found["offset"]), found["offset"].shape), (0.1 + 0.2, ()))
        self.assertEqual(list(exact.read(bpy.data.objects["b"])), ["vertices"])
        del second


class Presets(InBlender):
    def test_presets_of_the_file_are_shared_by_scenes_and_survive_saving(self):
        presets.save("mine", {"stiffness": 1 / 3}, "measured")
        bpy.data.scenes.new("second")
        saved_and_opened()
        self.assertEqual(presets.fields_of("mine"), {"stiffness": 1 / 3})
        self.assertEqual(presets.source_of("mine"), "measured")

    def test_standard_materials_state_their_source_and_keep_their_names(self):
        for name, preset in presets.STANDARD.items():
            self.assertIn("table 3.2.1", preset["source"], name)
        with self.assertRaises(ValueError):
            presets.save("glass", {"stiffness": 1.0})

    def test_their_stiffness_is_that_of_hertz(self):
        # 10 mm steel sphere on a rigid flat at 100 N: Hertz's depth from the radius of the contact, a² = R·δ.
        plane_modulus_pa, radius_m, load_n = 207e9 / (1 - 0.29**2), 0.01, 100.0
        contact_m = (3 * load_n * radius_m / (4 * plane_modulus_pa)) ** (1 / 3)
        self.assertAlmostEqual(presets.hertz_secant(207e9, 0.29) / (load_n * radius_m / contact_m**2), 1.0, places=12)

    def test_loading_adds_a_surface(self):
        activate(root())
        bpy.ops.pong.preset_load(preset="glass")
        self.assertIn("glass", bpy.data.objects["model"].pong_model.surfaces)
        bpy.ops.pong.preset_save(name="mine", source="guess")
        self.assertEqual(presets.fields_of("mine"), presets.fields_of("glass"))
        with self.assertRaises(RuntimeError):
            bpy.ops.pong.preset_remove(preset="glass")
        bpy.ops.pong.preset_remove(preset="mine")
        self.assertNotIn("mine", presets.all_presets())

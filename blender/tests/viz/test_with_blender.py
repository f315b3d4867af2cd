# SPDX-License-Identifier: GPL-3.0-or-later
"""Playback in Blender: keyframes, colours, pictures and films, from the command line and from the interface."""

import io
import os
import re
import shutil
import tempfile
import unittest
from contextlib import redirect_stderr
from pathlib import Path

import bpy
import numpy as np

import pong_pmtk
import pong_viz
from pong_viz import captions, patches, render
from pong_viz.cli import main
from pong_viz.log import Log
from pong_viz.marks import SLIP, STICK, TOUCHED
from pong_viz.scene import Options, show

from . import sample


class WithScene(unittest.TestCase):
    def setUp(self):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.log_folder = sample.write_log(self.folder / "log")

    def at(self, frame):
        bpy.context.scene.frame_set(frame)
        return bpy.context.evaluated_depsgraph_get()


class Scenes(WithScene):
    def setUp(self):
        super().setUp()
        self.made = show(Log(self.log_folder), Options(fps=100))

    def test_bodies_are_where_the_log_has_them(self):
        ball = self.made.objects["ball"]
        for picture in (0, 33, 50, 51, 100):
            t = picture / 100.0
            matrix = np.array(ball.evaluated_get(self.at(picture + 1)).matrix_world)
            np.testing.assert_allclose(matrix[:3, 3], (0.5 * t, 0.0, 0.1), atol=1e-6)
            expected = [[np.cos(3 * t), 0, np.sin(3 * t)], [0, 1, 0], [-np.sin(3 * t), 0, np.cos(3 * t)]]
            np.testing.assert_allclose(matrix[:3, :3], expected, atol=1e-6)

    def test_arrow_stands_at_the_contact_and_points_as_the_force(self):
        arrow = self.made.arrows[0]
        for picture in (0, 20, 50):
            t = picture / 100.0
            matrix = np.array(arrow.evaluated_get(self.at(picture + 1)).matrix_world)
            force = np.array([-2.0, 0.0, 10.0 * (1.0 + t)])
            np.testing.assert_allclose(matrix[:3, 3], (0.5 * t, 0.0, 0.0), atol=1e-6)
            np.testing.assert_allclose(matrix[:3, 2], force * self.made.metres_per_newton, atol=1e-6)
            self.assertFalse(arrow.hide_render)
        self.at(52)
        self.assertTrue(arrow.hide_render and arrow.hide_viewport)

    def test_marks_tell_stick_from_slip_and_touched_primitives_light_up(self):
        mark, skin = self.made.marks[0], bpy.data.objects["ball/skin"]
        for picture, color in ((10, SLIP), (25, SLIP), (26, STICK), (50, STICK)):
            np.testing.assert_allclose(mark.evaluated_get(self.at(picture + 1)).color, color, atol=1e-6)
        np.testing.assert_allclose(skin.evaluated_get(self.at(51)).color[:3], TOUCHED, atol=1e-6)
        self.assertGreater(np.abs(np.array(skin.evaluated_get(self.at(52)).color[:3]) - TOUCHED).max(), 0.1)

    def test_patches_of_solids_have_the_size_of_their_area_and_the_colour_of_their_pressure(self):
        sample.as_solids(self.log_folder)
        made = show(Log(self.log_folder), Options(fps=100))
        patch = made.marks[0]
        for picture in (0, 20, 50):
            shown = patch.evaluated_get(self.at(picture + 1))
            matrix, pressure = np.array(shown.matrix_world), 10.0 * (1.0 + picture / 100.0) / sample.AREA_M2
            np.testing.assert_allclose(matrix[:3, 3], (0.5 * picture / 100.0, 0.0, 0.0), atol=1e-6)
            radius = np.linalg.norm(matrix[:3, 0])
            self.assertAlmostEqual(np.pi * radius**2, sample.AREA_M2, places=8)
            np.testing.assert_allclose(shown.color, patches.colours(np.array([pressure]), made.pressure_scale)[0], atol=1e-6)
        friction = made.marks[2].evaluated_get(self.at(51))
        np.testing.assert_allclose(friction.color, STICK, atol=1e-6)
        self.assertRegex(captions.text(bpy.context.scene, 51), r"yellow: 3[67][.\d]* kPa")

    def test_events_are_never_interpolated(self):
        arrow = self.made.arrows[0]
        bpy.context.scene.frame_set(51, subframe=0.9)
        shown = np.array(arrow.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world)[:3, 3]
        np.testing.assert_allclose(shown, (0.25, 0.0, 0.0), atol=1e-6)

    def test_the_camera_sees_the_ball_all_the_time(self):
        from bpy_extras.object_utils import world_to_camera_view
        from mathutils import Vector

        scene = bpy.context.scene
        for picture in (1, 51, 101):
            self.at(picture)
            place = self.made.objects["ball"].matrix_world.translation
            for offset in (Vector((0, 0, 0.1)), Vector((0, 0, -0.1)), Vector((0.1, 0, 0)), Vector((-0.1, 0, 0))):
                seen = world_to_camera_view(scene, scene.camera, place + offset)
                self.assertTrue(0.0 < seen.x < 1.0 and 0.0 < seen.y < 1.0 and seen.z > 0.0)

    def test_shown_again_it_replaces_what_was_there(self):
        before = len(bpy.data.objects)
        show(Log(self.log_folder), Options(fps=100))
        self.assertEqual(len(bpy.data.objects), before)

    def test_scenes_in_millimetres(self):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.context.scene.unit_settings.scale_length = 0.001
        ball = show(Log(self.log_folder), Options(fps=100)).objects["ball"]
        place = ball.evaluated_get(self.at(101)).matrix_world.translation
        np.testing.assert_allclose(place, (500.0, 0.0, 100.0), rtol=1e-6, atol=1e-3)


class Odd(WithScene):
    """Faulty and unusual logs."""

    def shown(self, **options):
        return show(Log(self.log_folder), Options(fps=100, **options))

    def test_nothing_touches(self):
        sample.without_contacts(self.log_folder)
        made = self.shown()
        self.assertEqual((made.arrows, made.metres_per_newton), ([], 0.0))
        still = self.folder / "still.png"
        self.assertEqual(main([str(self.log_folder), "--still", str(still), "--size", "160x90"]), 0)
        self.assertGreater(np.ptp(_pixels(still)[..., 0]), 0.1)

    def test_hundreds_of_contacts_are_all_shown_when_asked_for(self):
        sample.many_contacts(self.log_folder, 300)
        made = self.shown(most_contacts=300)
        self.assertEqual((len(made.arrows), made.notes), (300, []))
        self.at(51)
        self.assertFalse(any(arrow.hide_render for arrow in made.arrows))
        lengths = [arrow.evaluated_get(self.at(51)).matrix_world.to_scale().z for arrow in made.arrows]
        np.testing.assert_allclose(lengths, np.hypot(1.0 + np.arange(300), 2.0) * made.metres_per_newton, rtol=1e-5)
        self.assertRegex(self.shown().notes[0], "12036 contacts are not shown")

    def test_a_body_without_a_state_is_told_and_left_out(self):
        states = np.load(self.log_folder / "states.npy")
        states["position"][:, 1] = np.nan
        np.save(self.log_folder / "states.npy", states)
        made = self.shown()
        self.assertEqual(list(made.objects), ["ball"])
        self.assertIn("body `ground` has no state in the log: it is not shown", made.notes)

    def test_a_planet_is_told_from_its_middle(self):
        """The ground's shapes and its origin are 4.2e6 m apart: on the screen its floor is still under the ball."""
        ground = self.log_folder / "models/ground/ground.ron"
        ground.write_text(ground.read_text().replace("offset: 0.0", "offset: 4200000.3"))
        states = np.load(self.log_folder / "states.npy")
        states["position"][:, 1, 2] -= 4200000.3
        np.save(self.log_folder / "states.npy", states)
        self.shown()
        floor = bpy.data.objects["ground/floor"].evaluated_get(self.at(30))
        heights = [(floor.matrix_world @ vertex.co).z for vertex in floor.data.vertices]
        np.testing.assert_allclose(heights, 0.0, atol=1e-6)
        self.assertLess(np.linalg.norm(bpy.context.scene.camera.location), 10.0)

    def test_the_camera_looks_at_what_touches_not_at_all_the_terrain(self):
        ground = self.log_folder / "models/ground/ground.ron"
        terrain = 'Triangle(name: "floor", vertices: ((-5e3, -5e3, 0.0), (5e3, -5e3, 0.0), (0.0, 5e3, 0.0)))'
        ground.write_text(ground.read_text().replace('Plane(name: "floor", normal: (0.0, 0.0, 1.0), offset: 0.0)', terrain))
        made = self.shown()
        self.assertLess(np.linalg.norm(bpy.context.scene.camera.location), 10.0)
        self.assertLess(15.0 * made.metres_per_newton, 1.0)

    def test_a_frame_rate_of_one_picture_and_a_run_of_one(self):
        made = show(Log(self.log_folder), Options(fps=1, start=0.2, end=0.2))
        self.assertEqual((len(made.film.times), bpy.context.scene.frame_end), (1, 1))


class Graphics(WithScene):
    def own_graphics(self):
        bpy.ops.mesh.primitive_cube_add(size=0.2)
        cube = bpy.context.object
        cube.name, cube.parent = "Pretty", bpy.data.objects.new("rig", None)
        return cube

    def test_an_object_marked_for_a_body_moves(self):
        cube = self.own_graphics()
        cube["pong_body"] = "ball"
        made = show(Log(self.log_folder), Options(fps=100))
        self.assertIs(made.objects["ball"], cube)
        self.assertNotIn("ball/skin", bpy.data.objects)
        np.testing.assert_allclose(cube.evaluated_get(self.at(101)).matrix_world.translation, (0.5, 0.0, 0.1), atol=1e-6)

    def test_an_object_with_the_name_of_a_body_moves(self):
        self.own_graphics().name = "ball"
        made = show(Log(self.log_folder), Options(fps=100))
        self.assertEqual(made.objects["ball"].type, "MESH")

    def test_what_else_moves_the_object_yields_and_is_told_and_stays_as_it_was(self):
        cube = self.own_graphics()
        cube["pong_body"] = "ball"
        cube.parent.scale = (2.0, 2.0, 2.0)
        bpy.context.scene.collection.objects.link(cube.parent)
        cube.constraints.new("LIMIT_LOCATION").use_max_x = True
        cube.keyframe_insert("location", frame=1)
        made = show(Log(self.log_folder), Options(fps=100))
        matrix = np.array(cube.evaluated_get(self.at(101)).matrix_world)
        np.testing.assert_allclose(matrix[:3, 3], (0.5, 0.0, 0.1), atol=1e-6)
        np.testing.assert_allclose(np.linalg.norm(matrix[:3, :3], axis=0), 2.0, atol=1e-5)
        for told in ("not its parent `rig`", "not constraint `Limit Location`", "not its own animation"):
            self.assertIn(told, " ".join(made.notes))
        self.assertEqual((cube.parent.name, cube.constraints["Limit Location"].mute), ("rig", False))
        self.assertIsNotNone(cube.animation_data.action)
        self.assertEqual(show(Log(self.log_folder), Options(fps=100)).notes, [])

    def test_marks_that_cannot_be_meant_are_told(self):
        self.own_graphics()["pong_body"] = "ball"
        self.own_graphics()["pong_body"] = "ball"
        with self.assertRaisesRegex(ValueError, "`ball` is to move `Pretty`, `Pretty.001`; parent them to one"):
            show(Log(self.log_folder), Options())
        bpy.data.objects["Pretty.001"]["pong_body"] = "moon"
        self.assertRegex(show(Log(self.log_folder), Options()).notes[0], "`Pretty.001` is marked for body `moon`, which is not")
        with self.assertRaisesRegex(ValueError, "both to move `Pretty`"):
            show(Log(self.log_folder), Options(graphics={"ball": "Pretty", "ground": "Pretty"}))

    def test_primitives_over_graphics_while_they_touch(self):
        cube = self.own_graphics()
        cube["pong_body"], cube.scale = "ball", (3.0, 3.0, 3.0)
        show(Log(self.log_folder), Options(fps=100, shapes="touched"))
        skin = bpy.data.objects["ball/skin"].evaluated_get(self.at(51))
        np.testing.assert_allclose(skin.matrix_world.translation, (0.25, 0.0, 0.1), atol=1e-6)
        np.testing.assert_allclose(skin.dimensions, 0.2, rtol=0.02)
        self.assertFalse(skin.hide_render)
        self.at(52)
        self.assertTrue(bpy.data.objects["ball/skin"].hide_render)
        self.assertNotIn("ball/mark", bpy.data.objects)

    def test_the_authors_camera_and_settings_can_stay(self):
        self.own_graphics()
        scene = bpy.context.scene
        scene.camera = bpy.data.objects.new("Mine", bpy.data.cameras.new("Mine"))
        scene.collection.objects.link(scene.camera)
        scene.render.resolution_x, scene.render.resolution_y = 96, 64
        own, made = self.folder / "own.blend", self.folder / "made.blend"
        bpy.ops.wm.save_as_mainfile(filepath=str(own))
        before = own.read_bytes()
        words = [str(self.log_folder), "--graphics", str(own), "--own-camera", "--engine", "scene", "--blend", str(made)]
        self.assertEqual(main(words), 0)
        bpy.ops.wm.open_mainfile(filepath=str(made))
        scene = bpy.context.scene
        self.assertEqual((scene.camera.name, scene.render.resolution_x), ("Mine", 96))
        self.assertEqual(main([*words[:-1], str(own)]), 2)
        self.assertEqual(own.read_bytes(), before)

    def test_an_object_named_on_the_command_line_moves(self):
        self.own_graphics()
        blend = self.folder / "own.blend"
        bpy.ops.wm.save_as_mainfile(filepath=str(blend))
        made = self.folder / "made.blend"
        words = [str(self.log_folder), "--graphics", str(blend), "--map", "ball=Pretty", "--blend", str(made), "--fps", "50"]
        self.assertEqual(main(words), 0)
        bpy.ops.wm.open_mainfile(filepath=str(made))
        bpy.context.scene.frame_set(51)
        np.testing.assert_allclose(bpy.data.objects["Pretty"].matrix_world.translation, (0.5, 0.0, 0.1), atol=1e-6)
        self.assertEqual(main([*words[:3], "--map", "ball=Nobody", "--blend", str(made)]), 1)


class Removed(WithScene):
    """A response leaves the author's file unchanged: while it is shown, and after its removal."""

    LOOK = ("frame_start", "frame_end", "frame_current", "camera", "world")

    def setUp(self):
        super().setUp()
        for package in (pong_pmtk, pong_viz):
            package.register()
            self.addCleanup(package.unregister)
        bpy.ops.mesh.primitive_cube_add(size=0.1, location=(0.0, 0.0, -0.05))
        plate = bpy.context.object
        bpy.ops.mesh.primitive_uv_sphere_add(radius=0.02, location=(0.3, 0.0, 0.05))
        ball = bpy.context.object
        plate.name, ball.name = "plate", "sphere"
        self.choose(plate, ball)
        bpy.ops.pong.mark()
        bpy.ops.pong.root_new(name="ground")
        bpy.ops.pong.surface_add(name="s", stiffness=1e5)
        bpy.ops.pong.surface_assign(surface="s")
        for item, name, movable in ((plate, "base", False), (ball, "ball", True)):
            self.choose(item)
            bpy.ops.pong.group_new(name=name, movable=movable, origin="MEDIAN")
        # A modifier's use of another object's pose counts too.
        mirror = plate.modifiers.new("Mirror", "MIRROR")
        mirror.mirror_object = bpy.data.objects["sphere"]
        self.before = self.exported(), self.state()

    def choose(self, *objects):
        for item in bpy.context.view_layer.objects:
            item.select_set(item in objects)
        bpy.context.view_layer.objects.active = objects[0]

    def exported(self):
        self.choose(bpy.data.objects["ground"])
        path = self.folder / "ground.ron"
        self.assertEqual(bpy.ops.pong.export_ron(filepath=str(path)), {"FINISHED"})
        return path.read_bytes()

    def state(self):
        bpy.context.view_layer.update()
        scene, render = bpy.context.scene, bpy.context.scene.render
        objects = {item.name: (item.parent and item.parent.name, [each.name for each in item.constraints],
                               item.animation_data and item.animation_data.action, tuple(map(tuple, item.matrix_world)))
                   for item in scene.objects}
        settings = [getattr(scene, name) for name in self.LOOK] + [render.fps, render.engine, render.resolution_x]
        settings += [scene.view_settings.view_transform, scene.display.shading.color_type, [key for key in scene.keys() if key in ("pong_before", "pong_response")]]
        kinds = (bpy.data.objects, bpy.data.meshes, bpy.data.actions, bpy.data.cameras, bpy.data.lights, bpy.data.materials,
                 bpy.data.collections, bpy.data.worlds)
        return objects, settings, [sorted(kind.keys()) for kind in kinds]

    def show(self):
        self.assertEqual(bpy.ops.pong.import_response(filepath=str(self.log_folder / "run.json"), fps=50), {"FINISHED"})
        bpy.context.scene.frame_set(bpy.context.scene.frame_end)

    def test_it_is_shown_and_taken_out_again(self):
        for _ in range(2):
            self.show()
            self.show()  # once more replaces the first
            ball = bpy.data.objects["ball"]
            np.testing.assert_allclose(ball.matrix_world.translation, (0.5, 0.0, 0.1), atol=1e-6)
            self.assertEqual(ball.parent.name, "ground")
            self.assertEqual(self.exported(), self.before[0])
            np.testing.assert_allclose(ball.matrix_world.translation, (0.5, 0.0, 0.1), atol=1e-6)
            self.assertEqual(bpy.ops.pong.remove_response(), {"FINISHED"})
            self.assertEqual(self.exported(), self.before[0])
            self.assertEqual(self.state(), self.before[1])
        self.assertFalse(bpy.ops.pong.remove_response.poll())

    def test_a_file_is_mended_by_the_command_line(self):
        self.show()
        shown, clean = self.folder / "shown.blend", self.folder / "clean.blend"
        bpy.ops.wm.save_as_mainfile(filepath=str(shown))
        with redirect_stderr(io.StringIO()) as told:
            self.assertEqual(main(["--remove", str(shown)]), 2)
            self.assertEqual(main(["--remove", str(self.folder / "no.blend"), "--blend", str(clean)]), 1)
        self.assertIn("needs --blend", told.getvalue())
        self.assertEqual(main(["--remove", str(shown), "--blend", str(clean)]), 0)
        bpy.ops.wm.open_mainfile(filepath=str(clean))
        self.assertEqual(self.exported(), self.before[0])
        self.assertEqual(self.state()[2][2:5], [[], [], []])
        with redirect_stderr(io.StringIO()):
            self.assertEqual(main(["--remove", str(clean), "--blend", str(clean)]), 1)


class Renders(WithScene):
    def test_a_still_shows_arrow_and_highlight(self):
        touching, apart = self._red_and_amber("0.4"), self._red_and_amber("0.9")
        self.assertGreater(touching[0], 40)
        self.assertGreater(touching[1], 400)
        self.assertEqual(apart, (0, 0))

    def _red_and_amber(self, at):
        still = self.folder / "still.png"
        words = [str(self.log_folder), "--still", str(still), "--size", "320x180", "--at", at, "--arrow", "0.2"]
        self.assertEqual(main(words), 0)
        red, green, blue = np.moveaxis(_pixels(still)[..., :3], -1, 0)
        return int(((red > 0.4) & (green < 0.4 * red)).sum()), int(((red > 0.4) & (green > 0.5 * red) & (blue < 0.5 * green)).sum())

    def test_pictures_and_film(self):
        frames, film = self.folder / "frames", self.folder / "film.mp4"
        words = [str(self.log_folder), "--frames", str(frames), "-o", str(film), "--size", "160x90", "--fps", "5"]
        self.assertEqual(main(words), 0)
        self.assertEqual(len(list(frames.glob("frame_*.png"))), 6)
        clip = bpy.data.movieclips.load(str(film))
        self.assertEqual((tuple(clip.size), clip.frame_duration), ((160, 90), 6))

    def test_a_quick_film_has_no_shadows_and_smooths_as_told(self):
        for words, shadows, smoothing in (
            (["--quick"], False, "FXAA"), ([], True, "8"), (["--quick", "--no-smoothing"], False, "OFF"),
        ):
            made = self.folder / "made.blend"
            self.assertEqual(main([str(self.log_folder), *words, "--blend", str(made)]), 0)
            bpy.ops.wm.open_mainfile(filepath=str(made))
            display = bpy.context.scene.display
            self.assertEqual((display.shading.show_shadows, display.render_aa), (shadows, smoothing))

    def test_marks_have_the_radius_that_is_given(self):
        made = show(Log(self.log_folder), Options(mark_radius=0.02), bpy.context.scene)
        radii = sorted(made.marks[0].scale)
        np.testing.assert_allclose(radii, [0.02 / 3.0, 0.02, 0.02], rtol=1e-6)

    def test_odd_sizes_make_a_film_too_and_old_pictures_go(self):
        frames, film = self.folder / "frames", self.folder / "film.mp4"
        for fps, count in ((5, 6), (2, 3)):
            words = [str(self.log_folder), "--frames", str(frames), "-o", str(film), "--size", "65x37", "--fps", str(fps)]
            self.assertEqual(main(words), 0)
            self.assertEqual(len(list(frames.iterdir())), count)
        self.assertEqual(tuple(bpy.data.movieclips.load(str(film)).size), (66, 38))

    def test_the_camera_stands_where_it_is_told(self):
        made, away = self.folder / "made.blend", np.array([-2.0, 1.0, 0.5])
        self.assertEqual(main([str(self.log_folder), "--look-from=-2,1,0.5", "--blend", str(made)]), 0)
        bpy.ops.wm.open_mainfile(filepath=str(made))
        looks = -np.array(bpy.context.scene.camera.matrix_world)[:3, 2]
        np.testing.assert_allclose(looks, -away / np.linalg.norm(away), atol=1e-6)

    def test_the_camera_has_the_ball_in_the_picture_that_it_is_told(self):
        made, center, radius = self.folder / "made.blend", np.array([0.5, -0.2, 0.1]), 0.3
        self.assertEqual(main([str(self.log_folder), "--look-at", "0.5,-0.2,0.1,0.3", "--blend", str(made)]), 0)
        bpy.ops.wm.open_mainfile(filepath=str(made))
        scene, camera = bpy.context.scene, bpy.context.scene.camera
        pose = np.array(camera.matrix_world)
        away = pose[:3, 3] - center
        np.testing.assert_allclose(away / np.linalg.norm(away), pose[:3, 2], atol=1e-6)
        shorter = np.arctan(np.tan(camera.data.angle / 2) * scene.render.resolution_y / scene.render.resolution_x)
        self.assertAlmostEqual(np.arcsin(radius / np.linalg.norm(away)) / shorter, 1.0, delta=0.03)

    def test_a_place_that_cannot_be_written_is_told(self):
        (self.folder / "file").write_text("")
        for words in (["-o", "nowhere/film.mp4"], ["--still", "nowhere/x.png"], ["--frames", "file"], ["--blend", "nowhere/a.blend"]):
            with self.subTest(words), redirect_stderr(io.StringIO()) as told:
                words = [words[0], str(self.folder / words[1])]
                self.assertEqual(main([str(self.log_folder), *words, "--size", "16x16", "--fps", "2"]), 1)
                self.assertRegex(told.getvalue(), "nowhere|file")

    def test_faults_are_told_and_nothing_is_written(self):
        still = self.folder / "still.png"
        log = str(self.log_folder)
        for code, words in ((1, [str(self.folder)]), (1, [log, "--from", "5"]), (1, [log, "--from", "nan"]),
                            (1, [log, "--relative-to", "moon"]), (1, [log, "--own-camera"]), (1, [log, "--map", "moon=x"]),
                            (2, [log, "--size", "big"]), (2, [log, "--speed", "nan"]), (2, [log, "--map", "ball"]),
                            (2, [log, "-o", "film.avi"]), (2, [log, "--look-from", "0,0,0"]), (2, [log, "--look-at", "0,0,0"])):
            with self.subTest(words), redirect_stderr(io.StringIO()) as told:
                self.assertEqual(main([*words, "--still", str(still)]), code)
                self.assertIn("pong_viz: ", told.getvalue())
        self.assertFalse(still.exists())


class Captions(WithScene):
    def test_a_caption_tells_time_force_and_scale(self):
        made = show(Log(self.log_folder), Options(fps=100))
        scene = bpy.context.scene
        largest = np.hypot(10.0 * 1.3, 2.0)
        self.assertEqual(captions.text(scene, 31).split("   "), [
            " t = 0.3000 s", f"1 contact, largest force {largest:.4g} N",
            f"1 m of arrow: {1.0 / made.metres_per_newton:.4g} N "])
        self.assertIn("t = 0.9000 s   no contact", captions.text(scene, 91))
        self.assertEqual(captions.text(bpy.data.scenes.new("other"), 1), "")

    def test_it_is_in_the_picture_and_nowhere_else(self):
        show(Log(self.log_folder), Options(fps=10))
        scene, render_ = bpy.context.scene, bpy.context.scene.render
        render.prepare(scene, render.Picture(640, 90))
        render_.use_stamp_scene, render_.stamp_note_text = True, "mine"
        before = {name: getattr(render_, name) for name in captions.STAMPS if hasattr(render_, name)}
        pictures = {}
        for name, caption in (("with", True), ("without", False)):
            pictures[name] = _pixels(render.still(scene, self.folder / f"{name}.png", 4, caption))
        differ = (np.abs(pictures["with"] - pictures["without"]).max(axis=2) > 0.1).nonzero()
        self.assertGreater(len(differ[0]), 500)
        self.assertGreater(differ[0].min(), 70)  # in the lines at the top alone
        self.assertEqual((before, "mine", False), (
            {name: getattr(render_, name) for name in before}, render_.stamp_note_text, render_.use_stamp))
        self.assertEqual(bpy.app.handlers.render_pre[:], [])

    def test_it_goes_along_with_the_pictures(self):
        show(Log(self.log_folder), Options(fps=2))
        scene, told = bpy.context.scene, []
        render.prepare(scene, render.Picture(64, 36))
        scene.render.stamp_note_text = ""

        def note(rendered, *_arguments):
            told.append(rendered.render.stamp_note_text)

        bpy.app.handlers.render_post.append(note)
        self.addCleanup(bpy.app.handlers.render_post.remove, note)
        render.frames(scene, self.folder / "frames")
        self.assertEqual([text.split()[2] for text in told], ["0.0000", "0.5000", "1.0000"])


class Colors(WithScene):
    def color_types(self):
        return {space.shading.color_type for screen in bpy.data.screens for area in screen.areas for space in area.spaces
                if space.type == "VIEW_3D"}

    def test_solid_views_show_the_objects_colors(self):
        pong_viz.register()
        self.addCleanup(pong_viz.unregister)
        before = self.color_types()
        self.assertTrue(before and before != {"OBJECT"})
        bpy.ops.pong.import_response(filepath=str(self.log_folder), fps=4, look=False)
        self.assertEqual(self.color_types(), before)
        bpy.ops.pong.import_response(filepath=str(self.log_folder), fps=4)
        self.assertEqual(self.color_types(), {"OBJECT"})

    def test_a_saved_scene_opens_in_colors(self):
        blend = self.folder / "run.blend"
        self.assertEqual(main([str(self.log_folder), "--blend", str(blend)]), 0)
        bpy.ops.wm.open_mainfile(filepath=str(blend), load_ui=True)
        self.assertEqual(self.color_types(), {"OBJECT"})

    def test_no_engine_fades_colors(self):
        """Standard view keeps the colours; the exposure compensates for light beyond a white surface."""
        scene = bpy.context.scene
        show(Log(self.log_folder), Options(fps=4))
        for engine in ("workbench", "eevee", "cycles"):
            scene.view_settings.view_transform = "Filmic" if engine == "workbench" else "AgX"
            render.prepare(scene, render.Picture(16, 16, engine))
            self.assertEqual(scene.view_settings.view_transform, "Standard", engine)
        suns = sum(item.data.energy for item in scene.objects if item.type == "LIGHT") / np.pi
        lit = suns + max(render.BACKGROUND)
        self.assertLess(lit * 2.0**scene.view_settings.exposure, 1.3)

    def test_a_lit_picture_has_the_colors_that_were_given(self):
        """Cycles lights like EEVEE, without compiled shaders: red arrow, orange ball, with their own saturation."""
        still = self.folder / "still.png"
        words = [str(self.log_folder), "--still", str(still), "--size", "160x90", "--at", "0.3", "--engine", "cycles"]
        self.assertEqual(main([*words, "--samples", "4", "--alpha", "1", "--no-caption"]), 0)
        pixels = _pixels(still)[..., :3]
        strongest = pixels.max(axis=2)
        saturation = (strongest - pixels.min(axis=2)) / np.maximum(strongest, 1e-6)
        ball = (pixels[..., 0] > 0.3) & (pixels[..., 2] < 0.5 * pixels[..., 0])
        self.assertGreater(ball.sum(), 100)
        self.assertGreater(np.median(saturation[ball]), 0.75)
        self.assertLess((strongest > 0.995).mean(), 0.05)  # hardly anything is burnt out


class Interface(WithScene):
    def setUp(self):
        super().setUp()
        pong_viz.register()
        self.addCleanup(pong_viz.unregister)

    def test_import_from_the_menu(self):
        done = bpy.ops.pong.import_response(filepath=str(self.log_folder / "run.json"), fps=100)
        self.assertEqual(done, {"FINISHED"})
        self.assertEqual(bpy.context.scene.frame_end, 101)
        self.assertIn("ball", bpy.data.objects)

    def test_faults_reach_the_user(self):
        os.remove(self.log_folder / "states.npy")
        with self.assertRaisesRegex(RuntimeError, "states.npy: it is missing"):
            bpy.ops.pong.import_response(filepath=str(self.log_folder / "run.json"))

    def test_a_part_of_the_run_in_the_scenes_own_look(self):
        engine = bpy.context.scene.render.engine
        bpy.ops.pong.import_response(filepath=str(self.log_folder), fps=100, part=True, start=0.2, end=0.4, look=False)
        self.assertEqual((bpy.context.scene.frame_end, bpy.context.scene.render.engine), (21, engine))

    def test_film_pictures_and_still(self):
        with self.assertRaisesRegex(RuntimeError, "no camera"):
            bpy.ops.pong.render_response(filepath=str(self.folder / "a.mp4"))
        bpy.ops.pong.import_response(filepath=str(self.log_folder), fps=4)
        scene = bpy.context.scene
        scene.render.resolution_x, scene.render.resolution_y, scene.render.filepath = 81, 45, "//mine"
        scene.frame_set(2)
        before = render.kept(scene)
        film, frames, still = self.folder / "film.mp4", self.folder / "frames", self.folder / "still.png"
        for form, path in (("FILM", film), ("FRAMES", frames), ("STILL", still)):
            self.assertEqual(bpy.ops.pong.render_response(filepath=str(path), form=form), {"FINISHED"})
        self.assertEqual(len(list(frames.glob("frame_*.png"))), 5)
        self.assertEqual(bpy.data.movieclips.load(str(film)).frame_duration, 5)
        self.assertEqual(_pixels(still).shape, (45, 81, 4))
        np.testing.assert_array_equal(_pixels(still), _pixels(frames / "frame_0002.png"))
        self.assertEqual(render.kept(scene), before)
        with self.assertRaisesRegex(RuntimeError, "must end in .mp4"):
            bpy.ops.pong.render_response(filepath=str(self.folder / "film.avi"))

    def test_binding_and_freeing_an_object(self):
        bpy.ops.mesh.primitive_cube_add()
        bpy.ops.pong.bind_body(body="ball")
        self.assertEqual(bpy.context.object["pong_body"], "ball")
        bpy.ops.pong.import_response(filepath=str(self.log_folder), fps=100)
        moved = bpy.context.object.evaluated_get(self.at(101)).matrix_world.translation
        np.testing.assert_allclose(moved, (0.5, 0.0, 0.1), atol=1e-6)
        bpy.ops.pong.free_object()
        self.assertNotIn("pong_body", bpy.context.object)

    def test_the_bodies_of_the_log_are_listed(self):
        from pong_viz import ui

        bpy.ops.mesh.primitive_cube_add()
        cube, scene = bpy.context.object, bpy.context.scene
        self.assertEqual(ui._search_body(None, bpy.context, ""), [])
        for path in (self.log_folder / "run.json", self.log_folder):
            scene.pong_response_log = str(path)
            self.assertEqual([name for name, _ in ui._search_body(None, bpy.context, "")], ["ball", "ground"])
        bpy.ops.pong.bind_body(body="ground")
        self.assertEqual(ui._search_body(None, bpy.context, "GR"), [("ground", f"moves {cube.name}")])
        for path in (self.folder / "nothing.json", self.log_folder / "frames.npy"):
            scene.pong_response_log = str(path)
            self.assertEqual(ui._search_body(None, bpy.context, ""), [])

    def test_an_import_remembers_its_log(self):
        from pong_viz import ui

        bpy.ops.pong.import_response(filepath=str(self.log_folder / "run.json"), fps=4)
        self.assertEqual(ui.bodies_of(bpy.context.scene.pong_response_log), ["ball", "ground"])

    def test_the_panel_names_operators_that_exist(self):
        source = Path(pong_viz.__file__).with_name("ui.py").read_text()
        for name in re.findall(r'bl_idname = "pong\.(\w+)"', source):
            self.assertTrue(hasattr(bpy.types, f"PONG_OT_{name}"), name)


def _pixels(path: Path) -> np.ndarray:
    image = bpy.data.images.load(str(path), check_existing=False)
    width, height = image.size
    return np.array(image.pixels[:]).reshape(height, width, 4)

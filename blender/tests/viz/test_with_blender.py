# SPDX-License-Identifier: GPL-3.0-or-later
"""Playback in Blender: keyframes, colours, pictures and films, from the command line and from the interface."""

import os
import shutil
import tempfile
import unittest
from pathlib import Path

import bpy
import numpy as np

import pong_viz
from pong_viz.__main__ import main
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

    def test_faults_are_told_and_nothing_is_written(self):
        still = self.folder / "still.png"
        for words in ([str(self.folder)], [str(self.log_folder), "--from", "5"], [str(self.log_folder), "--size", "big"],
                      [str(self.log_folder), "--relative-to", "moon"]):
            self.assertEqual(main([*words, "--still", str(still)]), 1)
        self.assertFalse(still.exists())


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

    def test_binding_an_object(self):
        bpy.ops.mesh.primitive_cube_add()
        bpy.ops.pong.bind_body(body="ball")
        self.assertEqual(bpy.context.object["pong_body"], "ball")


def _pixels(path: Path) -> np.ndarray:
    image = bpy.data.images.load(str(path), check_existing=False)
    width, height = image.size
    return np.array(image.pixels[:]).reshape(height, width, 4)

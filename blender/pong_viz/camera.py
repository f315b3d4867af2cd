# SPDX-License-Identifier: GPL-3.0-or-later
"""A camera that has the whole run in view, and lights."""

import bpy
import numpy as np
from mathutils import Vector

DIRECTION = (1.0, -1.5, 0.75)  # from what is looked at to the camera


def frame_camera(scene, collection, bodies, direction=DIRECTION, lens_mm: float = 50.0):
    """Adds a camera that sees every body in every picture, and two suns."""
    low, high = _box_of_run(scene, bodies)
    center, radius = 0.5 * (low + high), max(0.5 * float(np.linalg.norm(high - low)), 1e-3)
    data = bpy.data.cameras.new("Pong camera")
    data.lens = lens_mm
    camera = bpy.data.objects.new("Pong camera", data)
    collection.objects.link(camera)
    aspect = scene.render.resolution_y / max(1, scene.render.resolution_x)
    half_angle = 0.5 * data.angle * min(1.0, aspect)
    away = Vector(direction).normalized()
    distance = float(1.02 * radius / np.sin(half_angle))
    camera.location = Vector(center) + distance * away
    camera.rotation_mode = "QUATERNION"
    camera.rotation_quaternion = away.to_track_quat("Z", "Y")
    data.clip_start, data.clip_end = 0.001 * distance, 10.0 * distance + 4.0 * radius
    scene.camera = camera
    for name, energy, way in (("Pong key light", 3.0, (0.5, -1.0, 1.5)), ("Pong fill light", 1.0, (-1.0, -0.3, 0.5))):
        light = bpy.data.objects.new(name, bpy.data.lights.new(name, "SUN"))
        light.data.energy = energy
        light.rotation_mode = "QUATERNION"
        light.rotation_quaternion = Vector(way).normalized().to_track_quat("Z", "Y")
        collection.objects.link(light)
    return camera


def _box_of_run(scene, bodies, samples: int = 24):
    """Box around all bodies with what hangs on them, over the run. Planes have no end: they do not count."""
    points = []
    for picture in np.unique(np.linspace(scene.frame_start, scene.frame_end, samples).astype(int)):
        scene.frame_set(int(picture))
        for body in bodies:
            for item in (body, *body.children_recursive):
                points += _corners(item)
    scene.frame_set(scene.frame_start)
    points = np.array(points)
    return points.min(axis=0), points.max(axis=0)


def _corners(item):
    if item.type != "MESH" or item.get("pong_kind") == "Plane":
        return [tuple(item.matrix_world.translation)]
    return [tuple(item.matrix_world @ Vector(corner)) for corner in item.bound_box]

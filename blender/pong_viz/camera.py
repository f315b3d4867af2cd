# SPDX-License-Identifier: GPL-3.0-or-later
"""A camera that has the whole run in view, and lights."""

import bpy
import numpy as np
from mathutils import Vector

DIRECTION = (1.0, -1.5, 0.75)  # from what is looked at to the camera
SOLID = {"MESH", "CURVE", "SURFACE", "META", "FONT"}  # objects that have a size
LARGE = 20.0  # times what is looked at: a terrain, not what the camera is for


def frame_camera(scene, collection, bodies, points, extent: float, direction=DIRECTION, ball=None, lens_mm: float = 50.0):
    """Adds a camera that sees the bodies in every picture and all points, and two suns. `extent`: size of the subject.

    `ball`: centre and radius of what fills the picture instead.
    """
    center, radius = (ball[:3], float(ball[3])) if ball is not None else _ball_of_run(scene, bodies, points, extent)
    data = bpy.data.cameras.new("Pong camera")
    data.lens = lens_mm
    camera = bpy.data.objects.new("Pong camera", data)
    collection.objects.link(camera)
    sides = sorted((scene.render.resolution_x, scene.render.resolution_y))
    half_angle = np.arctan(np.tan(0.5 * data.angle) * sides[0] / sides[1])  # the lens tells that of the longer side
    away = Vector(direction).normalized()
    distance = float(1.02 * radius / np.sin(half_angle))
    camera.location = Vector(center) + distance * away
    camera.rotation_mode = "QUATERNION"
    camera.rotation_quaternion = away.to_track_quat("Z", "Y")
    data.clip_start, data.clip_end = 0.001 * distance, 10.0 * distance + 4.0 * max(radius, extent)
    scene.camera = camera
    for name, energy, way in (("Pong key light", 3.0, (0.5, -1.0, 1.5)), ("Pong fill light", 1.0, (-1.0, -0.3, 0.5))):
        light = bpy.data.objects.new(name, bpy.data.lights.new(name, "SUN"))
        light.data.energy = energy
        light.rotation_mode = "QUATERNION"
        light.rotation_quaternion = Vector(way).normalized().to_track_quat("Z", "Y")
        collection.objects.link(light)
    return camera


def _ball_of_run(scene, bodies, points, extent: float):
    low, high = _box_of_run(scene, _looked_at(bodies, extent), points)
    return 0.5 * (low + high), max(0.5 * float(np.linalg.norm(high - low)), 0.05 * extent)


def _looked_at(bodies, extent: float) -> list:
    """Bodies of finite size; all if there are none."""
    chosen = []
    for body in bodies:
        corners = np.array([corner for item in _solid(body) for corner in _corners(item)])
        instanced = body.instance_type == "COLLECTION"
        if instanced or (len(corners) and np.ptp(corners, axis=0).max() <= LARGE * extent):
            chosen.append(body)
    return chosen or bodies


def _solid(body) -> list:
    return [item for item in (body, *body.children_recursive) if item.type in SOLID and item.get("pong_kind") != "Plane"]


def _box_of_run(scene, bodies, points, samples: int = 24):
    """Box around all bodies with their shapes, over the run, and around points. Planes are infinite and do not count."""
    found = [points]
    for picture in np.unique(np.linspace(scene.frame_start, scene.frame_end, samples).astype(int)):
        scene.frame_set(int(picture))
        for body in bodies:
            found.append(np.array([corner for item in _solid(body) for corner in _corners(item)] or [body.matrix_world.translation]))
    scene.frame_set(scene.frame_start)
    joined = np.concatenate([np.zeros((0, 3)), *found])
    if len(joined) == 0:
        return np.zeros(3), np.zeros(3)
    return joined.min(axis=0), joined.max(axis=0)


def _corners(item):
    return [tuple(item.matrix_world @ Vector(corner)) for corner in item.bound_box]

# SPDX-License-Identifier: GPL-3.0-or-later
"""Volumes hold what they bound and are no larger than they need be; overlays lie where the model is."""

import math
import random
import re
import unittest

from support import PONG, built, check_model, np, scene
from core import bounds, overlay
from core.author import box, cylinder, mesh
from core.transforms import quaternion_matrix


def sampled(volume, points):
    """By how much points stick out of a volume."""
    if volume.kind == "Sphere":
        return float((np.sqrt(((points - volume.center) ** 2).sum(axis=1)) - volume.half[0]).max())
    return float((np.abs((points - volume.center) @ volume.axes) - volume.half).max())


def on_ball(count, rng):
    points = rng.normal(size=(count, 3))
    return points / np.sqrt((points**2).sum(axis=1, keepdims=True))


class Fits(unittest.TestCase):
    def things(self, case):
        rng = np.random.default_rng(case)
        points = rng.normal(size=(rng.integers(1, 40), 3)) * rng.uniform(0.01, 5, 3)
        balls = rng.normal(size=(3, 3))
        radii = rng.uniform(0.1, 1, 3)
        arms = np.linalg.qr(rng.normal(size=(3, 3)))[0] * rng.uniform(0.1, 3, 3)
        center = rng.normal(size=3)
        zero = np.zeros((len(points) + 3, 3))
        things = bounds.Things(
            np.concatenate([points, balls]), np.concatenate([np.zeros(len(points)), radii]), zero, [(center, arms)]
        )
        sphere = on_ball(2000, rng)
        cloud = np.concatenate([points, *(b + r * sphere for b, r in zip(balls, radii)), center + sphere @ arms.T])
        return things, cloud

    def test_everything_is_inside_and_the_fit_is_close(self):
        for case in range(12):
            things, cloud = self.things(case)
            sizes = {}
            for kind in ("Aabb", "Sphere", "Obb"):
                volume = bounds.fit(kind, things)
                self.assertLessEqual(sampled(volume, cloud), 1e-9)
                sizes[kind] = float(np.prod(volume.half))
            self.assertLessEqual(sizes["Obb"], sizes["Aabb"] * (1 + 1e-9))
            aabb = bounds.fit("Aabb", things)
            np.testing.assert_allclose(aabb.half, np.ptp(cloud, axis=0) / 2, rtol=0.02)
            ball = bounds.fit("Sphere", things)
            self.assertLess(ball.half[0], 1.02 * np.sqrt(aabb.half @ aabb.half))

    def test_known_volumes(self):
        tilt = quaternion_matrix((0.9, 0.1, 0.3, 0.3))
        corners = box((1.0, 2.0, 3.0)).vertices @ tilt.T + (5.0, 0.0, 0.0)
        zero = np.zeros((8, 3))
        obb = bounds.fit("Obb", bounds.Things(corners, np.zeros(8), zero))
        np.testing.assert_allclose(np.prod(2 * obb.half), 6.0, rtol=1e-3)
        ball = bounds.fit("Sphere", bounds.Things(corners, np.zeros(8), zero))
        np.testing.assert_allclose(ball.half[0], math.sqrt(14) / 2, rtol=2e-3)
        np.testing.assert_allclose(ball.center, (5.0, 0.0, 0.0), atol=5e-3)

    def test_very_many_points(self):
        rng = np.random.default_rng(4)
        points = rng.normal(size=(3000, 3)) @ np.diag([3.0, 1.0, 0.2])
        things = bounds.Things(points, np.zeros(3000), np.zeros((3000, 3)))
        for kind in ("Sphere", "Obb"):
            self.assertLessEqual(sampled(bounds.fit(kind, things), points), 1e-9)

    def test_planes_have_no_bounds(self):
        s = scene()
        s.primitive("ground", "Plane")
        volumes = bounds.volumes(built(s).model)
        self.assertEqual(volumes["model"].kind, "Unbounded")
        self.assertEqual(overlay.bounds_lines(built(s).model), {})

    def test_thick_triangles_are_thick_behind_their_front(self):
        s = scene()
        s.mesh("sheet", "TriangleMesh", mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [[0, 1, 2]]), thickness=0.25)
        volume = bounds.volumes(built(s).model)["model"]
        self.assertEqual(volume.center[2] + volume.half[2], 0.0)
        self.assertEqual(volume.center[2] - volume.half[2], -0.25)

    @unittest.skipUnless(PONG, "PONG does not name the program")
    def test_extents_are_those_that_the_engine_prints(self):
        random.seed(31)
        for _ in range(5):
            s = scene()
            arm = s.group("arm", location=(1.0, 2.0, 3.0), rotation_mode="XYZ", rotation=(0.1, 0.2, 0.3))
            s.mesh("drum", "Polyhedron", cylinder(random.random(), 0.0, random.random(), 7), above=arm)
            s.primitive(
                "egg", "Ellipsoid", above=arm, semi_axes=(0.1, random.random(), 0.5), rotation=(0.5, 0.5, 0.5, 0.5)
            )
            s.primitive("ray", "Ray", above=arm, length=random.random(), reach=0.3)
            model = built(s).model
            volume = bounds.volumes(model)["model"]
            _, text = check_model(model)
            low, high = (
                np.array(part.split(), dtype=float) for part in re.search(r"\((.*)\) … \((.*)\) m", text).groups()
            )
            np.testing.assert_allclose(low, volume.center - volume.half, rtol=1e-5, atol=1e-6)
            np.testing.assert_allclose(high, volume.center + volume.half, rtol=1e-5, atol=1e-6)


class Overlays(unittest.TestCase):
    def model(self):
        s = scene()
        arm = s.group(
            "arm", movable=True, location=(1.0, 0.0, 0.0), rotation_mode="XYZ", rotation=(0.0, 0.0, math.pi / 2)
        )
        hand = s.group("hand", above=arm, location=(0.0, 0.0, 1.0))
        s.mesh("block", "Polyhedron", box((2.0, 2.0, 2.0)), above=hand, inactive_faces=[0])
        s.primitive("ray", "Ray", above=hand, length=0.5, reach=0.1)
        return built(s).model

    def test_bounds_lie_in_the_frame_of_the_root(self):
        lines = overlay.bounds_lines(self.model())
        self.assertEqual(list(lines), ["model/arm", "model/arm/hand"][::-1])
        hand = lines["model/arm/hand"]
        self.assertEqual(hand.shape, (24, 3))
        np.testing.assert_allclose((hand.min(axis=0), hand.max(axis=0)), ((0, -1, 0), (2, 1, 2)), atol=1e-15)

    def test_normals_point_outward(self):
        lines = overlay.normals_lines(self.model(), 0.1)["model/arm/hand/block"].reshape(-1, 2, 3)
        self.assertEqual(len(lines), 5)
        center = np.array((1.0, 0.0, 1.0))
        for start, end in lines:
            self.assertAlmostEqual(np.linalg.norm(start - center), 1.0)
            self.assertAlmostEqual(np.linalg.norm(end - center), 1.1)

    def test_rays_and_groups(self):
        rays = overlay.rays_lines(self.model())["model/arm/hand/ray"]
        np.testing.assert_allclose(rays, [(1, 0, 1), (1, 0, 1.5), (1, 0, 0.9), (1, 0, 1)], atol=1e-15)
        groups = overlay.groups_lines(self.model(), 0.2)
        np.testing.assert_allclose(groups["model/arm"][:2], [(1, 0, 0), (1, 0.2, 0)], atol=1e-15)
        np.testing.assert_allclose(groups["model/arm/hand"][6:], [(1, 0, 0), (1, 0, 1)], atol=1e-15)
        self.assertEqual(len(groups["model"]), 6)

    def test_balls_are_three_circles(self):
        lines = overlay.volume_lines(bounds.Volume("Sphere", np.ones(3), np.full(3, 2.0)))
        self.assertEqual(lines.shape, (3 * 2 * overlay.CIRCLE, 3))
        np.testing.assert_allclose(np.linalg.norm(lines - 1.0, axis=1), 2.0)


if __name__ == "__main__":
    unittest.main()

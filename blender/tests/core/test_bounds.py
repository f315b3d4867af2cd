# SPDX-License-Identifier: GPL-3.0-or-later
"""Volumes contain their primitives tightly; overlays lie on the model."""

import math
import random
import re
import unittest

from support import PONG, built, check_model, np, scene
from core import bounds, overlay
from core.author import box, cylinder, mesh
from core.transforms import quaternion_matrix


def sampled(volume, points):
    """Largest distance of points outside a volume."""
    if volume.kind == "Sphere":
        return float((np.sqrt(((points - volume.center) ** 2).sum(axis=1)) - volume.half[0]).max())
    return float((np.abs((points - volume.center) @ volume.axes) - volume.half).max())


def on_ball(count, rng):
    points = rng.normal(size=(count, 3))
    return points / np.sqrt((points**2).sum(axis=1, keepdims=True))


KINDS = ("Aabb", "Sphere", "Obb")


class Fits(unittest.TestCase):
    """Volumes fitted by the engine, at the position of the overlays."""

    def scene(self, case, kind):
        """Points, spheres and an ellipsoid in a rotated group, with sample points on them in the frame of its body."""
        rng = np.random.default_rng(case)
        quaternion = rng.normal(size=4)
        quaternion /= np.sqrt(quaternion @ quaternion)
        turn, place = quaternion_matrix(quaternion), rng.normal(size=3)
        s = scene()
        arm = s.group("arm", bound=kind, location=tuple(place), rotation=tuple(quaternion))
        points = rng.normal(size=(rng.integers(1, 40), 3)) * rng.uniform(0.01, 5, 3)
        s.mesh("cloud", "Point", mesh(points), above=arm)
        cloud, sphere = [points], on_ball(2000, rng)
        for index in range(3):
            center, radius = rng.normal(size=3), rng.uniform(0.1, 1)
            s.primitive(f"ball{index}", "Sphere", above=arm, location=tuple(center), radius=radius)
            cloud.append(center + radius * sphere)
        center, axes = rng.normal(size=3), rng.uniform(0.1, 3, 3)
        s.primitive("egg", "Ellipsoid", above=arm, location=tuple(center), semi_axes=tuple(axes))
        # Triangles push an ellipsoid at contact points that may lie beside it: its bounds include those, too.
        feet = math.hypot(axes.max() - axes.min(), axes.min())
        cloud += [center + sphere * axes, center + sphere * feet]
        return s, np.concatenate(cloud) @ turn.T + place

    def test_everything_is_inside_and_the_fit_is_close(self):
        for case in range(12):
            sizes = {}
            for kind in KINDS:
                s, cloud = self.scene(case, kind)
                volume = sizes[kind] = bounds.volumes(built(s).loaded)["model/arm"]
                self.assertEqual(volume.kind, kind)
                self.assertLessEqual(sampled(volume, cloud), 1e-9)
            self.assertLessEqual(np.prod(sizes["Obb"].half), np.prod(sizes["Aabb"].half) * (1 + 1e-6))
            np.testing.assert_allclose(sizes["Aabb"].half, np.ptp(cloud, axis=0) / 2, rtol=0.02)
            self.assertLess(sizes["Sphere"].half[0], 1.02 * np.sqrt(sizes["Aabb"].half @ sizes["Aabb"].half))

    def test_known_volumes(self):
        found = {}
        for kind in KINDS:
            s = scene()
            arm = s.group("arm", bound=kind, location=(5.0, 0.0, 0.0), rotation=(0.9, 0.1, 0.3, 0.3))
            s.mesh("block", "Polyhedron", box((1.0, 2.0, 3.0)), above=arm)
            found[kind] = bounds.volumes(built(s).loaded)["model/arm"]
        np.testing.assert_allclose(np.prod(2 * found["Obb"].half), 6.0, rtol=1e-3)
        np.testing.assert_allclose(found["Sphere"].half[0], math.sqrt(14) / 2, rtol=2e-3)
        np.testing.assert_allclose(found["Sphere"].center, (5.0, 0.0, 0.0), atol=5e-3)

    def test_custom_primitives_and_volumes_are_the_hosts(self):
        s = scene()
        for name, more in (("arm", {"custom_bound": "torus"}), ("leg", {})):
            group = s.group(name, **more)
            s.primitive(f"{name}_spring", "Custom", above=group, custom_kind="spring", parameters=[1.0])
        s.primitive("ball", "Sphere", above=s.group("foot", bound="Aabb"), radius=1.0)
        made = built(s)
        self.assertEqual(set(bounds.volumes(made.loaded)), {"model", "model/foot"})
        alone = scene()
        alone.primitive("spring", "Custom", custom_kind="spring", parameters=[1.0])
        self.assertEqual(bounds.volumes(built(alone).loaded), {})

    def test_planes_have_no_bounds(self):
        s = scene()
        s.primitive("ground", "Plane")
        made = built(s)
        self.assertEqual(bounds.volumes(made.loaded), {})
        self.assertEqual(overlay.bounds_lines(made.model, made.loaded), {})

    def test_thick_triangles_are_thick_behind_their_front(self):
        s = scene()
        s.mesh("sheet", "TriangleMesh", mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [[0, 1, 2]]), thickness=0.25)
        volume = bounds.volumes(built(s).loaded)["model"]
        self.assertAlmostEqual(volume.center[2] + volume.half[2], 0.0, 6)
        self.assertAlmostEqual(volume.center[2] - volume.half[2], -0.25, 6)

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
            made = built(s)
            volume = bounds.volumes(made.loaded)["model"]
            _, text = check_model(made.model)
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
        hand = s.group("hand", above=arm, bound="Aabb", location=(0.0, 0.0, 1.0))
        s.mesh("block", "Polyhedron", box((2.0, 2.0, 2.0)), above=hand, inactive_faces=[0])
        s.primitive("ray", "Ray", above=hand, length=0.5, reach=0.1)
        return built(s)

    def test_bounds_lie_in_the_frame_of_the_root(self):
        made = self.model()
        lines = overlay.bounds_lines(made.model, made.loaded)
        self.assertEqual(set(lines), {"model/arm", "model/arm/hand"})
        hand = lines["model/arm/hand"]
        self.assertEqual(hand.shape, (24, 3))
        np.testing.assert_allclose((hand.min(axis=0), hand.max(axis=0)), ((0, -1, 0), (2, 1, 2)), atol=1e-6)

    def test_normals_point_outward(self):
        lines = overlay.normals_lines(self.model().model, 0.1)["model/arm/hand/block"].reshape(-1, 2, 3)
        self.assertEqual(len(lines), 5)
        center = np.array((1.0, 0.0, 1.0))
        for start, end in lines:
            self.assertAlmostEqual(np.linalg.norm(start - center), 1.0)
            self.assertAlmostEqual(np.linalg.norm(end - center), 1.1)

    def test_rays_and_groups(self):
        rays = overlay.rays_lines(self.model().model)["model/arm/hand/ray"]
        np.testing.assert_allclose(rays, [(1, 0, 1), (1, 0, 1.5), (1, 0, 0.9), (1, 0, 1)], atol=1e-15)
        groups = overlay.groups_lines(self.model().model, 0.2)
        np.testing.assert_allclose(groups["model/arm"][:2], [(1, 0, 0), (1, 0.2, 0)], atol=1e-15)
        np.testing.assert_allclose(groups["model/arm/hand"][6:], [(1, 0, 0), (1, 0, 1)], atol=1e-15)
        self.assertEqual(len(groups["model"]), 6)

    def test_balls_are_three_circles(self):
        lines = overlay.volume_lines(bounds.Volume("Sphere", np.ones(3), np.full(3, 2.0)))
        self.assertEqual(lines.shape, (3 * 2 * overlay.CIRCLE, 3))
        np.testing.assert_allclose(np.linalg.norm(lines - 1.0, axis=1), 2.0)


if __name__ == "__main__":
    unittest.main()

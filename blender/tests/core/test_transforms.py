# SPDX-License-Identifier: GPL-3.0-or-later
"""Transforms compared with plain 4 x 4 matrices, and exact numbers with NumPy's own printing."""

import itertools
import math
import random
import unittest

from support import author, build, built, in_single_precision, np, rules, scene
from core import exact, transforms
from core.snapshot import SnapshotObject, Transform


def turn(axis, angle):
    """A rotation by Rodrigues' formula, independent of the code."""
    axis = np.array(axis, dtype=float) / np.linalg.norm(axis)
    k = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.eye(3) + math.sin(angle) * k + (1 - math.cos(angle)) * k @ k


AXES = {"X": (1, 0, 0), "Y": (0, 1, 0), "Z": (0, 0, 1)}


def rotation_of(mode, values):
    if mode == "QUATERNION":
        w, *v = np.array(values) / np.linalg.norm(values)
        return turn(v, 2 * math.atan2(np.linalg.norm(v), w)) if np.linalg.norm(v) else np.eye(3)
    if mode == "AXIS_ANGLE":
        return turn(values[1:], values[0])
    matrix = np.eye(3)
    for axis in mode:
        matrix = turn(AXES[axis], values["XYZ".index(axis)]) @ matrix
    return matrix


def matrix_of(t):
    """Location, rotation and scale by Blender's manual, deltas first, parent inverse outermost."""
    delta_mode = "QUATERNION" if len(t.delta_rotation) == 4 else t.rotation_mode
    delta = (1, 0, 0, 0) if t.rotation_mode == "AXIS_ANGLE" else t.delta_rotation
    matrix = np.eye(4)
    scale = np.diag(np.array(t.scale) * t.delta_scale)
    matrix[:3, :3] = rotation_of(delta_mode, delta) @ rotation_of(t.rotation_mode, t.rotation) @ scale
    matrix[:3, 3] = np.array(t.location) + t.delta_location
    return matrix if t.parent_inverse is None else t.parent_inverse @ matrix


def random_transform(scaled=True):
    mode = random.choice(transforms.ROTATION_MODES)
    angles = lambda n: tuple(random.uniform(-3, 3) for _ in range(n))  # noqa: E731
    size = 3 if len(mode) == 3 else 4
    t = Transform(angles(3), mode, angles(size))
    if random.random() < 0.3:
        t.delta_location = angles(3)
        t.delta_rotation = angles(3 if size == 3 else 4)
    if scaled:
        t.scale = (random.choice([1.0, random.uniform(0.2, 3), -random.uniform(0.2, 3)]),) * 3
        t.delta_scale = (random.choice([1.0, 2.0]),) * 3
    if random.random() < 0.4:
        t.parent_inverse = (
            matrix_of(random_transform(False)) if random.random() < 0.5 else np.diag([2.0, 2.0, 2.0, 1.0])
        )
    return t


class Locals(unittest.TestCase):
    def test_every_mode(self):
        random.seed(11)
        for _ in range(500):
            t = random_transform()
            local = transforms.local_transform(SnapshotObject("x", "EMPTY", transform=t)).matrix
            expected = matrix_of(t)
            np.testing.assert_allclose(local.linear, expected[:3, :3], atol=1e-13)
            np.testing.assert_allclose(local.offset, expected[:3, 3], atol=1e-13)

    def test_a_zero_axis_turns_nothing(self):
        self.assertEqual(transforms.axis_angle_quaternion((1.0, 0.0, 0.0, 0.0)), (1.0, 0.0, 0.0, 0.0))

    def test_quaternions_of_matrices(self):
        random.seed(12)
        for _ in range(500):
            q = np.array([random.gauss(0, 1) * random.choice([1, 1e-9]) for _ in range(4)])
            matrix = transforms.quaternion_matrix(q)
            np.testing.assert_allclose(matrix, rotation_of("QUATERNION", q), atol=1e-14)
            again = transforms.quaternion_matrix(transforms.matrix_quaternion(matrix))
            np.testing.assert_allclose(again, matrix, atol=1e-14)

    def test_quarter_turns_leave_no_dust(self):
        for mode, k in itertools.product(transforms.EULER_ORDERS, range(64)):
            angles = [(k >> shift & 3) * math.pi / 2 for shift in (0, 2, 4)]
            matrix = transforms.euler_matrix(mode, angles)
            self.assertTrue(np.isin(matrix, [-1.0, 0.0, 1.0]).all())


class Chains(unittest.TestCase):
    """A point at the end of a chain of groups and helpers, seen from the root."""

    def world(self, chain, point):
        matrix = np.linalg.multi_dot([np.eye(4), np.eye(4), *map(matrix_of, chain)])
        return (matrix @ np.append(point, 1.0))[:3]

    def test_random_chains(self):
        random.seed(13)
        for case in range(150):
            s = scene()
            above, chain, groups = s.root, [], 0
            for depth in range(random.randint(1, 6)):
                t = random_transform()
                role = random.choice(["none", "group"])
                groups += role == "group"
                above = s.empty(f"o{depth}", role, above, transform=t)
                chain.append(t)
            point = tuple(random.uniform(-2, 2) for _ in range(3))
            s.mesh("p", "Point", author.mesh([point]), above=above)
            made = built(s)
            group, place = made.model.root, np.eye(4)
            while group.groups:
                group = group.groups[0]
                pose = np.eye(4)
                pose[:3, :3] = rotation_of("QUATERNION", group.orientation)
                pose[:3, 3] = group.position
                place = place @ pose
            found = place @ np.append(group.primitives[0].fields["position"], 1.0)
            expected = self.world(chain, point)
            np.testing.assert_allclose(found[:3], expected, rtol=1e-12, atol=1e-12 * (1 + np.abs(expected).max()))

    def test_no_digit_is_lost_along_a_chain(self):
        """Blender's own matrices lose 1e-6 m over six groups at 10 m; local transforms lose nothing."""
        s = scene()
        above = s.root
        for depth in range(6):
            above = s.group(
                f"g{depth}", above=above, location=(10.1, 0.3, 7.7), rotation_mode="XYZ", rotation=(0.1, 0.2, 0.3)
            )
        s.primitive("p", "Point", above=above, location=(0.1, 0.2, 0.3))
        made = build(in_single_precision(s.snapshot()))
        group = made.model.root
        while group.groups:
            group = group.groups[0]
            self.assertEqual(group.position, (10.1, 0.3, 7.7))
        self.assertEqual(group.primitives[0].fields["position"], (0.1, 0.2, 0.3))


class Scales(unittest.TestCase):
    BOX = author.box((1.0, 2.0, 3.0))

    def faces_outward(self, primitive):
        vertices, faces = primitive.fields["vertices"], primitive.fields["faces"]
        middle = vertices.mean(axis=0)
        corners = [vertices[list(face)] for face in faces]
        return all(np.cross(c[1] - c[0], c[2] - c[1]) @ (c[0] - middle) > 0 for c in corners)

    def test_mirrored_solids_keep_their_outside(self):
        for signs in itertools.product((1.0, -1.0), repeat=3):
            s = scene()
            s.mesh("block", "Polyhedron", self.BOX, scale=tuple(np.array((1.0, 0.5, 2.0)) * signs))
            block = built(s).model.root.primitives[0]
            self.assertTrue(self.faces_outward(block), signs)
            np.testing.assert_allclose(np.ptp(block.fields["vertices"], axis=0), (1.0, 1.0, 6.0))

    def test_a_mirrored_group_mirrors_what_is_below(self):
        s = scene()
        arm = s.group("arm", location=(1.0, 0.0, 0.0), scale=(-1.0, 1.0, 1.0))
        s.mesh("block", "Polyhedron", author.box((1.0, 1.0, 1.0), (0.5, 0.0, 0.0)), above=arm)
        made = built(s)
        block = made.model.root.groups[0].primitives[0]
        self.assertEqual(block.fields["vertices"][:, 0].max(), 0.0)
        self.assertTrue(self.faces_outward(block))
        self.assertEqual(rules(made, "warning"), ["mirrored-group"])

    def test_vertices_take_shear(self):
        s = scene()
        stretched = s.empty("helper", "none", s.root, scale=(2.0, 1.0, 1.0))
        s.mesh("block", "Polyhedron", self.BOX, above=stretched, rotation_mode="XYZ", rotation=(0.0, 0.0, 0.5))
        block = built(s).model.root.primitives[0]
        expected = self.BOX.vertices @ (np.diag([2.0, 1.0, 1.0]) @ turn((0, 0, 1), 0.5)).T
        np.testing.assert_allclose(block.fields["vertices"], expected, atol=1e-15)

    def test_balls(self):
        s = scene()
        s.primitive("even", "Sphere", radius=0.1, scale=(2.0, -2.0, 2.0))
        s.primitive("uneven", "Sphere", radius=0.1, scale=(1.0, 2.0, -3.0), rotation=(0.5, 0.5, 0.5, 0.5))
        made = built(s)
        even, uneven = made.model.root.primitives
        self.assertEqual((even.kind, even.fields["radius"]), ("Sphere", 0.2))
        self.assertEqual(uneven.kind, "Ellipsoid")
        np.testing.assert_allclose(uneven.fields["semi_axes"], (0.1, 0.2, 0.3))
        self.assertEqual(rules(made, "warning"), ["sphere-to-ellipsoid"])

    def test_a_plane_stays_normal_to_itself(self):
        """Tilted by 45° and stretched along x by 2, the plane x = z becomes x = 2z."""
        s = scene()
        stretched = s.empty("helper", "none", s.root, scale=(2.0, 1.0, 1.0))
        tilt = {"rotation_mode": "XYZ", "rotation": (0.0, -math.pi / 4, 0.0)}
        s.primitive("ramp", "Plane", above=stretched, location=(0.0, 0.0, 1.0), **tilt)
        fields = built(s).model.root.primitives[0].fields
        np.testing.assert_allclose(fields["normal"], np.array([-1, 0, 2]) / math.sqrt(5), atol=1e-15)
        self.assertAlmostEqual(fields["offset"], 2 / math.sqrt(5), 14)

    def test_rays_are_stretched(self):
        s = scene()
        s.primitive(
            "ray", "Ray", length=0.5, scale=(1.0, 1.0, 3.0), rotation_mode="XYZ", rotation=(math.pi / 2, 0.0, 0.0)
        )
        fields = built(s).model.root.primitives[0].fields
        self.assertEqual((fields["direction"], fields["length"]), ((0.0, -1.0, 0.0), 1.5))

    def test_millimetres(self):
        s = scene()
        arm = s.group("arm", location=(1234.5, 0.3, 0.0))
        s.primitive("ball", "Sphere", above=arm, radius=12.3, location=(0.1, 0.0, 0.0))
        s.mesh("block", "Polyhedron", author.box((100.0, 100.0, 100.0)), above=arm)
        made = build(in_single_precision(s.snapshot(unit_scale=float(np.float32(0.001)))))
        group = made.model.root.groups[0]
        self.assertEqual(group.position, (1.2345, 0.0003, 0.0))
        ball, block = group.primitives
        self.assertEqual((ball.fields["radius"], ball.fields["center"]), (0.0123, (0.0001, 0.0, 0.0)))
        self.assertEqual(np.abs(block.fields["vertices"]).max(), 0.05)

    def test_where_the_root_stands_does_not_matter(self):
        s = scene(location=(5.0, 6.0, 7.0), rotation_mode="XYZ", rotation=(1.0, 2.0, 3.0))
        s.primitive("p", "Point", location=(0.1, 0.2, 0.3))
        self.assertEqual(built(s).model.root.primitives[0].fields["position"], (0.1, 0.2, 0.3))


class Numbers(unittest.TestCase):
    def test_what_was_typed_comes_back(self):
        random.seed(14)
        values = [random.uniform(-1, 1) * 10.0 ** random.randint(-40, 38) for _ in range(5000)]
        values += [round(random.uniform(-100, 100), random.randint(0, 6)) for _ in range(5000)]
        values += [0.1, 0.3, 1e-45, 3.4028234e38, 16777216.0, 1e10, 123456.7, 2.0**-126]
        single = np.array(values, dtype=np.float32)
        expected = [float(str(x)) for x in single]
        found = exact.typed(single.astype(np.float64))
        self.assertEqual(found.tolist(), expected)

    def test_angles_are_typed_in_degrees(self):
        for degrees in (90.0, 45.0, 22.5, 0.1, -120.0, 33.333):
            self.assertEqual(exact.typed_angle(float(np.float32(np.radians(degrees)))), float(np.radians(degrees)))
        for radians in (0.1, 0.25, 1.5, -3.0):
            self.assertEqual(exact.typed_angle(float(np.float32(radians))), radians)

    def test_numbers_beyond_32_bits_are_meant_as_they_are(self):
        self.assertEqual(exact.meant([0.1, 1 / 3]).tolist(), [0.1, 1 / 3])


if __name__ == "__main__":
    unittest.main()

"""Appearance of a machine: MuJoCo's geoms as a contact model without pairs, so that logs and films show them.

A contact model has only what touches. Without this, a pallet in a film is its wheels, and an arm is not there.
"""

import fnmatch

import mujoco
import numpy as np
from kit import ron

NAME = "drawn"  # of the Object and of its root
FACES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))  # of `_box`


def model(of, patterns):
    """Text of a model with a movable group for each body with geoms whose name matches one of the patterns."""
    names = [of.body(number).name for number in range(of.nbody)]
    chosen = [name for name in names if any(fnmatch.fnmatchcase(name, pattern) for pattern in patterns)]
    groups = [(name, parts) for name in chosen if (parts := list(_parts(of, of.body(name).id)))]
    return ron.model(NAME, ron.rigid(), groups=groups)


def _parts(of, body):
    """Primitives in the frame of the body; planes, meshes and ellipsoids are left out."""
    first = of.body_geomadr[body]
    for number in range(first, first + of.body_geomnum[body]):
        make = MAKES.get(mujoco.mjtGeom(of.geom_type[number]))
        if make is not None:
            turned = np.empty(9)
            mujoco.mju_quat2Mat(turned, of.geom_quat[number])
            yield make(f"geom_{number - first}", of.geom_pos[number], turned.reshape(3, 3), of.geom_size[number])


def _sphere(name, place, turned, size):
    return ron.primitive("Sphere", name, center=tuple(place), radius=size[0])


def _capsule(name, place, turned, size):
    return ron.primitive("Capsule", name, ends=_ends(place, turned, size), radius=size[0])


def _cylinder(name, place, turned, size):
    return ron.primitive("Cylinder", name, ends=_ends(place, turned, size), radius=size[0])


def _ends(place, turned, size):
    return tuple(tuple(place + side * size[1] * turned[:, 2]) for side in (-1, 1))


def _box(name, place, turned, size):
    corners = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    vertices = [place + turned @ (size * corner) for corner in corners]
    return ron.primitive("Polyhedron", name, vertices=vertices, faces=FACES)


MAKES = {
    mujoco.mjtGeom.mjGEOM_SPHERE: _sphere,
    mujoco.mjtGeom.mjGEOM_CAPSULE: _capsule,
    mujoco.mjtGeom.mjGEOM_CYLINDER: _cylinder,
    mujoco.mjtGeom.mjGEOM_BOX: _box,
}

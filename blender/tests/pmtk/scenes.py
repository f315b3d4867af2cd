# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes for the tests, made with Blender's own functions."""

import unittest

import bpy
import pong_pmtk
from mathutils import Matrix
from pong_pmtk.core.marks import Mark, ModelSettings
from pong_pmtk.scene import session
from pong_pmtk.store import marks

CUBE = (
    [(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)],
    [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)],
)
TETRAHEDRON = ([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)])
SQUARE = ([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2, 3)])


class InBlender(unittest.TestCase):
    """Begins every test with an empty file and the toolkit registered."""

    @classmethod
    def setUpClass(cls):
        pong_pmtk.register()

    @classmethod
    def tearDownClass(cls):
        pong_pmtk.unregister()

    def setUp(self):
        bpy.ops.wm.read_factory_settings(use_empty=True)

    def check(self, root=""):
        return session.check(bpy.context, root)

    def rules(self, root=""):
        """The rules of all errors and warnings."""
        return {finding.rule for finding in self.check(root).findings if finding.severity != "hint"}

    def primitives(self, root=""):
        """All primitives of the model by their names; the test fails if there is none."""
        result = self.check(root)
        self.assertIsNotNone(result.model, "\n".join(map(str, result.findings)))
        found, open_ = {}, [result.model.root]
        while open_:
            group = open_.pop()
            found.update({primitive.name: primitive for primitive in group.primitives})
            open_ += group.groups
        return found


def new(name, data=None, parent=None, location=(0, 0, 0), scale=(1, 1, 1), rotation=None):
    """An object of the scene."""
    obj = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(obj)
    obj.parent = parent
    obj.location, obj.scale = location, scale
    if rotation is not None:
        obj.rotation_euler = rotation
    return obj


def mesh(shape, name="mesh", edges=()):
    made = bpy.data.meshes.new(name)
    made.from_pydata(shape[0], list(edges), shape[1])
    return made


def mark(obj, role="primitive", **fields):
    marks.write_mark(obj, Mark(role=role, **fields))
    return obj


def root(name="model", **options):
    """A root with one surface, inherited by everything below."""
    made = mark(new(name, **options), "root", surface="steel")
    marks.write_settings(made, ModelSettings(surfaces={"steel": {"stiffness": 1e6}}))
    return made


def activate(obj, *others):
    """Selects objects; the first is the active one."""
    bpy.context.view_layer.update()  # what was just made cannot be selected before
    for each in bpy.context.view_layer.objects:
        each.select_set(each in (obj, *others))
    bpy.context.view_layer.objects.active = obj


def edit(obj):
    activate(obj)
    bpy.ops.object.mode_set(mode="EDIT")


def keep_transform(obj, parent):
    """Parents an object as "Set Parent To > Object (Keep Transform)" does."""
    bpy.context.view_layer.update()
    obj.parent = parent
    obj.matrix_parent_inverse = parent.matrix_world.inverted() if parent else Matrix()

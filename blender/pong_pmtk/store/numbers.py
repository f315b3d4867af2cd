# SPDX-License-Identifier: GPL-3.0-or-later
"""Float properties over float64 numbers.

Blender's float properties are of single precision. The numbers of a mark are kept as float64 ID properties of its
property group, and its float properties are views of them. What is typed into a view is stored as the decimal that
was typed: 0.3, not 0.30000001192092896.
"""

import bpy
import numpy as np

SUFFIX = "_64"  # of the ID properties


def shortest(value):
    """Shortest decimal that rounds to the same float32, as float64."""
    return float(str(np.float32(value)))


def number(key, default=0.0, shown=None, **options):
    """A FloatProperty that shows the float64 ID property `key`. `shown` is called when it changes."""

    def read(self):
        return self.get(key, default)

    def write(self, value):
        self[key] = shortest(value)
        if shown is not None:
            shown(self)

    return bpy.props.FloatProperty(get=read, set=write, **options)


def vector(key, default=(0.0, 0.0, 0.0), shown=None, **options):
    """A FloatVectorProperty likewise, for three numbers or as many as in `default`."""

    def read(self):
        return self.get(key, default)

    def write(self, values):
        self[key] = [shortest(value) for value in values]
        if shown is not None:
            shown(self)

    return bpy.props.FloatVectorProperty(size=len(default), get=read, set=write, **options)


def given(key, default=0.0, **options):
    """A BoolProperty: true if the optional number `key` is given."""

    def read(self):
        return key in self

    def write(self, value):
        if value and key not in self:
            self[key] = default
        elif not value and key in self:
            del self[key]

    return bpy.props.BoolProperty(get=read, set=write, **options)


def listed(key, **options):
    """A StringProperty that shows a list of numbers, with commas."""

    def read(self):
        return ", ".join(repr(number) for number in self.get(key, ()))

    def write(self, value):
        self[key] = [float(word) for word in value.replace(",", " ").split()]

    return bpy.props.StringProperty(get=read, set=write, **options)

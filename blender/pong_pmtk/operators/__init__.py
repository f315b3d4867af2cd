# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators. All run without an interface, and all that change a scene can be undone."""

from . import files, findings, group, mark, surface

CLASSES = (*mark.CLASSES, *surface.CLASSES, *group.CLASSES, *findings.CLASSES, *files.CLASSES)

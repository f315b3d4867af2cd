# SPDX-License-Identifier: GPL-3.0-or-later
"""The "Pong" tab of the 3D view's sidebar, menus and overlays."""

from . import lists, menus, overlay, panels

CLASSES = (*lists.CLASSES, *menus.CLASSES, *panels.CLASSES)
PARTS = (menus, overlay)

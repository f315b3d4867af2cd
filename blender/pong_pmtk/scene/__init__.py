# SPDX-License-Identifier: GPL-3.0-or-later
"""Conversion between Blender scenes and snapshots."""

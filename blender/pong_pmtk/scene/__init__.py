# SPDX-License-Identifier: GPL-3.0-or-later
"""Between Blender scenes and snapshots."""

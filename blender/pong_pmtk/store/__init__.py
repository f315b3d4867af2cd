# SPDX-License-Identifier: GPL-3.0-or-later
"""What a .blend file keeps for the toolkit: marks, model settings, presets and numbers in full precision."""

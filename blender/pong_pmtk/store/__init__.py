# SPDX-License-Identifier: GPL-3.0-or-later
"""Data of the toolkit in a .blend file: marks, model settings, presets and numbers in full precision."""

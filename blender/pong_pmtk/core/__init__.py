# SPDX-License-Identifier: GPL-3.0-or-later
"""The modelling toolkit without Blender: scenes as data, models, and the conversion between them.

read.read_file, write.write_files      model files <-> Model
build.build, unbuild.unbuild           Snapshot <-> Model, with findings
snapshot_json.dumps, .loads            Snapshot <-> JSON
propose.propose                        what a mesh could be
overlay                                lines to draw over a scene
author.Scene                           scenes written down in Python
"""

# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the extension's zip, installs it into a fresh user folder and uses it there.

    BLENDER_USER_RESOURCES=FOLDER python shipped.py FOLDER

`blender_ext.py` is what `blender --command extension build` runs; it comes with the module too.
"""

import importlib
import os
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve()
SOURCE = HERE.parents[2] / "pong_pmtk"
MODELS = HERE.parents[3] / "models"
INSTALLED = "bl_ext.user_default.pong_pmtk"


def build(folder):
    import bpy

    tool = Path(bpy.utils.resource_path("LOCAL")) / "scripts/addons_core/bl_pkg/cli/blender_ext.py"
    for arguments in (["validate", str(SOURCE)], ["build", "--source-dir", str(SOURCE), "--output-dir", str(folder)]):
        subprocess.run([sys.executable, str(tool), *arguments], check=True)
    manifest = tomllib.loads((SOURCE / "blender_manifest.toml").read_text())
    path = folder / f"{manifest['id']}-{manifest['version']}.zip"
    subprocess.run([sys.executable, str(tool), "validate", str(path)], check=True)
    names = zipfile.ZipFile(path).namelist()
    assert not [name for name in names if "__pycache__" in name], names
    assert {"__init__.py", "blender_manifest.toml", "core/build.py", "store/marks.py"} <= set(names), names
    return path


def install(path):
    import bpy

    done = bpy.ops.extensions.package_install_files(filepath=str(path), repo="user_default", enable_on_install=True)
    assert done == {"FINISHED"}, done
    assert INSTALLED in bpy.context.preferences.addons.keys()
    bpy.ops.wm.save_userpref()


def use(folder):
    """In a process of its own, as on the next start of Blender."""
    import bpy

    assert "pong_pmtk" not in sys.modules, "the source folder must be out of reach"
    if INSTALLED not in bpy.context.preferences.addons:
        bpy.ops.preferences.addon_enable(module=INSTALLED)
    package = importlib.import_module(INSTALLED)
    assert Path(package.__file__).is_relative_to(folder.resolve()), package.__file__
    for name in ("idss_docking/idss_active.ron", "verification/ray_axial.ron", "verification/mesh_rough.ron"):
        through(importlib.import_module(f"{INSTALLED}.core.read"), importlib.import_module(f"{INSTALLED}.core.write"),
                MODELS / name, folder / "again.ron")
    bpy.ops.preferences.addon_disable(module=INSTALLED)
    assert not hasattr(bpy.types.Object, "pong"), "unregistering left something behind"
    print("used:", package.__file__)


def through(read, write, model, again):
    import bpy

    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.preferences.addon_enable(module=INSTALLED)
    assert bpy.ops.pong.import_ron(filepath=str(model)) == {"FINISHED"}
    assert bpy.ops.pong.check() == {"FINISHED"}
    assert bpy.ops.pong.export_ron(filepath=str(again)) == {"FINISHED"}
    assert again.read_text() == write.write_text(read.read_file(model)), model


def main():
    folder = Path(sys.argv[-1])
    if sys.argv[1] == "--use":
        use(folder)
        leave()
    assert Path(os.environ["BLENDER_USER_RESOURCES"]).resolve() == folder.resolve()
    install(build(folder))
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    subprocess.run([sys.executable, str(HERE), "--use", str(folder)], check=True, env=environment)
    leave()


def leave():
    """Without Blender's own exit: see run.py."""
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(0)


main()

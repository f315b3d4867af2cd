# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the zips of both extensions, installs them into one fresh user folder and uses them there.

    BLENDER_USER_RESOURCES=FOLDER PONG_WHEEL=FILE python shipped.py FOLDER

The wheel `pong` that is used is the one that Blender has installed from the zips: no other is in reach. With ZIPS=DIR, the zips
of a release in that folder are used, with the wheels of every system, and none are built.

`blender_ext.py` is what `blender --command extension validate` runs; it comes with the module too.
"""

import importlib.util
import os
import subprocess
import sys
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve()
BLENDER = HERE.parents[1]
MODELS = HERE.parents[2] / "models"
MUST_HOLD = {
    "pong_pmtk": {"__init__.py", "blender_manifest.toml", "core/build.py", "store/marks.py"},
    "pong_viz": {"__init__.py", "blender_manifest.toml", "core/read.py", "core/engine.py", "scene.py"},
}


def built(name, folder):
    """The zip; two builds from the same sources are equal."""
    zips = []
    for out in (folder / "zips", folder / "again"):
        tool = [sys.executable, str(BLENDER / "build_zips.py"), name, "-o", str(out)]
        zips.append(Path(subprocess.run(tool, check=True, capture_output=True, text=True).stdout.strip()))
    assert zips[0].read_bytes() == zips[1].read_bytes(), zips
    return zips[0]


def checked(name, path):
    """The zip, after Blender's own tool and its contents have been looked at."""
    import bpy

    judge = Path(bpy.utils.resource_path("LOCAL")) / "scripts/addons_core/bl_pkg/cli/blender_ext.py"
    for target in (BLENDER / name, path):
        subprocess.run([sys.executable, str(judge), "validate", str(target)], check=True)
    content = zipfile.ZipFile(path)
    entries = content.infolist()
    names = {entry.filename for entry in entries}
    assert not [name for name in names if "__pycache__" in name or name.endswith(".pyc")], names
    assert MUST_HOLD[name] <= names, MUST_HOLD[name] - names
    wheels = [content.read(name) for name in names if name.startswith("wheels/")]
    assert os.environ.get("ZIPS") or Path(os.environ["PONG_WHEEL"]).read_bytes() in wheels, names
    assert all(entry.external_attr >> 28 == 8 for entry in entries), "a link, or no plain file"
    return path


def install(name, path):
    import bpy

    done = bpy.ops.extensions.package_install_files(filepath=str(path), repo="user_default", enable_on_install=True)
    assert done == {"FINISHED"}, done
    assert installed(name) in bpy.context.preferences.addons.keys()
    bpy.ops.wm.save_userpref()


def refuse_other_platform(folder):
    """Blender refuses a zip without the wheel of this system, and says for which ones it is."""
    wheel = folder / "pong-0.1.0-cp310-abi3-win_arm64.whl"
    wheel.write_bytes(Path(os.environ["PONG_WHEEL"]).read_bytes())
    tool = [sys.executable, str(BLENDER / "build_zips.py"), "pong_viz", "--wheel", str(wheel), "-o", str(folder / "other")]
    path = subprocess.run(tool, check=True, capture_output=True, text=True).stdout.strip()
    # Its words go to the console, and to no exception.
    done = subprocess.run([sys.executable, str(HERE), "--install", path, str(folder)], capture_output=True, text=True)
    told = done.stdout + done.stderr
    assert "This platform (" in told and "isn't one of (windows-arm64)" in told, told
    assert not list(folder.glob("extensions/*/pong_viz")), "installed in spite of it"


def installed(name):
    return f"bl_ext.user_default.{name}"


def part(name, module):
    return importlib.import_module(f"{installed(name)}.{module}")


def use(folder):
    """Uses the extensions in a new process, as on the next start of Blender."""
    import bpy

    for name in MUST_HOLD:
        assert name not in sys.modules, "the source folder must be out of reach"
        enable(name)
        package = importlib.import_module(installed(name))
        assert Path(package.__file__).is_relative_to(folder.resolve()), package.__file__
        print("used:", package.__file__)
    import pong

    assert Path(pong.__file__).is_relative_to(folder.resolve()), f"{pong.__file__}: not the wheel of the zips"
    use_toolkit(folder)
    use_playback(folder)
    for name in MUST_HOLD:
        bpy.ops.preferences.addon_disable(module=installed(name))
    assert not hasattr(bpy.types.Object, "pong"), "unregistering left something behind"
    assert not any(name.startswith("PONG_") for name in dir(bpy.types)), "unregistering left a class behind"


def enable(name):
    import bpy

    if installed(name) not in bpy.context.preferences.addons:
        bpy.ops.preferences.addon_enable(module=installed(name))


def fresh_file():
    import bpy

    bpy.ops.wm.read_factory_settings(use_empty=True)
    for name in MUST_HOLD:
        enable(name)


def use_toolkit(folder):
    """Models survive import and export unchanged."""
    import bpy

    read, write, again = part("pong_pmtk", "core.read"), part("pong_pmtk", "core.write"), folder / "again.ron"
    for name in ("idss_docking/idss_active.ron", "verification/ray_axial.ron", "verification/mesh_rough.ron"):
        model = MODELS / name
        fresh_file()
        assert bpy.ops.pong.import_ron(filepath=str(model)) == {"FINISHED"}
        assert bpy.ops.pong.check() == {"FINISHED"}
        assert bpy.ops.pong.export_ron(filepath=str(again)) == {"FINISHED"}
        assert again.read_text() == write.write_text(read.read_file(model)), model


def use_playback(folder):
    """A log is shown, a picture rendered and a film written, from the interface and from the command line."""
    import bpy

    log = sample_log(folder / "log")
    fresh_file()
    assert bpy.ops.pong.import_response(filepath=str(log / "run.json"), fps=5) == {"FINISHED"}
    assert len(bpy.data.objects["ball/skin"].data.vertices) > 100, "the model is not drawn"
    bpy.context.scene.render.resolution_x, bpy.context.scene.render.resolution_y = 160, 90
    film, still = folder / "film.mp4", folder / "still.png"
    assert bpy.ops.pong.render_response(filepath=str(film), form="FILM") == {"FINISHED"}
    assert film.read_bytes()[4:8] == b"ftyp", "no mp4"
    assert part("pong_viz", "cli").main([str(log), "--still", str(still), "--size", "160x90"]) == 0
    assert still.read_bytes()[1:4] == b"PNG"


def sample_log(folder):
    """Log of the tests, without their installation."""
    spec = importlib.util.spec_from_file_location("sample", HERE.parent / "viz/sample.py")
    sample = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(sample)
    return sample.write_log(folder)


def main():
    folder = Path(sys.argv[-1])
    if sys.argv[1] == "--use":
        use(folder)
        leave()
    if sys.argv[1] == "--install":
        install("pong_viz", sys.argv[2])
        leave()
    assert Path(os.environ["BLENDER_USER_RESOURCES"]).resolve() == folder.resolve()
    refuse_other_platform(folder)
    given = os.environ.get("ZIPS")
    for name in MUST_HOLD:
        found = list(Path(given).glob(f"{name}-*.zip")) if given else [built(name, folder)]
        assert len(found) == 1, f"{len(found)} zips of {name} in {given}, and one is to be tried: make it by build_zips.py -o {given}"
        install(name, checked(name, found[0]))
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    subprocess.run([sys.executable, str(HERE), "--use", str(folder)], check=True, env=environment)
    leave()


def leave():
    """Exits without Blender's own exit: see run.py."""
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(0)


main()

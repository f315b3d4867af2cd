# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line: export, import and check without an interface.

    python -m pong_pmtk export scene.blend -o model.ron [--root NAME] [--scene NAME] [--check-only]
    python -m pong_pmtk check scene.blend [--root NAME] [--scene NAME]
    python -m pong_pmtk import model.ron -o scene.blend

Needs the module `bpy` (pip install bpy). The same commands are registered with Blender: `blender -c pong export …`.
Findings go to the standard error stream, one a line. Exit codes: 0 done, 1 refused with errors, 2 wrong usage,
3 a file could not be read or written. Nothing is written unless all of it can be.
"""

import argparse
import contextlib
import os
import sys
import tempfile
from pathlib import Path

DONE, REFUSED, USAGE, NO_FILE = 0, 1, 2, 3


def parser(program):
    top = argparse.ArgumentParser(prog=program, description="Contact models in and out of Blender")
    commands = top.add_subparsers(dest="command", required=True)
    export = commands.add_parser("export", help="write a model file from a .blend file")
    check = commands.add_parser("check", help="list what is wrong with the model in a .blend file")
    for command in (export, check):
        command.add_argument("blend", type=Path, help="the .blend file")
        command.add_argument("--root", default="", help="object that is the model's root; needed where there are several")
        command.add_argument("--scene", default="", help="scene of the file; the one it was saved with unless given")
    export.add_argument("-o", "--output", type=Path, help="the model file; beside the .blend file unless given")
    export.add_argument("--check-only", action="store_true", help="write nothing")
    load = commands.add_parser("import", help="make a .blend file from a model file")
    load.add_argument("model", type=Path, help="the model file")
    load.add_argument("-o", "--output", type=Path, help="the .blend file; beside the model file unless given")
    return top


def main(arguments, program="pong_pmtk", keep_open=False):
    """Runs one command and returns its exit code. `keep_open`: the file open in Blender stays in use."""
    try:
        options = parser(program).parse_args(arguments)
    except SystemExit as stop:
        return stop.code or DONE
    try:
        return COMMANDS[options.command](options, keep_open)
    except FileFault as fault:
        print(fault, file=sys.stderr)
        return NO_FILE


class FileFault(Exception):
    """A file that cannot be read or written."""


@contextlib.contextmanager
def quiet():
    """Silences Blender's report of every opened file, so that only the command prints."""
    sys.stdout.flush()
    kept, nowhere = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    try:
        yield
    finally:
        sys.stdout.flush()
        os.dup2(kept, 1)
        os.close(kept)
        os.close(nowhere)


def open_blend(path):
    import bpy

    if not path.is_file():
        raise FileFault(f"{path}: there is no such file")
    try:
        with quiet():
            bpy.ops.wm.open_mainfile(filepath=str(path.absolute()), load_ui=False, use_scripts=False)
    except RuntimeError as error:
        raise FileFault(f"{path}: Blender cannot open it: {str(error).strip()}") from None


@contextlib.contextmanager
def scene_context(name):
    """The context of a scene of the open file."""
    import bpy

    if not name:
        yield bpy.context
        return
    scene = bpy.data.scenes.get(name)
    if scene is None:
        raise FileFault(f'there is no scene "{name}"; choose from: {", ".join(bpy.data.scenes.keys())}')
    with bpy.context.temp_override(scene=scene, view_layer=scene.view_layers[0]):
        yield bpy.context


def check_command(options, _keep_open):
    from .scene import session

    open_blend(options.blend)
    with scene_context(options.scene) as context:
        result = session.check(context, options.root)
    tell(result)
    return DONE if result.model is not None else REFUSED


def tell(result):
    for finding in result.findings:
        print(finding, file=sys.stderr)
    print(result.summary())


def export_command(options, keep_open):
    from .scene import session

    if options.check_only:
        return check_command(options, keep_open)
    target = options.output or options.blend.with_suffix(".ron")
    open_blend(options.blend)
    with scene_context(options.scene) as context:
        try:
            result = session.export(context, target, options.root)
        except session.Refused as refused:
            tell(refused.result)
            print(f"{target}: not written", file=sys.stderr)
            return REFUSED
        except OSError as error:
            raise FileFault(f"{target}: cannot be written: {error.strerror}") from None
    tell(result)
    print(f"{target} written")
    return DONE


def import_command(options, keep_open):
    import bpy

    from .scene import session

    target = options.output or options.model.with_suffix(".blend")
    if not target.parent.is_dir():
        raise FileFault(f"{target}: there is no folder {target.parent}")
    with quiet():
        bpy.ops.wm.read_factory_settings(use_empty=True) if not keep_open else bpy.ops.wm.read_homefile(use_empty=True)
    try:
        root = session.load(bpy.context, options.model)
    except session.LOAD_FAULTS as faults:
        print(faults, file=sys.stderr)
        return REFUSED
    except OSError as error:
        raise FileFault(f"{options.model}: cannot be read: {error.strerror}") from None
    save_blend(target)
    print(f"{target} written: {len(root.children_recursive) + 1} objects")
    return DONE


def save_blend(target):
    """Saves the open file, whole or not at all."""
    import bpy

    with tempfile.TemporaryDirectory(prefix=".pong_", dir=target.parent) as folder:
        beside = Path(folder) / target.name
        try:
            with quiet():
                bpy.ops.wm.save_as_mainfile(filepath=str(beside.absolute()), copy=True, relative_remap=True)
            os.replace(beside, target)
        except (RuntimeError, OSError) as error:
            raise FileFault(f"{target}: cannot be written: {str(error).strip()}") from None


COMMANDS = {"export": export_command, "import": import_command, "check": check_command}

"""Compares the output of a model's build script, and Blender's re-export of its files, with the committed files.

    python models_blender.py FOLDER SCRATCH

Python is that of ci/blender_setup, with blender/ in PYTHONPATH. Exit code 1 if a byte differs.
"""

import contextlib
import io
import os
import pathlib
import subprocess
import sys

MODEL = 'format: "pong-model"'


def models(folder):
    """Model files of a folder, without its scenes."""
    return [path for path in sorted(folder.glob("*.ron")) if MODEL in path.read_text(encoding="utf-8")]


def files(folder):
    """All files below a folder, including mesh files in subfolders, by relative path."""
    return sorted(path.relative_to(folder) for path in folder.rglob("*") if path.is_file())


def build(folder, out):
    """Runs the build script into an empty folder; reports differences of its output."""
    out.mkdir(parents=True)
    done = subprocess.run([sys.executable, str(folder / "build.py"), str(out)], stdout=subprocess.PIPE, text=True)
    if done.returncode != 0:
        print(done.stdout, end="")
        yield f"{folder}/build.py failed"
        return
    print(f"{folder}/build.py: {len(files(out))} files")
    for model in models(folder):
        if not (out / model.name).exists():
            yield f"{model} is not written by {folder}/build.py"
    yield from differences(folder, out, f"{folder}/build.py writes; run it and commit the result")


def differences(folder, out, what):
    for name in files(out):
        committed = folder / name
        if not committed.is_file() or committed.read_bytes() != (out / name).read_bytes():
            yield f"{committed} is not what {what}"


def round_trip(model, out):
    """Imports a model into a .blend file and exports it: the model file and its mesh files must be the same."""
    from pong_pmtk import cli

    out.mkdir(parents=True)
    blend, exported = out.with_suffix(".blend"), out / model.name
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()) as told:
        failed = cli.main(["import", str(model), "-o", str(blend)]) or cli.main(["export", str(blend), "-o", str(exported)])
    if failed:
        yield f"{model} does not go through Blender and back:\n{told.getvalue()}"
        return
    print(f"{model}: through Blender and back, {len(files(out))} files")
    yield from differences(model.parent, out, "Blender exports of it")


def main():
    import pong_pmtk

    folder, scratch = map(pathlib.Path, sys.argv[1:])
    pong_pmtk.register()
    faults = [*build(folder, scratch / "built")]
    for model in models(folder):
        faults += round_trip(model, scratch / "exported" / model.stem)
    for fault in faults:
        print(fault)
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(1 if faults else 0)  # Blender as a module may crash or hang in its own exit, when Python has gone


if __name__ == "__main__":
    main()

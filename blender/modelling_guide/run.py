# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs docs/modelling.md from top to bottom and compares its listings with the output.

    python run.py [--pictures] [--library DIR] [--keep DIR]

Needs Blender as a module; `pong` on the path, or PONG=FILE; gcc. The extensions are built as zips and installed into a fresh
user folder, as the guide says. Blocks of the page, by the words behind the three ticks:

    python          runs, in one namespace for the whole page
    ron NAME        is written to a file
    obj NAME        likewise
    c NAME          is compiled, and run where --library names the folder of libpong.so
    console         a command line behind `$ `, then what it prints
    text            behind python or c: what that printed

`…` in what is shown stands for anything; a line of it alone for any number of lines. A picture is drawn with --pictures
where it stands, from the scene as it is there (pictures.py).
"""

import argparse
import contextlib
import io
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
GUIDE = ROOT / "docs/modelling.md"
PICTURE_BYTES = 150_000
IMAGE = re.compile(r"!\[[^\]]*\]\(figures/modelling/(\w+)\.png\)")


class Differs(Exception):
    """The page differs from the output."""


def blocks(text):
    """(line number, words of the fence, lines) of every fenced block; pictures as (line, ["picture", name], [])."""
    words, held, begun = None, [], 0
    for number, line in enumerate(text.splitlines(), 1):
        if words is None and line.startswith("```"):
            words, held, begun = line[3:].split(), [], number
        elif words is not None and line == "```":
            yield begun, words, held
            words = None
        elif words is not None:
            held.append(line)
        elif found := IMAGE.search(line):
            yield number, ["picture", found[1]], []


def is_like(printed, shown):
    """True if a line matches the listing; runs of blanks count as one."""
    pattern = ".*".join(re.escape(" ".join(part.split())) for part in shown.split("…"))
    return re.fullmatch(pattern.replace(r"\ .*", ".*").replace(r".*\ ", ".*"), " ".join(printed.split())) is not None


def compare(number, printed, shown):
    """Raises `Differs` at the first line of `shown` that is missing from `printed` at its position."""
    rest, skipping = list(printed), False
    for offset, line in enumerate(shown, 1):
        if line.strip() == "…":
            skipping = True
            continue
        while skipping and rest and not is_like(rest[0], line):
            rest.pop(0)
        if not rest or not is_like(rest[0], line):
            raise Differs(f"{GUIDE.name}:{number + offset}: shows `{line}`, but there is `{rest[0] if rest else 'nothing'}` in\n"
                          + "\n".join(printed))
        rest.pop(0)
        skipping = False
    if rest and not skipping:
        raise Differs(f"{GUIDE.name}:{number}: this is printed too:\n" + "\n".join(rest))


class Page:
    """Runner of the page's blocks, in the folder of the session."""

    def __init__(self, options):
        self.options, self.names, self.printed, self.count = options, {"__name__": "guide"}, None, {}
        self.faults, self.pending = [], []

    def run(self, number, words, lines):
        kind = words[0] if words else "text"
        getattr(self, kind)(number, words[1:], lines)
        self.count[kind] = self.count.get(kind, 0) + 1

    def python(self, number, _words, lines):
        code = compile("\n" * number + "\n".join(lines), str(GUIDE), "exec")
        told = io.StringIO()
        with contextlib.redirect_stdout(told):
            exec(code, self.names)
        self.printed = told.getvalue().splitlines()

    def ron(self, _number, words, lines):
        Path(words[0]).write_text("\n".join(lines) + "\n")

    obj = ron

    def c(self, _number, words, lines):
        source = Path(words[0])
        self.ron(_number, words, lines)
        command = ["gcc", "-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror", f"-I{ROOT / 'include'}", str(source)]
        library = self.options.library
        if library is None:
            subprocess.run([*command, "-fsyntax-only"], check=True)
            self.printed = None
            return
        program = source.with_suffix("").absolute()
        libraries = [f"-L{library}", "-lpong", f"-Wl,-rpath,{library}", "-o", str(program)]
        subprocess.run([*command, *libraries], check=True)
        environment = {**os.environ, "LD_LIBRARY_PATH": str(Path.cwd())}
        link = Path("libpong.so.1")
        if not link.exists():
            link.symlink_to(library / "libpong.so")
        done = subprocess.run([program], check=True, capture_output=True, text=True, env=environment)
        self.printed = done.stdout.splitlines()

    def console(self, number, _words, lines):
        words = shlex.split(lines[0].removeprefix("$ "))
        if words[0] == "pong":
            words[0] = os.environ.get("PONG", "pong")
        done = subprocess.run(words, capture_output=True, text=True)
        if done.returncode:
            raise Differs(f"{GUIDE.name}:{number + 1}: exit code {done.returncode}\n{done.stderr}")
        compare(number + 1, done.stdout.splitlines(), lines[1:])

    def text(self, number, _words, lines):
        """Compares the output of the block above; a text before the first block is for reading only."""
        if self.printed is not None:
            compare(number, self.printed, lines)

    def picture(self, _number, words, _lines):
        target = ROOT / f"docs/figures/modelling/{words[0]}.png"
        if self.options.pictures:
            import bpy

            kept = Path(f"picture_{words[0]}.blend").absolute()
            bpy.ops.wm.save_as_mainfile(filepath=str(kept), copy=True)
            self.pending.append((words[0], target))
        elif not target.exists():
            self.faults.append(f"{target}: missing; run again with --pictures and commit it")
        elif target.stat().st_size > PICTURE_BYTES:
            self.faults.append(f"{target}: {target.stat().st_size} bytes, at most {PICTURE_BYTES}")


def draw(pending):
    """Pictures are drawn by separate processes, so that the page's scene stays as it is."""
    for name, target in pending:
        subprocess.run([sys.executable, str(HERE / "pictures.py"), name, ".", str(target)], check=True, stdout=subprocess.DEVNULL)
        print(f"{target.relative_to(ROOT)}: {target.stat().st_size} bytes")


def run(options, folder):
    os.environ["BLENDER_USER_RESOURCES"] = str(folder / "user")
    (folder / "user").mkdir(parents=True, exist_ok=True)
    os.chdir(folder)
    subprocess.run([sys.executable, str(ROOT / "blender/build_zips.py"), "-o", "."], check=True, stdout=subprocess.DEVNULL)
    page = Page(options)
    for number, words, lines in blocks(GUIDE.read_text()):
        page.run(number, words, lines)
    draw(page.pending)
    if page.faults:
        raise Differs("\n".join(page.faults))
    print(", ".join(f"{count} {kind}" for kind, count in page.count.items()))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--pictures", action="store_true", help="draw the page's pictures into docs/figures/modelling")
    parser.add_argument("--library", type=Path, help="folder of libpong.so")
    parser.add_argument("--keep", type=Path, help="work in this folder and leave it there")
    options = parser.parse_args()
    options.library = options.library.resolve() if options.library else None
    folder = options.keep.resolve() if options.keep else Path(tempfile.mkdtemp(prefix="modelling_guide_"))
    folder.mkdir(parents=True, exist_ok=True)
    try:
        run(options, folder)
        code = 0
    except Differs as difference:
        print(difference, file=sys.stderr)
        code = 1
    finally:
        if not options.keep:
            shutil.rmtree(folder, ignore_errors=True)
    return code


if __name__ == "__main__":
    result = main()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(result)  # Blender as a module does not always survive its own exit

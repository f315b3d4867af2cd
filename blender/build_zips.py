#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the zips of both extensions, as Blender installs them.

    python3 blender/build_zips.py [-o DIR] [NAME …]

Needs Python 3.11 and nothing else. The same sources give the same bytes on any machine: names in order, one date, no
compression. Blender's own `extension build` leaves out links, so it would ship pong_viz without its core; here a link
becomes what it points at.
"""

import argparse
import sys
import tomllib
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
EXTENSIONS = ("pong_pmtk", "pong_viz")
DATE = (1980, 1, 1, 0, 0, 0)  # the first that a zip can tell
PLAIN_FILE = 0o100644 << 16


def files_of(source: Path, below: str = "") -> dict[str, Path]:
    """Name in the zip -> file; links followed, nothing hidden and nothing that Python compiled."""
    found = {}
    for path in source.iterdir():
        if path.name.startswith((".", "__pycache__")) or path.suffix == ".pyc":
            continue
        if path.is_dir():
            found |= files_of(path, f"{below}{path.name}/")
        elif path.is_file():
            found[below + path.name] = path
        else:
            raise OSError(f"{path}: a link that leads nowhere; check the repository out with its links")
    return found


def build(name: str, folder: Path) -> Path:
    """Writes `NAME-VERSION.zip` into a folder and returns its path."""
    source = HERE / name
    manifest = tomllib.loads((source / "blender_manifest.toml").read_text(encoding="utf-8"))
    if (source / "core").is_file():
        raise OSError(f"{source / 'core'}: a file where a link should be; on Windows, check out with core.symlinks=true")
    folder.mkdir(parents=True, exist_ok=True)
    target = folder / f"{manifest['id']}-{manifest['version']}.zip"
    with zipfile.ZipFile(target, "w") as out:
        for inside, path in sorted(files_of(source).items()):
            entry = zipfile.ZipInfo(inside, DATE)
            entry.create_system, entry.external_attr = 3, PLAIN_FILE
            out.writestr(entry, path.read_bytes().replace(b"\r\n", b"\n"))
    return target


def main(words=None) -> int:
    parser = argparse.ArgumentParser(prog="build_zips", description="Builds the zips of the Blender extensions")
    parser.add_argument("names", nargs="*", default=EXTENSIONS, metavar="NAME", help=f"{' or '.join(EXTENSIONS)}; both unless given")
    parser.add_argument("-o", "--output", type=Path, default=Path("target/blender"), metavar="DIR", help="default target/blender")
    given = parser.parse_args(words)
    unknown = [name for name in given.names if name not in EXTENSIONS]
    if unknown:
        parser.error(f"there is no extension {unknown[0]}; choose from {', '.join(EXTENSIONS)}")
    try:
        for name in given.names:
            print(build(name, given.output))
    except OSError as fault:
        print(f"build_zips: {fault}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())

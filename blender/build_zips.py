#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the zips of both extensions, as Blender installs them.

    python3 blender/build_zips.py [NAME …] [--wheel FILE …] [-o DIR]

Needs Python 3.11 and wheels `pong`, one for each system, which go into both zips: Blender installs that of its system with
the extension. The same sources and wheels give the same bytes on any machine: names in order, one date, no compression.
Blender's own `extension build` leaves out links, so it would ship pong_viz without its core; here a link becomes what it
points at.
"""

import argparse
import os
import re
import sys
import tomllib
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
EXTENSIONS = ("pong_pmtk", "pong_viz")
DATE = (1980, 1, 1, 0, 0, 0)  # the first that a zip can tell
PLAIN_FILE = 0o100644 << 16
BUILT_WHEELS = HERE.parent / "target/python/wheel"  # where the checks leave the wheel
PLATFORMS = {  # of a wheel, and as Blender says it
    "linux_x86_64": "linux-x64",
    "linux_aarch64": "linux-arm64",
    "win_amd64": "windows-x64",
    "win_arm64": "windows-arm64",
    "macosx_x86_64": "macos-x64",
    "macosx_arm64": "macos-arm64",
}


def files_of(source: Path, below: str = "") -> dict[str, Path]:
    """Name in the zip -> file; links followed, without hidden files and Python's compiled ones."""
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


def platform_of(wheel: Path) -> str:
    """Platform of a wheel in Blender's terms."""
    tag = re.sub(r"^(?:many(linux)(?:_\d+_\d+|\d+)|(macosx)_\d+_\d+)_", r"\1\2_", wheel.stem.split("-")[-1].split(".")[0])
    if tag not in PLATFORMS:
        raise OSError(f"{wheel}: `{tag}` is no platform of a Blender extension; take wheels for {', '.join(PLATFORMS)}")
    return PLATFORMS[tag]


def by_platform(wheels: list[Path]) -> dict[str, Path]:
    """Platform -> its wheel, in order."""
    found = {}
    for wheel in wheels:
        other = found.setdefault(platform_of(wheel), wheel)
        if other != wheel:
            raise OSError(f"{wheel}: {other.name} is for {platform_of(wheel)}, too; name one wheel for each platform")
        if wheel.name.split("-")[1] != wheels[0].name.split("-")[1]:
            raise OSError(f"{wheel}: not of the version of {wheels[0].name}; build the wheels from one commit")
    return dict(sorted(found.items()))


def built_wheel() -> Path:
    """The wheel that the environment names, or the one built by the checks."""
    if os.environ.get("PONG_WHEEL"):
        return Path(os.environ["PONG_WHEEL"])
    found = sorted(BUILT_WHEELS.glob("pong-*.whl"))
    if len(found) != 1:
        cause = f"there are {len(found)} wheels in {BUILT_WHEELS}, and one is to go into the zips"
        raise OSError(f"{cause}; build one with `bash hosts/python/build_wheel DIR` and name it with --wheel")
    return found[0]


def name_in_zip(wheel: Path) -> str:
    """File name of a wheel in the zips. Blender 4.2.0 to 4.3 takes `cp310-abi3` for Python 3.10 alone, and has 3.11."""
    return wheel.name.replace("-cp310-abi3-", "-cp310.cp311-abi3-")


def manifest_with(manifest: str, wheels: dict[str, Path]) -> bytes:
    """A manifest with the wheels added before its first table."""
    names = ", ".join(f'"./wheels/{name_in_zip(wheel)}"' for wheel in wheels.values())
    platforms = ", ".join(f'"{platform}"' for platform in wheels)
    lines = f"platforms = [{platforms}]\nwheels = [{names}]\n\n"
    head, table, tail = manifest.replace("\r\n", "\n").partition("\n[permissions]")
    return f"{head.rstrip()}\n{lines}{table.lstrip()}{tail}".encode()


def build(name: str, folder: Path, wheels: dict[str, Path]) -> Path:
    """Writes `NAME-VERSION.zip` into a folder and returns its path."""
    source = HERE / name
    written = (source / "blender_manifest.toml").read_text(encoding="utf-8")
    manifest = tomllib.loads(written)
    if (source / "core").is_file():
        raise OSError(f"{source / 'core'}: a file where a link should be; on Windows, check out with core.symlinks=true")
    folder.mkdir(parents=True, exist_ok=True)
    target = folder / f"{manifest['id']}-{manifest['version']}.zip"
    contents = {inside: path.read_bytes().replace(b"\r\n", b"\n") for inside, path in files_of(source).items()}
    contents["blender_manifest.toml"] = manifest_with(written, wheels)
    contents |= {f"wheels/{name_in_zip(wheel)}": wheel.read_bytes() for wheel in wheels.values()}
    with zipfile.ZipFile(target, "w") as out:
        for inside, content in sorted(contents.items()):
            entry = zipfile.ZipInfo(inside, DATE)
            entry.create_system, entry.external_attr = 3, PLAIN_FILE
            out.writestr(entry, content)
    return target


def main(words=None) -> int:
    parser = argparse.ArgumentParser(prog="build_zips", description="Builds the zips of the Blender extensions")
    parser.add_argument("names", nargs="*", default=EXTENSIONS, metavar="NAME", help=f"{' or '.join(EXTENSIONS)}; both unless given")
    told = "the wheels to bring along, one for each platform; default PONG_WHEEL, or the one in target/python/wheel"
    parser.add_argument("--wheel", type=Path, action="extend", nargs="+", metavar="FILE", help=told)
    parser.add_argument("-o", "--output", type=Path, default=Path("target/blender"), metavar="DIR", help="default target/blender")
    given = parser.parse_args(words)
    unknown = [name for name in given.names if name not in EXTENSIONS]
    if unknown:
        parser.error(f"there is no extension {unknown[0]}; choose from {', '.join(EXTENSIONS)}")
    try:
        wheels = by_platform(given.wheel or [built_wheel()])
        for name in given.names:
            print(build(name, given.output, wheels))
    except OSError as fault:
        print(f"build_zips: {fault}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""Checks wheels, whatever system they are for, without installing them:

    python3 hosts/python/check_wheel.py WHEEL…

The name says what is inside: the library is for the system and processor of its tag, and asks for nothing that the tag does not
promise (glibc, macOS, libraries). Every file has the sum in RECORD, none is missing or too much, the licences are there, and the
metadata name the oldest Python.
"""

import base64
import csv
import hashlib
import io
import re
import sys
import tempfile
import zipfile
from email.parser import Parser
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "packaging"))
from binary import read  # noqa: E402

TAG = re.compile(r"(?:many(?P<glibc>linux)_(?P<g>\d+_\d+)|musl(?P<musl>linux)_\d+_\d+|(?P<macos>macosx)_(?P<m>\d+_\d+)|win)_(?P<cpu>\w+)$")
# What each system has without being asked; Windows has more, by patterns.
LINUX = {"libc.so.6", "libm.so.6", "libpthread.so.0", "libdl.so.2", "librt.so.1", "libutil.so.1", "libgcc_s.so.1"}
LOADERS = {"ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1"}
WINDOWS = re.compile(r"(python3|kernel32|ntdll|advapi32|userenv|ws2_32|bcrypt|bcryptprimitives|msvcrt|api-ms-win-[\w-]+)\.dll", re.IGNORECASE)


class Unfit(Exception):
    """A fault of a wheel, with the cause."""


def check_library(tags: str, path: Path) -> str:
    # Older names of the same tag (manylinux2014) stand beside it.
    promised = next(filter(None, map(TAG.match, tags.split("."))), None)
    if not promised:
        raise Unfit(f"`{tags}` is no platform tag of a wheel that is published")
    found = read(path)
    system = "macos" if promised["macos"] else "linux" if promised["glibc"] or promised["musl"] else "windows"
    processor = {"amd64": "x86_64", "arm64": "aarch64"}.get(promised["cpu"], promised["cpu"])
    if (found.system, found.processor) != (system, processor):
        raise Unfit(f"{path.name} is for {found.system} on {found.processor}, the tag says {system} on {processor}")
    if promised["glibc"] or promised["macos"]:
        allowed = tuple(map(int, (promised["g"] or promised["m"]).split("_")))
        if found.oldest > allowed:
            raise Unfit(f"{path.name} needs version {'.'.join(map(str, found.oldest))}, the tag promises {'.'.join(map(str, allowed))}")
    if promised["musl"] and found.oldest:
        raise Unfit(f"{path.name} needs glibc, the tag says musl")
    if system == "linux":
        foreign = set(found.needs) - (LINUX | LOADERS if promised["glibc"] else {"libc.so", "libc.musl-" + processor + ".so.1"})
    elif system == "windows":
        foreign = {name for name in found.needs if not WINDOWS.fullmatch(name)}
    else:
        foreign = {name for name in found.needs if not name.startswith(("/usr/lib/", "/System/", "@rpath/_pong"))}
    if not found.signed and processor == "aarch64":
        raise Unfit(f"{path.name} has no signature or that of another file, so that macOS does not load it")
    if foreign:
        raise Unfit(f"{path.name} needs {', '.join(sorted(foreign))}, which the system does not bring")
    return str(found)


def check(wheel: Path) -> str:
    with zipfile.ZipFile(wheel) as content:
        files = {name: content.read(name) for name in content.namelist() if not name.endswith("/")}
    name, version, python, abi, tags = wheel.stem.split("-")
    info = f"{name}-{version}.dist-info/"
    for row in csv.reader(io.StringIO(files[info + "RECORD"].decode())):
        if row[1]:
            digest = base64.urlsafe_b64encode(hashlib.sha256(files.get(row[0], b"")).digest()).rstrip(b"=").decode()
            if row[1] != f"sha256={digest}":
                raise Unfit(f"{row[0]} is not the file of RECORD")
    recorded = {row[0] for row in csv.reader(io.StringIO(files[info + "RECORD"].decode()))}
    if recorded != set(files):
        raise Unfit(f"not both in RECORD and in the wheel: {', '.join(sorted(recorded ^ set(files)))}")
    written = {file.relative_to(ROOT / "hosts/python/python").as_posix() for file in (ROOT / "hosts/python/python").rglob("*.py*")}
    written = {file for file in written if "__pycache__" not in file} | {"pong/py.typed"}
    library = "pong/_pong.pyd" if "win" == tags[:3] else "pong/_pong.abi3.so"
    wanted = written | {library}
    inside = {file for file in files if not file.startswith(info)}
    if inside != wanted:
        raise Unfit(f"files missing or too much: {', '.join(sorted(inside ^ wanted))}")
    for licence in ("LICENSE", "THIRD_PARTY_LICENSES.md"):
        if info + f"licenses/{licence}" not in files:
            raise Unfit(f"{licence} is missing")
    told = Parser().parsestr(files[info + "WHEEL"].decode())
    expanded = {f"{python}-{abi}-{tag}" for tag in tags.split(".")}
    if set(told.get_all("Tag")) != expanded:
        raise Unfit(f"WHEEL says {told.get_all('Tag')}, the name {sorted(expanded)}")
    metadata = Parser().parsestr(files[info + "METADATA"].decode())
    oldest = f"{python[2]}.{python[3:]}"
    if metadata["Requires-Python"] != f">={oldest}" or abi != "abi3":
        raise Unfit(f"for Python {metadata['Requires-Python']} by the metadata, {python}-{abi} by the name")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / Path(library).name
        path.write_bytes(files[library])
        return f"{check_library(tags, path)}; {len(files)} files, {wheel.stat().st_size / 1e6:.1f} MB"


def main() -> int:
    if len(sys.argv) < 2:
        print(__doc__, file=sys.stderr)
        return 2
    for name in sys.argv[1:]:
        try:
            print(f"{Path(name).name}: {check(Path(name))}")
        except (Unfit, OSError, KeyError) as fault:
            print(f"check_wheel: {name}: {fault}; build it anew by hosts/python/build_wheel", file=sys.stderr)
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""Facts of a library or program, read from its file: system, processor, libraries that it needs, oldest system that it runs on.

    python3 packaging/binary.py FILE…        one line for each

ELF is read by readelf, PE by objdump (both of binutils, whatever the machine), Mach-O here.
"""

import hashlib
import re
import struct
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

PROCESSORS = {"Advanced Micro Devices X86-64": "x86_64", "AArch64": "aarch64", 0x01000007: "x86_64", 0x0100000C: "aarch64"}
# Load commands of Mach-O: libraries that are loaded, the oldest system in both forms, and where the signature is.
DYLIBS, MINIMUM, BUILD, SIGNATURE = (0xC, 0x80000018, 0x8000001F), 0x24, 0x32, 0x1D


@dataclass(frozen=True)
class Binary:
    """`system` is linux, windows or macos; `oldest` the version of glibc or of macOS that is needed, or none.

    `signed`: not for macOS, or the signature has the hashes of the file. Apple's processors run nothing else.
    """

    system: str
    processor: str
    needs: tuple[str, ...]
    oldest: tuple[int, ...]
    signed: bool = True

    def __str__(self):
        version = ".".join(map(str, self.oldest))
        oldest = {"linux": f"glibc {version}" if version else "no glibc", "macos": f"macOS {version}", "windows": "Windows"}
        return f"{self.system} {self.processor}, {oldest[self.system]}, needs {', '.join(self.needs) or 'no library'}{'' if self.signed else ', not signed'}"


def told_by(*command: str) -> str:
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def elf(path: Path) -> Binary:
    told = told_by("readelf", "--wide", "--file-header", "--dynamic", "--dyn-syms", str(path))
    machine = re.search(r"^ *Machine: +(.*)$", told, re.MULTILINE)[1]
    # Symbols that may be absent (weak) ask for nothing.
    wanted = re.findall(r" GLOBAL +\w+ +UND \S+@GLIBC_([\d.]+)", told)
    versions = [tuple(map(int, version.split("."))) for version in wanted]
    needs = re.findall(r"\(NEEDED\).*\[(.*)\]", told)
    return Binary("linux", PROCESSORS.get(machine, machine), tuple(needs), max(versions, default=()))


def pe(path: Path) -> Binary:
    told = told_by("objdump", "--private-headers", str(path))
    processor = "x86_64" if "file format pei-x86-64" in told else "unknown"
    needs = dict.fromkeys(re.findall(r"DLL Name: (.*)", told))
    return Binary("windows", processor, tuple(needs), ())


def mach_o(content: bytes) -> Binary:
    _, kind, _, _, count, _, _, _ = struct.unpack_from("<8I", content)
    needs, oldest, signed, at = [], 0, False, 32
    for _ in range(count):
        command, size, first, second = struct.unpack_from("<4I", content, at)
        if command in DYLIBS:
            needs.append(content[at + first : at + size].split(b"\0")[0].decode())
        elif command in (MINIMUM, BUILD):
            oldest = first if command == MINIMUM else second
        elif command == SIGNATURE:
            signed = signature_fits(content, first)
        at += size
    return Binary("macos", PROCESSORS.get(kind, hex(kind)), tuple(needs), (oldest >> 16, oldest >> 8 & 255), signed)


def signature_fits(content: bytes, start: int) -> bool:
    """Every page has the SHA-256 that the code directory of the signature at `start` says."""
    (parts,) = struct.unpack_from(">I", content, start + 8)
    kinds = dict(struct.unpack_from(">2I", content, start + 12 + 8 * part) for part in range(parts))
    directory = start + kinds[0]
    hashes, _, _, pages, end, width, kind, _, bits = struct.unpack_from(">5I4B", content, directory + 16)
    page = 1 << bits
    found = b"".join(hashlib.sha256(content[at : min(at + page, end)]).digest()[:width] for at in range(0, pages * page, page))
    return kind == 2 and content[directory + hashes : directory + hashes + len(found)] == found


def read(path: Path) -> Binary:
    """Reads a file. Raises `OSError` if it is no library or program of a 64-bit system."""
    content = path.read_bytes()
    if content[:5] == b"\x7fELF\x02":
        return elf(path)
    if content[:2] == b"MZ":
        return pe(path)
    if content[:4] == b"\xcf\xfa\xed\xfe":
        return mach_o(content)
    raise OSError(f"{path}: no library or program of Linux, Windows or macOS with 64 bits")


if __name__ == "__main__":
    for name in sys.argv[1:]:
        print(f"{name}: {read(Path(name))}")

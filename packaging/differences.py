"""Tells where the files of two folders of packages differ: file within archive, section of an ELF file, member of `libpong.a`.

    python3 packaging/differences.py FOLDER OTHER        fails if anything differs
"""

import struct
import subprocess
import sys
import tempfile
from pathlib import Path


def sections(content: bytes) -> dict[str, bytes]:
    """Sections of an ELF file of 64 bits, by name; the headers as `headers`."""
    table, (size, count, names) = struct.unpack_from("<Q", content, 40)[0], struct.unpack_from("<3H", content, 58)
    rows = [struct.unpack_from("<2I4Q", content, table + size * row) for row in range(count)]
    start = rows[names][4]
    found = {"headers": content[:64] + content[table : table + size * count]}
    for number, (name, kind, _, _, offset, length) in enumerate(rows):
        word = content[start + name : content.index(b"\0", start + name)].decode()
        # Sections of zeros (.bss) have no bytes in the file.
        found[f"{word or number}"] = b"" if kind == 8 else content[offset : offset + length]
    return found


def members(content: bytes) -> dict[str, bytes]:
    """Members of an archive of `ar`, by number and name."""
    found, at = {}, 8
    while at < len(content):
        name, size = content[at : at + 16].decode().strip(), int(content[at + 48 : at + 58])
        found[f"{len(found)} {name}"] = content[at : at + 60 + size]
        at += 60 + size + size % 2
    return found


def unpacked(file: Path, folder: Path) -> Path:
    folder.mkdir()
    command = ["dpkg-deb", "-R", file, folder] if file.suffix == ".deb" else ["tar", "xf", file, "-C", folder]
    subprocess.run(command, check=True)
    return folder


def parts(file: Path) -> dict[str, bytes]:
    content = b"link to " + str(file.readlink()).encode() if file.is_symlink() else file.read_bytes()
    if content[:5] == b"\x7fELF\x02":
        return sections(content)
    return members(content) if content[:8] == b"!<arch>\n" and file.suffix == ".a" else {"contents": content}


def differences(one: Path, other: Path, work: Path) -> list[str]:
    """One line for each file below both folders that differs, or is in one of them alone."""
    told = []
    names = [{path.relative_to(root).as_posix() for path in root.rglob("*") if path.is_symlink() or not path.is_dir()} for root in (one, other)]
    told += [f"{name}: in one of both only" for name in sorted(names[0] ^ names[1])]
    for name in sorted(names[0] & names[1]):
        first, second = parts(one / name), parts(other / name)
        if first == second:
            continue
        if name.endswith((".deb", ".tar.xz")):
            with tempfile.TemporaryDirectory(dir=work) as folder:
                inner = differences(unpacked(one / name, Path(folder, "one")), unpacked(other / name, Path(folder, "other")), work)
            told += [f"{name}: {line}" for line in inner or ["the files in it are equal; its times, order or packing are not"]]
            continue
        differ = [
            f"{part} ({len(first[part])} and {len(second[part])} bytes)" if part in first and part in second else f"{part} (in one only)"
            for part in [*first, *(part for part in second if part not in first)]
            if first.get(part) != second.get(part)
        ]
        told.append(f"{name}: {', '.join(differ[:20])}{', …' if len(differ) > 20 else ''}")
    return told


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as scratch:
        lines = differences(Path(sys.argv[1]), Path(sys.argv[2]), Path(scratch))
    print(*lines, sep="\n", end="\n" if lines else "")
    sys.exit(bool(lines))

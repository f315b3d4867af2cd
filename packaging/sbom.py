"""The bill of materials of libpong and the program pong, in one file in the format CycloneDX 1.5:

    python3 packaging/sbom.py CARGO-CYCLONEDX OUT      in an unpacked source tree; SOURCE_DATE_EPOCH is its time

cargo-cyclonedx writes one file for each crate of ours, with paths of this machine in the references. Here those of the two products
become one, and every reference a package URL (pkg:cargo/NAME@VERSION). Each crate that is linked into them, as cargo tells, must be
there, and in THIRD_PARTY_LICENSES.md.
"""

import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PRODUCTS = ("pong-capi", "pong-cli")
NAME = "sbom-of-crate"


def package_url(reference):
    """`registry+…#libm@0.2.16` and `path+file:///…/pong-arena#0.1.0` as package URLs."""
    place, _, package = reference.partition("#")
    name, _, version = package.rpartition("@")
    return f"pkg:cargo/{name or pathlib.PurePosixPath(place).name}@{version}"


def of_crate(crate):
    return json.loads((ROOT / "crates" / crate / f"{NAME}.json").read_text())


def cleaned(component):
    component = {key: value for key, value in component.items() if key != "components"}
    component["bom-ref"] = component["purl"] = package_url(component["bom-ref"])
    return component


def merged(version):
    parts = [of_crate(crate) for crate in PRODUCTS]
    components = {}
    for part in parts:
        for component in [part["metadata"]["component"], *part["components"]]:
            component = cleaned(component)
            components[component["bom-ref"]] = component
    depends = {}
    for part in parts:
        for entry in part["dependencies"]:
            wanted = depends.setdefault(package_url(entry["ref"]), set())
            wanted.update(package_url(reference) for reference in entry.get("dependsOn", []))
    own = f"pkg:generic/pong@{version}"
    depends[own] = {package_url(part["metadata"]["component"]["bom-ref"]) for part in parts}
    metadata = parts[0]["metadata"]
    metadata["component"] = {
        "type": "library", "bom-ref": own, "purl": own, "name": "pong", "version": version,
        "description": "Contact dynamics: libpong and the program pong", "licenses": [{"expression": "Apache-2.0"}],
    }
    return {
        "bomFormat": "CycloneDX", "specVersion": parts[0]["specVersion"], "version": 1, "metadata": metadata,
        "components": [components[key] for key in sorted(components)],
        "dependencies": [{"ref": key, "dependsOn": sorted(depends[key])} for key in sorted(depends)],
    }


def linked(platform):
    """Name and version of every crate of others that is linked into the products."""
    command = ["cargo", "tree", "--locked", "--offline", "--edges", "normal,no-proc-macro", "--prefix", "none", "--format", "{p}",
               "--target", platform, *(part for product in PRODUCTS for part in ("--package", product))]
    tree = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout
    crates = {tuple(line.split(" ")[:2]) for line in tree.splitlines() if line.strip()}
    return sorted((name, version.removeprefix("v")) for name, version in crates if not name.startswith("pong-"))


def missing(bom, platform):
    """Differences between the bill and the linked components."""
    there = {(component["name"], component["version"]) for component in bom["components"]}
    licences = (ROOT / "THIRD_PARTY_LICENSES.md").read_text()
    for name, version in linked(platform):
        if (name, version) not in there:
            yield f"{name} {version} is linked and not in the bill of materials"
        if f"| {name} | {version} |" not in licences:
            yield f"{name} {version} is linked and not in THIRD_PARTY_LICENSES.md"


def main():
    tool, out = sys.argv[1:]
    platform = f"{subprocess.run(['uname', '-m'], check=True, capture_output=True, text=True).stdout.strip()}-unknown-linux-gnu"
    subprocess.run([tool, "cyclonedx", "--quiet", "--quiet", "--format", "json", "--spec-version", "1.5", "--target", platform,
                    "--no-build-deps", "--override-filename", NAME], cwd=ROOT, check=True)
    version = re.search(r'^version = "(.+)"', (ROOT / "Cargo.toml").read_text(), re.M)[1]
    bom = merged(version)
    for path in ROOT.glob(f"crates/*/{NAME}.json"):
        path.unlink()
    if absent := list(missing(bom, platform)):
        sys.exit("\n".join(absent))
    text = json.dumps(bom, indent=1, ensure_ascii=False) + "\n"
    if str(ROOT) in text:
        sys.exit(f"the bill of materials names {ROOT}")
    pathlib.Path(out).write_text(text)
    print(f"bill of materials: {len(bom['components'])} components")


main()

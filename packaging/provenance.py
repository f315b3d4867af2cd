#!/usr/bin/env python3
"""Writes where the files of a release come from, in the form of SLSA 1.0 (in-toto statement 1):

    python3 packaging/provenance.py OUT BUILDER        OUT/pong-VERSION.provenance.json; BUILDER: an address that names who built

Subjects are the files of OUT/SHA256SUMS with their sums; dependencies are the commit, the lock files of all crates and the
tool chain. The same commit and files make the same bytes: no time and no folder is in it.
"""

import hashlib
import json
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def sha256(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def subjects(out: Path) -> list[dict]:
    """Files of SHA256SUMS, each of which must still have its sum."""
    found = []
    for line in (out / "SHA256SUMS").read_text(encoding="utf-8").splitlines():
        digest, name = line.split(maxsplit=1)
        name = name.removeprefix("*")
        if sha256(out / name) != digest:
            raise OSError(f"{out / name}: not the file of SHA256SUMS; run packaging/build again")
        found.append({"name": name, "digest": {"sha256": digest}})
    return found


def dependencies(commit: str) -> list[dict]:
    """The commit and what it fixes: crates, tool chain, tools of packaging/settings."""
    channel = re.search(r'channel = "(.*)"', (ROOT / "rust-toolchain.toml").read_text())[1]
    tools = dict(re.findall(r"^(\w+_version)=([\d.]+)$", (ROOT / "packaging/settings").read_text(), re.MULTILINE))
    locks = [{"uri": f"file:{name}", "digest": {"sha256": sha256(ROOT / name)}} for name in ("Cargo.lock", "hosts/python/Cargo.lock")]
    named = [{"uri": f"pkg:generic/{name.removesuffix('_version')}@{version}"} for name, version in sorted(tools.items())]
    return [{"uri": "git+commit", "digest": {"gitCommit": commit}}, *locks, {"uri": f"pkg:generic/rust@{channel}"}, *named]


def statement(out: Path, builder: str) -> dict:
    git = ["git", "-C", str(ROOT)]
    commit = subprocess.run([*git, "rev-parse", "HEAD"], check=True, capture_output=True, text=True).stdout.strip()
    version = re.search(r'^version = "(.*)"', (ROOT / "Cargo.toml").read_text(), re.MULTILINE)[1]
    return {
        "_type": "https://in-toto.io/Statement/v1",
        "subject": subjects(out),
        "predicateType": "https://slsa.dev/provenance/v1",
        "predicate": {
            "buildDefinition": {
                "buildType": "urn:pong:packaging/build",
                "externalParameters": {"command": "bash packaging/build", "version": version},
                "resolvedDependencies": dependencies(commit),
            },
            "runDetails": {"builder": {"id": builder}},
        },
    }


def main() -> int:
    if len(sys.argv) != 3:
        print(__doc__, file=sys.stderr)
        return 2
    out = Path(sys.argv[1])
    try:
        content = statement(out, sys.argv[2])
        version = content["predicate"]["buildDefinition"]["externalParameters"]["version"]
        (out / f"pong-{version}.provenance.json").write_text(json.dumps(content, indent=2) + "\n", encoding="utf-8")
    except OSError as fault:
        print(f"provenance: {fault}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())

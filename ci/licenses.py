"""Licences of the crates linked into libpong, pong and the Python wheel, as THIRD_PARTY_LICENSES.md.

    python3 ci/licenses.py            is the file current?
    python3 ci/licenses.py --write    renews it

What is linked is found by `cargo tree`: from the C interface, the program and the Python module on, by normal dependencies of the platform that
is built for; what only runs at build time (build scripts, derive macros) is not in the product.
"""

import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
OUT = ROOT / "THIRD_PARTY_LICENSES.md"
# Folder of a workspace -> its products.
PRODUCTS = {".": ("pong-capi", "pong-cli"), "hosts/python": ("pong-python",)}
PLATFORM = "x86_64-unknown-linux-gnu"
# Preferred licences where there is a choice, in this order: that of Pong itself first.
CHOICE = ("Apache-2.0", "MIT", "BSD-3-Clause", "BSD-2-Clause", "ISC", "Zlib", "BSL-1.0", "CC0-1.0", "Unlicense", "0BSD")
FILE_OF = {"Apache-2.0": "apache", "MIT": "mit", "BSD": "bsd", "Zlib": "zlib", "ISC": "isc", "Unicode": "unicode"}

HEAD = """# Licences of what is linked into Pong

libpong, the program `pong` and the Python module `pong` contain the crates below and the Rust standard library (MIT or Apache-2.0, copyright The Rust
Project Developers). Where a crate may be had under one of several licences, it is taken under the first of Apache-2.0, MIT
that it offers. Pong itself is under [Apache-2.0](LICENSE). This file is written by `ci/licenses --write`.

"""


MIT = """MIT License

Copyright (c) {holders}

Permission is hereby granted, free of charge, to any person obtaining a copy
of this software and associated documentation files (the "Software"), to deal
in the Software without restriction, including without limitation the rights
to use, copy, modify, merge, publish, distribute, sublicense, and/or sell
copies of the Software, and to permit persons to whom the Software is
furnished to do so, subject to the following conditions:

The above copyright notice and this permission notice shall be included in all
copies or substantial portions of the Software.

THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE
SOFTWARE.
"""


def metadata(folder):
    command = ["cargo", "metadata", "--format-version", "1", "--locked", "--filter-platform", PLATFORM]
    return json.loads(subprocess.run(command, cwd=ROOT / folder, check=True, capture_output=True, text=True).stdout)


def linked():
    """Third-party packages in the products, by name and version."""
    found = {}
    for folder, products in PRODUCTS.items():
        command = ["cargo", "tree", "--locked", "--edges", "normal,no-proc-macro", "--prefix", "none", "--target", PLATFORM]
        command += ["--format", "{p}"] + [part for product in products for part in ("--package", product)]
        tree = subprocess.run(command, cwd=ROOT / folder, check=True, capture_output=True, text=True).stdout
        used = {tuple(line.split(" ")[:2]) for line in tree.splitlines() if line.strip()}
        for package in metadata(folder)["packages"]:
            if package["source"] is not None and (package["name"], "v" + package["version"]) in used:
                found[package["name"], package["version"]] = package
    return [package for _, package in sorted(found.items())]


def chosen(expression):
    """Licences chosen from an expression such as `MIT OR Apache-2.0`, `A AND (B OR C)`."""
    parts = [part.strip(" ()") for part in re.split(r"\bAND\b(?![^(]*\))", expression.replace("/", " OR "))]
    taken = []
    for part in parts:
        offered = [name.strip(" ()") for name in re.split(r"\bOR\b", part)]
        known = [name for name in CHOICE if name in offered]
        taken.append(known[0] if known else offered[0])
    return taken


def files_of(package, licence):
    """Texts of a crate under a licence: the file named after it, or every licence file."""
    folder = pathlib.Path(package["manifest_path"]).parent
    named = re.compile(r"(licen[cs]e|copying|notice|unlicense)", re.I)
    files = sorted(path for path in folder.iterdir() if path.is_file() and named.match(path.name))
    mark = next((word for start, word in FILE_OF.items() if licence.startswith(start)), None)
    of_licence = [path for path in files if mark and mark in path.name.lower()]
    notices = [path for path in files if path.name.lower().startswith("notice")]
    plain = [path for path in files if not any(word in path.name.lower() for word in FILE_OF.values())]
    return (of_licence or plain or []) + [path for path in notices if path not in of_licence and path not in plain]


def normal(text):
    return re.sub(r"\s+", " ", text).strip()


# Apache-2.0 by its terms; the appendix is an example for appliers, which copies fill in or leave out.
APACHE_TERMS = "END OF TERMS AND CONDITIONS"


def written():
    texts, rows, missing = [], [], []
    for package in linked():
        name, licence = f"{package['name']} {package['version']}", package["license"] or "see its text"
        numbers = []
        for taken in chosen(licence):
            paths = files_of(package, taken)
            if not paths and taken == "Apache-2.0":
                paths = [ROOT / "LICENSE"]
            contents = [path.read_text(encoding="utf-8", errors="replace") for path in paths]
            if not contents and taken == "MIT":
                # Published without its text: the standard text of that licence.
                contents = [MIT.format(holders=", ".join(package["authors"]) or f"the authors of {package['name']}")]
            if not contents:
                missing.append(f"{name}: no text for {taken}")
            for text in contents:
                text = text.replace("\r\n", "\n").strip("\n")
                key = normal(text)
                if taken == "Apache-2.0" and APACHE_TERMS in key:
                    text = (ROOT / "LICENSE").read_text(encoding="utf-8").strip("\n")
                    key = "Apache-2.0"
                known = [number for number, (other, _) in enumerate(texts, 1) if other == key]
                if not known:
                    texts.append((key, text))
                    known = [len(texts)]
                numbers += [number for number in known if number not in numbers]
        rows.append((package["name"], package["version"], licence, numbers))
    lines = ["| crate | version | licence | text |", "|---|---|---|---|"]
    for name, version, licence, numbers in rows:
        lines.append(f"| {name} | {version} | {licence} | {', '.join(map(str, numbers))} |")
    body = "\n".join(lines) + "\n"
    for number, (_, text) in enumerate(texts, 1):
        quoted = "\n".join(f"    {line}".rstrip() for line in text.splitlines())
        body += f"\n## Text {number}\n\n{quoted}\n"
    return HEAD + body, missing


def main():
    text, missing = written()
    for line in missing:
        print(line)
    if sys.argv[1:] == ["--write"]:
        OUT.write_text(text, encoding="utf-8")
    elif not OUT.exists() or OUT.read_text(encoding="utf-8") != text:
        print(f"{OUT.name} is not current: run ci/licenses --write")
        sys.exit(1)
    sys.exit(1 if missing else 0)


main()

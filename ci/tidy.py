"""House rules that a program can check: arrows between crates, circles of files, unsafe code, words, lines, links."""

import pathlib
import re
import subprocess
import sys

import circles
import credibility
import openings

ROOT = pathlib.Path(__file__).resolve().parent.parent

# Crate -> crates of ours that it may use (docs/architecture.md).
ARROWS = {
    "pong-arena": set(),
    "pong-geometry": set(),
    "pong-threads": set(),
    "pong-model": {"pong-geometry"},
    "pong-engine": {"pong-arena", "pong-geometry", "pong-model", "pong-threads"},
    "pong": {"pong-geometry", "pong-model", "pong-engine", "pong-threads"},
    "pong-advise": {"pong-geometry", "pong-model", "pong-engine"},
    "pong-executive": {"pong-advise", "pong-geometry", "pong-model", "pong-engine", "pong-slow"},
    "pong-slow": {"pong-geometry", "pong-model", "pong-engine"},
    "pong-record": {"pong-arena", "pong-geometry", "pong-model", "pong-engine"},
    "pong-verify": {"pong-testkit", "pong-report", "pong-geometry", "pong-model", "pong-engine", "pong-executive"},
    "pong-report": {"pong-model"},
    "pong-study": {"pong-report", "pong-geometry", "pong-model", "pong-engine", "pong-executive", "pong-record"},
    "pong-fit": {"pong-report", "pong-geometry", "pong-model", "pong-engine", "pong-executive", "pong-record"},
    "pong-import": {"pong-geometry", "pong-model"},
    "pong-decompose": {"pong-geometry", "pong-import", "pong-model"},
    "pong-doctor": {"pong-geometry", "pong-threads"},
    "pong-invariance": {"pong-testkit", "pong-geometry", "pong-model", "pong-engine"},
    "pong-fpenv": set(),
    "pong-fmu": {"pong-engine", "pong-executive", "pong-fpenv", "pong-geometry", "pong-model"},
    "pong-testkit": {"pong-geometry", "pong-model", "pong-engine"},
    "pong-view": {"pong-geometry", "pong-model", "pong-record"},
    "pong-capi": {
        "pong-advise", "pong-arena", "pong-fpenv", "pong-geometry", "pong-model", "pong-engine", "pong-record", "pong-slow",
        "pong-threads",
    },
    "pong-cli": {
        "pong-advise", "pong-decompose", "pong-doctor", "pong-geometry", "pong-import", "pong-invariance", "pong-model", "pong-engine", "pong-executive", "pong-fit", "pong-fmu", "pong-record",
        "pong-verify", "pong-report", "pong-study", "pong-view",
    },
}
# The kit has a counting allocator.
MAY_BE_UNSAFE = {"pong-arena", "pong-capi", "pong-fmu", "pong-fpenv", "pong-testkit", "pong-threads"}
LINES_MAX = 800
# No part of the product may use the platform's mathematics or fused operations, whose bits differ between machines.
FORBIDDEN_IN_ENGINE = re.compile(
    r"\.(mul_add|sin|cos|tan|sinh|cosh|tanh|exp|exp2|exp_m1|ln|ln_1p|log|log2|log10|powf|powi|cbrt|hypot|atan|atan2|acos|asin)\("
    r"|vfm[as]|vml[as]|_fn?m(add|sub)_|relaxed_"  # of NEON, AVX, WebAssembly
)
ENGINE_CRATES = ["pong-geometry", "pong-model", "pong-engine", "pong-advise", "pong-slow", "pong-executive", "pong-record"]


def tracked(*patterns):
    listing = subprocess.run(["git", "ls-files", *patterns], cwd=ROOT, check=True, capture_output=True, text=True)
    return [ROOT / line for line in listing.stdout.splitlines()]


def product_code(text):
    """The text before the tests of a file, without comments."""
    text = text.split("#[cfg(test)]")[0]
    return "\n".join(line.split("//")[0] for line in text.splitlines())


def arrows():
    for manifest in tracked("crates/*/Cargo.toml"):
        if manifest.parent.name not in ARROWS:
            yield f"{manifest}: {manifest.parent.name} has no entry in ARROWS"
    for crate, allowed in ARROWS.items():
        manifest = ROOT / "crates" / crate / "Cargo.toml"
        if not manifest.exists():
            yield f"{manifest}: missing"
            continue
        section = None
        for line in manifest.read_text().splitlines():
            if line.startswith("["):
                section = line.strip("[]")
            used = re.match(r"(pong-[a-z]+)", line)
            if section == "dependencies" and used and used[1] not in allowed:
                yield f"{manifest}: {crate} must not use {used[1]}"


def unsafe_code():
    for path in tracked("crates/*/src/*.rs", "crates/*/src/**/*.rs"):
        crate = path.relative_to(ROOT).parts[1]
        if crate not in MAY_BE_UNSAFE and re.search(r"\bunsafe\b(?!_code)", product_code(path.read_text())):
            yield f"{path}: unsafe outside {sorted(MAY_BE_UNSAFE)}"


def platform_mathematics():
    for path in tracked("crates/*/src/*.rs", "crates/*/src/**/*.rs"):
        if path.relative_to(ROOT).parts[1] not in ENGINE_CRATES:
            continue
        for number, line in enumerate(product_code(path.read_text()).splitlines(), 1):
            if FORBIDDEN_IN_ENGINE.search(line):
                yield f"{path}:{number}: {line.strip()} (use sqrt and arithmetic, or libm while loading)"


def file_lengths():
    for path in tracked("*.rs", "*.py", "*.c", "*.h", "*.hpp"):
        if path.name == "pong.h":
            continue
        lines = len(path.read_text().splitlines())
        if lines > LINES_MAX:
            yield f"{path}: {lines} lines, at most {LINES_MAX}"


def dead_links():
    for path in tracked("*.md"):
        for target in re.findall(r"\]\(([^)#\s]+)", path.read_text()):
            if "://" in target or target.startswith("mailto:"):
                continue
            if not (path.parent / target).exists():
                yield f"{path}: link to {target} leads nowhere"


def theory_citations():
    """Checks that comments cite existing sections of the theory manual: `docs/theory.md, 2.2 and 2.4`."""
    manual = (ROOT / "docs/theory.md").read_text()
    sections = set(re.findall(r"^#+ ([0-9]+(?:\.[0-9]+)?) ", manual, re.M))
    cited = re.compile(r"docs/theory\.md, ([0-9.]+(?:(?:, | and | to )[0-9.]+)*)")
    for path in tracked("*.rs", "*.py", "*.c", "*.h", "*.hpp", "*.toml"):
        for number, line in enumerate(path.read_text().splitlines(), 1):
            for found in cited.findall(line):
                for section in re.split(r", | and | to ", found):
                    if section.rstrip(".") not in sections:
                        yield f"{path}:{number}: docs/theory.md has no section {section}"


def retired_words():
    """Finds words of the glossary's last table, which are retired."""
    table = (ROOT / "docs/glossary.md").read_text().split("## Retired words")[1]
    rows = re.findall(r"^\| (`.+?) \| (.+?) \|$", table, re.M)
    instead = {word: now for words, now in rows for word in re.findall(r"`([^`]+)`", words)}
    any_word = re.compile(rf"(?<![A-Za-z0-9])(?:{'|'.join(map(re.escape, instead))})(?![A-Za-z0-9_])")
    tells = {ROOT / "docs/glossary.md", ROOT / "CHANGELOG.md"}
    for path in tracked("*.rs", "*.py", "*.c", "*.cpp", "*.h", "*.hpp", "*.js", "*.md", "*.toml", "*.ron"):
        text = "" if path in tells else path.read_text()
        for found in any_word.finditer(text):
            number = text.count("\n", 0, found.start()) + 1
            yield f"{path}:{number}: `{found[0]}` is retired, say {instead[found[0]]} (docs/glossary.md)"


def long_lines():
    """Checks that prose is wrapped at 120 characters. A row of a table, a link and code may be longer."""
    written_by_programs = {ROOT / "THIRD_PARTY_LICENSES.md", ROOT / "docs/verification.md"}
    for path in {path.resolve() for path in tracked("*.md")} - written_by_programs:
        code = False
        for number, line in enumerate(path.read_text().splitlines(), 1):
            code ^= line.lstrip().startswith("```")
            if len(line) > 120 and not (code or line.lstrip().startswith(("|", "!", "[")) or line.startswith("    ")):
                yield f"{path}:{number}: {len(line)} characters, at most 120"


# Text that gives the unit of a number, or the absence of one.
UNIT = re.compile(
    r"\b(?:m|mm|s|ns|us|ms|µs|N|J|W|kg|rad|Hz|m/s|bytes|frames|pixels?|degrees|quaternion|order|coefficient|fractions?|ratio|relative|weight|unit"
    r" vector)\b|N·|·s|1/s|m/s|m²|m³|%|°|[Uu]nit\b|`unit`|metres|0…1|Coefficient|Ratio|Fraction|Relative|Weight",
)
NUMBER = re.compile(r"^\s*pub \w+: (?:Option<)?(?:f64|f32|Vec3|Duration|\[f(?:64|32); ?\w+\])>?,")


def documentation(lines, number):
    """The doc comment directly above a line."""
    first = number
    while first > 0 and lines[first - 1].lstrip().startswith(("///", "#[")):
        first -= 1
    return "\n".join(line for line in lines[first:number] if line.lstrip().startswith("///"))


def units():
    """Checks that every public number has a unit in its comment, or in that of its type."""
    for path in tracked("crates/*/src/*.rs"):
        lines = path.read_text().splitlines()
        of_type = ""
        for number, line in enumerate(lines):
            if re.match(r"\s*(?:pub(?:\(\w+\))? )?struct ", line):
                of_type = documentation(lines, number)
            if NUMBER.match(line) and not UNIT.search(of_type) and not UNIT.search(documentation(lines, number)):
                yield f"{path}:{number + 1}: say the unit of `{line.strip()}`, or that it has none"


# Structs whose vectors need no frame in their names (docs/glossary.md, Motion and frames).
IN_THE_COMMON_FRAME = {"Contact", "ContactSide", "NearestPrimitive"}
FRAME_STANDS_IN_THE_NAME_OF_THE_VALUE = {"Pose", "Transform", "Twist", "Wrench"}
CONSTANTS_OF_A_PRIMITIVE = {"TriangleView", "PreparedEllipsoid", "Shadow", "Wedge"}
VECTOR = re.compile(r"^    pub(?:\(\w+\))? (\w+): [&'a-z (\[]*(?:Option<|Cell<|Vec<)*Vec3\b")
STRUCT = re.compile(r"^(?:pub(?:\(\w+\))? )?(?:struct|enum) (\w+)")


def frames_of_vectors():
    """Checks that the name of a vector computed in contact contains its axes: `normal_b`."""
    exempt = IN_THE_COMMON_FRAME | FRAME_STANDS_IN_THE_NAME_OF_THE_VALUE | CONSTANTS_OF_A_PRIMITIVE
    for path in tracked("crates/pong-engine/src/*.rs", "crates/pong-geometry/src/*.rs"):
        if path.relative_to(ROOT).parts[1:4] in {("pong-geometry", "src", "primitive"), ("pong-geometry", "src", "bounding")}:
            continue  # constants in the frame of their own group
        of_struct = ""
        for number, line in enumerate(path.read_text().splitlines(), 1):
            of_struct = (STRUCT.match(line) or [None, of_struct])[1]
            field = VECTOR.match(line)
            if field and of_struct not in exempt and not re.search(r"_[abw]$", field[1]):
                yield f"{path}:{number}: `{field[1]}` of {of_struct} does not say its frame: `{field[1]}_b`? (docs/glossary.md)"


def circles_of_files():
    yield from circles.check(ROOT)


def doc_comments():
    yield from openings.check(ROOT)


def counts_of_credibility():
    yield from credibility.check(ROOT)


def main():
    checks = (
        arrows, circles_of_files, unsafe_code, platform_mathematics, file_lengths, dead_links, theory_citations, retired_words,
        long_lines, units, frames_of_vectors, doc_comments, counts_of_credibility,
    )
    problems = [problem for check in checks for problem in check()]
    for problem in problems:
        print(problem.replace(str(ROOT) + "/", ""))
    sys.exit(1 if problems else 0)


main()

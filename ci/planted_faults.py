"""Plants the faults of ci/planted/ one by one in a copy of the repository and shows that a test catches each.

An entry says what it `breaks`, and the text `before`, which must stand exactly once in `file`, and `after`. `caught_by` is
crate, test program (`lib` for unit tests, `it` for the integration tests) and test with its modules.

A fault is caught when its test passes without it, still builds with it, and then fails by an assertion of its own: not by a
build error, not by an index out of bounds, not by taking too long.
"""

import os
import pathlib
import re
import signal
import subprocess
import sys
import time
import tomllib

from copied_tree import ROOT, copy_tree

LISTS = ROOT / "ci" / "planted"
TARGET = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")) / "planted_faults"
TREE = TARGET / "tree"
# Little optimisation and no symbols: building takes most of the time. The answers are the same bits.
ENVIRONMENT = os.environ | {
    "CARGO_TARGET_DIR": str(TARGET / "build"),
    "CARGO_PROFILE_DEV_OPT_LEVEL": "1",
    "CARGO_PROFILE_DEV_DEBUG": "0",
    "CARGO_INCREMENTAL": "1",
    "CARGO_TERM_COLOR": "never",
    "RUST_BACKTRACE": "0",
    # As many samples as there are: a fault may show in few of them.
    "PONG_TESTS": "night",
}
SECONDS_MAX = 300
# Output of a test that fails without judging.
STUMBLES = re.compile(r"called `|index out of bounds|attempt to |range end|range start|mid > len|already borrowed")
PANIC = re.compile(r"panicked at ([^\s:]+):\d+:\d+:\n(.*(?:\n.+)*)")


class Fault:
    def __init__(self, entry):
        self.name, self.breaks, self.file = entry["name"], entry["breaks"], entry["file"]
        self.before, self.after = entry["before"], entry["after"]
        self.crate, self.binary, self.test = entry["caught_by"].split()

    def select(self):
        """Cargo's selection arguments."""
        return ["-p", self.crate, *(["--lib"] if self.binary == "lib" else ["--test", self.binary])]

    def problems(self):
        """Reason why it cannot be planted or caught, if any."""
        text = (ROOT / self.file).read_text() if (ROOT / self.file).is_file() else ""
        if text.count(self.before) != 1:
            yield f"{self.name}: the text before is {text.count(self.before)} times in {self.file}, not once"
        if self.before == self.after:
            yield f"{self.name}: nothing changes"
        if not self.has_test():
            yield f"{self.name}: {self.crate} has no test {self.test} in {self.binary}"

    def has_test(self):
        *modules, function = self.test.split("::")
        folder = ROOT / "crates" / self.crate / ("src" if self.binary == "lib" else f"tests/{self.binary}")
        if self.binary == "lib":
            files = folder.rglob("*.rs")
        elif not folder.is_dir():
            files = [folder.with_suffix(".rs")]
        elif modules:
            # The first module is a file or a folder of the program.
            module = modules.pop(0)
            files = [folder / f"{module}.rs", folder / module / "mod.rs"]
        else:
            files = [folder / "main.rs"]
        # A test in a module of the file is indented.
        indent = "^ *" if modules else "^"
        # Declared as a test, or by a macro for a case.
        test = re.compile(
            rf"{indent}#\[test\]\s+(?:#\[.*\]\s+)*fn {function}\(|^    {function} => ", re.MULTILINE
        )
        return any(test.search(path.read_text()) for path in files if path.is_file())

    def plant(self):
        path = TREE / self.file
        path.write_text(path.read_text().replace(self.before, self.after))

    def heal(self):
        (TREE / self.file).write_text((ROOT / self.file).read_text())


def read_list():
    lists = [tomllib.loads(path.read_text()) for path in sorted(LISTS.glob("*.toml"))]
    faults = [Fault(entry) for entries in lists for entry in entries["fault"]]
    problems = [problem for fault in faults for problem in fault.problems()]
    names = [fault.name for fault in faults]
    problems += [f"{name}: twice in the list" for name in {name for name in names if names.count(name) > 1}]
    if problems:
        sys.exit("\n".join(problems))
    return faults


def cargo(arguments, timeout=None):
    """Output of cargo. A run that takes too long is ended with all of its child processes."""
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True, "errors": "replace"}
    command = ["cargo", "test", *arguments]
    with subprocess.Popen(command, cwd=TREE, env=ENVIRONMENT, start_new_session=True, **pipes) as started:
        try:
            out, err = started.communicate(timeout=timeout)
        except subprocess.TimeoutExpired:
            os.killpg(started.pid, signal.SIGKILL)
            raise
    return subprocess.CompletedProcess(command, started.returncode, out, err)


def run_clean(faults):
    """Runs all named tests, one binary after the other, without any fault."""
    for select in dict.fromkeys(tuple(fault.select()) for fault in faults):
        tests = sorted({fault.test for fault in faults if tuple(fault.select()) == select})
        print(f"without a fault: {' '.join(select)}, {len(tests)} tests", flush=True)
        done = cargo([*select, "--", "--exact", *tests], timeout=20 * SECONDS_MAX)
        if done.returncode != 0 or f"test result: ok. {len(tests)} passed" not in done.stdout:
            sys.exit(f"{done.stdout}{done.stderr}\nthe tests do not pass without a fault")


def judge(fault):
    """(caught, result, seconds of building, seconds of the test)."""
    started = time.monotonic()
    built = cargo([*fault.select(), "--no-run"])
    building = time.monotonic() - started
    if built.returncode != 0:
        error = re.search(r"^error.*", built.stderr, re.MULTILINE)
        return False, f"does not build: {error[0] if error else built.stderr[-200:]}", building, 0.0
    started = time.monotonic()
    try:
        done = cargo([*fault.select(), "--", "--exact", fault.test], timeout=SECONDS_MAX)
    except subprocess.TimeoutExpired:
        return False, "took too long", building, time.monotonic() - started
    seconds = time.monotonic() - started
    return *read_verdict(fault, done), building, seconds


def read_verdict(fault, done):
    output = done.stdout + done.stderr
    if done.returncode == 0:
        return False, "not seen"
    if f"test {fault.test} ... FAILED" not in output:
        return False, f"did not end as a test: {output[-300:]}"
    panic = PANIC.search(output)
    place, message = (panic[1], " ".join(panic[2].split("\nnote: ")[0].split())) if panic else ("", output[-300:])
    # An assertion of the code itself counts as well.
    is_own = "/tests/" in place or place.startswith("crates/") and (fault.binary == "lib" or message.startswith("assertion"))
    if not is_own or STUMBLES.match(message):
        return False, f"stumbled at {place}: {message}"
    return True, message


def plant_all(faults):
    started = time.monotonic()
    copy_tree(TREE)
    run_clean(faults)
    missed = []
    print(f"\n{'fault':<40} {'build':>6} {'test':>6}  what the test said")
    # Faults of one binary one after the other, so that only that one is rebuilt.
    for fault in sorted(faults, key=Fault.select):
        fault.plant()
        caught, said, building, seconds = judge(fault)
        fault.heal()
        print(f"{fault.name:<40} {building:5.0f}s {seconds:5.1f}s  {'' if caught else 'MISSED: '}{said[:150]}", flush=True)
        if not caught:
            missed.append(fault.name)
    print(f"\n{len(faults) - len(missed)} of {len(faults)} caught in {(time.monotonic() - started) / 60:.0f} minutes")
    if missed:
        sys.exit(f"missed: {' '.join(missed)}")


def main(arguments):
    faults = read_list()
    if not arguments:
        print(f"{len(faults)} faults can be planted, {len({fault.test for fault in faults})} tests exist")
        return
    if arguments != ["--all"]:
        unknown = set(arguments) - {fault.name for fault in faults}
        if unknown:
            sys.exit(f"no such fault: {' '.join(sorted(unknown))}")
        faults = [fault for fault in faults if fault.name in arguments]
    plant_all(faults)


main(sys.argv[1:])

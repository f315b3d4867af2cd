#!/usr/bin/env python3
"""Hands a mechanism over to its C program (hosts/mujoco/realtime), or compares the two.

    python3 mechanisms/from_c.py NAME --write FOLDER
    python3 mechanisms/from_c.py NAME --compare PROGRAM

FOLDER gets machine.xml, the contact models and numbers.txt: what the mechanism's `in_c.py` tells of its sequence. The
comparison runs PROGRAM as fast as it goes and the same in Python: the outcome must be as predicted, and positions and
velocities at the end the same bits. Needs what mechanisms/run.py needs.
"""

import argparse
import pathlib
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

HERE = pathlib.Path(__file__).resolve().parent
AS_PREDICTED, UNFINISHED = 0, 4  # exit codes of the programs
PACED = "1.0"  # s by the clock, to see deadlines


def write(folder, machine, rows):
    """`rows`: lists of words and numbers, a name first."""
    folder.mkdir(parents=True, exist_ok=True)
    tree = xml.fromstring(machine.text)
    for instance in tree.iterfind(".//instance"):
        _bring_models(folder, {config.get("key"): config for config in instance.iterfind("config")})
    (folder / "machine.xml").write_text(xml.tostring(tree, encoding="unicode"), encoding="utf-8")
    rows = [["qvel", *machine.data.qvel], *rows]
    text = "\n".join(" ".join(map(_word, row)) for row in rows)
    (folder / "numbers.txt").write_text(text + "\n", encoding="utf-8")


def _word(value):
    return value if isinstance(value, str) else repr(float(value))


def _bring_models(folder, keys):
    """Copies the model files, and names them as they are seen from the folder."""
    source = pathlib.Path(keys["dir"].get("value")) if "dir" in keys else pathlib.Path()
    objects = [entry.split("=") for entry in keys["objects"].get("value").split(";")]
    named = [(name.strip(), model.strip()) for name, model in objects]
    for _, model in named:
        if model not in keys:
            shutil.copyfile(source / model, folder / pathlib.Path(model).name)
    entries = [f"{name} = {model if model in keys else pathlib.Path(model).name}" for name, model in named]
    keys["objects"].set("value", "; ".join(entries))
    if "dir" in keys:
        keys["dir"].set("value", ".")


def compare(program, in_c):
    """Returns the differences, or nothing."""
    with tempfile.TemporaryDirectory() as made:
        folder = pathlib.Path(made)
        machine = in_c.machine()
        write(folder, machine, in_c.rows(machine))
        code = subprocess.run([program, folder, "--fast", "--end", "end"], check=False).returncode
        if code != AS_PREDICTED:
            return f"exit code {code}"
        in_c.run(machine)
        here = machine.data.qpos.tobytes() + machine.data.qvel.tobytes()
        if here != (folder / "end").read_bytes():
            return "positions and velocities at the end have other bits"
        code = subprocess.run([program, folder, "--seconds", PACED, "--lock", "--fifo", "10"], check=False).returncode
        return "" if code == UNFINISHED else f"by the clock: exit code {code}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("name", choices=sorted(path.parent.name for path in HERE.glob("*/in_c.py")))
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("--write", type=pathlib.Path, metavar="FOLDER")
    what.add_argument("--compare", type=pathlib.Path, metavar="PROGRAM")
    given = parser.parse_args()
    sys.path[:0] = [str(HERE / given.name), str(HERE)]
    import in_c

    if given.write:
        machine = in_c.machine()
        write(given.write, machine, in_c.rows(machine))
        return
    wrong = compare(given.compare.resolve(), in_c)
    if wrong:
        sys.exit(f"{given.name} in C: {wrong}")
    print(f"{given.name}: C and Python come to the same bits")


if __name__ == "__main__":
    main()

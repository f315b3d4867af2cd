"""Makes a program of an S_define, its headers and an input file: a small stand-in for Trick's own generators.

    generate.py S_define models include... > sim.cpp      the simulation
    generate.py --input input.py                          the commands of an input file, for the standard input of sim

Trick's interface code generator reads units and permissions from the comment behind each member; so does this one, and
it refuses a member without them.
"""

import pathlib
import re
import sys

KIND = r"(unsigned int|unsigned char|[A-Za-z_][\w:]*)"
MEMBER = re.compile(rf"^\s+{KIND}\s*(\*?)\s*(\w+)((?:\[\w+\])*);\s*/\*\s*(.*?)\s*\*/$")
COMMENT = re.compile(r"^(?P<io>\*\*|\*i|\*o|\*io)?\s*\((?P<unit>[^()]+)\)")
NUMBERS = {"double", "int", "unsigned int", "unsigned char", "std::string", "Regula_Falsi"}
JOB = re.compile(r'^\s*\("(\w+)"\)\s*(?:trick_ret\s*=\s*)?(.*?)\s*;\s*$')


def fail(path, number, text):
    sys.exit(f"{path}:{number}: {text}")


def classes(path):
    """Name and members (type, star, name, dimensions) of each class of a header; members that are `**` are left out."""
    found, name, members, hidden = {}, None, [], False
    for number, line in enumerate(path.read_text().splitlines(), 1):
        begin = re.match(r"^(?:typedef struct|class)\s+(\w+)\s*\{$", line)
        if begin:
            name, members, hidden = begin[1], [], False
        elif name and line.startswith("}"):
            found[name], name = members, None
        elif name and re.match(r"^  ?(public|private|protected):", line):
            hidden = "public" not in line
        elif name and ";" in line and "(" not in line.split("/*")[0] and not line.strip().startswith("/*"):
            member = MEMBER.match(line)
            comment = member and COMMENT.match(member[5])
            if not comment:
                fail(path, number, "a member needs a comment behind it in one line: /* [**] (unit) text */")
            if not hidden and comment["io"] != "**":
                members.append(member.groups()[:4])
    return found


def s_define(path):
    """The C++ that trick-CP would make of it."""
    text = re.sub(r"/\*.*?\*/", "", path.read_text(), flags=re.S)
    out = []
    for line in text.splitlines():
        job = JOB.match(line)
        loop = re.match(r"^IntegLoop\s+(\w+)\s*\(([^)]*)\)\s*(\w+)\s*;", line)
        objects = re.match(r"^(\w+SimObject)\s+(\w+)\s*;", line)
        if job:
            counts = job[1] == "dynamic_event" or "trick_ret" in line
            body = f"return {job[2]};" if counts else f"{job[2]}; return 0.0;"
            out.append(f'        job("{job[1]}", [this]() -> double {{ {body} }});')
        elif loop:
            out.append(f"Trick::IntegLoop {loop[1]}({loop[2]}, {loop[3]});")
        elif objects:
            out.append(f"{line}")
        elif line.startswith("##include"):
            out.append(line[1:])
        elif not line.startswith("#"):
            out.append(line)
    names = re.findall(r"^(\w+SimObject)\s+(\w+)\s*;", text, re.M)
    members = re.findall(r"^    (\w+) (\w+);$", text, re.M)
    return "\n".join(out), names, members


def simulation(define, headers):
    tables, known = {}, set(NUMBERS)
    for header in headers:
        tables.update(classes(pathlib.Path(header)))
    code, objects, members = s_define(pathlib.Path(define))
    print("// Made by generate.py; do not edit.")
    print('#include "standin.hh"')
    print(code)
    print(EACH_BEGINS)
    for name in tables:
        print(f"template <class Visitor> void each(Visitor &v, const std::string &name, {name} &x);")
    print(EACH_OF_AN_ARRAY)
    known.update(tables)
    for name, fields in tables.items():
        print(f"template <class Visitor> void each(Visitor &v, const std::string &name, {name} &x) {{")
        for kind, star, field, _ in fields:
            if kind not in known:
                sys.exit(f"{name}::{field}: no table for the type {kind}")
            call = "v.allocated" if star else "each"
            print(f'    {call}({"" if star else "v, "}name + ".{field}", x.{field});')
        print("}")
    # Trick's Python interface assigns members as a whole.
    for name in tables:
        print(f"void assigned({name} &to, const {name} &from) {{ to = from; }}")
    print("template <class Visitor> void everything(Visitor &v) {")
    for kind, name in objects:
        for member_kind, member in members:
            if member_kind in tables:
                print(f'    each(v, "{name}.{member}", {name}.{member});')
    print("}")
    print('#include "standin_main.hh"')


EACH_BEGINS = """
template <class Visitor, class T> void each(Visitor &v, const std::string &name, T &number) { v.number(name, number); }
template <class Visitor, class T, size_t N> void each(Visitor &v, const std::string &name, T (&all)[N]);"""
EACH_OF_AN_ARRAY = """
template <class Visitor, class T, size_t N> void each(Visitor &v, const std::string &name, T (&all)[N]) {
    for (size_t i = 0; i < N; i++) each(v, name + "[" + std::to_string(i) + "]", all[i]);
}"""


class Recorder:
    """Stands for an object of the simulation: what an input file assigns becomes a command."""

    def __init__(self, path):
        object.__setattr__(self, "path", path)

    def __getattr__(self, name):
        return Recorder(f"{self.path}.{name}")

    def __setattr__(self, name, value):
        if name == "thisown":
            return
        if isinstance(value, list):
            for index, item in enumerate(value):
                print(f"set {self.path}.{name}[{index}] {item!r}")
        else:
            print(f"set {self.path}.{name} {value}")

    def __call__(self, *arguments):
        print(" ".join([self.path, *map(str, arguments)]))
        return Recorder(arguments[0] if self.path == "trick.DRAscii" else self.path)


def main():
    if sys.argv[1] == "--input":
        source = pathlib.Path(sys.argv[2]).read_text()
        exec(compile(source, sys.argv[2], "exec"), {"trick": Recorder("trick"), "dyn": Recorder("dyn")})
    else:
        simulation(sys.argv[1], sys.argv[2:])


main()

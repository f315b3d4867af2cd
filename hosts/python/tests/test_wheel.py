"""The wheel: one for every CPython from 3.10 on, typed, with its licences; and what is said where it does not fit."""

import base64
import hashlib
import importlib
import os
import pathlib
import shutil
import subprocess
import sys
import zipfile

import pong
import pytest

pytest.importorskip("zlib", reason="this Python was made without zlib, and cannot read wheels")
sys.path.insert(0, os.path.join(os.environ["REPOSITORY"], "hosts/python"))
import check_wheel  # noqa: E402


def test_the_wheel_has_what_it_must():
    wheel = os.environ["WHEEL"]
    assert "-cp310-abi3-" in wheel and f"pong-{pong.__version__}-" in wheel
    names = zipfile.ZipFile(wheel).namelist()
    library = "_pong.pyd" if sys.platform == "win32" else "_pong.abi3.so"
    for file in (f"pong/{library}", "pong/_pong.pyi", "pong/py.typed"):
        assert file in names
    # Every module of the tree, those of campaigns among them; and what the tests import is what was installed.
    modules = pathlib.Path(os.environ["REPOSITORY"]) / "hosts/python/python"
    written = {file.relative_to(modules).as_posix() for file in modules.rglob("*.py")}
    assert written <= set(names), written - set(names)
    assert "pong/campaign/__init__.py" in written and "pong/campaign/plots.py" in written
    assert modules not in pathlib.Path(importlib.import_module("pong.campaign").__file__).parents
    assert any(name.endswith("licenses/LICENSE") for name in names)
    assert any(name.endswith("licenses/THIRD_PARTY_LICENSES.md") for name in names)
    assert not any("test" in name for name in names)


def test_the_version_is_that_of_the_engine():
    root = os.environ["REPOSITORY"]
    workspace = open(os.path.join(root, "Cargo.toml"), encoding="utf-8").read()
    assert f'version = "{pong.__version__}"' in workspace


def test_every_public_name_is_documented():
    for name in pong.__all__:
        thing = getattr(pong, name)
        if callable(thing):
            assert thing.__doc__, name


def retagged(folder, tag, edit=None):
    """The wheel under another platform tag, which its WHEEL and RECORD repeat; `edit` changes files before that."""
    with zipfile.ZipFile(os.environ["WHEEL"]) as content:
        files = {name: content.read(name) for name in content.namelist() if not name.endswith("/")}
    info = next(name for name in files if name.endswith("/WHEEL"))
    files[info] = b"\n".join(b"Tag: cp310-abi3-" + tag.encode() if line.startswith(b"Tag:") else line for line in files[info].split(b"\n"))
    record = info.replace("WHEEL", "RECORD")
    lines = []
    for name, content in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        lines.append(f"{name},," if name == record else f"{name},sha256={digest},{len(content)}")
    files[record] = "\n".join(lines).encode()
    (edit or (lambda _: None))(files)
    path = pathlib.Path(folder) / f"pong-{pong.__version__}-cp310-abi3-{tag}.whl"
    with zipfile.ZipFile(path, "w") as out:
        for name, content in files.items():
            out.writestr(name, content)
    return path


@pytest.mark.skipif(sys.platform != "linux", reason="the wheel is for Linux")
def test_a_wheel_that_is_not_what_its_name_says_is_refused(tmp_path):
    own = os.uname().machine
    other = {"x86_64": "aarch64"}.get(own, "x86_64")
    assert f"linux {own}" in check_wheel.check(retagged(tmp_path, f"manylinux_2_99_{own}"))
    for tag, cause in (
        (f"manylinux_2_99_{other}", f"is for linux on {own}, the tag says linux on {other}"),
        (f"manylinux_2_5_{own}", "the tag promises 2.5"),
        (f"musllinux_1_2_{own}", "needs glibc, the tag says musl"),
        ("win_amd64", "pong/_pong.pyd"),
        (f"linux_{own}", "no platform tag of a wheel that is published"),
    ):
        with pytest.raises(check_wheel.Unfit, match=cause):
            check_wheel.check(retagged(tmp_path, tag))
    for edit, cause in (
        (lambda files: files.update({"pong/py.typed": b"changed"}), "py.typed is not the file of RECORD"),
        (lambda files: files.update({"pong/stray.txt": b""}), "stray.txt"),
    ):
        with pytest.raises(check_wheel.Unfit, match=cause):
            check_wheel.check(retagged(tmp_path, f"manylinux_2_99_{own}", edit))


@pytest.mark.skipif(sys.platform != "linux", reason="it changes the header of an ELF file")
def test_a_library_of_another_platform_is_told_with_cause_and_cure(tmp_path):
    package = tmp_path / "pong"
    shutil.copytree(pathlib.Path(pong.__file__).parent, package)
    library = next(package.glob("_pong.*so"))
    content = bytearray(library.read_bytes())

    def told():
        program = "import sys; sys.path.insert(0, sys.argv[1]); import pong"
        done = subprocess.run([sys.executable, "-c", program, str(tmp_path)], capture_output=True, text=True)
        return done.stderr.splitlines()[-1]

    content[18] ^= 0xFF  # the processor in the header of the file
    library.write_bytes(content)
    for word in ("ImportError: pong cannot be imported", f"has {library.name}, which cpython", "install the wheel for this platform"):
        assert word in told()
    library.rename(package / "_pong.pyd")
    assert "has _pong.pyd, which cpython" in told()


@pytest.mark.skipif(sys.platform != "linux", reason="the wheel is for Linux")
def test_pip_refuses_what_does_not_fit(tmp_path):
    fits, own = os.environ["WHEEL"], f"linux_{os.uname().machine}"
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-deps", "--only-binary", ":all:", "--target", str(tmp_path / "site")]
    for wheel, version, platform in ((fits, "3.9", own), (retagged(tmp_path, "win_amd64"), "3.11", own), (fits, "3.11", "win_amd64")):
        done = subprocess.run([*pip, "--python-version", version, "--platform", platform, str(wheel)], capture_output=True, text=True)
        assert done.returncode != 0 and f"{pathlib.Path(wheel).name} is not a supported wheel on this platform" in done.stderr
    assert not (tmp_path / "site").exists()

"""The wheel: one for every CPython from 3.10 on, typed, with its licences."""

import importlib
import os
import pathlib
import zipfile

import pong


def test_the_wheel_has_what_it_must():
    wheel = os.environ["WHEEL"]
    assert "-cp310-abi3-" in wheel and f"pong-{pong.__version__}-" in wheel
    names = zipfile.ZipFile(wheel).namelist()
    for file in ("pong/_pong.abi3.so", "pong/_pong.pyi", "pong/py.typed"):
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

"""Docstrings are NumPy-style: they name every parameter and what a call returns, and their examples run."""

import doctest
import inspect
import re
import types

import pytest

import pong
import pong.campaign
import pong.campaign.plots
import pong.model
from support import BALL, GROUND, world

PLACES = (pong, pong.model, pong.campaign, pong.campaign.plots)
DESCRIPTORS = (property, types.GetSetDescriptorType, types.MemberDescriptorType)


def public():
    """Name and value of every public class, function, method and property."""
    for place in PLACES:
        own = [name for name, thing in vars(place).items() if inspect.isfunction(thing) and thing.__module__ == place.__name__]
        names = getattr(place, "__all__", [name for name in own if not name.startswith("_")])
        for name in names:
            thing = getattr(place, name)
            if not callable(thing) or name == "Status":
                continue
            yield f"{place.__name__}.{name}", thing
            if inspect.isclass(thing):
                for member, value in vars(thing).items():
                    field = member in getattr(thing, "__dataclass_fields__", ())
                    if not (member.startswith("_") or field or isinstance(value, str)):
                        yield f"{place.__name__}.{name}.{member}", value if isinstance(value, DESCRIPTORS) else getattr(thing, member)


PUBLIC = dict(public())


def named(text, section):
    """Names in a section of a docstring."""
    found = re.search(rf"^{section}\n-+\n(.*?)(?=^\w[^\n]*\n---|\Z)", text, re.M | re.S)
    lines = found[1].splitlines() if found else []
    return [name for line in lines if line[:1].strip() for name in line.partition(" : ")[0].split(", ")]


@pytest.mark.parametrize("name", PUBLIC)
def test_docstrings_name_every_parameter(name):
    thing = PUBLIC[name]
    text = inspect.getdoc(thing)
    assert text, f"{name} has no docstring"
    if isinstance(thing, DESCRIPTORS):
        assert re.match(r"\S[^:]* : \S", text), f"{name}: begin with the type, `float : Time, s.`"
        return
    if inspect.isclass(thing) and issubclass(thing, Exception):
        return
    try:
        signature = inspect.signature(thing)
    except ValueError:
        return  # a class that only the library makes
    parameters = [argument for argument in signature.parameters if argument != "self"]
    # Results document their fields, and are made by the library alone.
    given = named(text, "Parameters") or (named(text, "Attributes") if inspect.isclass(thing) else [])
    assert sorted(given) == sorted(parameters), name


@pytest.mark.parametrize("name", [name for name, thing in PUBLIC.items() if ">>>" in (inspect.getdoc(thing) or "")])
def test_examples_of_docstrings_run(name, tmp_path, monkeypatch):
    (tmp_path / "ball.ron").write_text(BALL)
    (tmp_path / "ground.ron").write_text(GROUND)
    monkeypatch.chdir(tmp_path)
    names = {"pong": pong, "world": world()}
    test = doctest.DocTestParser().get_doctest(inspect.getdoc(PUBLIC[name]), names, name, None, 0)
    assert doctest.DocTestRunner().run(test).failed == 0


def test_names_that_moved_to_types_warn():
    for name in pong.types.__all__:
        assert name not in pong.__all__
        with pytest.warns(DeprecationWarning, match=f"pong.types.{name} now"):
            assert getattr(pong, name) is getattr(pong.types, name)
        assert getattr(pong.types, name).__module__ == "pong.types"
    with pytest.raises(AttributeError, match="no attribute `?'?Nothing"):
        pong.Nothing

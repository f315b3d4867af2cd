"""The examples of docs/python.md behave as the page says."""

import os
import pathlib
import re

import pong

ROOT = pathlib.Path(os.environ["REPOSITORY"])
PAGE = (ROOT / "docs/python.md").read_text(encoding="utf-8")


def test_the_programs_of_the_page_run(capsys):
    names = {}
    for program in re.findall(r"```python\n(.*?)```", PAGE, re.S):
        exec(compile(program, "docs/python.md", "exec"), names)
    told = capsys.readouterr().out
    assert abs(names["wrenches"][0, 2] - 20.0) < 1e-9
    for line in ("highest force", "touch at 0.143 s: ball/ball/shell", "V2", "passes", "5 the radius must be above zero"):
        assert line in told, told
    assert "FAILS" not in told


def test_every_call_and_exception_is_on_the_page():
    for kind in (pong.WorldBuilder, pong.World):
        for name in vars(kind):
            if not name.startswith("_"):
                assert re.search(rf"\b{name}\b", PAGE), f"{kind.__name__}.{name}"
    for name in pong.__all__:
        if name.endswith("Error"):
            assert f"`{name}`" in PAGE or name == "PongError", name

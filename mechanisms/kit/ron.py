"""Contact models as text on one line, as the plugin's key `text1` requires. `pong.model.write` writes them."""

import math

from pong import model as models


def elastic(stiffness, damping, friction=0.0, friction_damping=None):
    """A surface of N/m and N·s/m, with bristle friction unless that is zero."""
    return {"stiffness": stiffness, "normal": {"Linear": {"damping": damping}}, **_friction(friction, friction_damping)}


def rigid(friction=0.0):
    """A rigid surface, with the stiffness of the pair's other surface."""
    return {"stiffness": math.inf, **_friction(friction)}


def _friction(friction, damping=None):
    return {"friction": {"Bristle": {"mu": friction, "damping": damping}}} if friction else {}


def primitive(kind, name, **fields):
    """A primitive with the fields of the model format; vectors are tuples."""
    lists = {key: list(fields[key]) for key in ("vertices", "faces") if key in fields}
    return {kind: {"name": name, **fields, **lists}}


def model(name, surface, primitives=(), groups=()):
    """A model with one surface for all. `groups`: (name, primitives) of movable groups below the root."""
    movable = [{"name": name, "movable": True, "primitives": list(parts)} for name, parts in groups]
    inside = {"groups": movable} if movable else {"primitives": list(primitives)}
    root = {"name": name, "surface": "steel", **inside}
    return models.write({"name": name, "surfaces": {"steel": surface}, "root": root}, one_line=True)

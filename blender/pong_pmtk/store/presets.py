# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets of surfaces: those of the toolkit, and those stored in the .blend file for all its scenes.

The latter are a text of the file (Text Editor: "pong_presets.json"), so they can be read, edited and appended to other
files, and they stay there when the toolkit is not installed.

Standard materials. Friction is that of the material on itself, dry: Marks' Standard Handbook for Mechanical Engineers,
10th ed., table 3.2.1 (static and sliding). Stiffness follows from Young's modulus E and Poisson's ratio ν, usual values
of engineering, by Hertz: a ball of radius 10 mm on a rigid flat, secant at a load of 100 N,

    K = 4/3·E/(1 − ν²)·√R,   δ = (F/K)^(2/3),   k = F/δ

It is a beginning, not a property of the material: the shape of the contact decides, and so does the step of the host.

Rebound is no property of a material either: it depends on the bodies, their shape and their speed. So that nothing bounces
for ever, every preset begins with the same restitution, 0.5, for a mass of 1 kg that one contact stops. The panel shows
both numbers; the author puts those of the bodies in their place.
"""

import json

import bpy

TEXT_NAME = "pong_presets.json"
RADIUS_M = 0.01
LOAD_N = 100.0
RESTITUTION = {"e": 0.5, "mass": 1.0}
SOURCE = (
    "Friction on itself, dry, {static:g} static, {sliding:g} sliding: Marks' Handbook, 10th ed., table 3.2.1. "
    "Stiffness of a 10 mm ball at 100 N by Hertz, E {e:g} GPa, ν {nu:g}. Restitution {rebound:g} at a mass of {mass:g} kg is "
    "a beginning and no property of the material: give the mass that one contact stops, and your restitution"
)

# name -> (E, GPa; ν; static and sliding friction on itself, dry)
MATERIALS = {
    "steel_hard": (207.0, 0.29, 0.78, 0.42),
    "steel_mild": (207.0, 0.29, 0.74, 0.57),
    "cast_iron": (100.0, 0.21, 1.10, 0.15),
    "nickel": (207.0, 0.31, 1.10, 0.53),
    "glass": (69.0, 0.24, 0.94, 0.40),
    "ptfe": (0.5, 0.46, 0.04, 0.04),
}


def hertz_secant(young_pa, poisson):
    """Stiffness of a sphere on a rigid flat at the load above, N/m."""
    hertz = 4.0 / 3.0 * young_pa / (1.0 - poisson**2) * RADIUS_M**0.5
    return LOAD_N / (LOAD_N / hertz) ** (2.0 / 3.0)


def _standard(young_gpa, poisson, static, sliding):
    stiffness = float(f"{hertz_secant(young_gpa * 1e9, poisson):.2g}")
    excess = float(f"{static / sliding - 1.0:.3g}")
    friction = {"mu": sliding} | ({"static_excess": excess} if excess else {})
    return {"stiffness": stiffness, "normal": {"Linear": {"restitution": dict(RESTITUTION)}}, "friction": {"Bristle": friction}}


STANDARD = {
    name: {
        "fields": _standard(*values),
        "source": SOURCE.format(
            e=values[0], nu=values[1], static=values[2], sliding=values[3], rebound=RESTITUTION["e"], mass=RESTITUTION["mass"]),
    }
    for name, values in MATERIALS.items()
}


def _stored():
    text = bpy.data.texts.get(TEXT_NAME)
    return json.loads(text.as_string() or "{}") if text else {}


def _store(table):
    text = bpy.data.texts.get(TEXT_NAME) or bpy.data.texts.new(TEXT_NAME)
    text.use_fake_user = True
    text.from_string(json.dumps(table, indent=2, ensure_ascii=False) + "\n")


def all_presets():
    """name -> {"fields": ..., "source": ...}; the file's own come first."""
    return {**_stored(), **STANDARD}


def listing():
    return [(name, preset["source"]) for name, preset in all_presets().items()]


def fields_of(name):
    return all_presets()[name]["fields"]


def source_of(name):
    return all_presets()[name]["source"] or "no source given"


def save(name, fields, source=""):
    """Stores a preset in the .blend file."""
    if name in STANDARD:
        raise ValueError(f'"{name}" is the name of a standard material: choose another one')
    _store({**_stored(), name: {"fields": fields, "source": source}})


def remove(name):
    table = _stored()
    if name not in table:
        return False
    del table[name]
    _store(table)
    return True

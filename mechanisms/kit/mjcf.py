"""Pieces of MJCF text."""

import pathlib
import re

from kit import parameters


def numbers(values):
    return " ".join(f"{value:.12g}" for value in values)


def quaternion_about_z(angle):
    import math

    return (math.cos(angle / 2), 0.0, 0.0, math.sin(angle / 2))


def quaternion_of(attitude):
    """Quaternion of any rotation matrix, by its largest component."""
    import mujoco
    import numpy as np

    made = np.empty(4)
    mujoco.mju_mat2Quat(made, np.ascontiguousarray(attitude).ravel())
    return made


def motor(name, joint, stall, free_speed, gear=1.0):
    """A direct-current motor behind a gear: its control −1 to 1 is the voltage relative to the largest.

    At the joint the torque is stall·(control − speed/free_speed), never more than `stall`, N·m (N for a slide).
    """
    return (
        f'<general name="{name}" joint="{joint}" gear="{gear:.12g}" ctrllimited="true" ctrlrange="-1 1" gaintype="fixed" '
        f'gainprm="{stall:.12g}" biastype="affine" biasprm="0 0 {-stall / free_speed:.12g}" forcelimited="true" '
        f'forcerange="{-stall:.12g} {stall:.12g}"/>'
    )


def contact_instance(objects, pairs, bodies, texts=(), folder=None, capacity=64, friction=None):
    """An instance of the plugin. `objects`: name → model file or text1 … text4; `bodies`: group → body.

    `friction`: of all surfaces, in place of what the files say; there may be four files at most. Values of surfaces that
    a loads case replaces are in files written anew (kit/parameters.py).
    """
    if folder is not None:
        objects = parameters.with_surfaces(objects, folder)
    if friction is not None:
        files = list(dict.fromkeys(objects.values()))
        texts = [with_friction((pathlib.Path(folder) / file).read_text(encoding="utf-8"), friction) for file in files]
        objects = {name: f"text{1 + files.index(file)}" for name, file in objects.items()}
    keys = {
        "objects": "; ".join(f"{name} = {model}" for name, model in objects.items()),
        "pairs": "; ".join(f"{a}, {b}" for a, b in pairs),
        "bodies": "; ".join(f"{group} = {body}" for group, body in bodies.items()),
        "contact_capacity": capacity,
        "check_step": "false",
        **({"dir": folder} if folder else {}),
        **{f"text{i + 1}": text for i, text in enumerate(texts)},
    }
    inside = "".join(f"<config key='{key}' value='{value}'/>" for key, value in keys.items() if value != "")
    return (
        f'<extension><plugin plugin="pong.contact"><instance name="contact">{inside}</instance></plugin></extension>'
    )


def with_friction(text, friction):
    """Text of a contact model with this coefficient of friction for all of its surfaces."""
    changed, count = re.subn(r"\bmu: [-+.0-9e]+", f"mu: {friction:.12g}", text)
    if not count:
        raise ValueError("no surface of the model has friction")
    return changed


def model(name, extension, world, more="", step=1e-3, integrator="RK4", gravity=(0, 0, 0)):
    return f"""<mujoco model="{name}">
  <compiler angle="radian"/>
  <option timestep="{step:.12g}" integrator="{integrator}" gravity="{numbers(gravity)}"><flag contact="disable"/></option>
  <visual><headlight ambient="0.5 0.5 0.5" diffuse="0.7 0.7 0.7"/><global offwidth="1280" offheight="800"/></visual>
  <asset><texture type="skybox" builtin="gradient" rgb1="1 1 1" rgb2="0.75 0.8 0.85" width="64" height="384"/></asset>
  {extension}
  <worldbody>
    {world}
  </worldbody>
  {more}
  <sensor><plugin name="contact" instance="contact"/></sensor>
</mujoco>
"""

#!/usr/bin/env python3
"""Draws picture.png without a screen, and diagram.png: force of insertion and lean against depth.

MUJOCO_GL=egl python3 mechanisms/peg/picture.py        with the plugin as for mechanisms/run.py, and matplotlib
"""

import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

import matplotlib  # noqa: E402

matplotlib.use("agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import rig  # noqa: E402
import whitney  # noqa: E402

from kit import picture  # noqa: E402


def in_two_places():
    """View through the cut in the wall."""
    made = rig.machine(rig.CENTRES["far"], 5e-4)
    made.run(6.0, rig.feed, lambda m: rig.height(m) < -0.06)
    made.model.vis.scale.contactwidth, made.model.vis.scale.forcewidth = 0.004, 0.003
    ahead = rig.axes(made) @ np.array([0.0, 0.95, -0.3])
    azimuth = np.degrees(np.arctan2(ahead[1], ahead[0]))
    elevation = np.degrees(np.arcsin(ahead[2] / np.linalg.norm(ahead)))
    picture.take(made, HERE / "picture.png", made.place("hole"), 0.35, azimuth, elevation, force_scale=4e-4)


def run(centre):
    """Depth, force and tilt of an insertion."""
    made, rows = rig.machine(centre, 5e-4), []
    every = 20

    def watch(m):
        if round(m.time / m.step) % every == 0:
            rows.append((-rig.height(m) * 1e3, rig.resistance(m), rig.lean(m) * 1e3))
        return rig.height(m) < -0.09

    made.run(10.0, rig.feed, watch)
    return np.array(rows)


def diagram():
    figure, (forces, leans) = plt.subplots(2, 1, figsize=(7.5, 6), sharex=True, layout="constrained")
    for name, colour in (("near", "tab:blue"), ("far", "tab:red")):
        found, support = run(rig.CENTRES[name]), whitney.Support(rig.CENTRES[name])
        depths = np.linspace(-2.2, 90, 400)
        expected = np.array([whitney.insertion(support, -depth * 1e-3)[1:] for depth in depths])
        label = f"centre of compliance {support.centre * 1e3:.0f} mm above the tip"
        for axes, column, unit in ((forces, 1, 1.0), (leans, 2, 1e3)):
            axes.plot(found[:, 0], found[:, column], color=colour, lw=3, alpha=0.35, label=f"{label}, measured")
            axes.plot(depths, expected[:, column - 1] * unit, color=colour, lw=1, label=f"{label}, predicted")
    forces.set_ylabel("force of insertion, N")
    leans.set_ylabel("lean, mrad")
    leans.set_xlabel("depth of the tip below the end of the chamfer, mm")
    forces.legend(fontsize=8)
    figure.savefig(HERE / "diagram.png", dpi=110)


if __name__ == "__main__":
    in_two_places()
    diagram()

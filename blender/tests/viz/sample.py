# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes a small response log with known answers: a ball slides on a plane, turning; then it rolls away.

Times k/100 s, k = 0..100. The ball (radius 0.1 m) is at (0.5 t, 0, 0.1) from an origin far away, turned by 3 t rad about
y. It touches until t = 0.5: normal force 10 (1 + t) N upwards, friction 2 N backwards, slipping until t = 0.25.
"""

import json
from pathlib import Path

import numpy as np

ORIGIN = np.array([6.8e6, 0.0, 0.0])
STATES = [("position", "<f8", 3), ("orientation", "<f8", 4), ("linear_velocity", "<f8", 3), ("angular_velocity", "<f8", 3)]
WRENCHES = [("force", "<f8", 3), ("moment", "<f8", 3)]
FRAMES = [("frame", "<u8"), ("time", "<f8"), ("first_contact", "<u8"), ("contacts", "<u4"), ("flags", "<u4"),
          ("evaluate_ns", "<u8"), ("committed", "<u4"), ("commits_missed", "<u4")]
CONTACTS = [("frame", "<u8"), ("pair", "<u4"), ("primitive_a", "<u4"), ("primitive_b", "<u4"), ("element_a", "<u4"),
            ("element_b", "<u4"), ("feature_kind", "<u4"), ("feature_index", "<u4"), ("end", "<u4"), ("sticks", "<u4"),
            ("point", "<f8", 3), ("normal", "<f8", 3), ("depth", "<f8"), ("depth_rate", "<f8"), ("weight", "<f8"),
            ("normal_force", "<f8"), ("friction_force", "<f8", 3), ("slip_velocity", "<f8", 3), ("stored", "<f8")]

BALL = """(
    format: "pong-model", version: 1, name: "ball",
    surfaces: { "soft": (stiffness: 1e5) },
    root: (name: "ball", surface: "soft", primitives: [
        Sphere(name: "skin", center: (0.0, 0.0, 0.0), radius: 0.1),
        Point(name: "mark", position: (0.0, 0.0, 0.1)),
    ]),
)
"""
GROUND = """(
    format: "pong-model", version: 1, name: "ground",
    surfaces: { "rigid": (stiffness: inf) },
    root: (name: "ground", surface: "rigid", primitives: [
        Plane(name: "floor", normal: (0.0, 0.0, 1.0), offset: 0.0),
    ]),
)
"""


def write_log(folder: Path) -> Path:
    """The log described above."""
    for name, text in (("ball", BALL), ("ground", GROUND)):
        (folder / "models" / name).mkdir(parents=True)
        (folder / "models" / name / f"{name}.ron").write_text(text)
    t = np.arange(101) / 100.0
    touches = t <= 0.5
    np.save(folder / "states.npy", _states(t))
    np.save(folder / "wrenches.npy", np.zeros((101, 2), dtype=WRENCHES))
    np.save(folder / "frames.npy", _frames(t, touches))
    np.save(folder / "contacts.npy", _contacts(t[touches]))
    (folder / "run.json").write_text(json.dumps(_run()))
    return folder


def _states(t):
    states = np.zeros((len(t), 2), dtype=STATES)
    states["orientation"][:, :, 0] = 1.0
    states["position"][:] = ORIGIN
    states["position"][:, 0, 0] += 0.5 * t
    states["position"][:, 0, 2] += 0.1
    states["orientation"][:, 0, 0] = np.cos(1.5 * t)
    states["orientation"][:, 0, 2] = np.sin(1.5 * t)
    states["orientation"][50:, 0] *= -1.0  # the same rotations: playback must not spin
    return states


def _frames(t, touches):
    frames = np.zeros(len(t), dtype=FRAMES)
    frames["frame"], frames["time"], frames["contacts"] = np.arange(len(t)), t, touches
    frames["first_contact"] = np.concatenate([[0], np.cumsum(touches)[:-1]])
    return frames


def _contacts(t):
    contacts = np.zeros(len(t), dtype=CONTACTS)
    contacts["frame"], contacts["primitive_a"], contacts["primitive_b"] = np.arange(len(t)), 0, 2
    contacts["point"] = ORIGIN + np.stack([0.5 * t, 0.0 * t, 0.0 * t], axis=1)
    contacts["normal"] = (0.0, 0.0, 1.0)
    contacts["depth"], contacts["weight"] = 1e-4, 1.0
    contacts["normal_force"] = 10.0 * (1.0 + t)
    contacts["friction_force"] = (-2.0, 0.0, 0.0)
    contacts["sticks"] = t > 0.25
    return contacts


def _run():
    return {
        "format": "pong-log", "version": 2, "name": "slide", "writer": "a test", "engine": "0.1.0",
        "scene_hash": "0x0000000000000000", "step": 0.01, "commits_per_frame": 1, "integrator": None,
        "models": [{"name": "ball", "file": "models/ball/ball.ron", "hash": "0x0"},
                   {"name": "ground", "file": "models/ground/ground.ron", "hash": "0x0"}],
        "objects": [{"name": "ball", "model": 0}, {"name": "ground", "model": 1}],
        "bodies": [{"name": "ball", "object": 0, "path": "ball", "parent": None},
                   {"name": "ground", "object": 1, "path": "ground", "parent": None}],
        "pairs": [[0, 1]],
        "primitives": [{"body": 0, "path": "ball/skin", "kind": "Sphere", "surface": "soft"},
                       {"body": 0, "path": "ball/mark", "kind": "Point", "surface": "soft"},
                       {"body": 1, "path": "ground/floor", "kind": "Plane", "surface": "rigid"}],
        "finished": True, "frames": 101, "lost": 0,
    }


def change_run(folder: Path, **fields) -> None:
    """Replaces values in run.json."""
    path = folder / "run.json"
    path.write_text(json.dumps(json.loads(path.read_text()) | fields))


def without_contacts(folder: Path) -> None:
    """Removes all contacts."""
    frames = np.load(folder / "frames.npy")
    frames["first_contact"] = frames["contacts"] = 0
    np.save(folder / "frames.npy", frames)
    np.save(folder / "contacts.npy", np.zeros(0, dtype=CONTACTS))


def many_contacts(folder: Path, count: int) -> None:
    """Replaces each contact by `count` of them along y, 1 mm apart, the k-th with 1 + k N."""
    frames, contacts = np.load(folder / "frames.npy"), np.load(folder / "contacts.npy")
    more, number = np.repeat(contacts, count), np.tile(np.arange(count), len(contacts))
    more["point"][:, 1] += 1e-3 * number
    more["normal_force"] = 1.0 + number
    frames["contacts"] *= count
    frames["first_contact"] *= count
    np.save(folder / "frames.npy", frames)
    np.save(folder / "contacts.npy", more)


AREA_M2 = 4e-4  # of the patch of `as_solids`


def as_solids(folder: Path) -> None:
    """Replaces each contact by those of two solids: a cell of each field, 1 mm apart, with half of the area and of the
    normal force each, a wedge at the rim with the normal along x, and two contacts with half of the friction each."""
    frames, contacts = np.load(folder / "frames.npy"), np.load(folder / "contacts.npy")
    more, kind = np.repeat(contacts, 5), np.tile(np.arange(5), len(contacts))
    more["end"] = np.array([4, 5, 5, 6, 6], dtype=np.uint32)[kind] << np.uint32(29)
    more["point"][:, 1] += np.array([-5e-4, 5e-4, 2e-3, 1e-2, -1e-2])[kind]
    more["weight"] = np.array([AREA_M2 / 2, AREA_M2 / 2, 1e-6, 0.0, 0.0])[kind]
    more["normal_force"] *= np.array([0.5, 0.5, 1e-4, 0.0, 0.0])[kind]
    more["friction_force"] *= np.array([0.0, 0.0, 0.0, 0.5, 0.5])[kind, None]
    more["normal"][kind == 2] = (1.0, 0.0, 0.0)
    frames["contacts"] *= 5
    frames["first_contact"] *= 5
    np.save(folder / "frames.npy", frames)
    np.save(folder / "contacts.npy", more)

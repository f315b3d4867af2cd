"""The measured tosses of an acrylic cube (README.md): states, and facts that the data give without any simulation."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from validation.kit import rotation

FILE = Path(__file__).with_name("tosses.npz")
TOSSES = 550
FRAME = 1.0 / 148.0  # s
HALF_EDGE = 0.0524  # m
GRAVITY = 9.81  # m/s²

POSITION, ORIENTATION, VELOCITY, ANGULAR_VELOCITY = slice(0, 3), slice(3, 7), slice(7, 10), slice(10, 13)
CORNERS = HALF_EDGE * np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=float)  # m


@dataclass(frozen=True)
class Body:
    """Mass properties and shape of the cube as a simulation has them."""

    mass: float = 0.37  # kg
    inertia: float = 0.00081  # kg·m², about every axis
    corner_radius: float = 0.0  # m


# The body of the published programs.
PUBLISHED_BODY = Body()


class DataError(Exception):
    """Fault of a data file: the message names the thing, the cause and the cure."""


def load(path=FILE):
    """List of tosses, each frames × 13: position (m), quaternion w, x, y, z, velocity (m/s), and angular velocity along
    the axes of the cube (rad/s)."""
    path = Path(path)
    if not path.is_file():
        raise DataError(f"{path}: there is no such file; the tosses come with the repository as {FILE.name}")
    with np.load(path) as archive:
        missing = {"frames", "states"} - set(archive.files)
        if missing:
            raise DataError(
                f"{path}: the array `{sorted(missing)[0]}` is missing; restore {FILE.name} from the repository"
            )
        frames, states = archive["frames"], archive["states"].astype(float)
    if states.ndim != 2 or states.shape[1] != 13 or frames.sum() != len(states):
        raise DataError(
            f"{path}: {states.shape} states for {frames.sum()} frames of 13 numbers; restore {FILE.name} from the repository"
        )
    states[:, ORIENTATION] /= np.linalg.norm(states[:, ORIENTATION], axis=1, keepdims=True)
    return np.split(states, np.cumsum(frames)[:-1])


def lowest_corner(states, half_edge=HALF_EDGE):
    """Height of the lowest corner of a sharp cube in each state, m."""
    # The third row of the rotation matrix has the heights of the turned axes.
    heights = rotation.matrix(states[..., ORIENTATION])[..., 2, :]
    return states[..., 2] - half_edge * np.abs(heights).sum(axis=-1)


def at_rest(toss, speed=0.02, turning=0.2):
    """Frames at the end of a toss in which the cube hardly moves: the longest row of them that reaches the last frame."""
    moves = (np.linalg.norm(toss[:, VELOCITY], axis=1) > speed) | (
        np.linalg.norm(toss[:, ANGULAR_VELOCITY], axis=1) > turning
    )
    last = np.flatnonzero(moves)
    return toss[last[-1] + 1 :] if len(last) else toss


def table_height(tosses, frames=5):
    """Height of the table in each toss, m: the centre at rest less half an edge. Tosses that do not come to rest give none."""
    rests = [at_rest(toss) for toss in tosses]
    return np.array([rest[-frames:, 2].mean() - HALF_EDGE for rest in rests if len(rest) >= frames])

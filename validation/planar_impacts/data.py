"""The planar impact data set of the MCube Lab, MIT: read from a folder of the user, because it has no licence."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

ORIGIN = "github.com/mcubelab/planar-impact-dataset, folder processed_data"
# Files that are read, with their sizes in bytes in the published data set.
FILES = {"data_ellipse.mat": 182_950, "v_models.mat": 235_504}
MODELS = ("Drumwright–Shell", "AP Poisson", "AP Newton", "Mirtich", "Wang–Mason", "Whittaker")

MASS = 36.4e-3  # kg
SEMI_AXES = (35e-3, 25e-3)  # m
GYRATION = 19.2e-3  # m
GRAVITY = 9.81  # m/s²
# Metric of the errors: the kinetic energy of a velocity (x, y, turning) is half its squared length times the mass.
METRIC = np.array([1.0, 1.0, GYRATION**2])


class DataError(Exception):
    """Fault of the data set: the message names the thing, the cause and the cure."""


@dataclass(frozen=True)
class Impacts:
    """Impacts, one in each row."""

    angle: np.ndarray  # rad
    before: np.ndarray  # velocity x, y (m/s) and turning (rad/s) before the impact
    after: np.ndarray  # the same after it
    normal: np.ndarray  # third number of the normal Jacobian: arm of the normal force, m
    tangent: np.ndarray  # third number of the tangential Jacobian: arm of the friction, m
    predicted: dict  # name of a published model: velocities after the impact

    def __len__(self):
        return len(self.angle)

    def part(self, rows):
        """Impacts of some rows."""
        predicted = {name: velocities[rows] for name, velocities in self.predicted.items()}
        return Impacts(
            *(getattr(self, name)[rows] for name in ("angle", "before", "after", "normal", "tangent")), predicted
        )


def load(folder):
    """Reads the data set; returns it with a note for each file that has another size than the published one."""
    from scipy.io import loadmat

    folder, notes, read = Path(folder), [], {}
    for name, size in FILES.items():
        path = folder / name
        if not path.is_file():
            raise DataError(
                f"{path}: there is no such file; the data set has no licence, so that it does not come with Pong."
                f" Get {', '.join(f'{one} ({bytes_:,} bytes)' for one, bytes_ in FILES.items())} from {ORIGIN}, and name the folder"
            )
        if path.stat().st_size != size:
            notes.append(f"{path}: {path.stat().st_size:,} bytes, not the {size:,} of the published file")
        try:
            read[name] = loadmat(path)
        except (ValueError, NotImplementedError, TypeError) as error:
            raise DataError(f"{path}: not a MATLAB file ({error}); get it again from {ORIGIN}") from error
    try:
        data = read["data_ellipse.mat"]["data"][0, 0]
        first, last, normal, tangent = (
            np.asarray(data[name], dtype=float) for name in ("states_i", "states_f", "n", "d")
        )
        models = np.asarray(read["v_models.mat"]["v_models"], dtype=float)
    except (KeyError, IndexError, ValueError) as error:
        raise DataError(f"{folder}: the field {error} is missing; get the files again from {ORIGIN}") from error
    shapes = {one.shape for one in (first, last)}, {one.shape for one in (normal, tangent)}
    if shapes != ({(len(first), 6)}, {(len(first), 3)}) or models.shape != (len(first), 18):
        raise DataError(
            f"{folder}: arrays of {first.shape}, {normal.shape} and {models.shape}, not n × 6, n × 3 and n × 18; get the files again from {ORIGIN}"
        )
    predicted = {name: models[:, 3 * number : 3 * number + 3] for number, name in enumerate(MODELS)}
    return Impacts(first[:, 2], first[:, 3:], last[:, 3:], normal[:, 2], tangent[:, 2], predicted), notes


def length(velocities):
    """Length of velocities in the norm of the kinetic energy, m/s."""
    return np.sqrt(np.sum(METRIC * np.asarray(velocities) ** 2, axis=-1))


def error(impacts, predicted):
    """Error of each prediction: distance from the measured velocities, of their length."""
    return length(predicted - impacts.after) / length(impacts.after)


def training(impacts, count=400):
    """Rows with even numbers, evenly taken: they identify parameters."""
    rows = np.arange(0, len(impacts), 2)
    return rows[np.linspace(0, len(rows) - 1, min(count, len(rows))).astype(int)]


def test(impacts):
    """Rows with odd numbers: they take no part in the identification."""
    return np.arange(1, len(impacts), 2)

"""Parameters from measurements (docs/fit.md): arrays as data, and the plot."""

import io
import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ._pong import BadValueError, identify, momentum_inertia

if TYPE_CHECKING:
    from .types import Fit, MomentumInertia

_COLUMNS = {
    "position": ("x", "y", "z"),
    "orientation": ("qw", "qx", "qy", "qz"),
    "velocity": ("vx", "vy", "vz"),
    "angular_velocity": ("wx", "wy", "wz"),
    "force": ("fx", "fy", "fz"),
    "moment": ("mx", "my", "mz"),
}


def _refused(thing: str, cause: str, cure: str) -> BadValueError:
    return BadValueError(f"{thing}: {cause}; {cure}")


def _array(thing: str, given: Any, shape: tuple[int, ...]) -> np.ndarray:
    try:
        array = np.asarray(given, dtype=float)
    except (TypeError, ValueError):
        raise _refused(thing, "it holds no numbers", "give an array of numbers") from None
    if array.shape != shape:
        raise _refused(thing, f"its shape is {array.shape}", f"give {shape}: a row for each time")
    return array


def _text(data: Mapping[str, Any], axes: str) -> str:
    """Text of a CSV file with the data of arrays. Its numbers keep every bit."""
    if axes not in ("common", "body"):
        raise _refused("angular_velocity_axes", f"it is {axes!r}", 'give "common" or "body"')
    known = {"time", "record", "body", *_COLUMNS}
    for name in data:
        if name not in known:
            raise _refused("data", f"there is no quantity `{name}`", f"name them {', '.join(sorted(known))}")
    if "time" not in data:
        raise _refused("data", "there is no `time`", "give the time of each row, s")
    count = np.size(data["time"])
    columns: list[tuple[str, list[str]]] = []
    for name in ("record", "body"):
        if name in data:
            labels = [str(label) for label in np.asarray(data[name]).ravel()]
            if len(labels) != count or any("," in label or "\n" in label for label in labels):
                raise _refused(f"data: {name}", "it does not fit `time`, or a name has a comma", "give a name for each time")
            columns.append((name, labels))
    columns.append(("time", [repr(float(t)) for t in _array("data: time", data["time"], (count,))]))
    for name, names in _COLUMNS.items():
        if name in data:
            array = _array(f"data: {name}", data[name], (count, len(names)))
            cells = [["" if np.isnan(row).all() else repr(float(x)) for x in row] for row in array]
            columns.extend((column, [row[place] for row in cells]) for place, column in enumerate(names))
    out = io.StringIO()
    out.write(f"# angular_velocity = {axes}\n{','.join(name for name, _ in columns)}\n")
    for row in range(count):
        out.write(",".join(cells[row] for _, cells in columns) + "\n")
    return out.getvalue()


def _source(data: Any, axes: str) -> tuple[str, str | None]:
    """Name of a file, or of the data in errors, and the text that takes its place."""
    if isinstance(data, Mapping):
        return "data", _text(data, axes)
    name = os.fspath(data)
    if not name.endswith(".npz"):
        return name, None
    with np.load(name) as arrays:
        return name, _text(dict(arrays), axes)


def fit(
    scene: str | os.PathLike[str],
    data: str | os.PathLike[str] | Mapping[str, Any],
    free: Mapping[str, tuple[float, float] | None] | Sequence[str],
    *,
    noise: Mapping[str, float] | None = None,
    of: Sequence[str] = (),
    begin: float = 0.0,
    horizon: float | None = None,
    test: float = 0.25,
    measured_starts: bool = False,
    tries: int = 8,
    seed: int = 0,
    threads: int | None = None,
    confidence: float = 0.95,
    profiles: bool = True,
    output: str | os.PathLike[str] | None = None,
    angular_velocity_axes: str = "common",
    allow_files_below: Sequence[str | os.PathLike[str]] = (),
) -> "Fit":
    """Identifies parameters of a scene from measured data: `pong fit`.

    Parameters
    ----------
    scene : path_like
        Scene file.
    data : path_like or Mapping
        CSV file, folder of a response log, NPZ file, or arrays by name: `time` (n,), and any of `record` (n,), `body`
        (n,), `position` (n, 3), `orientation` (n, 4), `velocity`, `angular_velocity`, `force`, `moment` (n, 3). A row
        of NaN was not measured.
    free : Mapping[str, tuple[float, float] or None] or sequence of str
        Parameters with their bounds.
    noise : Mapping[str, float], optional
        Standard deviation of the sensors along one axis, by quantity; `rotation` is that of `orientation`.
    of : sequence of str, optional
        Quantities that count; all that were measured without it.
    begin : float, default 0
        Time from the start of each record before which nothing counts, s.
    horizon : float, optional
        Length of each record that counts, s.
    test : float, default 0.25
        Share of the records that takes no part.
    measured_starts : bool, default False
        Takes the first measurement of each record as it is.
    tries : int, default 8
        Number of points from which the search begins.
    seed : int, default 0
        Seed of the split, of the tries and of the bootstrap.
    threads : int, optional
        Number of threads; one for each core without it.
    confidence : float, default 0.95
        Confidence of the intervals.
    profiles : bool, default True
        Computes profile intervals, which take most of the time.
    output : path_like, optional
        Folder for the page, the tables and the plot of `pong fit`.
    angular_velocity_axes : {"common", "body"}, default "common"
        Axes of the angular velocities of arrays.
    allow_files_below : sequence of path_like, optional
        Further folders from which models may read meshes.

    Returns
    -------
    Fit

    Raises
    ------
    StudyError
        The data, a name or a setting cannot be used.
    BadValueError
        An array has another shape.
    """
    name, text = _source(data, angular_velocity_axes)
    named = dict(free) if isinstance(free, Mapping) else dict.fromkeys(free)
    bounds = [(key, None if ends is None else (float(ends[0]), float(ends[1]))) for key, ends in named.items()]
    return identify(
        scene, name, text, bounds, dict(noise or {}), list(of), begin, horizon, test, confidence, measured_starts, profiles,
        tries, seed, threads or 0, output, list(allow_files_below),
    )


def inertia_from_momentum(
    scene: str | os.PathLike[str],
    data: str | os.PathLike[str] | Mapping[str, Any],
    *,
    body: str | None = None,
    flight: int = 5,
    clear: int = 1,
    longest: int = 4,
    near: float = 1e-3,
    apart: float = 15e-3,
    confidence: float = 0.95,
    seed: int = 0,
    allow_files_below: Sequence[str | os.PathLike[str]] = (),
) -> "MomentumInertia":
    """Finds the inertia of a free body from touches at a single point between two flights: `pong fit --momentum`.

    No law of contact takes part. Mass, mass centre, gravity, geometry and the ratios of the principal moments are those of
    the scene; stiffness, damping and friction have no effect. The other bodies stay where the scene has them.

    Parameters
    ----------
    scene : path_like
        Scene file.
    data : path_like or Mapping
        Positions and orientations in a file or in arrays, as `fit` takes them.
    body : str, optional
        Name of the body; not needed if one body is free.
    flight : int, default 5
        Number of poses of the flights before and after a touch.
    clear : int, default 1
        Number of poses between a touch and each flight.
    longest : int, default 4
        Largest number of poses in a touch.
    near : float, default 1e-3
        Distance from the other bodies below which a point may touch, m.
    apart : float, default 15e-3
        Distance that all other points of the body keep in a touch, m.
    confidence : float, default 0.95
        Confidence of the interval.
    seed : int, default 0
        Seed of the bootstrap.
    allow_files_below : sequence of path_like, optional
        Further folders from which models may read meshes.

    Returns
    -------
    MomentumInertia

    Raises
    ------
    StudyError
        A name, a setting or the data cannot be used, there are too few touches, or the body has unlike principal moments.
    BadValueError
        An array has another shape.
    """
    name, text = _source(data, "common")
    return momentum_inertia(
        scene, name, text, body, flight, clear, longest, near, apart, confidence, seed, list(allow_files_below)
    )


def plot_fit(found: "Fit", path: str | os.PathLike[str]) -> None:
    """Draws the profile of each parameter, and the errors, into a file. Needs Matplotlib.

    Parameters
    ----------
    found : Fit
        Result of `fit`.
    path : path_like
        File; its ending says the format, such as .svg or .png.
    """
    from matplotlib.figure import Figure

    count = max(len(found.parameters), 1)
    figure = Figure(figsize=(3.4 * count, 3.2), layout="constrained")
    for axes, one in zip(np.atleast_1d(figure.subplots(1, count)), found.parameters):
        values = [value for value, _ in one.profile_points]
        axes.plot(values, [max(rise, 0.0) ** 0.5 for _, rise in one.profile_points], "o-", color="#222", markersize=3)
        axes.axvline(one.value, color="#222", linewidth=0.8)
        for interval, color, label in ((one.profile, "#c33", "profile"), (one.bootstrap, "#39c", "bootstrap")):
            if interval is not None:
                axes.axvspan(*interval, color=color, alpha=0.2, label=label)
        axes.set_xlabel(f"{'.'.join(one.name.split('.')[-2:])}{', ' + one.unit if one.unit else ''}")
        axes.set_ylabel("√(rise / s²)")
        axes.legend(fontsize=7)
    figure.savefig(path)

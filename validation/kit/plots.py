"""Plots as SVG files, with matplotlib if it is there."""

from pathlib import Path


def plotter():
    """`matplotlib.pyplot` without a screen, or None where matplotlib is not installed."""
    try:
        import matplotlib
    except ImportError:
        return None
    matplotlib.use("Agg")
    from matplotlib import pyplot

    # Files of the same figures have the same bytes, and little of them.
    matplotlib.rcParams.update(
        {"svg.hashsalt": "pong", "svg.fonttype": "none", "font.size": 9, "axes.grid": True, "grid.alpha": 0.3}
    )
    return pyplot


def save(figure, path):
    """Writes a figure."""
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, metadata={"Date": None}, bbox_inches="tight")


def intervals(path, groups, label):
    """Means with their intervals, one panel for each group on one axis: groups are (title, [(name, Interval)])."""
    pyplot = plotter()
    if pyplot is None:
        return False
    rows = sum(len(rows) for _, rows in groups)
    figure, axes = pyplot.subplots(
        len(groups),
        1,
        figsize=(7.5, 0.6 + 0.25 * rows + 0.3 * len(groups)),
        squeeze=False,
        sharex=True,
        height_ratios=[len(rows) for _, rows in groups],
        layout="constrained",
    )
    for (title, named), axis in zip(groups, axes[:, 0]):
        for number, (name, found) in enumerate(named):
            colour = "tab:blue" if name.startswith("Pong") else "0.35"
            axis.plot([found.low, found.high], [number, number], color=colour, linewidth=2)
            axis.plot([found.value], [number], "o", color=colour, markersize=4)
        axis.set_yticks(range(len(named)), [name for name, _ in named])
        axis.set_ylim(len(named) - 0.5, -0.5)
        axis.set_xlim(left=0.0)
        axis.set_title(title, loc="left", fontsize=9)
    axes[-1, 0].set_xlabel(label)
    save(figure, path)
    return True


def distributions(path, named, label):
    """Share of tests whose error is at most that of the axis: named are (name, errors)."""
    pyplot = plotter()
    if pyplot is None:
        return False
    figure, axis = pyplot.subplots(figsize=(7.5, 4.0), layout="constrained")
    for name, errors in named:
        ordered = sorted(errors)
        axis.step(ordered, [(one + 1) / len(ordered) for one in range(len(ordered))], where="post", label=name)
    axis.set_xscale("log")
    axis.set_xlabel(label)
    axis.set_ylabel("share of the tests")
    axis.legend(fontsize=8)
    save(figure, path)
    return True

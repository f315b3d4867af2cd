"""Plots of histories of loads, where Matplotlib is installed."""

import numpy as np

TIME, PHASE = 0, 1  # columns of a history
SIZE, DOTS = (11.0, 6.5), 110  # inches; dots of an inch


def write(path, title, columns, rows):
    """Draws the loads of a history over time, one panel for forces and one for moments, with phases and peaks.

    `columns`: time, phase, and a load each, such as `force.target`. Bodies that nothing touches are left out.
    """
    try:
        import matplotlib
    except ImportError:
        print(f"{path} is not drawn: Matplotlib is missing")
        return
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    times = np.array([row[TIME] for row in rows])
    figure, panels = plt.subplots(2, 1, sharex=True, figsize=SIZE, layout="constrained")
    for panel, quantity, unit in zip(panels, ("force", "moment"), ("N", "N·m")):
        for number, column in enumerate(columns):
            kind, _, body = column.partition(".")
            values = np.array([row[number] for row in rows], float) if kind == quantity else np.zeros(1)
            if values.any():
                _line(panel, times, values, f"{body}: {values.max():.4g} {unit}")
        _phases(panel, times, [row[PHASE] for row in rows], named=panel is panels[0])
        panel.set_ylabel(f"{quantity}, {unit}")
        panel.grid(alpha=0.3)
        if panel.lines:
            panel.legend(loc="upper right", fontsize="small")
    panels[-1].set_xlabel("time, s")
    figure.suptitle(title)
    figure.savefig(path, dpi=DOTS)
    plt.close(figure)


def _line(panel, times, values, label):
    """A load and a dot at its peak."""
    greatest = int(np.argmax(values))
    (line,) = panel.plot(times, values, lw=1.0, label=label)
    panel.plot(times[greatest], values[greatest], "o", ms=4, color=line.get_color())


def _phases(panel, times, phases, named):
    """A thin line where a phase begins; in one panel with its name."""
    for number, phase in enumerate(phases):
        if phase and (number == 0 or phase != phases[number - 1]):
            panel.axvline(times[number], color="0.6", lw=0.7)
            if named:
                top = panel.get_xaxis_transform()
                panel.text(times[number], 1.01, f" {phase}", transform=top, fontsize="x-small", rotation=30)

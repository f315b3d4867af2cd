"""Plots of a campaign, by Matplotlib: each function returns a figure."""

import numpy as np

from ._errors import CampaignError
from ._sensitivity import SobolIndex
from ._sensitivity import indices as indices_of_campaign
from ._store import Store
from ._summary import QUANTILES, quantile_interval, wilson


def _column(table, name):
    if name not in table.column_names:
        raise CampaignError(f"quantity `{name}`: the results have no such column; they have: {', '.join(table.column_names)}")
    return table[name].to_numpy(zero_copy_only=False)


def _figure():
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6.4, 4.8), layout="constrained")
    return figure, figure.add_subplot()


def distribution(folder, quantity, *, quantiles=QUANTILES, confidence=0.95):
    """Plots the share of runs up to each value of a quantity, and quantiles with their intervals.

    Parameters
    ----------
    folder : path_like
        Folder of the campaign.
    quantity : str
        Column of the results.
    quantiles : sequence of float, optional
        Shares of the quantiles.
    confidence : float, default 0.95
        Confidence of the intervals.

    Returns
    -------
    matplotlib.figure.Figure
    """
    values = np.sort(_column(Store(folder).table(), quantity))
    figure, axes = _figure()
    axes.step(values, np.arange(1, len(values) + 1) / len(values), where="post", color="black", linewidth=1)
    for share in quantiles:
        low, high = quantile_interval(values, share, confidence)
        # A side for which there are too few runs is drawn to the last of them.
        ends = [max(low, values[0]), min(high, values[-1])]
        axes.plot(ends, [share, share], linewidth=3, solid_capstyle="butt", label=f"{100 * share:g} %")
    axes.set(xlabel=quantity, ylabel="share of runs", ylim=(0, 1))
    axes.legend(title=f"{100 * confidence:g} % confidence")
    return figure


def envelope(folder, x, y, criterion):
    """Plots successful and other runs over two dispersed parameters.

    Parameters
    ----------
    folder : path_like
        Folder of the campaign.
    x, y : str
        Columns of the results along both axes.
    criterion : str
        Name of the criterion.

    Returns
    -------
    matplotlib.figure.Figure
    """
    table = Store(folder).table()
    met = _column(table, criterion).astype(bool)
    across, up = _column(table, x), _column(table, y)
    figure, axes = _figure()
    for chosen, mark, color, label in ((met, "o", "tab:blue", criterion), (~met, "x", "tab:red", f"not {criterion}")):
        axes.scatter(across[chosen], up[chosen], marker=mark, color=color, s=12, label=label)
    axes.set(xlabel=x, ylabel=y)
    axes.legend()
    return figure


def share(folder, parameter, criterion, *, bins=12, confidence=0.95):
    """Plots the share of runs that met a criterion over a parameter, with Wilson's interval of each bin.

    Parameters
    ----------
    folder : path_like
        Folder of the campaign.
    parameter : str or tuple[str, array_like]
        Column of the results, or a label and a value for each of their rows.
    criterion : str
        Name of the criterion.
    bins : int, default 12
        Number of bins.
    confidence : float, default 0.95
        Confidence of the intervals.

    Returns
    -------
    matplotlib.figure.Figure
    """
    table = Store(folder).table()
    met = _column(table, criterion).astype(bool)
    label, values = (parameter, _column(table, parameter)) if isinstance(parameter, str) else parameter
    values = np.asarray(values, dtype=float)
    if values.shape != met.shape:
        raise CampaignError(f"quantity `{label}`: it has {values.size} values; give one for each of the {len(met)} rows of the results")
    edges = np.linspace(values.min(), values.max(), bins + 1)
    places = np.clip(np.searchsorted(edges, values, side="right") - 1, 0, bins - 1)
    figure, axes = _figure()
    for place in range(bins):
        inside = met[places == place]
        # Empty bins are skipped.
        if len(inside):
            low, high = wilson(int(inside.sum()), len(inside), confidence)
            middle = 0.5 * (edges[place] + edges[place + 1])
            axes.plot([middle, middle], [low, high], color="black", linewidth=1)
            axes.plot(middle, inside.mean(), "o", color="tab:blue", markersize=4)
    axes.set(xlabel=label, ylabel=f"share {criterion}, {100 * confidence:g} % confidence", ylim=(0, 1.02))
    return figure


def indices(folder, quantity, *, confidence=0.95):
    """Plots the sensitivity indices of a quantity as bars with their intervals, the most important parameter on top.

    Parameters
    ----------
    folder : path_like
        Folder of a campaign with the method `sobol` or `morris`.
    quantity : str
        Column of the results.
    confidence : float, default 0.95
        Confidence of the intervals.

    Returns
    -------
    matplotlib.figure.Figure
    """
    found = indices_of_campaign(folder, quantities=[quantity], confidence=confidence).indices
    if not found:
        raise CampaignError(f"quantity `{quantity}`: it is the same in all runs; take another")
    of_variance = isinstance(found[0], SobolIndex)
    kinds = ("total", "first") if of_variance else ("size",)
    figure, axes = _figure()
    places = np.arange(len(found), dtype=float)
    for number, kind in enumerate(kinds):
        values, low, high = (np.array([getattr(one, kind + end) for one in found]) for end in ("", "_low", "_high"))
        height = 0.8 / len(kinds)
        label = {"total": "in total", "first": "alone", "size": "mean magnitude of the effects"}[kind]
        axes.barh(places + number * height, values, height, xerr=[values - low, high - values], label=label, capsize=2)
    axes.set_yticks(places, [one.parameter for one in found])
    axes.invert_yaxis()
    axes.set(xlabel=f"share of the variance of {quantity}" if of_variance else f"effect on {quantity}")
    axes.legend(title=f"{100 * confidence:g} % confidence")
    return figure

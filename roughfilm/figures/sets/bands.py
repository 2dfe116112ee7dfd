"""Means over windows as curves with two bands: the scatter of the mean, and the interval for one window."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from roughfilm.contact.windows.average import WindowAverage

WINDOW_ALPHA, MEAN_ALPHA = 0.14, 0.38
"""Opacity of the band of one window, and of that of the mean."""

LEGEND_COLOUR = "0.35"
"""Colour of the bands and bars in the legend, which explains those of all curves."""


def draw_bands(
    axes: Axes,
    places: Sequence[float],
    averages: Sequence[WindowAverage],
    colour: str,
    label: str,
) -> None:
    """Draw the mean over windows with its bands, light for one window, darker for the mean, and numerical bars.

    On a logarithmic axis, which is set before, numbers that are not positive are left out.
    """
    x = np.asarray(places, dtype=float)
    values = np.array([one.value for one in averages])
    intervals = np.array([one.interval or (np.nan, np.nan) for one in averages])
    means = np.array([one.mean_interval or (np.nan, np.nan) for one in averages])
    bars = np.array([np.nan if one.uncertainty is None else one.uncertainty for one in averages])
    logarithmic = axes.get_yscale() == "log"
    if logarithmic:
        shown = values > 0
        x, values, intervals, means, bars = (part[shown] for part in (x, values, intervals, means, bars))
    least = values.min() * 1e-12 if logarithmic and values.size else -np.inf
    for ends, alpha in ((intervals, WINDOW_ALPHA), (means, MEAN_ALPHA)):
        axes.fill_between(x, np.maximum(ends[:, 0], least), ends[:, 1], color=colour, alpha=alpha, linewidth=0)
    axes.plot(x, values, color=colour, linewidth=1.4, label=label)
    known = np.isfinite(bars)
    if known.any():
        bounded = np.minimum(bars[known], 0.999 * values[known]) if logarithmic else bars[known]
        axes.errorbar(
            x[known], values[known], [bounded, bars[known]], fmt="o", markersize=2.5, color=colour, elinewidth=0.9
        )


def explain_bands(figure: Figure, axes: Axes) -> None:
    """Put a legend above all panels: the curves of one panel, and what bands and bars are."""
    handles, labels = axes.get_legend_handles_labels()
    handles += [
        Line2D([], [], marker="o", markersize=2.5, color=LEGEND_COLOUR, linestyle="", label="bar"),
        Patch(color=LEGEND_COLOUR, alpha=MEAN_ALPHA, linewidth=0),
        Patch(color=LEGEND_COLOUR, alpha=WINDOW_ALPHA, linewidth=0),
    ]
    labels += ["bar: numerical uncertainty", "dark: scatter of the mean (95 %)", "light: one window (95 %)"]
    figure.legend(handles, labels, fontsize=8, loc="outside upper center", ncols=3)

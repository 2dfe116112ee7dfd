"""Published numbers beside ours."""

import textwrap
from collections.abc import Sequence

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes

from roughfilm.figures.base import new_figure, svg
from roughfilm.validation.published import Curve, Row, Source, Verdict

COLOURS = {Verdict.WITHIN: "#2166ac", Verdict.OUTSIDE: "#b2182b", Verdict.SUSPECT: "#e08214"}
"""Colours of the verdicts."""

WIDTH, COLUMNS = 9.6, 4
"""Width of a figure, inches, and largest number of quantities beside each other."""

MIN_DECADES = 1.5
"""Range of the values, decades, from which on their axis is logarithmic."""


def compared_figure(source: Source, rows: Sequence[Row]) -> str:
    """For each quantity the published values and ours, and below them their difference over what is allowed."""
    quantities = list(dict.fromkeys(row.quantity for row in rows))
    blocks = -(-len(quantities) // COLUMNS)
    columns = -(-len(quantities) // blocks)
    figure, axes = new_figure((WIDTH, 4.2 * blocks), 2 * blocks, columns, squeeze=False, height_ratios=[2, 1] * blocks)
    for number, quantity in enumerate(quantities):
        block, column = divmod(number, columns)
        own = [row for row in rows if row.quantity == quantity]
        _values(axes[2 * block, column], own, columns)
        _differences(axes[2 * block + 1, column], own)
        axes[2 * block + 1, column].set_xlabel(source.abscissa, fontsize=9)
        if column == 0:
            axes[2 * block + 1, column].set_ylabel("difference\nover allowed", fontsize=9)
    for number in range(len(quantities), blocks * columns):
        block, column = divmod(number, columns)
        axes[2 * block, column].set_axis_off()
        axes[2 * block + 1, column].set_axis_off()
    handles, labels = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=5, fontsize=8)
    return svg(figure)


def _values(axes: Axes, rows: Sequence[Row], columns: int) -> None:
    series = list(dict.fromkeys(row.series for row in rows))
    colours = colormaps["viridis"](np.linspace(0, 0.85, len(series)))
    for name, colour in zip(series, colours, strict=True):
        own = sorted((row for row in rows if row.series == name), key=lambda row: row.at)
        at = [row.at for row in own]
        label = f"ours, {name}" if len(series) > 1 else "ours"
        axes.plot(at, [row.ours for row in own], color=colour, linewidth=1.2, label=label)
        axes.plot(at, [row.published for row in own], "o", color=colour, markersize=4, markerfacecolor="none")
    axes.plot([], [], "o", color="black", markersize=4, markerfacecolor="none", label="published")
    values = np.array([[row.published, row.ours] for row in rows])
    if values.min() > 0 and values.max() > values.min() * 10**MIN_DECADES:
        axes.set_yscale("log")
    unit = rows[0].unit
    axes.set_title(textwrap.fill(rows[0].quantity + ("" if unit == "1" else f", {unit}"), 100 // columns), fontsize=9)
    axes.tick_params(labelsize=8, labelbottom=False)


def _differences(axes: Axes, rows: Sequence[Row]) -> None:
    axes.axhspan(-1, 1, color="black", alpha=0.08, linewidth=0)
    for row in rows:
        axes.plot(row.at, row.difference / row.allowed, ".", color=COLOURS[row.verdict], markersize=5)
    axes.set_ylim(min(-1.3, axes.get_ylim()[0]), max(1.3, axes.get_ylim()[1]))
    axes.tick_params(labelsize=8)


def curve_figure(curves: Sequence[Curve]) -> str:
    """Published curves beside ours."""
    figure, panels = new_figure((WIDTH, 3.6), 1, len(curves), squeeze=False)
    for axes, curve in zip(panels[0], curves, strict=True):
        line = "-" if len(curve.published) == 2 else "."
        axes.plot(
            curve.published_x, curve.published, line, color=COLOURS[Verdict.OUTSIDE], markersize=4, label="published"
        )
        axes.plot(curve.x, curve.ours, color=COLOURS[Verdict.WITHIN], linewidth=1.4, label="ours")
        if curve.logarithmic:
            axes.set_xscale("log")
        axes.set(xlabel=curve.abscissa, ylabel=curve.ordinate)
        axes.set_title(curve.title, fontsize=10)
        axes.legend(fontsize=9)
    return svg(figure)

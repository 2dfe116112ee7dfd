"""Figures of many windows: places, values of each, trend with the size, and mean over their number."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle

from roughfilm.contact.surfaces.surface import Surface
from roughfilm.contact.windows.scatter import Scatter, scatter
from roughfilm.figures.base import new_figure, surface_map, svg
from roughfilm.figures.ticks import plain_logarithmic
from roughfilm.sampling.answer import WindowQuantity
from roughfilm.sampling.plan import Group
from roughfilm.words.scales import Scale

DOTS, MEANS, LIMIT = "#4a7fb5", "#b2182b", "#1a7f37"
"""Colours of the windows, of their means, and of the whole surface."""

SHOWN_QUANTILE = 0.001
"""Quantile of the heights at which the colours of a map end."""

CELLS = 3
"""Number of cells that are drawn of a description."""

MOST_LINEAR = 5.0
"""Largest ratio of the ends of an interval that is drawn on a linear axis."""

Shown = Mapping[str, tuple[str, WindowQuantity, Scale]]
"""The quantities that are drawn, by name: title, values and unit."""


def places(surface: Surface, groups: Sequence[Group]) -> str:
    """The levelled measurement with the outlines of the windows of each size."""
    length, width = surface.size
    figure, axes = new_figure((7.6, min(7.0, max(2.6, 6.2 * width / length + 0.7))))
    image = surface_map(axes, 1e6 * (surface.heights - surface.heights.mean()), surface.size, **_colours(surface))
    figure.colorbar(image, ax=axes, label="height, µm", shrink=0.8)
    styles = ("-", (0, (4, 2)), (0, (1, 1.5)))
    for group, style in zip(groups, styles, strict=False):
        for number, window in enumerate(group.windows):
            (i, j), (nx, ny), (dx, dy) = window.start, window.shape, surface.spacing
            label = f"{1e6 * group.size:.4g} µm" if number == 0 else None
            axes.add_patch(
                Rectangle(
                    (1e6 * i * dx, 1e6 * j * dy),
                    1e6 * nx * dx,
                    1e6 * ny * dy,
                    fill=False,
                    linewidth=1.3,
                    linestyle=style,
                    edgecolor="black",
                    label=label,
                )
            )
    figure.legend(loc="outside upper center", ncols=len(groups), fontsize=9, title="windows")
    return svg(figure)


def seeds(group: Group) -> str:
    """The first cells of a description."""
    cells = group.cells[:CELLS]
    figure, panels = new_figure((10.4, 3.6), 1, len(cells), squeeze=False)
    for axes, cell, seed in zip(panels[0], cells, group.seeds, strict=False):
        image = surface_map(axes, 1e6 * (cell.heights - cell.heights.mean()), cell.size, **_colours(cells[0]))
        axes.set_title(f"seed {seed}", fontsize=9)
    figure.colorbar(image, ax=panels[0].tolist(), label="height, µm", shrink=0.8)
    return svg(figure)


def _colours(surface: Surface) -> dict[str, Any]:
    most = 1e6 * float(np.quantile(np.abs(surface.heights - surface.heights.mean()), 1 - SHOWN_QUANTILE))
    return {"cmap": "RdBu_r", "vmin": -most, "vmax": most}


def values(shown: Shown) -> str:
    """The value of each window by size, with the mean, and the interval of one further window of the largest size."""
    figure, panels = new_figure((10.4, 3.4 * -(-len(shown) // 2)), -(-len(shown) // 2), 2, squeeze=False)
    rng = np.random.default_rng(1)
    for axes, (title, one, scale) in zip(panels.flat, shown.values(), strict=False):
        largest = next(iter(one.by_size.values()))
        if largest.interval is not None:
            ends = [end / scale.factor for end in largest.interval]
            axes.fill_between(ends, -0.32, 0.32, color="black", alpha=0.1, linewidth=0, label="one window, 95 %")
        for number, found in enumerate(one.by_size.values()):
            jitter = number + rng.uniform(-0.2, 0.2, found.values.size)
            axes.plot(found.values / scale.factor, jitter, "o", color=DOTS, markersize=4, alpha=0.6)
            _draw_mean(axes, found, scale, number, upright=False)
        axes.set_yticks(range(len(one.by_size)), [f"{1e6 * size:.4g}" for size in one.by_size])
        if _spans(*(largest.interval or (0.0, 0.0))):
            axes.set_xscale("log")
            plain_logarithmic(axes.xaxis)
        axes.set(xlabel=scale.label(title), ylabel="window, µm", ylim=(len(one.by_size) - 0.5, -0.5))
    _hide_rest(panels, len(shown))
    return svg(figure)


def over_size(shown: Shown) -> str:
    """The mean over the inverse of the size of the window, with the regression and its value on the whole surface."""
    figure, panels = new_figure((10.4, 3.4 * -(-len(shown) // 2)), -(-len(shown) // 2), 2, squeeze=False)
    for axes, (title, one, scale) in zip(panels.flat, shown.values(), strict=False):
        inverse = [1e-3 / size for size in one.by_size]
        for place, found in zip(inverse, one.by_size.values(), strict=True):
            _draw_mean(axes, found, scale, place, upright=True)
        trend = one.trend
        if trend.limit is not None and trend.limit_uncertainty is not None:
            ends = np.array([0.0, max(inverse)])
            axes.plot(ends, (trend.limit + trend.slope * 1e3 * ends) / scale.factor, "-", color="0.5", linewidth=1)
            axes.errorbar(
                0,
                trend.limit / scale.factor,
                trend.limit_uncertainty / scale.factor,
                fmt="o",
                color=LIMIT,
                capsize=4,
                label="whole surface",
            )
        ends_of_means = [end for found in one.by_size.values() for end in found.mean_interval or (found.mean,)]
        if trend.limit is None and _spans(min(ends_of_means), max(ends_of_means)):
            axes.set_yscale("log")
            plain_logarithmic(axes.yaxis)
        axes.set(xlim=(-0.04 * max(inverse), None), xlabel="1/side of the window, 1/mm", ylabel=scale.label(title))
    _hide_rest(panels, len(shown))
    _legend(figure, panels)
    return svg(figure)


def _spans(low: float, high: float) -> bool:
    """Whether an axis from a number to another is logarithmic."""
    return 0 < MOST_LINEAR * low < high


def _draw_mean(axes: Axes, found: Scatter, scale: Scale, place: float, *, upright: bool) -> None:
    """Draw a mean at a place of the other axis, with its 95 % interval where that is known."""
    mean = found.mean / scale.factor
    point = (place, mean) if upright else (mean, place)
    axes.plot(*point, "D", color=MEANS, markersize=6, label="mean over windows" if upright else None)
    if found.mean_interval is not None:
        low, high = (end / scale.factor for end in found.mean_interval)
        bars: dict[str, Any] = {"yerr" if upright else "xerr": [[mean - low], [high - mean]]}
        axes.errorbar(*point, **bars, fmt="none", ecolor=MEANS, capsize=4)


def over_number(shown: Shown) -> str:
    """The mean over the first windows of a random order, with its 95 % interval."""
    figure, panels = new_figure((10.4, 3.4 * -(-len(shown) // 2)), -(-len(shown) // 2), 2, squeeze=False)
    for axes, (title, one, scale) in zip(panels.flat, shown.values(), strict=False):
        found = one.scatter
        order = np.random.default_rng(1).permutation(found.values.size)
        counts = sorted({round(n) for n in np.geomspace(1, found.values.size, 24)})
        part = found.independent / found.values.size
        means, low, high = [], [], []
        for count in counts:
            some = scatter(found.values[order[:count]], max(1.0, part * count), found.positive)
            means.append(some.mean / scale.factor)
            ends = some.mean_interval or (np.nan, np.nan)
            low.append(ends[0] / scale.factor)
            high.append(ends[1] / scale.factor)
        axes.fill_between(counts, low, high, color=MEANS, alpha=0.15, linewidth=0, label="95 %")
        axes.plot(counts, means, "o-", color=MEANS, markersize=4, label="mean")
        known = np.isfinite(high)
        if known.any():
            last = np.flatnonzero(known)[-1]
            bottom = min(*means, means[-1] - 2.5 * (means[-1] - low[last]))
            top = max(*means, means[-1] + 2.5 * (high[last] - means[-1]))
            if found.positive and _spans(low[last], high[last]):
                least, most = (min(*means, low[last]), max(*means, high[last]))
                axes.set_yscale("log")
                axes.set_ylim(least / MOST_LINEAR, most * MOST_LINEAR)
                plain_logarithmic(axes.yaxis)
            else:
                room = 0.05 * (top - bottom or 1.0)
                axes.set_ylim(max(bottom - room, 0.0) if found.positive else bottom - room, top + room)
        axes.set(xlabel="number of windows", ylabel=scale.label(title))
    _hide_rest(panels, len(shown))
    _legend(figure, panels)
    return svg(figure)


def _hide_rest(panels: Any, count: int) -> None:
    for axes in list(panels.flat)[count:]:
        axes.set_axis_off()


def _legend(figure: Any, panels: Any) -> None:
    handles: dict[str, Any] = {}
    for axes in panels.flat:
        own, labels = axes.get_legend_handles_labels()
        handles |= dict(zip(labels, own, strict=True))
    figure.legend(handles.values(), handles.keys(), loc="outside upper center", ncols=3, fontsize=9)

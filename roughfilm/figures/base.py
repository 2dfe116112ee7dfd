"""The figures of a comparison as SVG text, and what all figures share."""

import hashlib
import html
import io
import json
import re
from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.layout_engine import ConstrainedLayoutEngine

from roughfilm.contact.mechanics.contact import Contact
from roughfilm.figures.readings import readings
from roughfilm.figures.ticks import whole_decades
from roughfilm.figures.view import View
from roughfilm.rom.studies.comparison import Point, pareto_front
from roughfilm.rom.studies.convergence import Convergence, ConvergenceKind

mpl.rcParams.update(
    {
        "font.family": "DejaVu Sans",
        "font.size": 10,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.grid": True,
        "grid.alpha": 0.25,
        "legend.frameon": False,
        "svg.fonttype": "path",
        "svg.hashsalt": "roughfilm",
    }
)


MIN_ERROR = 1e-9
"""Smallest relative error that is drawn."""

LEAST = 0.03
"""Smallest relative error that is drawn over the uncertainty of the reference."""

FRONT = "Pareto front"
"""Label of the front in a legend."""

MAX_PIXELS = 512
"""Largest number of points of a map along a side."""


def speed_against_accuracy(
    chart: Sequence[Point], floor: Mapping[str, float], titles: Mapping[str, str], view: View
) -> Figure:
    """Error over CPU time, a panel for each compared quantity, with the Pareto front through its points.

    ``floor`` is the relative uncertainty of the reference by quantity: a bar at each point spans error ± uncertainty,
    and the front does not rank points that it does not distinguish. Errors far below it are drawn at ``LEAST`` of it.
    ``titles`` are those of the compared quantities.
    """
    figure, panels = new_figure((10, 4.6), 1, len(titles))
    for axes, (quantity, title) in zip(panels, titles.items(), strict=True):
        known = [point for point in chart if quantity in point.error]
        if not known:
            axes.set_axis_off()
            axes.text(0.5, 0.5, f"{title}: 0, no relative error", ha="center", transform=axes.transAxes)
            continue
        bar = floor.get(quantity, 0.0)
        drawn = partial(_drawn, least=LEAST * bar)
        for name in dict.fromkeys(point.model for point in known):
            run = sorted((point for point in known if point.model == name), key=lambda point: point.resolution)
            times, errors = [p.cpu_s for p in run], [drawn(p.error[quantity]) for p in run]
            style = view.style(name)
            if bar:
                ends = [[drawn(p.error[quantity] + side * bar) for p in run] for side in (-1, 1)]
                axes.vlines(times, *ends, color=style.colour, alpha=0.35, linewidth=1)
            axes.plot(times, errors, color=style.colour, linewidth=0.8, alpha=0.6)
            grids = f"{run[0].resolution} to {run[-1].resolution}" if len(run) > 1 else f"{run[0].resolution}"
            axes.plot(
                times, errors, style.marker, color=style.colour, label=f"{name}, {grids}", alpha=0.85, markersize=6
            )
        front = pareto_front(chart, quantity, floor.get(quantity))
        axes.plot(
            [p.cpu_s for p in front],
            [drawn(p.error[quantity]) for p in front],
            color="black",
            linewidth=1.2,
            label=FRONT,
            zorder=1.5,
        )
        if bar > 0:
            axes.axhspan(drawn(0.0) / 2, 100 * bar, color="black", alpha=0.06, zorder=-1)
            axes.axhline(100 * bar, color="black", alpha=0.4, linewidth=0.8, linestyle=":")
        axes.set(
            xscale="log", yscale="log", xlabel="CPU time, s", ylabel=f"error in {title}\nrelative to the reference, %"
        )
        axes.set_ylim(bottom=min(drawn(p.error[quantity]) for p in known) / 2)
        whole_decades(axes.xaxis, axes.yaxis)
    _legend_above(figure)
    return figure


def _drawn(error: float, least: float) -> float:
    """A relative error in per cent, at least the least one that is drawn."""
    return 100 * max(error, least, MIN_ERROR)


def _legend_above(figure: Figure) -> None:
    """The legend of all panels above them, with each name once."""
    found = [axes.get_legend_handles_labels() for axes in figure.axes]
    handles = {label: handle for one in found for handle, label in zip(*one, strict=True)}
    figure.legend(handles.values(), handles.keys(), loc="outside upper center", ncols=3, fontsize=8)


def grid_convergence(studies: Mapping[str, Mapping[str, Convergence]], titles: Mapping[str, str], view: View) -> Figure:
    """Difference from the extrapolated value over the cell size, with lines of slope 2."""
    figure, panels = new_figure((10, 3.6), 1, len(titles))
    for axes, (quantity, title) in zip(panels, titles.items(), strict=True):
        known = {name: study[quantity] for name, study in studies.items() if quantity in study}
        drawn = {name: one for name, one in known.items() if one.kind is ConvergenceKind.MONOTONE}
        if not drawn:
            axes.set_axis_off()
            axes.text(0.5, 0.5, f"{title}: nothing to extrapolate", ha="center", transform=axes.transAxes)
            continue
        for name, one in drawn.items():
            sizes = [1 / grid for grid in one.grids]
            errors = [100 * abs(value / one.value - 1) for value in one.values]
            style = view.style(name)
            axes.plot(sizes, errors, style.marker + "-", color=style.colour, label=name, linewidth=1.2)
            slope = [errors[0] * (size / sizes[0]) ** 2 for size in sizes]
            axes.plot(sizes, slope, ":", color=style.colour, linewidth=1)
        grids = sorted({grid for one in drawn.values() for grid in one.grids})
        axes.set_xscale("log")
        axes.set_xticks([1 / grid for grid in grids], [f"1/{grid}" for grid in grids], rotation=45)
        axes.xaxis.minorticks_off()
        axes.set_yscale("log")
        low, high = axes.get_ylim()
        axes.set(
            ylim=(10 ** np.floor(np.log10(low)), 10 ** np.ceil(np.log10(high))),
            xlabel="mean length of a cell, periods (dotted: slope 2)",
            ylabel=f"{title}: difference from\nthe extrapolated value, %",
        )
    _legend_above(figure)
    return figure


def new_figure(size: tuple[float, float], rows: int = 1, columns: int = 1, **options: Any) -> tuple[Figure, Any]:
    """Return an empty figure of a size in inches and its axes, which are as ``Figure.subplots`` returns them."""
    figure = Figure(figsize=size, layout="constrained")
    return figure, figure.subplots(rows, columns, **options)


def thinned(values: Any) -> Any:
    """Every first, second, third ... point of a map, so that it has at most ``MAX_PIXELS`` along a side."""
    step = max(1, -(-max(values.shape) // MAX_PIXELS))
    return values[::step, ::step]


def size_of(contact: Contact) -> tuple[float, float]:
    """Length and width of the surface of a contact, m."""
    (nx, ny), (dx, dy) = contact.heights.shape, contact.spacing
    return nx * dx, ny * dy


def surface_map(axes: Axes, values: Any, size: tuple[float, float], **options: Any) -> AxesImage:
    """Draw values of shape (nx, ny) over a surface of a length and width in m."""
    axes.grid(visible=False)
    axes.set(xlabel="x, µm", ylabel="y, µm")
    extent = (0.0, 1e6 * size[0], 0.0, 1e6 * size[1])
    return axes.imshow(thinned(values).T, origin="lower", extent=extent, interpolation="nearest", **options)


def model_map(axes: Axes, name: str, values: Any, size: tuple[float, float], **options: Any) -> AxesImage:
    """Draw values over a surface under the name of their model; a narrow surface is stretched."""
    axes.set_title(name, fontsize=9)
    aspect: Any = "equal" if 0.2 < size[1] / size[0] < 5 else "auto"
    return surface_map(axes, values, size, aspect=aspect, **options)


def map_figure(size: tuple[float, float], models: int, height: float) -> tuple[Figure, Any]:
    """An empty figure and its axes: a row for each model, two maps of a size in m in each, of a height in inches."""
    height = min(height, max(1.5, (height - 0.3) * size[1] / size[0]))
    figure = Figure(figsize=(10, 0.4 + height * models), layout=ConstrainedLayoutEngine(w_pad=0.15))
    return figure, figure.subplots(models, 2, squeeze=False)


def svg(figure: Figure) -> str:
    """The figure as SVG text, which holds the values that a page shows under the pointer.

    The text can stand beside others on one page: its identifiers begin with a digest of itself. The figure is laid out
    and drawn once; ``Figure.savefig`` draws it one more time, without output, to lay it out.
    """
    buffer = io.StringIO()
    FigureCanvasSVG(figure).print_svg(buffer, metadata={"Date": None})  # type: ignore[no-untyped-call]
    text = buffer.getvalue()
    text = text[text.index("<svg") :]
    own = "f" + hashlib.sha256(text.encode()).hexdigest()[:8] + "-"
    text = re.sub(r'(\bid="|url\(#|href="#)', rf"\g<1>{own}", text)
    held = json.dumps(readings(figure), ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    return text.replace("</svg>", f'<metadata class="readings">{html.escape(held, quote=False)}</metadata>\n</svg>')

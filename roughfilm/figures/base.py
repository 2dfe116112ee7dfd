"""The plots of a comparison, by matplotlib, as SVG text."""

import io
from collections.abc import Mapping, Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

from roughfilm.figures.view import View
from roughfilm.rom.studies.comparison import Point, pareto_front
from roughfilm.rom.studies.convergence import Convergence, Kind

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


def speed_against_accuracy(
    chart: Sequence[Point], floor: Mapping[str, float], titles: Mapping[str, str], view: View
) -> str:
    """CPU seconds against error, a panel for each compared quantity, with the Pareto front.

    ``floor`` is the numerical uncertainty of the reference itself, below which errors mean nothing; ``titles`` names
    the compared quantities.
    """
    figure = Figure(figsize=(10, 4.6), layout="constrained")
    panels = figure.subplots(1, len(titles))
    for axes, (quantity, title) in zip(panels, titles.items(), strict=True):
        known = [point for point in chart if quantity in point.error]
        for name in dict.fromkeys(point.model for point in known):
            run = sorted((point for point in known if point.model == name), key=lambda point: point.resolution)
            times, errors = [p.cpu_s for p in run], [100 * max(p.error[quantity], 1e-9) for p in run]
            style = view.style(name)
            axes.plot(times, errors, style.marker, color=style.colour, label=name, alpha=0.85, markersize=6)
            axes.annotate(f"{run[-1].resolution}", (times[-1], errors[-1]), (5, 5), textcoords="offset points", size=8)
            if len(run) > 1:
                axes.annotate(
                    f"{run[0].resolution}", (times[0], errors[0]), (-12, 6), textcoords="offset points", size=8
                )
        front = pareto_front(chart, quantity)
        axes.step(
            [p.cpu_s for p in front],
            [100 * max(p.error[quantity], 1e-9) for p in front],
            where="post",
            color="black",
            linewidth=1,
            label="Pareto front",
            zorder=0,
        )
        if floor.get(quantity, 0) > 0:
            axes.axhspan(axes.get_ylim()[0], 100 * floor[quantity], color="black", alpha=0.06, zorder=-1)
            axes.axhline(100 * floor[quantity], color="black", alpha=0.4, linewidth=0.8, linestyle=":")
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_xlabel("CPU time, s")
        axes.set_ylabel(f"error in {title} relative to the reference, %")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=4, fontsize=8)
    return svg(figure)


def grid_convergence(studies: Mapping[str, Mapping[str, Convergence]], titles: Mapping[str, str], view: View) -> str:
    """Cell size against the difference to the extrapolated value, where there is one, with slope 2 for the eye."""
    figure = Figure(figsize=(10, 3.6), layout="constrained")
    panels = figure.subplots(1, len(titles))
    for axes, (quantity, title) in zip(panels, titles.items(), strict=True):
        found = {name: study[quantity] for name, study in studies.items() if quantity in study}
        drawn = {name: one for name, one in found.items() if one.kind is Kind.MONOTONE}
        if not drawn:
            axes.set_axis_off()
            axes.text(0.5, 0.5, f"{title}: nothing to extrapolate", ha="center", transform=axes.transAxes)
            continue
        for name, one in drawn.items():
            sizes = [1 / grid for grid in one.grids]
            errors = [100 * abs(value / one.value - 1) for value in one.values]
            label, style = f"{name}: order {one.order_told}", view.style(name)
            axes.plot(sizes, errors, style.marker + "-", color=style.colour, label=label, linewidth=1.2)
            slope = [errors[0] * (size / sizes[0]) ** 2 for size in sizes]
            axes.plot(sizes, slope, ":", color=style.colour, linewidth=1)
        grids = sorted({grid for one in drawn.values() for grid in one.grids})
        axes.set_xscale("log")
        axes.set_xticks([1 / grid for grid in grids], [f"1/{grid}" for grid in grids], rotation=45)
        axes.xaxis.minorticks_off()
        axes.set_yscale("log")
        low, high = axes.get_ylim()
        axes.set_ylim(10 ** np.floor(np.log10(low)), 10 ** np.ceil(np.log10(high)))
        axes.set_xlabel("mean length of a cell, periods (dotted: slope 2)")
        axes.set_ylabel(f"{title}: difference from\nthe extrapolated value, %")
        axes.legend(fontsize=8)
    return svg(figure)


def new_figure(size: tuple[float, float], rows: int = 1, columns: int = 1, **options: Any) -> tuple[Figure, Any]:
    """Return an empty figure of a size in inches and its axes, which are as ``Figure.subplots`` returns them."""
    figure = Figure(figsize=size, layout="constrained")
    return figure, figure.subplots(rows, columns, **options)


def svg(figure: Figure) -> str:
    """The figure as SVG text."""
    buffer = io.StringIO()
    figure.savefig(buffer, format="svg", metadata={"Date": None})
    text = buffer.getvalue()
    return text[text.index("<svg") :]

"""The plots of a comparison, by matplotlib, as SVG text."""

import io
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

from rom.comparison import Point, pareto_front
from rom.convergence import Convergence, Kind
from rom.result import Result
from rom.scene import Scene

COLOURS = {
    "reynolds": "#7f7f7f",
    "inertial_reynolds": "#e08214",
    "film": "#b2182b",
    "film_slope": "#762a83",
    "stokes": "#5aae61",
    "navier_stokes": "#2166ac",
}
STYLES = {
    "reynolds": "--",
    "inertial_reynolds": "-.",
    "film": (0, (5, 1)),
    "film_slope": (0, (3, 1, 1, 1)),
    "stokes": ":",
    "navier_stokes": "-",
}
MARKERS = {
    "reynolds": "s",
    "inertial_reynolds": "D",
    "film": "v",
    "film_slope": "P",
    "stokes": "^",
    "navier_stokes": "o",
}

TITLES = {"load_plus": "load", "friction_plus": "friction"}

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


def pressure(scene: Scene, results: Mapping[str, Result]) -> str:
    """Pressure on the sliding wall by every model, with the edges of the grooves."""
    figure = Figure(figsize=(9, 4.2), layout="constrained")
    axes = figure.add_subplot()
    for name, result in results.items():
        plus = result.fields["pressure"].values / scene.pressure_unit * scene.plus_factor
        x = result.fields["position"].values * 1e3
        axes.plot(x, plus, linestyle=STYLES.get(name, "-"), color=COLOURS.get(name), label=name, linewidth=2)
    for edge in {edge for groove in scene.grooves for edge in groove.span}:
        axes.axvline(edge * 1e3, color="black", linewidth=0.8, linestyle=(0, (4, 3)), alpha=0.6)
    axes.set_xlabel("position along the sliding wall, mm (dashed: groove edges)")
    axes.set_ylabel("p+ = 100 p Ly² / (η u Lx)")
    pascal = scene.pressure_unit / scene.plus_factor
    right = axes.secondary_yaxis("right", functions=(_times(pascal / 1e3), _times(1e3 / pascal)))
    right.set_ylabel("pressure, kPa")
    axes.legend()
    return svg(figure)


def speed_against_accuracy(chart: Sequence[Point], floor: Mapping[str, float]) -> str:
    """CPU seconds against error, a panel for each compared quantity, with the Pareto front.

    ``floor`` is the numerical uncertainty of the reference itself, below which errors mean nothing.
    """
    figure = Figure(figsize=(10, 4.6), layout="constrained")
    panels = figure.subplots(1, len(TITLES))
    names = list(dict.fromkeys(point.model for point in chart))
    for axes, (quantity, title) in zip(panels, TITLES.items(), strict=True):
        for name in names:
            run = sorted((point for point in chart if point.model == name), key=lambda point: point.resolution)
            times, errors = [p.cpu_s for p in run], [100 * max(p.error[quantity], 1e-9) for p in run]
            colour, marker = COLOURS.get(name), MARKERS.get(name, "o")
            axes.plot(times, errors, marker, color=colour, label=name, alpha=0.85, markersize=6)
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
        axes.set_ylabel(f"error in {title} against the best rung, %")
    panels[0].legend(fontsize=8)
    return svg(figure)


def grid_convergence(studies: Mapping[str, Mapping[str, Convergence]]) -> str:
    """Cell size against the difference to the extrapolated value, where there is one, with slope 2 for the eye."""
    figure = Figure(figsize=(10, 3.6), layout="constrained")
    panels = figure.subplots(1, len(TITLES))
    for axes, (quantity, title) in zip(panels, TITLES.items(), strict=True):
        drawn = {name: study[quantity] for name, study in studies.items() if study[quantity].kind is Kind.MONOTONE}
        if not drawn:
            axes.set_axis_off()
            axes.text(0.5, 0.5, f"{title}: nothing to extrapolate", ha="center", transform=axes.transAxes)
            continue
        for name, found in drawn.items():
            sizes = [1 / grid for grid in found.grids]
            errors = [100 * abs(value / found.value - 1) for value in found.values]
            label, colour = f"{name}: order {found.order_told}", COLOURS.get(name)
            axes.plot(sizes, errors, MARKERS.get(name, "o") + "-", color=colour, label=label, linewidth=1.2)
            slope = [errors[0] * (size / sizes[0]) ** 2 for size in sizes]
            axes.plot(sizes, slope, ":", color=colour, linewidth=1)
        grids = sorted({grid for found in drawn.values() for grid in found.grids})
        axes.set_xscale("log")
        axes.set_xticks([1 / grid for grid in grids], [f"1/{grid}" for grid in grids])
        axes.xaxis.minorticks_off()
        axes.set_yscale("log")
        low, high = axes.get_ylim()
        axes.set_ylim(10 ** np.floor(np.log10(low)), 10 ** np.ceil(np.log10(high)))
        axes.set_xlabel("mean length of a cell, periods (dotted: slope 2)")
        axes.set_ylabel(f"{title}: from the extrapolated, %")
        axes.legend(fontsize=8)
    return svg(figure)


def _times(factor: float) -> Callable[[Any], Any]:
    return lambda value: value * factor


def colour(setting: str) -> str | None:
    """The colour of a model, or of a setting that begins with its name."""
    return COLOURS.get(setting.split("-")[0])


def marker(setting: str) -> str:
    """The marker of a model; a cross for a setting that is not its only one."""
    name, *chosen = setting.split("-")
    return "X" if chosen else MARKERS.get(name, "o")


def svg(figure: Figure) -> str:
    """The figure as SVG text."""
    buffer = io.StringIO()
    figure.savefig(buffer, format="svg", metadata={"Date": None})
    text = buffer.getvalue()
    return text[text.index("<svg") :]

"""The plots of a comparison, by matplotlib, as SVG text."""

import io
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import matplotlib as mpl
from matplotlib.figure import Figure

from rom.comparison import Point, pareto_front
from rom.result import Result
from rom.scene import Scene

COLOURS = {"reynolds": "#7f7f7f", "inertial_reynolds": "#e08214", "stokes": "#5aae61", "navier_stokes": "#2166ac"}
STYLES = {"reynolds": "--", "inertial_reynolds": "-.", "stokes": ":", "navier_stokes": "-"}
MARKERS = {"reynolds": "s", "inertial_reynolds": "D", "stokes": "^", "navier_stokes": "o"}

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
        axes.plot(x, plus, STYLES.get(name, "-"), color=COLOURS.get(name), label=name, linewidth=2)
    for edge in {edge for groove in scene.grooves for edge in groove.span}:
        axes.axvline(edge * 1e3, color="black", linewidth=0.8, linestyle=(0, (4, 3)), alpha=0.6)
    axes.set_xlabel("position along the sliding wall, mm (dashed: groove edges)")
    axes.set_ylabel("p+ = 100 p Ly² / (η u Lx)")
    pascal = scene.pressure_unit / scene.plus_factor
    right = axes.secondary_yaxis("right", functions=(_times(pascal / 1e3), _times(1e3 / pascal)))
    right.set_ylabel("pressure, kPa")
    axes.legend()
    return _svg(figure)


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
    return _svg(figure)


def _times(factor: float) -> Callable[[Any], Any]:
    return lambda value: value * factor


def _svg(figure: Figure) -> str:
    buffer = io.StringIO()
    figure.savefig(buffer, format="svg", metadata={"Date": None})
    text = buffer.getvalue()
    return text[text.index("<svg") :]

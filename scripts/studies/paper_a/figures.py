"""Figures A.3 to A.15 of Paper A from a sweep, each under its number; dots are Navier-Stokes, lines film_slope."""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from roughfilm.figures.base import new_figure
from roughfilm.rom.ladder.result import Result
from scripts.studies.paper_a.data import DEPTHS, NUMBERS, SHAPES, WIDTHS, PaperA, Shape, highest

CYLINDRICAL, AHEAD, LEVEL, BEHIND = SHAPES.values()
LINE = "film_slope"
DEPTH = np.array(DEPTHS)

Onsets = Mapping[tuple[str, float, float], float]


def _colours(count: int) -> NDArray[np.float64]:
    return colormaps["viridis"](np.linspace(0, 0.88, count))


def _panels(count: int, *, height: float = 3.9) -> tuple[Figure, list[Axes]]:
    figure, axes = new_figure((5 * count, height), 1, count, squeeze=False)
    return figure, list(axes[0])


def _pressure(axes: Axes, result: Result, style: str, label: str, **look: Any) -> None:
    """p+ along x+ = 2x/Lx."""
    geometry = result.provenance["scene"]
    x, p = result.fields["position"].values, result.fields["pressure"].values
    plus = result.quantities["load_plus"].value / result.quantities["load_per_area"].value
    length = result.fields["vertices"].values[-1, -1, 0] - result.fields["vertices"].values[0, -1, 0]
    axes.plot(2 * x / length, p * plus, style, label=label, **look)
    axes.set_title(str(geometry["name"]), fontsize=0)
    axes.set(xlabel="x+ = 2x / Lx", ylabel="p+")


def _edges(axes: Axes, width: float) -> None:
    for edge in (-width, width):
        axes.axvline(edge, color="black", lw=0.8, ls=(0, (4, 3)), alpha=0.5)


def _against(
    axes: Axes, paper: PaperA, quantity: str, rows: NDArray[np.int64], key: str, label: str, colour: Any
) -> None:
    """A quantity against w+ or d+: dots by the best model, a line by film_slope."""
    x = paper.sweep.given[key][rows]
    axes.plot(x, paper.of(quantity, rows), "o", color=colour, ms=4, label=label)
    axes.plot(x, paper.of(quantity, rows, LINE), "-", color=colour, lw=1)


def _inertial_pressures(paper: PaperA) -> Figure:
    """Draw the pressure by Navier-Stokes and Stokes."""
    figure, panels = _panels(2)
    for axes, number in zip(panels, (10.0, 160.0), strict=True):
        rows = paper.rows(CYLINDRICAL, width=0.2, depth=0.25, number=number)
        _pressure(axes, paper.result(rows, paper.best), "-", "Navier-Stokes")
        _pressure(axes, paper.result(rows, paper.stokes), "--", "Stokes")
        _edges(axes, 0.2)
        axes.set_title(f"Re = {number:g}", fontsize=10)
        axes.legend()
    return figure


def _inertial_loads(paper: PaperA) -> Figure:
    """Draw the load by Navier-Stokes and Stokes."""
    figure, panels = _panels(2)
    for axes, number in zip(panels, (10.0, 160.0), strict=True):
        rows = paper.rows(CYLINDRICAL, depth=0.25, number=number)
        _against(axes, paper, "load_plus", rows, "width_plus", "Navier-Stokes (line: film_slope)", "C0")
        stokes = np.abs(paper.of("load_plus", rows, paper.stokes))
        axes.plot(paper.sweep.given["width_plus"][rows], stokes, "s", color="C2", ms=4, label="Stokes, size")
        axes.set_title(f"Re = {number:g}", fontsize=10)
        axes.set(yscale="log", xlabel="w+", ylabel="Fy+")
        axes.legend()
    return figure


def _pressures(cases: Sequence[tuple[str, Shape, float, float]], paper: PaperA) -> Figure:
    """Draw the pressure for four Re: a panel for each title, shape, w+ and d+."""
    figure, panels = _panels(3)
    for axes, (title, shape, width, depth) in zip(panels, cases, strict=True):
        for number, colour in zip(NUMBERS, _colours(4), strict=True):
            rows = paper.rows(shape, width=width, depth=depth, number=number)
            _pressure(axes, paper.result(rows, paper.best), "-", f"Re = {number:g}", color=colour)
        _edges(axes, width)
        axes.set_title(title, fontsize=10)
    panels[0].legend()
    return figure


def _load_by_width(paper: PaperA) -> Figure:
    figure, panels = _panels(2)
    for axes, name in zip(panels, ("cylindrical", "splined, xd+ = 0"), strict=True):
        for number, colour in zip(NUMBERS, _colours(4), strict=True):
            rows = paper.rows(SHAPES[name], depth=0.25, number=number)
            _against(axes, paper, "load_plus", rows, "width_plus", f"Re = {number:g}", colour)
        _labels(axes, "w+", "Fy+", name)
    return figure


def _splined_loads(paper: PaperA) -> Figure:
    figure, panels = _panels(2)
    for axes, fixed, key, x in zip(
        panels, ({"depth": 0.25}, {"width": 0.15}), ("width_plus", "depth_plus"), ("w+", "d+"), strict=True
    ):
        for shape, colour in zip((AHEAD, LEVEL, BEHIND), _colours(3), strict=True):
            rows = paper.rows(shape, **fixed, number=40)
            _against(axes, paper, "load_plus", rows, key, f"xd+ = {shape[1]:g}", colour)
        ((name, value),) = fixed.items()
        _labels(axes, x, "Fy+", f"Re = 40, {name[0]}+ = {value:g}")
    return figure


def _friction(paper: PaperA) -> Figure:
    figure, panels = _panels(2)
    for axes, name in zip(panels, ("cylindrical", "splined, xd+ = 0"), strict=True):
        for width, colour in zip(WIDTHS, _colours(len(WIDTHS)), strict=True):
            for number, style in ((40.0, "o-"), (160.0, "s--")):
                rows = paper.rows(SHAPES[name], width=width, number=number)
                label = f"w+ = {width:g}" if number == 40 else None
                axes.plot(DEPTH, paper.of("friction_plus", rows), style, color=colour, ms=3, lw=1, label=label)
        _labels(axes, "d+", "Fx+", name)
    panels[1].set_ylim(panels[0].get_ylim())
    return figure


def _loads(number: float, paper: PaperA) -> Figure:
    """Draw the load against d+ for every w+; a tick is at the greatest load."""
    figure, panels = _panels(2, height=4.6)
    for axes, name in zip(panels, ("cylindrical", "splined, xd+ = -0.3"), strict=True):
        for width, colour in zip(WIDTHS, _colours(len(WIDTHS)), strict=True):
            rows = paper.rows(SHAPES[name], width=width, number=number)
            _against(axes, paper, "load_plus", rows, "depth_plus", f"w+ = {width:g}", colour)
            if paper.upwind is not None:
                axes.plot(DEPTH, paper.of("load_plus", rows, paper.upwind), ":", color=colour, lw=1.2)
            best = highest(DEPTH, paper.of("load_plus", rows))
            axes.plot(best, np.interp(best, DEPTH, paper.of("load_plus", rows)), "|", color=colour, ms=14)
        _labels(axes, "d+", "Fy+", f"{name}, Re = {number:g}")
    limits = [axes.get_ylim() for axes in panels]
    for axes in panels:
        axes.set_ylim(min(low for low, _ in limits), max(high for _, high in limits))
    return figure


def onset(paper: PaperA, onsets: Onsets) -> Figure:
    """The depth at which back-flow begins, and the depth of the greatest load, over w+ for each Re and shape."""
    figure, panels = new_figure((15, 3.9), 1, len(SHAPES), sharey=True)
    for axes, (name, shape) in zip(panels, SHAPES.items(), strict=True):
        for number, colour in zip(NUMBERS, _colours(4), strict=True):
            begins = [onsets[name, width, number] for width in WIDTHS]
            loads = paper.table(shape, "load_plus", number)
            axes.plot(
                WIDTHS, np.where(np.isfinite(begins), begins, np.nan), "-", color=colour, label=f"Re = {number:g}"
            )
            axes.plot(WIDTHS, [highest(DEPTH, line) for line in loads], "o", color=colour, ms=4)
        _labels(axes, "w+", "d+", name)
    return figure


def scheme(paper: PaperA) -> Figure:
    """How much more load first-order upwind gives than second order, per cent, against d+, for three w+."""
    figure, panels = _panels(2)
    if paper.upwind is None:
        return figure
    for axes, number in zip(panels, (40.0, 160.0), strict=True):
        for width, colour in zip((0.15, 0.3, 0.5), _colours(3), strict=True):
            rows = paper.rows(CYLINDRICAL, width=width, number=number)
            more = paper.of("load_plus", rows, paper.upwind) / paper.of("load_plus", rows) - 1
            axes.plot(DEPTH, 100 * more, "o-", color=colour, label=f"w+ = {width:g}")
        _labels(axes, "d+", "load by upwind against second order, %", f"cylindrical, Re = {number:g}")
    return figure


def _labels(axes: Axes, x: str, y: str, title: str) -> None:
    axes.set_title(title, fontsize=10)
    axes.set(xlabel=x, ylabel=y)
    axes.legend(fontsize=8)


DRAWINGS: dict[str, Callable[[PaperA], Figure]] = {
    "A.3": _inertial_pressures,
    "A.4": _inertial_loads,
    "A.5": partial(_pressures, [(f"d+ = {depth:g}", CYLINDRICAL, 0.3, depth) for depth in (0.25, 0.75, 1.25)]),
    "A.6": partial(_pressures, [(f"xd+ = {shape[1]:g}", shape, 0.5, 0.25) for shape in (AHEAD, LEVEL, BEHIND)]),
    "A.11": _load_by_width,
    "A.12": _splined_loads,
    "A.13": _friction,
    "A.14": partial(_loads, 40.0),
    "A.15": partial(_loads, 160.0),
    "scheme": scheme,
}

STREAMLINES: dict[str, tuple[tuple[str, str, float, float, float], ...]] = {
    "A.7": tuple((f"d+ = {depth:g}", "navier_stokes", 0.2, depth, 40.0) for depth in (0.5, 0.75, 1.0, 1.25)),
    "A.8": tuple((f"Re = {number:g}", "navier_stokes", 0.15, 0.25, number) for number in NUMBERS),
    "A.9": tuple((f"w+ = {width:g}", "navier_stokes", width, 0.75, 40.0) for width in (0.15, 0.25, 0.35, 0.45)),
    "A.10": tuple(
        (f"d+ = {depth:g}, {'with' if model == 'navier_stokes' else 'without'} inertia", model, 0.15, depth, 160.0)
        for depth in (0.5, 1.0)
        for model in ("navier_stokes", "stokes")
    ),
}
"""Title, model, w+, d+ and Re of every picture, cylindrical."""

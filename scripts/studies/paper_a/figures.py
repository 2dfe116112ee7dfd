"""Figures A.3 to A.15 of Paper A from a sweep, each under its number; dots are Navier-Stokes, lines film_slope."""

from collections.abc import Callable, Mapping, Sequence
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


def a3(paper: PaperA) -> Figure:
    """Pressure by Navier-Stokes and Stokes, cylindrical, w+ = 0.2, d+ = 0.25, Re = 10 and 160."""
    figure, panels = _panels(2)
    for axes, number in zip(panels, (10.0, 160.0), strict=True):
        rows = paper.rows(CYLINDRICAL, width=0.2, depth=0.25, number=number)
        _pressure(axes, paper.result(rows, paper.best), "-", "Navier-Stokes")
        _pressure(axes, paper.result(rows, paper.stokes), "--", "Stokes")
        _edges(axes, 0.2)
        axes.set_title(f"Re = {number:g}", fontsize=10)
        axes.legend()
    return figure


def a4(paper: PaperA) -> Figure:
    """Load against w+ by Navier-Stokes and Stokes, cylindrical, d+ = 0.25, Re = 10 and 160; logarithmic."""
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


def _pressures(paper: PaperA, cases: Sequence[tuple[str, Shape, float, float]]) -> Figure:
    figure, panels = _panels(3)
    for axes, (title, shape, width, depth) in zip(panels, cases, strict=True):
        for number, colour in zip(NUMBERS, _colours(4), strict=True):
            rows = paper.rows(shape, width=width, depth=depth, number=number)
            _pressure(axes, paper.result(rows, paper.best), "-", f"Re = {number:g}", color=colour)
        _edges(axes, width)
        axes.set_title(title, fontsize=10)
    panels[0].legend()
    return figure


def a5(paper: PaperA) -> Figure:
    """Pressure, cylindrical, w+ = 0.3, three depths, four Re."""
    return _pressures(paper, [(f"d+ = {depth:g}", CYLINDRICAL, 0.3, depth) for depth in (0.25, 0.75, 1.25)])


def a6(paper: PaperA) -> Figure:
    """Pressure, splined, w+ = 0.5, d+ = 0.25, three xd+, four Re."""
    return _pressures(paper, [(f"xd+ = {shape[1]:g}", shape, 0.5, 0.25) for shape in (AHEAD, LEVEL, BEHIND)])


def a11(paper: PaperA) -> Figure:
    """Load against w+ at d+ = 0.25: cylindrical, and splined with xd+ = 0."""
    figure, panels = _panels(2)
    for axes, (title, shape) in zip(panels, (("cylindrical", CYLINDRICAL), ("splined, xd+ = 0", LEVEL)), strict=True):
        for number, colour in zip(NUMBERS, _colours(4), strict=True):
            rows = paper.rows(shape, depth=0.25, number=number)
            _against(axes, paper, "load_plus", rows, "width_plus", f"Re = {number:g}", colour)
        _labels(axes, "w+", "Fy+", title)
    return figure


def a12(paper: PaperA) -> Figure:
    """Load of the splined grooves at Re = 40: against w+ at d+ = 0.25, and against d+ at w+ = 0.15."""
    figure, panels = _panels(2)
    for shape, colour in zip((AHEAD, LEVEL, BEHIND), _colours(3), strict=True):
        rows = paper.rows(shape, depth=0.25, number=40)
        _against(panels[0], paper, "load_plus", rows, "width_plus", f"xd+ = {shape[1]:g}", colour)
        rows = paper.rows(shape, width=0.15, number=40)
        _against(panels[1], paper, "load_plus", rows, "depth_plus", f"xd+ = {shape[1]:g}", colour)
    _labels(panels[0], "w+", "Fy+", "Re = 40, d+ = 0.25")
    _labels(panels[1], "d+", "Fy+", "Re = 40, w+ = 0.15")
    return figure


def a13(paper: PaperA) -> Figure:
    """Friction against d+ for every w+: full at Re = 40, dashed at Re = 160."""
    figure, panels = _panels(2)
    for axes, (title, shape) in zip(panels, (("cylindrical", CYLINDRICAL), ("splined, xd+ = 0", LEVEL)), strict=True):
        for width, colour in zip(WIDTHS, _colours(len(WIDTHS)), strict=True):
            for number, style in ((40.0, "o-"), (160.0, "s--")):
                rows = paper.rows(shape, width=width, number=number)
                label = f"w+ = {width:g}" if number == 40 else None
                axes.plot(DEPTH, paper.of("friction_plus", rows), style, color=colour, ms=3, lw=1, label=label)
        _labels(axes, "d+", "Fx+", title)
    panels[1].set_ylim(panels[0].get_ylim())
    return figure


def _loads(paper: PaperA, number: float) -> Figure:
    figure, panels = _panels(2, height=4.6)
    shapes = (("cylindrical", CYLINDRICAL), ("splined, xd+ = -0.3", AHEAD))
    for axes, (title, shape) in zip(panels, shapes, strict=True):
        for width, colour in zip(WIDTHS, _colours(len(WIDTHS)), strict=True):
            rows = paper.rows(shape, width=width, number=number)
            _against(axes, paper, "load_plus", rows, "depth_plus", f"w+ = {width:g}", colour)
            if paper.upwind is not None:
                axes.plot(DEPTH, paper.of("load_plus", rows, paper.upwind), ":", color=colour, lw=1.2)
            best = highest(DEPTH, paper.of("load_plus", rows))
            axes.plot(best, np.interp(best, DEPTH, paper.of("load_plus", rows)), "|", color=colour, ms=14)
        _labels(axes, "d+", "Fy+", f"{title}, Re = {number:g}")
    limits = [axes.get_ylim() for axes in panels]
    for axes in panels:
        axes.set_ylim(min(low for low, _ in limits), max(high for _, high in limits))
    return figure


def a14(paper: PaperA) -> Figure:
    """Load against d+ at Re = 40 for every w+: cylindrical, and splined with xd+ = -0.3."""
    return _loads(paper, 40.0)


def a15(paper: PaperA) -> Figure:
    """Load against d+ at Re = 160 for every w+: cylindrical, and splined with xd+ = -0.3."""
    return _loads(paper, 160.0)


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


NUMBERED: dict[str, Callable[[PaperA], Figure]] = {
    "A.3": a3,
    "A.4": a4,
    "A.5": a5,
    "A.6": a6,
    "A.11": a11,
    "A.12": a12,
    "A.13": a13,
    "A.14": a14,
    "A.15": a15,
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

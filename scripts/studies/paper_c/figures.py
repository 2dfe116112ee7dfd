"""Figures C.4 to C.13 of Paper C; A to D are profiles made to its table, S is smooth."""

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.parameters.bearing_curve import bearing_curve
from roughfilm.rom.homogenization.node_sums import Rule
from scripts.studies.paper_c.data import ALPHAS, BESIDE, RANGE, WAYS, PaperC
from scripts.studies.paper_c.films import LOADS, SMOOTH
from scripts.studies.paper_d.figures import COLOURS as PROFILE_COLOURS

COLOURS = {SMOOTH: "#1d2530"} | PROFILE_COLOURS
RULES = {Rule.DIFFERENCES: "#5aae61", Rule.TRAPEZOID: "#2166ac", Rule.SIMPSON: "#b2182b"}
PLACES = {0: ("-", "points are nodes"), BESIDE: ("--", "nodes beside points")}
FACTORS = ("φx", "φs")


def _panels(rows: int, columns: int, height: float = 3.5, *, same: bool = False) -> tuple[Figure, list[Axes]]:
    figure = Figure(figsize=((5 if columns < 3 else 3.9) * columns, height * rows), layout="constrained")
    return figure, list(figure.subplots(rows, columns, squeeze=False, sharey="row" if same else False).ravel())


def _powers(axis: Axis, base: int) -> None:
    """Label ticks with powers: 2¹⁰, 10⁻⁴."""
    raised = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
    axis.set_major_formatter(lambda value, _: f"{base}{str(round(math.log(value, base))).translate(raised)}")
    axis.set_minor_formatter(NullFormatter())


def _logarithmic(axes: Axes) -> None:
    axes.set_yscale("log")
    _powers(axes.yaxis, 10)


def _nodes(axes: Axes) -> None:
    axes.set_xscale("log", base=2)
    _powers(axes.xaxis, 2)
    _logarithmic(axes)
    axes.set_xlabel("nodes N")


def c4(paper: PaperC) -> Figure:
    """Bearing curves: r in µm, and G = 1 − r/rmax, whose mean is 1 and whose least is 0."""
    figure, (left, right) = _panels(1, 2)
    for name, made in paper.profiles.items():
        heights = made[0]
        ratio, height = bearing_curve(heights)
        left.plot(100 * ratio, 1e6 * height, color=COLOURS[name], label=name)
        right.plot(100 * ratio, 1 - height / heights.max(), color=COLOURS[name])
    left.set_ylabel("r, µm")
    right.set_ylabel("G")
    for axes in (left, right):
        axes.set_xlabel("part of the profile above, %")
    left.legend()
    return figure


def c5(paper: PaperC) -> Figure:
    """Profile A at α = 0.98: change from N/2 to N nodes (above), and error against the closed form (below).

    The paper's figure is the upper one. Dashed: four nodes fewer, so that they lie beside the points of the profile.
    """
    figure, panels = _panels(2, 2)
    study = paper.convergence["A", ALPHAS[-1]]
    for i, factor in enumerate(FACTORS):
        for rule, left_out in study.found:
            colour, (style, place) = RULES[rule], PLACES[left_out]
            changes, errors = study.changes(rule, left_out)[0, :, i], study.errors(rule, left_out)[0, :, i]
            panels[i].plot(study.nodes[1:], changes, style, color=colour, label=f"{rule}, {place}", lw=1.6)
            panels[2 + i].plot(study.nodes, errors, style, color=colour, lw=1.6)
        panels[i].set_ylabel(f"change of {factor}")
        panels[2 + i].set_ylabel(f"error of {factor}")
    for axes in panels:
        _nodes(axes)
    panels[0].legend(fontsize=8)
    return figure


def c6(paper: PaperC) -> Figure:
    """Change from N/2 to N nodes by Simpson's rule at α = 0.49 (above), 0.98 (below); dashed: nodes beside points."""
    figure, panels = _panels(2, 2, same=True)
    for row, alpha in enumerate(ALPHAS):
        for i, factor in enumerate(FACTORS):
            axes = panels[2 * row + i]
            for name in paper.profiles:
                study = paper.convergence[name, alpha]
                for left_out, (style, _) in PLACES.items():
                    values = np.maximum(study.changes(Rule.SIMPSON, left_out)[0, :, i], 1e-15)
                    label = name if style == "-" else ""
                    axes.plot(study.nodes[1:], values, style, color=COLOURS[name], label=label, lw=1.4)
            axes.set_title(f"α = {alpha}", fontsize=10)
            axes.set_ylabel(f"change of {factor}")
            _nodes(axes)
    panels[0].legend()
    return figure


def c7(paper: PaperC) -> Figure:
    """Standard deviation of φx over a profile and six rearrangements of it, integrated in three ways.

    Sums over the 512 heights are the same to rounding; straight lines between them are not, unless the profile was
    refined before it was rearranged, as in the paper.
    """
    figure, panels = _panels(1, 3, same=True)
    for axes, way in zip(panels, WAYS, strict=True):
        for name in paper.profiles:
            deviation = np.maximum(paper.shuffled[name, way].std(axis=0)[:, 0], 1e-17)
            axes.plot(RANGE, deviation, color=COLOURS[name], label=name, lw=1.4)
        _logarithmic(axes)
        axes.set_title(way, fontsize=10)
        axes.set_xlabel("α")
    panels[0].set_ylabel("standard deviation of φx")
    panels[0].legend()
    return figure


def c8(paper: PaperC) -> Figure:
    """Flow factors over α; bands: from the least to the greatest of the seeds, visible near contact only (insets)."""
    figure, panels = _panels(1, 2, 4.2)
    for i, (axes, factor) in enumerate(zip(panels, FACTORS, strict=True)):
        inset = axes.inset_axes((0.1, 0.1, 0.42, 0.42))
        for name, values in paper.factors.items():
            for one in (axes, inset):
                one.plot(RANGE, values[:, :, i].mean(axis=0), color=COLOURS[name], label=name, lw=1.5)
                low, high = values[:, :, i].min(axis=0), values[:, :, i].max(axis=0)
                one.fill_between(RANGE, low, high, color=COLOURS[name], alpha=0.2, lw=0)
        axes.set(xlim=(0, 1), ylim=(0, 1.02))
        inset.set(xlim=(0.95, 1), ylim=(0, (0.16, 0.34)[i]))
        inset.tick_params(labelsize=8)
        axes.set(xlabel="α = rmax/ĥ", ylabel=factor)
    panels[0].legend(loc="upper right")
    return figure


def c9(paper: PaperC) -> Figure:
    """Change of the load from N/2 to N nodes, ĥ = 6 to 5 µm; the paper has below 2.8·10⁻⁵ at 2¹⁶ (grey)."""
    figure, panels = _panels(1, 2, 3.8, same=True)
    nodes = 2.0 ** np.array(paper.powers)
    for axes, rule in zip(panels, (Rule.SIMPSON, Rule.TRAPEZOID), strict=True):
        for name in paper.profiles:
            for left_out, (style, _) in PLACES.items():
                loads = paper.loads[name, rule, left_out]
                change = np.abs(2 * np.diff(loads) / (loads[1:] + loads[:-1]))
                label = name if style == "-" else ""
                axes.plot(nodes[1:], np.maximum(change, 1e-15), style, color=COLOURS[name], label=label, lw=1.4)
        axes.plot([2**16], [2.8e-5], "v", color="#5b6675", ms=8)
        axes.set_title(f"{rule} rule" if rule is Rule.TRAPEZOID else f"{rule}'s rule", fontsize=10)
        _nodes(axes)
    panels[0].set_ylabel("change of load")
    panels[0].legend()
    return figure


def _pressures(paper: PaperC, figure_name: str) -> Figure:
    figure, (axes,) = _panels(1, 1, 3.9)
    figure.set_size_inches(8, 3.9)
    for name, film in paper.films[figure_name].items():
        axes.plot(film.x, film.pressure / 1e6, color=COLOURS[name], label=name, lw=1.6)
    axes.set(xlabel="x, m", ylabel="p, MPa", xlim=(0, film.x[-1]), ylim=(0, None))
    axes.legend()
    return figure


def c10(paper: PaperC) -> Figure:
    """Pressure at equal h0 = 3.4 to 3.0 µm, from the highest points."""
    return _pressures(paper, "C.10")


def c11(paper: PaperC) -> Figure:
    """Pressure at equal mean ĥ = 4.4 to 4.0 µm."""
    return _pressures(paper, "C.11")


def c12(paper: PaperC) -> Figure:
    """Pressure at equal Λ = min h0/Rq = 10, narrowing by 0.4 µm."""
    return _pressures(paper, "C.12")


def c13(paper: PaperC) -> Figure:
    """Films min h0 and Λ over load, the film narrowing by 1 µm: on the paper's axes, and beyond them (right)."""
    figure, (left, middle, right) = _panels(1, 3, 3.9)
    loads = np.geomspace(LOADS[0], 1e8, 200)
    for name, curves in paper.curves.items():
        clearance = curves[0].at(loads)
        for axes in (left, right):
            axes.plot(loads / 1e5, 1e6 * clearance, color=COLOURS[name], label=name, lw=1.6)
        if name != SMOOTH:
            middle.plot(loads / 1e5, clearance / curves[0].rms, color=COLOURS[name], lw=1.6)
    _range(left, (0, 10), (5, 25), "min h0, µm")
    _range(middle, (0, 10), (0, 130), "Λ")
    right.set_xscale("log")
    _powers(right.xaxis, 10)
    _logarithmic(right)
    _range(right, (LOADS[0] / 1e5, 1000), (0.02, 30), "min h0, µm")
    left.legend()
    return figure


def _range(axes: Axes, x: tuple[float, float], y: tuple[float, float], label: str) -> None:
    axes.set(xlim=x, ylim=y, xlabel="W, 10⁵ N/m", ylabel=label)


NUMBERED = {
    f"C.{number}": draw for number, draw in zip(range(4, 14), (c4, c5, c6, c7, c8, c9, c10, c11, c12, c13), strict=True)
}


def claim_14(paper: PaperC) -> Figure:
    """Films min h0 of random profiles at 5·10⁵ N/m over Ra, Rq and rmax: only the last one orders them."""
    figure, panels = _panels(1, 3, 3.9, same=True)
    load = LOADS.index(5e5)
    for axes, number in zip(panels, ("Ra", "Rq", "rmax"), strict=True):
        _scatter(axes, [paper.orderings[kind].numbers[number] for kind in paper.orderings], paper, load)
        axes.set_xlabel(f"{number}, µm")
    panels[0].set_ylabel("min h0, µm")
    panels[0].legend()
    return figure


def _scatter(axes: Axes, values: Sequence[Array], paper: PaperC, load: int) -> None:
    marks = zip(paper.orderings.items(), values, ("#2166ac", "#b2182b"), strict=True)
    for (kind, ordering), rough, colour in marks:
        axes.plot(1e6 * rough, 1e6 * ordering.clearance[:, load], ".", color=colour, label=kind, ms=5, alpha=0.8)

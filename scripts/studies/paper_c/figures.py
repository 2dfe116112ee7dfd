"""Figures C.4 to C.13 of Paper C; A to D are synthetic profiles with the numbers of its table, S is smooth."""

import math
from collections.abc import Callable
from functools import partial
from itertools import product

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.parameters.bearing_curve import bearing_curve
from roughfilm.figures.base import new_figure
from roughfilm.rom.homogenization.node_sums import Rule
from scripts.studies.paper_c.data import ALPHAS, BESIDE, RANGE, WAYS, PaperC
from scripts.studies.paper_c.films import LOADS, SMOOTH
from scripts.studies.paper_d.figures import COLOURS as PROFILE_COLOURS

COLOURS = {SMOOTH: "#1d2530"} | PROFILE_COLOURS
RULES = {Rule.DIFFERENCES: "#5aae61", Rule.TRAPEZOID: "#2166ac", Rule.SIMPSON: "#b2182b"}
PLACES = {0: ("-", "points are nodes"), BESIDE: ("--", "nodes beside points")}
FACTORS = ("φx", "φs")


def _panels(rows: int, columns: int, height: float = 3.5, *, same: bool = False) -> tuple[Figure, list[Axes]]:
    size = (5 if columns < 3 else 3.9) * columns, height * rows
    figure, panels = new_figure(size, rows, columns, squeeze=False, sharey="row" if same else False)
    return figure, list(panels.ravel())


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


def _bearing_curves(paper: PaperC) -> Figure:
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


def _profile_a(paper: PaperC) -> Figure:
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


def _change(axes: Axes, name: str, left_out: int, nodes: Array, values: Array) -> None:
    """Draw the change of a value of one profile from N/2 to N nodes."""
    style, _ = PLACES[left_out]
    label = name if style == "-" else ""
    axes.plot(nodes[1:], np.maximum(values, 1e-15), style, color=COLOURS[name], label=label, lw=1.4)


def _changes(paper: PaperC) -> Figure:
    figure, panels = _panels(2, 2, same=True)
    for axes, (alpha, (i, factor)) in zip(panels, product(ALPHAS, enumerate(FACTORS)), strict=True):
        for name, left_out in product(paper.profiles, PLACES):
            study = paper.convergence[name, alpha]
            _change(axes, name, left_out, study.nodes, study.changes(Rule.SIMPSON, left_out)[0, :, i])
        axes.set_title(f"α = {alpha}", fontsize=10)
        axes.set_ylabel(f"change of {factor}")
        _nodes(axes)
    panels[0].legend()
    return figure


def _rearranged(paper: PaperC) -> Figure:
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


def _factors(paper: PaperC) -> Figure:
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


def _load_changes(paper: PaperC) -> Figure:
    figure, panels = _panels(1, 2, 3.8, same=True)
    nodes = 2.0 ** np.array(paper.powers)
    for axes, rule in zip(panels, (Rule.SIMPSON, Rule.TRAPEZOID), strict=True):
        for name, left_out in product(paper.profiles, PLACES):
            loads = paper.loads[name, rule, left_out]
            _change(axes, name, left_out, nodes, np.abs(2 * np.diff(loads) / (loads[1:] + loads[:-1])))
        axes.plot([2**16], [2.8e-5], "v", color="#5b6675", ms=8)
        axes.set_title(f"{rule} rule" if rule is Rule.TRAPEZOID else f"{rule}'s rule", fontsize=10)
        _nodes(axes)
    panels[0].set_ylabel("change of load")
    panels[0].legend()
    return figure


def _pressures(figure_name: str, paper: PaperC) -> Figure:
    figure, axes = new_figure((8, 3.9))
    for name, film in paper.films[figure_name].items():
        axes.plot(film.x, film.pressure / 1e6, color=COLOURS[name], label=name, lw=1.6)
    axes.set(xlabel="x, m", ylabel="p, MPa", xlim=(0, film.x[-1]), ylim=(0, None))
    axes.legend()
    return figure


def _films_by_load(paper: PaperC) -> Figure:
    figure, (left, middle, right) = _panels(1, 3, 3.9)
    loads = np.geomspace(LOADS[0], 1e8, 200)
    for name, curves in paper.curves.items():
        clearance = curves[0].at(loads)
        for axes in (left, right):
            axes.plot(loads / 1e5, 1e6 * clearance, color=COLOURS[name], label=name, lw=1.6)
        if name != SMOOTH:
            middle.plot(loads / 1e5, clearance / curves[0].rms, color=COLOURS[name], lw=1.6)
    left.set(xlim=(0, 10), ylim=(5, 25), xlabel="W, 10⁵ N/m", ylabel="min h0, µm")
    middle.set(xlim=(0, 10), ylim=(0, 130), xlabel="W, 10⁵ N/m", ylabel="Λ")
    right.set_xscale("log")
    _powers(right.xaxis, 10)
    _logarithmic(right)
    right.set(xlim=(LOADS[0] / 1e5, 1000), ylim=(0.02, 30), xlabel="W, 10⁵ N/m", ylabel="min h0, µm")
    left.legend()
    return figure


def _random_films(paper: PaperC) -> Figure:
    figure, panels = _panels(1, 3, 3.9, same=True)
    load = LOADS.index(5e5)
    for axes, number in zip(panels, ("Ra", "Rq", "rmax"), strict=True):
        for (kind, ordering), colour in zip(paper.orderings.items(), ("#2166ac", "#b2182b"), strict=True):
            x, y = 1e6 * ordering.numbers[number], 1e6 * ordering.clearance[:, load]
            axes.plot(x, y, ".", color=colour, label=kind, ms=5, alpha=0.8)
        axes.set_xlabel(f"{number}, µm")
    panels[0].set_ylabel("min h0, µm")
    panels[0].legend()
    return figure


DRAWINGS: dict[str, Callable[[PaperC], Figure]] = {
    "C.4": _bearing_curves,
    "C.5": _profile_a,
    "C.6": _changes,
    "C.7": _rearranged,
    "C.8": _factors,
    "C.9": _load_changes,
    "C.10": partial(_pressures, "C.10"),
    "C.11": partial(_pressures, "C.11"),
    "C.12": partial(_pressures, "C.12"),
    "C.13": _films_by_load,
    "claim 14": _random_films,
}

"""The figures of the report on rough gaps, by matplotlib."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from roughfilm.contact.foundation.arrays import Array
from roughfilm.figures.base import new_figure
from roughfilm.figures.views.rough_gap import STYLES
from scripts.studies.rough_gaps.data import NAMES, GapComparison, best
from scripts.studies.rough_gaps.inertia import LEVELS, RIDGES, InertialLoss
from scripts.studies.rough_gaps.map import MODELS
from scripts.studies.rough_gaps.range_of_validity import SurfaceValidity
from scripts.studies.rough_gaps.study import MAX_FITTED_SLOPE, RoughGapStudy
from scripts.studies.rough_gaps.waves import MARKED, Wave, bare_coefficient

COLOURS = ("#2166ac", "#e08214", "#762a83", "#1b7837", "#b2182b", "#01665e", "#8c510a", "#c51b7d")

TITLES = {
    "A11": "flow across the crests, A₁₁",
    "A22": "flow along the crests, A₂₂",
    "B1": "dragged flow, B₁",
    "friction": "friction",
}

LINES: dict[str, dict[str, Any]] = {
    "exact": {"color": "black", "linewidth": 1.4},
    "homogenized": {"color": STYLES["homogenized"].colour, "linewidth": 1.4},
    "slope_corrected": {"color": STYLES["slope_corrected"].colour, "linewidth": 1.4, "linestyle": "--"},
    "perturbed": {"color": "#1b7837", "linewidth": 1.1, "linestyle": ":"},
    "bare": {"color": "#8c97a5", "linewidth": 1.1, "linestyle": "-."},
}


LENGTH_TICKS = [1, 2.5, 5, 10, 20, 40]
MESH: dict[str, Any] = {"color": STYLES["stokes"].colour, "marker": "o", "linestyle": ""}
MESH_BARS: dict[str, Any] = {**MESH, "markersize": 4.5, "capsize": 3}
"""Styles of the results by OpenFOAM."""


def drawings(study: RoughGapStudy) -> Mapping[str, Callable[[RoughGapStudy], Figure]]:
    """Return the functions that draw, by name, for which there are numbers."""
    shown: dict[str, Callable[[RoughGapStudy], Figure]] = {"waves": waves, "others": others}
    if study.random:
        shown["random"] = partial(surfaces, measured=False)
    if study.milled:
        shown["milled"] = partial(surfaces, measured=True)
    if study.inertia.flows:
        shown["inertia"] = inertia
    if study.reach:
        shown |= {"reach": reach, "pixels": pixels}
    if study.map:
        shown["map"] = map_of_models
    return shown


def waves(study: RoughGapStudy) -> Figure:
    """Stokes over Reynolds across the crests, over the length of a wave, and how far the cheap ones are off."""
    amplitudes = sorted({wave.amplitude for wave in study.waves.drawn})
    figure, panels = new_figure(
        (11, 6.4), 2, len(amplitudes), sharex=True, sharey="row", squeeze=False, height_ratios=(1.5, 1)
    )
    for column, amplitude in enumerate(amplitudes):
        ratio, error = panels[:, column]
        _ratio(ratio, study, amplitude)
        _error(error, study, amplitude)
        ratio.set_title(f"amplitude {amplitude:g} of the mean gap", fontsize=10)
        error.set_xlabel("length of a wave over the mean gap, L/h̄")
    panels[0, 0].set_ylabel("Stokes over Reynolds")
    panels[1, 0].set_ylabel("off the exact flow, %")
    figure.legend(handles=_keys(), loc="outside lower center", ncols=6, fontsize=9)
    return figure


def _keys() -> list[Line2D]:
    names = {
        "exact": "exact Stokes flow",
        "homogenized": "Reynolds",
        "slope_corrected": "slope corrected",
        "perturbed": "low waves of any length",
        "bare": "1 − c⟨h′²⟩",
    }
    keys = [Line2D([], [], label=label, **LINES[name]) for name, label in names.items()]
    return [*keys, Line2D([], [], label="OpenFOAM, extrapolated", **MESH)]


def _ticks(axes: Axes, places: list[float]) -> None:
    """Give a logarithmic axis ticks at these places."""
    axes.set_xscale("log")
    axes.set_xticks(places, [f"{place:g}" for place in places])
    axes.xaxis.minorticks_off()


def _dotted(axes: Axes, width: float) -> None:
    """Mark 1 % and 5 %."""
    for level in (1, 5):
        axes.axhline(level, color="black", linewidth=width, linestyle=":")


def _by_slope(study: RoughGapStudy) -> Iterator[tuple[Any, str, SurfaceValidity]]:
    """Yield colour, marker and values of every surface, from gentle to steep."""
    order = sorted(study.reach, key=lambda one: one.slope)
    for colour, one in zip(mpl.colormaps["turbo"](np.linspace(0.05, 0.95, len(order))), order, strict=True):
        yield colour, "o" if one.measured else "s", one


def _of(rows: Sequence[Wave], amplitude: float) -> list[Wave]:
    return sorted((wave for wave in rows if wave.amplitude == amplitude), key=lambda wave: wave.length)


def _ratio(axes: Axes, study: RoughGapStudy, amplitude: float) -> None:
    drawn = _of(study.waves.drawn, amplitude)
    lengths = [wave.length for wave in drawn]
    exact = [(wave.length, wave.exact["A11"]) for wave in drawn if "A11" in wave.exact]
    axes.plot(*np.transpose(exact), **LINES["exact"])
    theory = [wave.found.theory["A11"] for wave in drawn]
    axes.fill_between(lengths, [one.bound for one in theory], 1, color=STYLES["slope_corrected"].colour, alpha=0.10)
    axes.plot(lengths, [one.corrected for one in theory], **LINES["slope_corrected"])
    axes.plot(lengths, [one.perturbed for one in theory], **LINES["perturbed"])
    axes.plot(lengths, [1 - bare_coefficient(amplitude) * wave.slope**2 for wave in drawn], **LINES["bare"])
    for wave in _of(study.waves.resolved, amplitude):
        if (found := wave.found.resolved.get("A11")) is not None:
            axes.errorbar(wave.length, found.value, found.uncertainty, **MESH_BARS)
    for length in MARKED:
        axes.axvline(length, color="#dde2e8", linewidth=0.8, zorder=0)
    _ticks(axes, LENGTH_TICKS)
    axes.set_ylim(0.3, 1.03)


def _error(axes: Axes, study: RoughGapStudy, amplitude: float) -> None:
    drawn = [wave for wave in _of(study.waves.drawn, amplitude) if wave.exact]
    lengths = [wave.length for wave in drawn]
    rows = {
        "slope_corrected": [wave.found.theory["A11"].corrected for wave in drawn],
        "perturbed": [wave.found.theory["A11"].perturbed for wave in drawn],
        "bare": [1 - bare_coefficient(amplitude) * wave.slope**2 for wave in drawn],
    }
    for name, row in rows.items():
        errors = [100 * abs(one / wave.exact["A11"] - 1) for one, wave in zip(row, drawn, strict=True)]
        axes.plot(lengths, np.maximum(errors, 1e-3), **LINES[name])
    reynolds = [100 * abs(1 / wave.exact["A11"] - 1) for wave in drawn]
    axes.plot(lengths, reynolds, **LINES["homogenized"])
    for wave in _of(study.waves.resolved, amplitude):
        if "A11" in wave.exact and (found := wave.found.resolved.get("A11")) is not None:
            error = 100 * abs(found.value / wave.exact["A11"] - 1)
            axes.plot(wave.length, max(error, 1e-3), markersize=4.5, **MESH)
    _dotted(axes, 0.6)
    axes.set(yscale="log", ylim=(1e-3, 100))


def others(study: RoughGapStudy) -> Figure:
    """The other coefficients of the same waves."""
    names = [name for name in NAMES if name != "A11"]
    amplitudes = sorted({wave.amplitude for wave in study.waves.drawn})
    figure, panels = new_figure((11, 3.8), 1, len(names))
    for axes, name in zip(panels, names, strict=True):
        for colour, amplitude in zip(COLOURS, amplitudes, strict=False):
            drawn = _of(study.waves.drawn, amplitude)
            exact = [(wave.length, wave.exact[name]) for wave in drawn if name in wave.exact]
            axes.plot(*np.transpose(exact), color=colour, linewidth=1.4, label=f"a = {amplitude:g} h̄")
            corrected = [wave.found.theory[name].corrected for wave in drawn]
            axes.plot([wave.length for wave in drawn], corrected, color=colour, linestyle="--", linewidth=1)
            for wave in _of(study.waves.resolved, amplitude):
                if (found := wave.found.resolved.get(name)) is not None:
                    axes.errorbar(wave.length, found.value, found.uncertainty, **{**MESH_BARS, "color": colour})
        _ticks(axes, LENGTH_TICKS)
        axes.set_title(TITLES[name], fontsize=10)
        axes.set_xlabel("L/h̄")
    panels[0].set_ylabel("Stokes over Reynolds")
    panels[0].legend(fontsize=8)
    return figure


def surfaces(study: RoughGapStudy, *, measured: bool) -> Figure:
    """Stokes over Reynolds of each gap: mesh and slope correction with their bars, bounds behind them."""
    gaps = study.milled if measured else study.random
    figure, panels = new_figure((11, 1.5 + 0.38 * len(gaps)), 1, 2, sharey=True)
    for axes, name in zip(panels, ("A11", "A22"), strict=True):
        for place, one in enumerate(gaps):
            _row(axes, len(gaps) - 1 - place, one, name)
        axes.set_xlabel(f"Stokes over Reynolds, {'A₁₁' if name == 'A11' else 'A₂₂'}")
        axes.axvline(1, color="black", linewidth=0.6)
        axes.xaxis.set_major_locator(MaxNLocator(6))
    labels = [f"{one.name}\ng′ = {one.slope:.2g}" for one in reversed(gaps)]
    panels[0].set_yticks(range(len(gaps)), labels, fontsize=8)
    keys = [
        Line2D([], [], label="OpenFOAM, extrapolated", **MESH),
        Line2D([], [], color=STYLES["slope_corrected"].colour, marker="D", linestyle="", label="slope corrected"),
        Line2D([], [], color="#1b7837", marker="|", linestyle="", label="low waves of any length"),
        Patch(color=STYLES["slope_corrected"].colour, alpha=0.15, label="between the bounds"),
    ]
    figure.legend(handles=keys, loc="outside lower center", ncols=4, fontsize=9)
    return figure


def _row(axes: Axes, place: float, one: GapComparison, name: str) -> None:
    theory, colour = one.theory[name], STYLES["slope_corrected"].colour
    axes.barh(place, 1 - theory.bound, left=theory.bound, height=0.62, color=colour, alpha=0.15)
    look: dict[str, Any] = {"color": colour, "marker": "D", "markersize": 4, "capsize": 3, "linestyle": ""}
    axes.errorbar(theory.corrected, place - 0.14, xerr=theory.bar, **look)
    axes.plot(theory.perturbed, place, "|", color="#1b7837", markersize=9)
    if name in one.resolved:
        value, bar = best(one, name)
        axes.errorbar(value, place + 0.14, xerr=bar, **MESH_BARS)


def inertia(study: RoughGapStudy) -> Figure:
    """Loss of flow by inertia over Re and over the law of its group."""
    flows, laws = study.inertia.flows, {law.group: law for law in study.inertia.laws}
    measures: dict[str, Callable[[InertialLoss], float]] = {"Re": lambda one: one.reynolds_number}
    if laws:
        measures["by the law of its group, %"] = lambda one: (
            100 * laws[one.group].lost(one) if one.group in laws else np.nan
        )
    names = list(dict.fromkeys(one.name for one in flows))
    colours = mpl.colormaps["turbo"](np.linspace(0.05, 0.95, len(names)))
    figure, grid = new_figure((11, 4.8), 1, len(measures), sharey=True, squeeze=False)
    panels = grid[0]
    style: dict[str, Any] = {"markersize": 4, "linewidth": 1, "capsize": 2, "elinewidth": 0.8}
    for axes, (title, measure) in zip(panels, measures.items(), strict=True):
        for colour, name in zip(colours, names, strict=True):
            own = [one for one in flows if one.name == name]
            marker = "o-" if own[0].group == RIDGES else "s--"
            x, y, bars = np.transpose([(measure(one), 100 * one.lost, 100 * one.bar) for one in own])
            axes.errorbar(x, y, bars, fmt=marker, color=colour, label=name, **style)
        for level in LEVELS:
            axes.axhline(100 * level, color="black", linewidth=0.6, linestyle=":")
        axes.set(xscale="log", yscale="log", ylim=(1e-3, 100), xlabel=title)
    if laws:
        panels[-1].plot((1e-3, 100), (1e-3, 100), color="black", linewidth=1)
        panels[-1].set_xlim(1e-3, 100)
    panels[0].set_ylabel("held back by inertia, % of Stokes flow")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside right upper", fontsize=8)
    return figure


def reach(study: RoughGapStudy) -> Figure:
    """Error of Reynolds' equation for real surfaces, over their rms slope and over the mean gap."""
    figure, (by_slope, by_gap) = new_figure((11, 4.8), 1, 2, sharey=True)
    for colour, marker, one in _by_slope(study):
        errors, bars = (np.array([100 * getattr(off, name) for off in one.found]) for name in ("error", "bar"))
        middle, look = np.median(errors), {"color": colour, "marker": marker}
        ends = [[middle - errors.min()], [errors.max() - middle]]
        by_slope.errorbar(one.slope, middle, yerr=ends, markersize=6, linestyle="", label=one.name, **look)
        gaps = [off.thickness for off in one.found]
        by_gap.plot(gaps, errors, markersize=4, linewidth=1, **look)
        if one.slope < MAX_FITTED_SLOPE:
            by_gap.fill_between(gaps, np.maximum(errors - bars, 1e-7), errors + bars, color=colour, alpha=0.12)
    x = np.geomspace(min(one.slope for one in study.reach) / 2, 1, 30)
    if study.factors:
        factor = float(np.median(study.factors))
        by_slope.plot(x, 100 * factor * x**2, "--", color="black", linewidth=1, label=f"{factor:.2g} g′²")
    for axes in (by_slope, by_gap):
        _dotted(axes, 0.7)
        axes.set(xscale="log", yscale="log", ylim=(3e-6, 3000))
    by_slope.set(xlabel="rms slope g′", ylabel="excess of Reynolds flow, % of Stokes flow")
    by_gap.set_xlabel("mean gap over rms height, h̄/Sq")
    _ticks(by_gap, [2, 3, 5, 10, 20, 30])
    figure.legend(loc="outside right upper", fontsize=8)
    return figure


def pixels(study: RoughGapStudy) -> Figure:
    """The rms slope over the pixel, and the error over that slope, on coarser and coarser grids."""
    figure, (left, right) = new_figure((11, 3.8), 1, 2)
    for colour, marker, one in _by_slope(study):
        pixel, slope, error = np.transpose([(grid.pixel, grid.slope, grid.error) for grid in one.coarser])
        look = {"color": colour, "marker": marker, "markersize": 4, "linewidth": 1, "label": one.name}
        left.plot(pixel * 1e6, slope, **look)
        right.plot(slope, 100 * error, **look)
    for axes in (left, right):
        axes.set(xscale="log", yscale="log")
    _dotted(right, 0.7)
    left.set(xlabel="pixel, µm", ylabel="rms slope g′")
    right.set(xlabel="rms slope g′ on that pixel", ylabel="off at twice the highest point, %")
    return figure


def map_of_models(study: RoughGapStudy) -> Figure:
    """The cheapest model that is accurate enough, over slope and wavelength."""
    figure, panels = new_figure((11, 4.4), 1, 2, sharey=True)
    slopes, lengths = (sorted({getattr(one, name) for one in study.map}) for name in ("slope", "length"))
    colours = ListedColormap([STYLES[name].colour or "black" for name in MODELS])
    for axes, level in zip(panels, LEVELS, strict=True):
        cheapest = np.full((len(slopes), len(lengths)), np.nan)
        for one in study.map:
            cheapest[slopes.index(one.slope), lengths.index(one.length)] = MODELS.index(one.cheapest(level))
        axes.pcolormesh(
            _edges(lengths), _edges(slopes), cheapest, cmap=colours, alpha=0.75,
            norm=BoundaryNorm(np.arange(len(MODELS) + 1) - 0.5, len(MODELS)), rasterized=True,
        )  # fmt: skip
        axes.grid(visible=False)
        axes.set_facecolor("#f0f2f5")
        axes.set(xscale="log", yscale="log")
        _ticks(axes, [2, 5, 10, 20, 50])
        axes.set_title(f"within {100 * level:.0f} %", fontsize=10)
        axes.set_xlabel("wavelength over mean gap, λ/h̄")
    panels[0].set_ylabel("rms slope g′")
    keys = [Patch(color=STYLES[name].colour, alpha=0.75, label=name) for name in MODELS]
    keys.append(Patch(color="#f0f2f5", label="waves as high as the gap"))
    figure.legend(handles=keys, loc="outside lower center", ncols=5, fontsize=9)
    return figure


def _edges(values: Sequence[float]) -> Array:
    logs = np.log(values)
    middle = (logs[1:] + logs[:-1]) / 2
    return np.asarray(np.exp(np.concatenate([[2 * logs[0] - middle[0]], middle, [2 * logs[-1] - middle[-1]]])))

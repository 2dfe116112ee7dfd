"""The figures of the report on rough gaps, by matplotlib."""

from collections.abc import Callable, Mapping, Sequence
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
from scripts.studies.rough_gaps.map import RUNGS
from scripts.studies.rough_gaps.study import STEEP, RoughGapStudy
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
        shown["map"] = map_of_rungs
    return shown


def waves(study: RoughGapStudy) -> Figure:
    """Stokes over Reynolds across the crests, over the length of a wave, and how far the cheap ones are off."""
    amplitudes = sorted({wave.amplitude for wave in study.waves.drawn})
    figure, panels = new_figure(
        (11, 6.4), 2, len(amplitudes), sharex=True, sharey="row", squeeze=False, height_ratios=(1.5, 1)
    )
    for column, amplitude in enumerate(amplitudes):
        ratio, error = panels[:, column]
        _ratio(ratio, study, amplitude, "A11", bare=True)
        _error(error, study, amplitude)
        ratio.set_title(f"amplitude {amplitude:g} of the mean gap", fontsize=10)
        error.set_xlabel("length of a wave over the mean gap, L/h̄")
    panels[0, 0].set_ylabel("Stokes over Reynolds")
    panels[1, 0].set_ylabel("off the exact flow, %")
    figure.legend(handles=_keys(bare=True), loc="outside lower center", ncols=6, fontsize=9)
    return figure


def _keys(*, bare: bool) -> list[Line2D]:
    names = {
        "exact": "exact Stokes flow",
        "homogenized": "Reynolds",
        "slope_corrected": "slope corrected",
        "perturbed": "low waves of any length",
        **({"bare": "1 − c⟨h′²⟩"} if bare else {}),
    }
    mesh = STYLES["stokes"]
    keys = [Line2D([], [], label=label, **LINES[name]) for name, label in names.items()]
    return [*keys, Line2D([], [], color=mesh.colour, marker="o", linestyle="", label="OpenFOAM, extrapolated")]


def _of(rows: Sequence[Wave], amplitude: float) -> list[Wave]:
    return sorted((wave for wave in rows if wave.amplitude == amplitude), key=lambda wave: wave.length)


def _ratio(axes: Axes, study: RoughGapStudy, amplitude: float, name: str, *, bare: bool = False) -> None:
    drawn = _of(study.waves.drawn, amplitude)
    lengths = [wave.length for wave in drawn]
    exact = [(wave.length, wave.exact[name]) for wave in drawn if name in wave.exact]
    axes.plot(*np.transpose(exact), **LINES["exact"])
    theory = [wave.found.theory[name] for wave in drawn]
    axes.fill_between(lengths, [one.bound for one in theory], 1, color=STYLES["slope_corrected"].colour, alpha=0.10)
    axes.plot(lengths, [one.corrected for one in theory], **LINES["slope_corrected"])
    axes.plot(lengths, [one.perturbed for one in theory], **LINES["perturbed"])
    if bare:
        axes.plot(lengths, [1 - bare_coefficient(amplitude) * wave.slope**2 for wave in drawn], **LINES["bare"])
    for wave in _of(study.waves.resolved, amplitude):
        if (found := wave.found.resolved.get(name)) is not None:
            axes.errorbar(wave.length, found.value, found.uncertainty, **_mark())
    for length in MARKED:
        axes.axvline(length, color="#dde2e8", linewidth=0.8, zorder=0)
    axes.set_xscale("log")
    axes.set_xticks([1, 2.5, 5, 10, 20, 40], ["1", "2.5", "5", "10", "20", "40"])
    axes.xaxis.minorticks_off()
    if name != "friction":
        axes.set_ylim(0.3, 1.03)


def _mark() -> dict[str, Any]:
    return {"color": STYLES["stokes"].colour, "marker": "o", "markersize": 4.5, "capsize": 3, "linestyle": ""}


def _error(axes: Axes, study: RoughGapStudy, amplitude: float) -> None:
    drawn = [wave for wave in _of(study.waves.drawn, amplitude) if wave.exact]
    lengths = [wave.length for wave in drawn]
    rows = {
        "slope_corrected": [wave.found.theory["A11"].corrected for wave in drawn],
        "perturbed": [wave.found.theory["A11"].perturbed for wave in drawn],
        "bare": [1 - bare_coefficient(amplitude) * wave.slope**2 for wave in drawn],
    }
    for name, row in rows.items():
        off = [100 * abs(one / wave.exact["A11"] - 1) for one, wave in zip(row, drawn, strict=True)]
        axes.plot(lengths, np.maximum(off, 1e-3), **LINES[name])
    reynolds = [100 * abs(1 / wave.exact["A11"] - 1) for wave in drawn]
    axes.plot(lengths, reynolds, **LINES["homogenized"])
    for wave in _of(study.waves.resolved, amplitude):
        if "A11" in wave.exact and (found := wave.found.resolved.get("A11")) is not None:
            off_mesh = 100 * abs(found.value / wave.exact["A11"] - 1)
            axes.plot(wave.length, max(off_mesh, 1e-3), "o", color=STYLES["stokes"].colour, markersize=4.5)
    for level in (1, 5):
        axes.axhline(level, color="black", linewidth=0.6, linestyle=":")
    axes.set(yscale="log", ylim=(1e-3, 100))


def others(study: RoughGapStudy) -> Figure:
    """The other coefficients of the same waves."""
    names = [name for name in NAMES if name != "A11"]
    amplitudes = sorted({wave.amplitude for wave in study.waves.drawn})
    figure = Figure(figsize=(11, 3.8), layout="constrained")
    for axes, name in zip(figure.subplots(1, len(names)), names, strict=True):
        for colour, amplitude in zip(COLOURS, amplitudes, strict=False):
            drawn = _of(study.waves.drawn, amplitude)
            exact = [(wave.length, wave.exact[name]) for wave in drawn if name in wave.exact]
            axes.plot(*np.transpose(exact), color=colour, linewidth=1.4, label=f"a = {amplitude:g} h̄")
            corrected = [wave.found.theory[name].corrected for wave in drawn]
            axes.plot([wave.length for wave in drawn], corrected, color=colour, linestyle="--", linewidth=1)
            for wave in _of(study.waves.resolved, amplitude):
                if (found := wave.found.resolved.get(name)) is not None:
                    axes.errorbar(wave.length, found.value, found.uncertainty, **{**_mark(), "color": colour})
        axes.set_xscale("log")
        axes.set_xticks([1, 2.5, 5, 10, 20, 40], ["1", "2.5", "5", "10", "20", "40"])
        axes.xaxis.minorticks_off()
        axes.set_title(TITLES[name], fontsize=10)
        axes.set_xlabel("L/h̄")
    figure.axes[0].set_ylabel("Stokes over Reynolds")
    figure.axes[0].legend(fontsize=8)
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
        Line2D([], [], color=STYLES["stokes"].colour, marker="o", linestyle="", label="OpenFOAM, extrapolated"),
        Line2D([], [], color=STYLES["slope_corrected"].colour, marker="D", linestyle="", label="slope corrected"),
        Line2D([], [], color="#1b7837", marker="|", linestyle="", label="low waves of any length"),
        Patch(color=STYLES["slope_corrected"].colour, alpha=0.15, label="between the bounds"),
    ]
    figure.legend(handles=keys, loc="outside lower center", ncols=4, fontsize=9)
    return figure


def _row(axes: Axes, place: float, one: GapComparison, name: str) -> None:
    theory, colour = one.theory[name], STYLES["slope_corrected"].colour
    axes.barh(place, 1 - theory.bound, left=theory.bound, height=0.62, color=colour, alpha=0.15)
    axes.errorbar(
        theory.corrected, place - 0.14, xerr=theory.bar, color=colour, marker="D", markersize=4, capsize=3, linestyle=""
    )
    axes.plot(theory.perturbed, place, "|", color="#1b7837", markersize=9)
    if name in one.resolved:
        value, bar = best(one, name)
        axes.errorbar(value, place + 0.14, xerr=bar, **_mark())


def inertia(study: RoughGapStudy) -> Figure:
    """Loss of flow by inertia over Re and over the law of its group."""
    figure = Figure(figsize=(11, 4.8), layout="constrained")
    flows, laws = study.inertia.flows, {law.group: law for law in study.inertia.laws}
    measures: dict[str, Callable[[InertialLoss], float]] = {"Re": lambda one: one.reynolds_number}
    if laws:
        measures["by the law of its group, %"] = lambda one: (
            100 * laws[one.group].lost(one) if one.group in laws else np.nan
        )
    names = list(dict.fromkeys(one.name for one in flows))
    colours = mpl.colormaps["turbo"](np.linspace(0.05, 0.95, len(names)))
    panels = figure.subplots(1, len(measures), sharey=True, squeeze=False)[0]
    for axes, (title, measure) in zip(panels, measures.items(), strict=True):
        for colour, name in zip(colours, names, strict=True):
            own = [one for one in flows if one.name == name]
            marker = "o-" if own[0].group == RIDGES else "s--"
            y, bars = (
                [100 * part for part in parts] for parts in ([one.lost for one in own], [one.bar for one in own])
            )
            axes.errorbar(
                [measure(one) for one in own], y, bars, fmt=marker, color=colour, markersize=4, linewidth=1, capsize=2,
                elinewidth=0.8, label=name,
            )  # fmt: skip
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
    """How far Reynolds is off for real surfaces, over their rms slope and over the mean gap."""
    figure, (by_slope, by_gap) = new_figure((11, 4.8), 1, 2, sharey=True)
    order = sorted(study.reach, key=lambda one: one.slope)
    colours = mpl.colormaps["turbo"](np.linspace(0.05, 0.95, len(order)))
    for colour, one in zip(colours, order, strict=True):
        marker = "o" if one.measured else "s"
        errors = np.array([100 * off.error for off in one.found])
        bars = np.array([100 * off.bar for off in one.found])
        by_slope.errorbar(
            one.slope, np.median(errors), color=colour, marker=marker, markersize=6, linestyle="",
            yerr=[[np.median(errors) - errors.min()], [errors.max() - np.median(errors)]], label=one.name,
        )  # fmt: skip
        gaps = [off.thickness for off in one.found]
        by_gap.plot(gaps, errors, marker + "-", color=colour, markersize=4, linewidth=1)
        if one.slope < STEEP:
            by_gap.fill_between(gaps, np.maximum(errors - bars, 1e-7), errors + bars, color=colour, alpha=0.12)
    x = np.geomspace(min(one.slope for one in order) / 2, 1, 30)
    if study.factors:
        middle = float(np.median(study.factors))
        by_slope.plot(x, 100 * middle * x**2, "--", color="black", linewidth=1, label=f"{middle:.2g} g′²")
    for axes in (by_slope, by_gap):
        for level in (1, 5):
            axes.axhline(level, color="black", linewidth=0.7, linestyle=":")
        axes.set(xscale="log", yscale="log", ylim=(3e-6, 3000))
    by_slope.set(xlabel="rms slope g′", ylabel="Reynolds lets through too much, % of Stokes flow")
    by_gap.set_xlabel("mean gap over rms height, h̄/Sq")
    by_gap.set_xticks([2, 3, 5, 10, 20, 30], ["2", "3", "5", "10", "20", "30"])
    by_gap.xaxis.minorticks_off()
    figure.legend(loc="outside right upper", fontsize=8)
    return figure


def pixels(study: RoughGapStudy) -> Figure:
    """The rms slope, and with it the error, over the pixel on which a surface is looked at."""
    figure, (left, right) = new_figure((11, 3.8), 1, 2)
    order = sorted(study.reach, key=lambda one: one.slope)
    colours = mpl.colormaps["turbo"](np.linspace(0.05, 0.95, len(order)))
    for colour, one in zip(colours, order, strict=True):
        marker = "o" if one.measured else "s"
        x = [coarse.pixel * 1e6 for coarse in one.coarser]
        left.plot(x, [coarse.slope for coarse in one.coarser], marker + "-", color=colour, markersize=4, linewidth=1)
        slopes = [coarse.slope for coarse in one.coarser]
        errors = [100 * coarse.error for coarse in one.coarser]
        right.plot(slopes, errors, marker + "-", color=colour, markersize=4, linewidth=1, label=one.name)
    for axes in (left, right):
        axes.set(xscale="log", yscale="log")
    for level in (1, 5):
        right.axhline(level, color="black", linewidth=0.7, linestyle=":")
    left.set(xlabel="pixel, µm", ylabel="rms slope g′")
    right.set(xlabel="rms slope g′ on that pixel", ylabel="off at twice the highest point, %")
    return figure


def map_of_rungs(study: RoughGapStudy) -> Figure:
    """The cheapest rung that is good enough, over slope and wavelength."""
    figure = Figure(figsize=(11, 4.4), layout="constrained")
    slopes, lengths = (sorted({getattr(one, name) for one in study.map}) for name in ("slope", "length"))
    colours = ListedColormap([STYLES[name].colour or "black" for name in RUNGS])
    for axes, level in zip(figure.subplots(1, 2, sharey=True), LEVELS, strict=True):
        cheapest = np.full((len(slopes), len(lengths)), np.nan)
        for one in study.map:
            cheapest[slopes.index(one.slope), lengths.index(one.length)] = RUNGS.index(one.cheapest(level))
        axes.pcolormesh(
            _edges(lengths), _edges(slopes), cheapest, cmap=colours, alpha=0.75,
            norm=BoundaryNorm(np.arange(len(RUNGS) + 1) - 0.5, len(RUNGS)), rasterized=True,
        )  # fmt: skip
        axes.grid(visible=False)
        axes.set_facecolor("#f0f2f5")
        axes.set(xscale="log", yscale="log")
        axes.set_xticks([2, 5, 10, 20, 50], ["2", "5", "10", "20", "50"])
        axes.xaxis.minorticks_off()
        axes.set_title(f"within {100 * level:.0f} %", fontsize=10)
        axes.set_xlabel("wavelength over mean gap, λ/h̄")
    figure.axes[0].set_ylabel("rms slope g′")
    keys = [Patch(color=STYLES[name].colour, alpha=0.75, label=name) for name in RUNGS]
    keys.append(Patch(color="#f0f2f5", label="waves as high as the gap"))
    figure.legend(handles=keys, loc="outside lower center", ncols=5, fontsize=9)
    return figure


def _edges(values: Sequence[float]) -> Array:
    logs = np.log(values)
    middle = (logs[1:] + logs[:-1]) / 2
    return np.asarray(np.exp(np.concatenate([[2 * logs[0] - middle[0]], middle, [2 * logs[-1] - middle[-1]]])))

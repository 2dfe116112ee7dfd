"""Figures F.5 to F.12 of Paper F, and figures of the offset, the size, and the cell against the direct solution."""

import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, NullFormatter
from scipy.special import erf

from roughfilm.contact.foundation.arrays import Array
from roughfilm.figures.base import new_figure
from scripts.studies.paper_f.claims import LEAKAGE, RANGE, SEALING, above_the_cell, subtracted
from scripts.studies.paper_f.data import MODULUS, Pressed
from scripts.studies.paper_f.fits import SLOPE, LeakageLaw, SealStudy, scale_of
from scripts.studies.paper_f.surfaces import HEIGHTS

COLOURS = (
    *("#08519c", "#4292c6", "#d94801", "#fdae6b", "#8c6d31", "#238b45", "#74c476"),
    *("#6a51a3", "#9e9ac8", "#c51b8a", "#f768a1"),
)
"""Colours of the families: blue for random, orange and brown for skewed, green with a lay, violet for self-affine."""

COMPUTED, SOURCE = "#1d2530", "#b42318"
"""Colours of fitted laws, and of the laws of the source."""

DENSITY, VISCOSITY, PRESSURE_DROP, LENGTH = 1e3, 1e-3, 1e6, 1e-3
"""Density, kg/m³, viscosity, Pa s, pressure drop, Pa, and length, m, of the source."""

MIN_LEAKAGE = 1e-6
"""Least leakage that is drawn, kg/(h m)."""


def kilograms(permeability: Array) -> Array:
    """Return the leakage per width, 3600 ρ K Δp/(12 η L), kg/(h m), for permeabilities K, m³."""
    return 3600 * DENSITY * permeability * PRESSURE_DROP / (12 * VISCOSITY * LENGTH)


def _colours(study: SealStudy) -> Mapping[str, str]:
    families = dict.fromkeys(one.family for one in study.sample)
    return dict(zip(families, COLOURS, strict=False))


def _firsts(study: SealStudy) -> dict[str, Pressed]:
    """Return the first surface of each family."""
    return {one.family: one for one in reversed(study.sample)}


def _limits_of_area(axes: Axes) -> None:
    for part in RANGE:
        axes.axhline(100 * part, color=COMPUTED, lw=0.8, ls="--")


def _legend(figure: Figure, study: SealStudy) -> None:
    handles = [Line2D([], [], color=colour, label=name, lw=2) for name, colour in _colours(study).items()]
    figure.legend(handles=handles, loc="outside lower center", ncols=6, fontsize=8)


def _panels(rows: int, columns: int, height: float) -> tuple[Figure, list[Axes]]:
    figure, panels = new_figure((10.5, height * rows), rows, columns, squeeze=False)
    return figure, list(panels.ravel())


def _area(study: SealStudy) -> Figure:
    figure, (left, right) = _panels(1, 2, 4.6)
    colours = _colours(study)
    for one in (*study.sample, *study.measured):
        colour = colours.get(one.family, "#888888")
        for axes, unit in ((left, 1e6), (right, MODULUS * one.numbers.slope)):
            axes.plot(one.loads / unit, 100 * one.area, color=colour, lw=0.7, alpha=0.7)
            for i, face in ((0, colour), (1, "white")):
                axes.plot(one.threshold[i] / unit, 100 * one.sealed_area[i], "o", color=colour, mfc=face, ms=4)
    for axes in (left, right):
        _limits_of_area(axes)
        axes.set(ylabel="real area of contact, %", ylim=(0, 90))
    x = np.linspace(0, 0.8, 200)
    right.plot(x, 100 * erf(np.sqrt(2) * x), ":", color=COMPUTED)
    left.set(xlim=(0, 1.6), xlabel="load W, MPa")
    right.set(xlim=(0, 0.8), xlabel="W/(E* g′)")
    _legend(figure, study)
    return figure


def _spots(study: SealStudy) -> Figure:
    firsts = list(_firsts(study).values())[::-1]
    rows = math.ceil(len(firsts) / 3)
    figure, grid = new_figure((10.5, 2.05 * rows), rows, 6, squeeze=False)
    panels = grid.ravel()
    for axes in panels:
        axes.set_axis_off()
    shades = ListedColormap(["#e8eef5", COMPUTED])
    for number, one in enumerate(firsts):
        for i, sign in ((0, "→"), (1, "↑")):
            axes = panels[2 * number + i]
            axes.imshow(one.spots[i].T, cmap=shades, origin="lower", interpolation="nearest")
            label = f"{sign} {one.threshold[i] / 1e6:.2g} MPa, {100 * one.sealed_area[i]:.0f} %"
            axes.set_title(f"{one.family} {label}" if i == 0 else label, fontsize=7)
    return figure


def _heights(study: SealStudy) -> Figure:
    figure, panels = _panels(2, 4, 2.9)
    for axes, name in zip(panels, HEIGHTS, strict=True):
        _thresholds(axes, study, name, 1e6)
        axes.set_xlabel(f"{name}, µm")
        if name == "Spm":
            ends = np.array(axes.get_xlim())
            axes.plot(ends, SEALING * MODULUS * ends / 1e12, color=SOURCE, lw=1.2, label="W = 3.6e4 E Spm")
            axes.legend(fontsize=7, loc="lower right")
    for axes in panels[::4]:
        axes.set_ylabel("W at the threshold, MPa")
    _legend(figure, study)
    return figure


def _thresholds(axes: Axes, study: SealStudy, name: str, unit: float) -> None:
    law, colours = study.laws["all"].sealing[name], _colours(study)
    for one in study.sample:
        x = scale_of(one, name) * unit
        axes.plot([x, x], one.threshold / 1e6, ".", color=colours[one.family], ms=5, alpha=0.8)
    axes.set(xscale="log", yscale="log")
    axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axes.xaxis.set_major_formatter("{x:g}")
    axes.xaxis.set_minor_formatter(NullFormatter())
    ends = np.array(axes.get_xlim())
    axes.plot(ends, law.constant.value * MODULUS * ends / unit / 1e6, color=COMPUTED, lw=1)
    axes.set_xlim(*ends)
    axes.set_title(f"spread {law.spread:.3g}, R² {law.explained:.2f}", fontsize=8)


def _sealing_law(study: SealStudy) -> Figure:
    figure, (left, middle, right) = _panels(1, 3, 3.7)
    colours, laws = _colours(study), study.laws["all"]
    for one in study.sample:
        colour = colours[one.family]
        length, k = one.numbers.heights["Sq"] / one.numbers.slope, one.threshold / MODULUS / one.numbers.heights["Spm"]
        left.plot(np.full(2, 1e6 * length), k, ".", color=colour, ms=5)
        load = one.threshold / (MODULUS * one.numbers.slope)
        right.plot(np.full(2, one.numbers.skewness), load, ".", color=colour, ms=5)
    left.axhline(SEALING, color=SOURCE, lw=1.2)
    left.set(xlabel="Sq/g′, µm", ylabel="W/(E* Spm), 1/m")
    _thresholds(middle, study, SLOPE, 1.0)
    middle.set(xlabel="g′", ylabel="W at the threshold, MPa")
    x = np.linspace(*right.get_xlim(), 50)
    right.plot(x, laws.skewed.constant.value * np.exp(laws.skewed.skewness.value * x), color=COMPUTED, lw=1)
    right.set(xlabel="Ssk", ylabel="W/(E* g′)")
    for axes in (left, right):
        axes.set_yscale("log")
    _legend(figure, study)
    return figure


def _leakage(study: SealStudy) -> Figure:
    figure, (left, right) = _panels(1, 2, 4.4)
    colours = _colours(study)
    for family, one in _firsts(study).items():
        for flow, look in ((one.flow[:, 0], {"lw": 1}), (one.direct[:, 0], {"ls": "", "marker": "o", "ms": 4})):
            left.plot(one.loads[flow > 0], kilograms(flow[flow > 0]), color=colours[family], mfc="none", **look)
    left.set(xscale="log", yscale="log", ylim=(MIN_LEAKAGE, None), xlabel="load W, Pa", ylabel="leakage, kg/(h m)")
    parts, more = above_the_cell(study.sample)
    right.plot(parts, 1 + more, ".", color="#4292c6", ms=2.5, alpha=0.5)
    _bands(right, parts, 1 + more, COMPUTED)
    right.set(xscale="log", yscale="log", ylim=(0.9, 100))
    right.set(xlabel="load over the one that seals the cell", ylabel="DNS/HNS")
    _legend(figure, study)
    return figure


def _bands(axes: Axes, parts: Array, values: Array, colour: str) -> None:
    """Draw the median and the 90th percentile of the values over bins with equal numbers of values."""
    order = np.argsort(parts)
    bins = [one for one in np.array_split(order, 12) if one.size]
    places = [float(np.median(parts[one])) for one in bins]
    axes.plot(places, [float(np.nanmedian(values[one])) for one in bins], color=colour, lw=1.4)
    axes.plot(places, [float(np.nanpercentile(values[one], 90)) for one in bins], color=colour, lw=1.4, ls="--")


def _same_heights(study: SealStudy) -> Figure:
    figure, panels = _panels(2, 4, 2.8)
    colours = _colours(study)
    apart = {one.scale[0]: one.apart for one in study.laws["all"].collapses if one.scale[0] == one.scale[1]}
    for axes, name in zip(panels, HEIGHTS, strict=True):
        mean = float(np.mean([one.numbers.heights[name] for one in study.sample]))
        for one in study.sample:
            factor = mean / one.numbers.heights[name]
            for i in (0, 1):
                flow = kilograms(one.direct[:, i] * factor**3)
                axes.plot(
                    one.loads * factor,
                    np.where(flow > MIN_LEAKAGE, flow, np.nan),
                    color=colours[one.family],
                    lw=0.5,
                )
        axes.set(xscale="log", yscale="log", ylim=(MIN_LEAKAGE, 1e2), xlim=(1e1, 2e6))
        label = ", ".join(f"{10**value:.2g}" for value in apart[name][:2])
        axes.set_title(f"{name} = {1e6 * mean:.3g} µm; spread {label}", fontsize=8)
    for axes in panels[::4]:
        axes.set_ylabel("kg/(h m)")
    for axes in panels[4:]:
        axes.set_xlabel("load, Pa")
    _legend(figure, study)
    return figure


def _dimensionless(study: SealStudy) -> Figure:
    figure, panels = _panels(1, 2, 4.2)
    colours = _colours(study)
    for one in study.sample:
        valley = one.numbers.heights["Svm"]
        x = one.loads / MODULUS * 1e-6 / valley
        for axes, height in zip(panels, (np.full(x.shape, valley), one.valley), strict=True):
            for i in (0, 1):
                y = one.direct[:, i] / height**3
                axes.plot(x, np.where(y > 1e-6, y, np.nan), color=colours[one.family], lw=0.6)
    for axes, name in zip(panels, ("Svm", "Svm under load"), strict=True):
        axes.axhline(1, color=COMPUTED, lw=0.8)
        axes.set(
            xscale="log",
            yscale="log",
            ylim=(1e-6, 1e3),
            xlabel="W/E*, for Svm = 1 µm",
            ylabel=f"12 η Q/(h³ p), h = {name}",
        )
    _legend(figure, study)
    return figure


def _closed_form(study: SealStudy) -> Figure:
    figure, (axes,) = _panels(1, 1, 4.4)
    colours = _colours(study)
    for family, one in _firsts(study).items():
        for axis, marker in enumerate("ox"):
            leaks = one.direct[:, axis] > 0
            shown = kilograms(one.direct[leaks, axis])
            axes.plot(one.loads[leaks], shown, marker, color=colours[family], ms=4, mfc="none")
        height = LEAKAGE[0] * np.cbrt(scale_of(one, "Svm")) - LEAKAGE[1] * np.cbrt(one.loads / MODULUS)
        axes.plot(one.loads, kilograms(np.maximum(height, 0.0) ** 9), color=colours[family], lw=1)
    axes.set(xscale="log", yscale="log", ylim=(MIN_LEAKAGE, None), xlabel="load W, Pa", ylabel="leakage, kg/(h m)")
    _legend(figure, study)
    return figure


def _leakage_law(study: SealStudy) -> Figure:
    figure, panels = _panels(1, 2, 4.2)
    fitted = study.laws["all"].leakage
    pairs = {("Svm", "Svm"): "(W/(E* Svm))^⅓, 1/m^⅓", ("Sp", SLOPE): "(W/(E* g′))^⅓"}
    for axes, (pair, load) in zip(panels, pairs.items(), strict=True):
        _line(axes, study, fitted[pair])
        axes.set(xlabel=load, ylabel=f"(K/{pair[0]}³)^(1/9)")
    x = np.array(panels[0].get_xlim())
    panels[0].plot(x, LEAKAGE[0] - LEAKAGE[1] * x, color=SOURCE, lw=1.4, label="1.1 − 0.023 x, the source")
    for axes in panels:
        axes.legend(fontsize=8)
    _legend(figure, study)
    return figure


def _line(axes: Axes, study: SealStudy, law: LeakageLaw) -> None:
    colours, (height, load) = _colours(study), law.scale
    for one in study.sample:
        x = np.cbrt(one.loads / (MODULUS * scale_of(one, load)))
        for i in (0, 1):
            y = (one.direct[:, i] / scale_of(one, height) ** 3) ** (1 / 9)
            axes.plot(x, np.where(y > 0, y, np.nan), ".", color=colours[one.family], ms=3, alpha=0.7)
    ends = np.array([0.0, axes.get_xlim()[1]])
    label = f"{law.a.value:.3g} − {law.b.value:.3g} x, R² {law.explained:.2f}"
    axes.plot(ends, law.a.value - law.b.value * ends, color=COMPUTED, lw=1.4, label=label)
    axes.set(xlim=ends, ylim=(0, 1.9))


def _size(study: SealStudy) -> Figure:
    figure, panels = _panels(1, 2, 3.6)
    draw = np.random.default_rng(11)
    rows: Sequence[tuple[Mapping[float, Array], float, str]] = (
        (study.sizes.area, 100.0, "real area of contact, %"),
        (study.sizes.load, 1.0, "W/(E* g′)"),
    )
    for axes, (by_length, unit, name) in zip(panels, rows, strict=True):
        for lengths, values in by_length.items():
            ends = unit * values[:, :2].ravel()
            axes.plot(lengths * np.exp(draw.uniform(-0.1, 0.1, ends.size)), ends, ".", color="#4292c6", ms=4)
            axes.errorbar(lengths, ends.mean(), ends.std(), color=COMPUTED, fmt="o", ms=5, capsize=5, lw=1.4)
        axes.set_xscale("log", base=2)
        axes.set_xticks(list(by_length), [f"{one:.3g}" for one in by_length])
        axes.set(xlabel="side, correlation lengths Sal", ylabel=name)
    _limits_of_area(panels[0])
    return figure


def _offset(study: SealStudy) -> Figure:
    figure, panels = _panels(1, 2, 3.9)
    leakage = subtracted(study.sample)
    for axes, values, name in zip(
        panels, (leakage.added, leakage.error), ("as it is", "after subtraction"), strict=True
    ):
        drawn = axes.scatter(
            leakage.part, 1 + values, c=1e6 * leakage.average, s=4, cmap="viridis", norm="log", rasterized=True
        )
        _bands(axes, leakage.part, 1 + values, COMPUTED)
        axes.set_title(name, fontsize=9)
        axes.set(yscale="log", ylim=(0.5, 1e4), xlabel="load over the one that seals the cell")
    panels[0].set_ylabel("leakage over that with closed contact")
    bar = figure.colorbar(drawn, ax=panels, label="Sa, µm", ticks=[0.06, 0.12, 0.24, 0.48], format="%g")
    bar.ax.yaxis.set_minor_formatter(NullFormatter())
    return figure


DRAWINGS: dict[str, Callable[[SealStudy], Figure]] = {
    "F.5": _area,
    "F.6": _spots,
    "F.7": _heights,
    "sealing law": _sealing_law,
    "F.9": _leakage,
    "F.10": _same_heights,
    "F.11": _dimensionless,
    "F.12": _closed_form,
    "leakage law": _leakage_law,
    "size": _size,
    "offset": _offset,
}
"""Functions that draw the figures, by name, in the order of the page."""

"""Figures F.5 to F.12 of Paper F, and what they do not show: offset, size, and the cell beside the reservoirs."""

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
from scripts.studies.paper_f.data import MODULUS
from scripts.studies.paper_f.fits import SLOPE, LeakageLaw, scale_of
from scripts.studies.paper_f.laws import SealStudy
from scripts.studies.paper_f.surfaces import HEIGHTS

COLOURS = (
    *("#08519c", "#4292c6", "#d94801", "#fdae6b", "#8c6d31", "#238b45", "#74c476"),
    *("#6a51a3", "#9e9ac8", "#c51b8a", "#f768a1"),
)
"""Colours of the families: random blue, skewed orange and brown, with a lay green, self-affine violet."""

FOUND, SOURCE = "#1d2530", "#b42318"
DENSITY, VISCOSITY, DROP, LENGTH = 1e3, 1e-3, 1e6, 1e-3
"""kg/m³, Pa s, Pa, m, of the source."""

LEAST = 1e-6
"""kg/(h m); below it leakage is not drawn."""


def kilograms(permeability: Array) -> Array:
    """Leakage per width over the length of the source, kg/(h m): 3600 ρ K Δp/(12 η L)."""
    return 3600 * DENSITY * permeability * DROP / (12 * VISCOSITY * LENGTH)


def _colours(study: SealStudy) -> Mapping[str, str]:
    families = dict.fromkeys(one.family for one in study.sample)
    return dict(zip(families, COLOURS, strict=False))


def _legend(figure: Figure, study: SealStudy) -> None:
    handles = [Line2D([], [], color=colour, label=name, lw=2) for name, colour in _colours(study).items()]
    figure.legend(handles=handles, loc="outside lower center", ncols=6, fontsize=8)


def _panels(rows: int, columns: int, height: float) -> tuple[Figure, list[Axes]]:
    figure = Figure(figsize=(10.5, height * rows), layout="constrained")
    return figure, list(figure.subplots(rows, columns, squeeze=False).ravel())


def area(study: SealStudy) -> Figure:
    """Real area of contact until both directions are sealed (dots: along x full, along y white; dashed: 33 and 55 %).

    Left as the source has it; right over E* times the rms slope, where surfaces fall together. Grey: measured ones.
    Dotted: Persson's erf(√2 W/(E* g′)).
    """
    figure, (left, right) = _panels(1, 2, 4.6)
    colours = _colours(study)
    for one in (*study.sample, *study.measured):
        colour = colours.get(one.family, "#888888")
        for axes, unit in ((left, 1e6), (right, MODULUS * one.numbers.slope)):
            axes.plot(one.loads / unit, 100 * one.area, color=colour, lw=0.7, alpha=0.7)
            for i, face in ((0, colour), (1, "white")):
                axes.plot(one.threshold[i] / unit, 100 * one.sealed_area[i], "o", color=colour, mfc=face, ms=4)
    for axes in (left, right):
        for part in RANGE:
            axes.axhline(100 * part, color=FOUND, lw=0.8, ls="--")
        axes.set(ylabel="real area of contact, %", ylim=(0, 90))
    x = np.linspace(0, 0.8, 200)
    right.plot(x, 100 * erf(np.sqrt(2) * x), ":", color=FOUND)
    left.set_xlim(0, 1.6)
    right.set_xlim(0, 0.8)
    left.set_xlabel("load W, MPa")
    right.set_xlabel("W/(E* g′)")
    _legend(figure, study)
    return figure


def spots(study: SealStudy) -> Figure:
    """Contact (dark) when the last path from end to end closes: along x (left of each pair) and along y."""
    firsts = list({one.family: one for one in reversed(study.sample)}.values())[::-1]
    rows = math.ceil(len(firsts) / 3)
    figure, grid = new_figure((10.5, 2.05 * rows), rows, 6, squeeze=False)
    panels = grid.ravel()
    for axes in panels:
        axes.set_axis_off()
    shades = ListedColormap(["#e8eef5", FOUND])
    for number, one in enumerate(firsts):
        for i, sign in ((0, "→"), (1, "↑")):
            axes = panels[2 * number + i]
            axes.imshow(one.spots[i].T, cmap=shades, origin="lower", interpolation="nearest")
            label = f"{sign} {one.threshold[i] / 1e6:.2g} MPa, {100 * one.sealed_area[i]:.0f} %"
            axes.set_title(f"{one.family} {label}" if i == 0 else label, fontsize=7)
    return figure


def heights(study: SealStudy) -> Figure:
    """Load at the threshold over the eight heights, both directions; lines: geometric mean of the ratio; red: F.14.

    The spread is the standard deviation of the ratio, as a factor.
    """
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
    axes.plot(ends, law.constant.value * MODULUS * ends / unit / 1e6, color=FOUND, lw=1)
    axes.set_xlim(*ends)
    axes.set_title(f"spread {law.spread:.3g}, R² {law.explained:.2f}", fontsize=8)


def pure(study: SealStudy) -> Figure:
    """Left: k of F.14 falls as the length Sq/g′ of a surface grows; red: k of the source.

    Middle: load over the rms slope, whose ratio is a pure number; line: geometric mean. Right: that number over the
    skewness, with the fitted law.
    """
    figure, (left, middle, right) = _panels(1, 3, 3.7)
    colours, laws = _colours(study), study.laws["all"]
    for one in study.sample:
        colour = colours[one.family]
        length, k = one.numbers.heights["Sq"] / one.numbers.slope, one.threshold / MODULUS / one.numbers.heights["Spm"]
        left.plot(np.full(2, 1e6 * length), k, ".", color=colour, ms=5)
        right.plot(
            np.full(2, one.numbers.skewness), one.threshold / (MODULUS * one.numbers.slope), ".", color=colour, ms=5
        )
    left.axhline(SEALING, color=SOURCE, lw=1.2)
    left.set(xlabel="Sq/g′, µm", ylabel="W/(E* Spm), 1/m")
    _thresholds(middle, study, SLOPE, 1.0)
    middle.set(xlabel="g′", ylabel="W at the threshold, MPa")
    x = np.linspace(*right.get_xlim(), 50)
    right.plot(x, laws.skewed.constant.value * np.exp(laws.skewed.skewness.value * x), color=FOUND, lw=1)
    right.set(xlabel="Ssk", ylabel="W/(E* g′)")
    for axes in (left, right):
        axes.set_yscale("log")
    _legend(figure, study)
    return figure


def leakage(study: SealStudy) -> Figure:
    """Leakage along x, a surface of each family: HNS (lines) and DNS (circles), 1 MPa over 1 mm, 10³ kg/m³, 1 mPa s.

    Right: DNS over HNS of all surfaces and directions; line: median, dashed: nine in ten below.
    """
    figure, (left, right) = _panels(1, 2, 4.4)
    colours = _colours(study)
    firsts = {one.family: one for one in reversed(study.sample)}
    for family, one in firsts.items():
        open_cell, open_ends = one.flow[:, 0] > 0, one.direct[:, 0] > 0
        left.plot(one.loads[open_cell], kilograms(one.flow[open_cell, 0]), color=colours[family], lw=1)
        left.plot(
            one.loads[open_ends], kilograms(one.direct[open_ends, 0]), "o", color=colours[family], ms=4, mfc="none"
        )
    left.set(xscale="log", yscale="log", ylim=(LEAST, None), xlabel="load W, Pa", ylabel="leakage, kg/(h m)")
    parts, more = above_the_cell(study.sample)
    right.plot(parts, 1 + more, ".", color="#4292c6", ms=2.5, alpha=0.5)
    _bands(right, parts, 1 + more, FOUND)
    right.set(
        yscale="log", xscale="log", ylim=(0.9, 100), xlabel="load over the one that seals the cell", ylabel="DNS/HNS"
    )
    _legend(figure, study)
    return figure


def _bands(axes: Axes, parts: Array, values: Array, colour: str) -> None:
    """The median and the 90th percentile over bins of equal counts."""
    order = np.argsort(parts)
    bins = [one for one in np.array_split(order, 12) if one.size]
    places = [float(np.median(parts[one])) for one in bins]
    axes.plot(places, [float(np.nanmedian(values[one])) for one in bins], color=colour, lw=1.4)
    axes.plot(places, [float(np.nanpercentile(values[one], 90)) for one in bins], color=colour, lw=1.4, ls="--")


def same_heights(study: SealStudy) -> Figure:
    """Leakage of all surfaces in both directions (DNS) scaled to the same height, which is the mean of all."""
    figure, panels = _panels(2, 4, 2.8)
    colours = _colours(study)
    apart = {one.scale[0]: one.apart for one in study.laws["all"].collapses if one.scale[0] == one.scale[1]}
    for axes, name in zip(panels, HEIGHTS, strict=True):
        mean = float(np.mean([one.numbers.heights[name] for one in study.sample]))
        for one in study.sample:
            factor = mean / one.numbers.heights[name]
            for i in (0, 1):
                flow = kilograms(one.direct[:, i] * factor**3)
                axes.plot(one.loads * factor, np.where(flow > LEAST, flow, np.nan), color=colours[one.family], lw=0.5)
        axes.set(xscale="log", yscale="log", ylim=(LEAST, 1e2), xlim=(1e1, 2e6))
        label = ", ".join(f"{10**value:.2g}" for value in apart[name][:2])
        axes.set_title(f"{name} = {1e6 * mean:.3g} µm; spread {label}", fontsize=8)
    for axes in panels[::4]:
        axes.set_ylabel("kg/(h m)")
    for axes in panels[4:]:
        axes.set_xlabel("load, Pa")
    _legend(figure, study)
    return figure


def dimensionless(study: SealStudy) -> Figure:
    """Leakage (DNS) over that of a smooth gap as high as Svm (left) and as Svm under load (right), both directions.

    Loads for surfaces of Svm = 1 µm. Under load Svm hardly changes, and does not follow the leakage.
    """
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
        axes.set(xscale="log", yscale="log")
        axes.axhline(1, color=FOUND, lw=0.8)
        axes.set(ylim=(1e-6, 1e3), xlabel="W/E*, for Svm = 1 µm", ylabel=f"12 η Q/(h³ p), h = {name}")
    _legend(figure, study)
    return figure


def closed_form(study: SealStudy) -> Figure:
    """Leakage of a surface of each family by DNS, in x (circles) and y (crosses), and by F.18 as the source has it.

    The closed form (lines) knows no direction, and no sealing but where its base is 0.
    """
    figure, (axes,) = _panels(1, 1, 4.4)
    colours = _colours(study)
    firsts = {one.family: one for one in reversed(study.sample)}
    for family, one in firsts.items():
        for axis, marker in enumerate("ox"):
            leaks = one.direct[:, axis] > 0
            shown = kilograms(one.direct[leaks, axis])
            axes.plot(one.loads[leaks], shown, marker, color=colours[family], ms=4, mfc="none")
        height = LEAKAGE[0] * np.cbrt(scale_of(one, "Svm")) - LEAKAGE[1] * np.cbrt(one.loads / MODULUS)
        axes.plot(one.loads, kilograms(np.maximum(height, 0.0) ** 9), color=colours[family], lw=1)
    axes.set(xscale="log", yscale="log", ylim=(LEAST, None), xlabel="load W, Pa", ylabel="leakage, kg/(h m)")
    _legend(figure, study)
    return figure


def laws(study: SealStudy) -> Figure:
    """F.18 as a straight line, K = s³ (a − b (W/(E* r))^⅓)⁹, K = 12ηQL/Δp by DNS, both directions.

    Left: s = r = Svm, as the source has it (red: its constants). Right: s = Sp, the mean gap at the first touch, with
    loads over the rms slope.
    """
    figure, panels = _panels(1, 2, 4.2)
    fitted = study.laws["all"].leakage
    for axes, pair in zip(panels, (("Svm", "Svm"), ("Sp", SLOPE)), strict=True):
        _line(axes, study, fitted[pair])
    x = np.array(panels[0].get_xlim())
    panels[0].plot(x, LEAKAGE[0] - LEAKAGE[1] * x, color=SOURCE, lw=1.4, label="1.1 − 0.023 x, the source")
    panels[0].set_xlabel("(W/(E* Svm))^⅓, 1/m^⅓")
    panels[1].set_xlabel("(W/(E* g′))^⅓")
    for axes, name in zip(panels, ("Svm", "Sp"), strict=True):
        axes.set_ylabel(f"(K/{name}³)^(1/9)")
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
    axes.plot(ends, law.a.value - law.b.value * ends, color=FOUND, lw=1.4, label=label)
    axes.set(xlim=ends, ylim=(0, 1.9))


def size(study: SealStudy) -> Figure:
    """One kind of random surface, larger and larger: area, and load over E* g′, when the last path closes.

    A dot for each surface and direction; bars: mean and standard deviation. Dashed: 33 and 55 %.
    """
    figure, panels = _panels(1, 2, 3.6)
    draw = np.random.default_rng(11)
    rows: Sequence[tuple[Mapping[float, Array], float, str]] = (
        (study.sizes.area, 100.0, "real area of contact, %"),
        (study.sizes.load, 1.0, "W/(E* g′)"),
    )
    for axes, (found, unit, name) in zip(panels, rows, strict=True):
        for lengths, values in found.items():
            ends = unit * values[:, :2].ravel()
            axes.plot(lengths * np.exp(draw.uniform(-0.1, 0.1, ends.size)), ends, ".", color="#4292c6", ms=4)
            axes.errorbar(lengths, ends.mean(), ends.std(), color=FOUND, fmt="o", ms=5, capsize=5, lw=1.4)
        axes.set_xscale("log", base=2)
        axes.set_xticks(list(found), [f"{one:.3g}" for one in found])
        axes.set(xlabel="side, correlation lengths Sal", ylabel=name)
    for part in RANGE:
        panels[0].axhline(100 * part, color=FOUND, lw=0.8, ls="--")
    return figure


def offset(study: SealStudy) -> Figure:
    """Leakage of the cell with 10 nm let through everywhere, over that with closed contact.

    Left as it is, right after what is left at the threshold is subtracted. Lines: median, and nine in ten below.
    """
    figure, panels = _panels(1, 2, 3.9)
    found = subtracted(study.sample)
    for axes, values, name in zip(panels, (found.added, found.error), ("as it is", "after subtraction"), strict=True):
        drawn = axes.scatter(
            found.part, 1 + values, c=1e6 * found.average, s=4, cmap="viridis", norm="log", rasterized=True
        )
        _bands(axes, found.part, 1 + values, FOUND)
        axes.set_title(name, fontsize=9)
        axes.set(yscale="log", ylim=(0.5, 1e4), xlabel="load over the one that seals the cell")
    panels[0].set_ylabel("leakage over that with closed contact")
    bar = figure.colorbar(drawn, ax=panels, label="Sa, µm", ticks=[0.06, 0.12, 0.24, 0.48], format="%g")
    bar.ax.yaxis.set_minor_formatter(NullFormatter())
    return figure


NUMBERED: dict[str, Callable[[SealStudy], Figure]] = {
    "F.5": area,
    "F.6": spots,
    "F.7": heights,
    "sealing law": pure,
    "F.9": leakage,
    "F.10": same_heights,
    "F.11": dimensionless,
    "F.12": closed_form,
    "leakage law": laws,
    "size": size,
    "offset": offset,
}
"""In the order of the page."""
